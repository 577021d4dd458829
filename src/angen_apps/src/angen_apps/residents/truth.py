"""The ground truth of residents: place and activity of each, without gaps."""
from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Callable

HEAD = ('start', 'end', 'resident', 'activity', 'cause', 'phase', 'room', 'thing', 'posture', 'x',
        'y', 'note')


@dataclass(frozen=True)
class Interval:
    """A resident in one phase of an activity. Phases: goes, does, waits, away. `note`: failures
    of the plan."""

    start: float
    end: float
    resident: str
    activity: str
    cause: str
    phase: str
    room: str
    thing: str
    posture: str
    x: float
    y: float
    note: str = ''

    def row(self) -> list[str]:
        return [f'{self.start:.3f}', f'{self.end:.3f}', self.resident, self.activity, self.cause,
                self.phase, self.room, self.thing, self.posture, f'{self.x:.3f}', f'{self.y:.3f}',
                self.note]


class Diary:
    """The intervals of one resident; the newest is open."""

    def __init__(self) -> None:
        self.closed: list[Interval] = []
        self.now: Interval | None = None
        self.changed: Callable[[Interval], None] = lambda _: None  # with the newest

    def turn(self, interval: Interval) -> None:
        """Another phase begins."""
        self.end(interval.start)
        self.now = interval
        self.changed(interval)

    def end(self, time: float) -> None:
        """The present phase ends."""
        if self.now is not None and time > self.now.start:
            self.closed.append(replace(self.now, end=time))
        self.now = None

    def note(self, text: str) -> None:
        """Records a failure of the plan, if there is one, in the present phase."""
        if self.now is not None and text:
            self.now = replace(self.now, note=f'{self.now.note}; {text}'.strip('; '))
            self.changed(self.now)
