"""Positions of the cabins and leaves of elevators in a recording, for its replay."""
from __future__ import annotations

from typing import Any, NamedTuple

LEAST = 0.002  # m: a link that has moved less is where it was
Place = tuple[float, float, float]


class Slide(NamedTuple):
    """The place of a link of an elevator from a time on."""

    time: float
    model: str
    link: str
    x: float
    y: float
    z: float


class Cabins:
    """Follows the elevators of a world from each event of theirs until they rest."""

    def __init__(self, world: Any) -> None:
        self._world = world
        self.slides: list[Slide] = []
        names = [name.split('::', 1) for name in world.links]
        self._rows = {name: [(i, model, link) for i, (model, link) in enumerate(names)
                             if model == own] for _, name, own, _ in world.entities('elevator')}
        self._placed: dict[int, Place] = {}
        self._moving: dict[str, float] = {}  # since when, by name
        for name in self._rows:
            self._note(0.0, name)

    def event(self, time: float, name: str) -> None:
        """An elevator began or ended a motion."""
        if name in self._rows:
            self._moving[name] = time

    def look(self) -> None:
        """Records the links that have moved."""
        for name, since in list(self._moving.items()):
            state = self._world.device('elevator', name)
            rests = state['mode'] == 'IDLE' and state['door_mode'] in ('OPEN', 'CLOSED')
            self._note(since if rests else self._world.time, name)  # it may have ended before
            if rests:
                del self._moving[name]

    def _note(self, time: float, name: str) -> None:
        poses = self._world.link_poses
        for row, model, link in self._rows[name]:
            x, y, z = (float(value) for value in poses[row, :3])
            before = self._placed.get(row)
            if before and max(abs(x - before[0]), abs(y - before[1]), abs(z - before[2])) < LEAST:
                continue
            self._placed[row] = (x, y, z)
            self.slides.append(Slide(time, model, link, x, y, z))
