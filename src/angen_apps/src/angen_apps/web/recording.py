"""A recorded run as the source of pages: it is replayed in this process."""
from pathlib import Path
from typing import Any

import numpy as np

from angen_apps.web.played import Lined
from angen_apps.web.store import summary
from angen_tools.common.catalog import simulator

TURN, MOST = 0.1, 6000  # s between two positions; so many at most
TICK = 1e-6  # s: at most a tick, in which devices set their lamps


class Recording(Lined):
    """A Source, see server.py."""

    def __init__(self, log: Path) -> None:
        with simulator() as angen:
            self._replay = angen.Replay(str(log))
        super().__init__(float(self._replay.end), log.name)
        self._revision = -1
        self._poses: Any = None
        self._levels: Any = None

    def _run(self) -> None:
        turn = max(TURN, self._line['end'] / MOST)
        with simulator():
            world, more = self._replay.present, self._replay.advance(TICK)
            while more:
                self._take(world)
                self._line['loaded'] = min(world.time, self._line['end'])
                self.store.put('line', dict(self._line))
                more = self._replay.advance(turn)
            self._take(world)
        self._finish()

    def _take(self, world: Any) -> None:
        """What has changed since the last call."""
        poses, levels = world.link_poses.astype(np.float32), np.array(world.light_levels, 'f4')
        if world.revision != self._revision:
            self._revision = world.revision
            moved = np.array(self._show(world), bool)
            lit = np.ones(len(levels), bool)
        else:
            moved, lit = (poses != self._poses).any(axis=1), levels != self._levels
        self._poses, self._levels = poses, levels
        links, lights = (np.flatnonzero(each).astype(np.uint32) for each in (moved, lit))
        self.store.put_changes(self._revision, links, poses[links].ravel(), lights, levels[lights],
                               world.time)
        self.store.put_rows([summary(*each) for each in world.summaries()], False)
        for time, source, kind, event, detail in world.events():
            self.store.add_event([time, kind, source, event, detail])
