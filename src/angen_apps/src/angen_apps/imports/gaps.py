"""Doors in a picture: gaps between its walls."""
from dataclasses import dataclass, replace
from math import pi

from angen_apps.plan.model import Leaf, Opening, Wall

DOOR_TOP = 2.1  # m
NARROW, WIDE = 0.7, 1.1  # m: gaps that are doors
THICKEST = 0.45  # m of a wall across
TOUCH = 0.02  # m between walls that meet
CORNER = 0.06  # m between the faces of a wall and of the end of another one
ALIKE = 0.6  # share of a wall's thickness: a stub in its line is as thick


def doors(walls: list[Wall]) -> list[Opening]:
    """Gaps of 0.7 to 1.1 m between two walls in one line, and between a wall's end and a face."""
    found = []
    for along in (0, 1):
        spans = []
        for wall in walls:
            run = 0 if abs(wall.end[0] - wall.start[0]) >= abs(wall.end[1] - wall.start[1]) else 1
            half = wall.thickness / 2
            low, high = sorted((wall.start[along], wall.end[along]))
            across = wall.start[1 - along]
            if run == along:
                spans.append(_Span(low, high, across - half, across + half, True))
            else:
                first, last = sorted((wall.start[1 - along], wall.end[1 - along]))
                spans.append(_Span(wall.start[along] - half, wall.start[along] + half, first,
                                   last, False))
        for span in spans:
            if span.across <= THICKEST:
                found += _gaps(spans, span, along)
    return _once(found)


@dataclass(frozen=True)
class _Span:
    """A wall by its ends along an axis, and its faces."""

    low: float
    high: float
    first: float
    last: float
    runs: bool  # along the axis

    @property
    def across(self) -> float:
        return self.last - self.first


def _through_corners(spans: list[_Span], wall: _Span) -> _Span:
    """A wall to the outer faces of those that end at it: a door may begin there."""
    low, high = wall.low, wall.high
    for other in spans if wall.runs else ():
        if not other.runs and other.high - other.low <= THICKEST and _ends_at(other, wall):
            low = other.low if abs(other.high - wall.low) <= TOUCH else low
            high = other.high if abs(other.low - wall.high) <= TOUCH else high
    return replace(wall, low=low, high=high)


def _ends_at(other: _Span, wall: _Span) -> bool:
    """Whether a wall across another one ends at a face of it."""
    return min(abs(other.first - wall.first), abs(other.last - wall.last)) <= CORNER and (
        min(other.last, wall.last) - max(other.first, wall.first) > wall.across / 2)


def _gaps(spans: list[_Span], wall: _Span, along: int) -> list[Opening]:
    """The gaps at both ends of a wall. A stub that is shorter than thick, and a corner, have them
    only to another one."""
    first, last, wide = wall.first, wall.last, wall.across
    through = _through_corners(spans, wall)
    found = []
    for own, end, sign in ((wall.high, through.high, 1), (wall.low, through.low, -1)):
        in_line = [s for s in spans if min(s.last, last) - max(s.first, first) > 0.5 * wide]
        beyond = [(s.low - end if sign > 0 else end - s.high, s) for s in in_line]
        is_joined = any(g <= TOUCH < (s.high - end if sign > 0 else end - s.low)
                        for g, s in beyond)
        gap, other = min(((g, s) for g, s in beyond if g > TOUCH), key=lambda each: each[0],
                         default=(0.0, wall))
        is_end = (wall.runs and end == own or wide > ALIKE * other.across
                  or _ends_at(other, wall))
        if NARROW <= gap <= WIDE and is_end and not is_joined:
            at, across = end + sign * gap / 2, (first + last) / 2
            x, y = (at, across) if along == 0 else (across, at)
            leaf = Leaf((-gap / 2 + 0.005, -wide / 2), gap - 0.01, 0.0, -pi / 2)
            found.append(Opening('door', x, y, 0.0 if along == 0 else pi / 2, gap, 0.0, DOOR_TOP,
                                 (-wide / 2, wide / 2), (leaf,), source='gap'))
    return found


def _once(openings: list[Opening]) -> list[Opening]:
    kept: list[Opening] = []
    for opening in openings:
        if all(abs(opening.x - o.x) + abs(opening.y - o.y) > 0.3 for o in kept):
            kept.append(opening)
    return kept
