"""/angen/summary: the last reading or state of every sensor and device, in words."""
import math
import time
from dataclasses import dataclass
from typing import Sequence

from angen_tools.common.catalog import is_robot, kinds
from angen_tools.session import Summary
from angen_tools.session.live import Live

PERIOD = 0.5  # s of wall time between two looks at the places of robots
RECENT = 5.0  # s of wall time for which a change counts as activity


@dataclass(frozen=True)
class Filter:
    """Which rows are shown; an empty part lets all pass."""

    names: Sequence[str] = ()
    kinds: Sequence[str] = ()
    room: str = ''
    active: bool = False

    def passes(self, kind: str, name: str, room: str = '') -> bool:
        """Whether a sensor or device is shown, whatever it does."""
        return ((not self.names or name in self.names)
                and (not self.kinds or kind in self.kinds)
                and any(self.room.lower() in text.lower() for text in (room, name)))


@dataclass(frozen=True)
class Row(Summary):
    """A sensor or device in a table."""

    room: str = ''
    place: str = ''  # a robot's, in the world: its state has that by its wheels
    changed: float = -math.inf  # s of wall time, when its text changed last

    @property
    def waits(self) -> bool:
        """Whether it is a sensor whose first reading has still to come."""
        return self.period > 0 and not self.text


class Board:
    """The summaries of a world, and the state of time in its simulation."""

    def __init__(self, world: Live) -> None:
        self.rows: dict[tuple[str, str], Row] = {}
        self.time = 0.0       # s simulated
        self.paused = False
        self._world = world
        entities = world.entities()
        self._rooms = {(e.kind, e.name): e.room for e in entities}
        self._robots = {name for name, kind in kinds('device').items() if is_robot(kind)
                        and any(e.kind == name for e in entities)}
        self._places: dict[str, str] = {}  # robots' by name
        self._placed = -math.inf  # s of wall time
        self._take()

    def receive(self, limit: float) -> bool:
        """Takes a change within `limit` s of wall time; false if none came."""
        return self._world.until(self._take, limit)

    def _take(self) -> bool:
        stats, before = self._world.stats, self.rows
        if self._robots and time.monotonic() - self._placed > PERIOD:
            self._placed = time.monotonic()
            self._places = {e.name: '{:.2f} m  {:.2f} m in the world'.format(*e.pose)
                            for e in self._world.entities() if e.kind in self._robots}
        self.rows = {key: self._row(key, summary, before.get(key))
                     for key, summary in self._world.summaries().items()}
        self.paused = bool(stats.paused)
        self.time = max([stats.sim_time.to_sec(), *(row.time for row in self.rows.values())])
        return self.rows != before

    def _row(self, key: tuple[str, str], new: Summary, old: Row | None) -> Row:
        place = self._places.get(key[1], '') if key[0] in self._robots else ''
        if old is None:
            return Row(**vars(new), room=self._rooms.get(key, ''), place=place)
        changed = old.changed if old.text == new.text else time.monotonic()
        return Row(**vars(new), room=old.room, place=place, changed=changed)

    def chosen(self, rule: Filter) -> list[Row]:
        """The rows to show, by kind and name."""
        rows = (row for _, row in sorted(self.rows.items())
                if rule.passes(row.kind, row.name, row.room))
        return [row for row in rows if not rule.active or is_active(row)]


def is_active(row: Row) -> bool:
    """Whether a row is an alarm; for kinds without alarms, whether it has changed lately."""
    kind = kinds().get(row.kind)
    if kind is not None and any(field['alarm'] for field in kind['fields']):
        return row.alarm
    return time.monotonic() - row.changed < RECENT
