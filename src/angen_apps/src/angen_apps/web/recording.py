"""A recorded run as the source of pages: a node of its own replays it, faster than it was."""
from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from angen_apps.web.played import Played
from angen_tools.common.catalog import simulator

LOADING = 60.0  # s of wall time in which a run is read, where the machine is fast enough
LEAST_RATE = 4.0  # simulated seconds per second: positions are some tenths of a second apart
TURN = 0.1
PARTS = ('scene', 'home', 'entities')  # what a run without duration has, too


class Recording(Played):
    """A Source, see server.py. A context: its end ends the node."""

    def __init__(self, log: Path) -> None:
        with simulator() as angen:
            length = float(angen.Replay(str(log)).end)
        super().__init__(length, log.name)
        self._log = log.resolve()

    def _run(self) -> None:
        """Reads the run to its end, with browsers or without."""
        rate = max(LEAST_RATE, self._line['end'] / LOADING)
        self._node = self._sandbox.node(None, rate, replay=self._log)
        listed = -1
        while self._now < self._line['end'] or not all(map(self.store.part, PARTS)):
            number = self.store.part('scene') or 0
            if number != listed:
                listed = number
                self._survey()
            time.sleep(TURN)
        self._unsubscribe_all()
        self._finish()
        self._end_node()

    def _on_stats(self, message: Any) -> None:
        self._now = message.sim_time.to_sec()
        self._line['loaded'] = min(self._now, self._line['end'])
        self.store.put('line', dict(self._line))
