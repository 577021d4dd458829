"""Claims about a home, as scenarios write them: `light.hall_lamp is on and anyone in hall0`."""
import math
import re
from dataclasses import dataclass
from itertools import combinations
from typing import Callable, Iterable, Mapping, Sequence

from angen_tools.common.clock import DAY, time_of_day

Spans = list[tuple[float, float]]  # ascending, apart: from, until, s
Line = list[tuple[float, str]]     # a value from a time on
COMPARED = re.compile(r'(\S+?\.\S+)(?: (\w+))? (below|above) (-?\d+(?:\.\d+)?)')
STATED = re.compile(r'(\S+?\.\S+)(?: (\w+))? is( not)? (\S+)')
PEOPLE = re.compile(r'(\w+) (?:(home)|in (\S+)|awake in (\S+)|does (\w+))')
CLOCK = re.compile(r'time (\d+:\d+) to (\d+:\d+)')
ANYONE, NOBODY = 'anyone', 'nobody'
FORMS = ("'light.hall_lamp is on', 'sensor.hall_light_sensor below 20', 'anyone in hall0', "
         "'nobody home', 'anna does sleep', 'time 22:00 to 6:00', several with 'and'")


@dataclass(frozen=True)
class Part:
    """One claim. `source`: an entity's id with its attribute, or a person."""

    source: str
    attribute: str = ''
    negated: bool = False
    value: str = ''
    below: float = math.inf
    above: float = -math.inf
    who: str = ''       # a name, anyone or nobody
    room: str = ''
    awake: bool = False
    activity: str = ''
    window: tuple[float, float] | None = None  # times of day, s

    @property
    def key(self) -> tuple[str, str]:
        """Of its time line."""
        return self.source, self.attribute

    def holds(self, text: str) -> bool:
        """For a value of the time line."""
        if self.value:
            return (text == self.value) != self.negated
        try:
            return self.above < float(text) < self.below
        except ValueError:
            return False

    def of_person(self, text: str) -> bool:
        """For a person, whose line has `room|activity|posture`; outside the room is empty."""
        room, activity, posture = text.split('|')
        if self.activity:
            return activity == self.activity
        if self.room:
            return room == self.room and not (self.awake and posture == 'lie')
        return bool(room)


@dataclass(frozen=True)
class Claim:
    """Parts that hold together."""

    text: str
    parts: tuple[Part, ...]


def parsed(text: str) -> Claim:
    """The claim of a text; ValueError with what would be right."""
    return Claim(text, tuple(_part(each.strip()) for each in text.split(' and ')))


def _part(text: str) -> Part:
    if found := COMPARED.fullmatch(text):
        number = float(found[4])
        return Part(found[1], found[2] or '', below=number if found[3] == 'below' else math.inf,
                    above=number if found[3] == 'above' else -math.inf)
    if found := STATED.fullmatch(text):
        return Part(found[1], found[2] or '', bool(found[3]), found[4])
    if found := PEOPLE.fullmatch(text):
        return Part(found[1], who=found[1], room=found[3] or found[4] or '',
                    awake=bool(found[4]), activity=found[5] or '')
    if found := CLOCK.fullmatch(text):
        return Part('', window=(time_of_day(found[1]), time_of_day(found[2])))
    raise ValueError(f"'{text}' is no claim; write it as {FORMS}")


def contradiction(claim: Claim) -> str:
    """Why its parts never hold together, '' if they can."""
    for one, other in combinations(claim.parts, 2):
        if one.source and one.key == other.key and not one.who and (
                (one.value and other.value and not one.negated and not other.negated
                 and one.value != other.value) or max(one.above, other.above) >= min(
                     one.below, other.below)):
            return f"'{claim.text}' is a contradiction"
    return ''


# --- over time

def pieces(line: Line, end: float) -> list[tuple[float, float, str]]:
    """From, until, value."""
    return [(time, after, value) for (time, value), (after, _) in zip(line, [*line[1:], (end, '')])
            if after > time]


def spans_of(line: Line, holds: Callable[[str], bool], end: float) -> Spans:
    """When the values of a line hold."""
    return union([[(time, after) for time, after, value in pieces(line, end) if holds(value)]])


def both(one: Spans, other: Spans) -> Spans:
    """When both hold."""
    found, i, j = [], 0, 0
    while i < len(one) and j < len(other):
        low, high = max(one[i][0], other[j][0]), min(one[i][1], other[j][1])
        if low < high:
            found.append((low, high))
        if one[i][1] < other[j][1]:
            i += 1
        else:
            j += 1
    return found


def inverse(spans: Spans, end: float) -> Spans:
    """When they do not hold, from 0 on."""
    ends = [0.0, *(edge for span in spans for edge in span), end]
    return [(low, high) for low, high in zip(ends[::2], ends[1::2]) if low < high]


def union(all_spans: Iterable[Spans]) -> Spans:
    """When any holds."""
    found: Spans = []
    for low, high in sorted(span for spans in all_spans for span in spans):
        if found and low <= found[-1][1]:
            found[-1] = found[-1][0], max(found[-1][1], high)
        else:
            found.append((low, high))
    return found


def total(spans: Spans) -> float:
    return sum(high - low for low, high in spans)


@dataclass
class Lines:
    """All that was recorded, by source and attribute; people by name. `end`: of the run; `since`:
    its start, s after midnight."""

    values: dict[tuple[str, str], Line]
    people: Sequence[str]
    end: float
    since: float

    def spans(self, claim: Claim) -> Spans:
        """When a claim holds."""
        found: Spans = [(0.0, self.end)]
        for part in claim.parts:
            found = both(found, self._of(part))
        return found

    def _of(self, part: Part) -> Spans:
        if part.window is not None:
            return day_spans(*part.window, self.since, self.end)
        if not part.who:
            return spans_of(self.values.get(part.key, []), part.holds, self.end)
        names = self.people if part.who in (ANYONE, NOBODY) else [part.who]
        found = union(spans_of(self.values.get((name, ''), []), part.of_person, self.end)
                      for name in names)
        return inverse(found, self.end) if part.who == NOBODY else found


def day_spans(low: float, high: float, since: float, end: float) -> Spans:
    """A time of day on each day of a run."""
    lasts = (high - low) % DAY or DAY
    first = [low + days * DAY - since for days in range(-1, int((since + end) / DAY) + 1)]
    return [(max(begin, 0.0), min(begin + lasts, end)) for begin in first
            if begin + lasts > 0.0 and begin < end]


def power_used(lines: Mapping[str, Line], end: float) -> float:
    """kWh of lines of W."""
    return sum(float(value) * (after - time) for line in lines.values()
               for time, after, value in pieces(line, end)) / 3.6e6
