"""A recorded run as the source of pages: a node of its own replays it, faster than it was."""
from __future__ import annotations

import asyncio
import tempfile
import threading
from pathlib import Path
from typing import Any

from angen_apps.web.feed import Feed
from angen_apps.web.timeline import Timeline
from angen_tools.common.catalog import simulator
from angen_tools.common.failure import Failure
from angen_tools.live.sandbox import Sandbox

LOADING = 60.0  # s of wall time in which a run is read, where the machine is fast enough
LEAST_RATE = 4.0  # simulated seconds per second: positions are some tenths of a second apart
TURN = 0.1


class Recording(Feed):
    """A Source, see server.py. A context: its end ends the node."""

    def __init__(self, log: Path) -> None:
        super().__init__()
        with simulator() as angen:
            self._end = float(angen.Replay(str(log)).end)
        self.store = Timeline()
        self.store.put('status', {'node': False, 'replay': True})
        self.store.put('line', {'end': self._end, 'loaded': 0.0, 'name': log.name})
        self._log = log.resolve()
        self._folder = tempfile.TemporaryDirectory(prefix='angen_web_')
        self._sandbox = Sandbox(Path(self._folder.name))
        self._loaded = False

    def __enter__(self) -> Recording:
        from angen_apps.web.node import start_node
        start_node()
        self._subscribe_usual()
        threading.Thread(target=self._run, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self._sandbox.__exit__()
        self._folder.cleanup()

    def _run(self) -> None:
        try:
            rate = max(LEAST_RATE, self._end / LOADING)
            self._node = self._sandbox.node(None, rate, replay=self._log)
        except Failure as failure:
            print(f'angen web: {failure}', flush=True)

    async def serve(self) -> None:
        """Reads the run to its end, with browsers or without."""
        listed = -1
        while not self._loaded:
            await asyncio.sleep(TURN)
            number = self.store.part('scene') or 0
            if number != listed:
                listed = number
                threading.Thread(target=self._survey, daemon=True).start()
        self._unsubscribe_all()

    def want(self, topics: set[str] | None) -> None:
        pass

    async def order(self, order: dict[str, Any]) -> dict[str, Any]:
        raise ValueError('a recording takes no orders')

    def _on_changes(self, message: Any) -> None:
        self.store.put_changes(message.revision, message.links, message.poses, message.lights,
                               message.levels, message.header.stamp.to_sec())

    def _on_stats(self, message: Any) -> None:
        now = min(message.sim_time.to_sec(), self._end)
        self.store.put('line', {**self.store.part('line'), 'loaded': now})
        self._loaded = now >= self._end

    def _unsubscribe_all(self) -> None:
        for key in list(self._subscribers):
            self._drop(key)
        line = self.store.part('line')
        if self._loaded:
            self.store.put('line', {**line, 'loaded': self._end})
            threading.Thread(target=self._close_node, daemon=True).start()

    def _close_node(self) -> None:
        from angen_tools.live.sandbox import end
        end(self._node)
