"""Walls as boxes: joints closed, nothing twice in one place, openings cut out."""
from dataclasses import dataclass, replace
from math import atan2, ceil, cos, degrees, hypot, pi, radians, sin, tan
from typing import Callable, Iterable, Sequence

import numpy as np

from angen_apps.plan.model import Color, Opening, Point, Wall
from angen_apps.plan.polygons import hole, overlap, rectangle
from angen_tools.common.geometry import local, turned

ALIGNED = 0.01  # m that a wall may deviate from the direction of others along its length
REACH = 0.05  # m before another wall at which an end is joined to it
STEP = 0.1  # m of height between the boxes of a sloped wall
LEAST = 0.004  # m: smaller boxes are left out
SLOPE = radians(40)  # an opening is cut into walls within this angle of it
LOWER = 0.001  # m that walls of another direction are lower, so that their tops do not coincide
SAG = 0.05  # m between an arc and its segments


@dataclass(frozen=True)
class Box:
    """A box in the frame turned by `yaw` about the plan's origin."""

    yaw: float
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    color: Color

    def corners(self) -> list[Point]:
        return rectangle(0, 0, self.yaw, self.low[:2], self.high[:2])

    @property
    def size(self) -> tuple[float, float, float]:
        x, y, z = (b - a for a, b in zip(self.low, self.high))
        return x, y, z

    @property
    def middle(self) -> tuple[float, float, float]:
        u, v, z = ((a + b) / 2 for a, b in zip(self.low, self.high))
        return (*turned((0, 0), self.yaw, u, v), z)


def arc(start: Point, end: Point, extent: float) -> list[Point]:
    """Points on the arc from start to end that turns by `extent`, counterclockwise if positive."""
    chord = hypot(end[0] - start[0], end[1] - start[1])
    if abs(extent) < 1e-3 or chord < 1e-6:
        return [start, end]
    radius = chord / 2 / abs(sin(extent / 2))
    step = 2 * (2 * SAG / radius) ** 0.5 if radius > SAG else 1.0
    count = max(2, ceil(abs(extent) / min(step, 0.35)))
    # the middle of the circle is left of the chord where the arc turns counterclockwise
    away = chord / 2 / tan(extent / 2)
    ux, uy = (end[0] - start[0]) / chord, (end[1] - start[1]) / chord
    mx, my = (start[0] + end[0]) / 2 - uy * away, (start[1] + end[1]) / 2 + ux * away
    first = atan2(start[1] - my, start[0] - mx)
    inner = [(mx + radius * cos(first + extent * i / count),
              my + radius * sin(first + extent * i / count)) for i in range(1, count)]
    return [start, *inner, end]


def footprint(wall: Wall) -> list[Point]:
    """The corners of a wall seen from above, without its joints."""
    yaw = direction(wall)
    half = wall.thickness / 2
    return rectangle(*wall.start, yaw, (0, -half), (wall.length, half))


def direction(wall: Wall) -> float:
    return atan2(wall.end[1] - wall.start[1], wall.end[0] - wall.start[0])


def boxes(walls: Sequence[Wall], openings: Sequence[Opening], sunk: float) -> list[Box]:
    """The boxes of all walls; they start `sunk` below the floor."""
    walls = [wall for wall in walls if wall.length > LEAST and wall.thickness > LEAST]
    frames = _frames(walls)
    order = sorted(range(len(walls)), key=lambda i: (-round(walls[i].thickness, 4),
                                                     -round(walls[i].length, 4), i))
    placed: dict[float, list[Box]] = {}
    found: list[Box] = []
    names = sorted(set(frames))
    near = _neighbors(walls)
    for i in order:
        lower = LOWER * (names.index(frames[i]) % 8)
        extended = _extended(walls[i], [walls[k] for k in near(i)])
        solids = _solids(extended, frames[i], sunk, lower)
        others = placed.setdefault(frames[i], [])
        pieces = [piece for solid in solids for piece in _without(solid, others)]
        others += solids
        for low, high in _cuts(extended, frames[i], openings):
            pieces = [rest for piece in pieces for rest in _cut(piece, low, high)]
        found += [piece for piece in pieces if min(piece.size) > LEAST]
    return found


def _neighbors(walls: Sequence[Wall]) -> Callable[[int], list[int]]:
    """Which walls are near enough to an end of wall i to be joined to it."""
    ends = np.array([(*wall.start, *wall.end) for wall in walls]).reshape(-1, 4)
    low, high = np.minimum(ends[:, :2], ends[:, 2:]), np.maximum(ends[:, :2], ends[:, 2:])
    reach = (np.array([wall.thickness for wall in walls]) / 2 + REACH)[:, None] * 2

    def near(i: int) -> list[int]:
        beside = np.zeros(len(walls), bool)
        for point in (ends[i, :2], ends[i, 2:]):
            beside |= ((point > low - reach) & (point < high + reach)).all(axis=1)
        beside[i] = False
        return [int(k) for k in np.nonzero(beside)[0]]

    return near


def _frames(walls: Sequence[Wall]) -> list[float]:
    """The yaw of each wall's frame: that of a longer wall if it is parallel or normal to it."""
    known: list[float] = [0.0]
    frames = [0.0] * len(walls)
    for i in sorted(range(len(walls)), key=lambda i: -walls[i].length):
        yaw = direction(walls[i]) % (pi / 2)
        for other in known:
            away = abs((yaw - other + pi / 4) % (pi / 2) - pi / 4)
            if away * walls[i].length < ALIGNED:
                frames[i] = other
                break
        else:
            frames[i] = radians(round(degrees(yaw), 3))
            known.append(frames[i])
    return frames


def _extended(wall: Wall, others: Sequence[Wall]) -> Wall:
    """The wall with its ends extended to the outer corners of its joints."""
    yaw = direction(wall)
    ends = []
    for point, sign in ((wall.start, -1.0), (wall.end, 1.0)):
        more = max((_extension(wall, point, yaw if sign > 0 else yaw + pi, other)
                    for other in others), default=0.0)
        ends.append(turned(point, yaw, sign * more, 0.0))
    if wall.top_at_end is not None:
        return wall  # its slope would change
    return replace(wall, start=ends[0], end=ends[1])


def _extension(wall: Wall, point: Point, outward: float, other: Wall) -> float:
    """The extension of an end that closes its joint with another wall; 0 without a joint."""
    if other.bottom > wall.top or other.top < wall.bottom:
        return 0.0
    heading = direction(other)
    at_start = hypot(point[0] - other.start[0], point[1] - other.start[1])
    at_end = hypot(point[0] - other.end[0], point[1] - other.end[1])
    near = other.thickness / 2 + REACH
    if min(at_start, at_end) < 0.02:  # a corner
        leaving = heading if at_start < at_end else heading + pi
        bend = abs((leaving - outward + pi) % (2 * pi) - pi)
        if bend < 1e-3 or bend > pi - 0.05:
            return 0.0
        more = (other.thickness - wall.thickness * cos(bend)) / (2 * sin(bend))
        return min(max(more, 0.0), max(other.thickness, wall.thickness))
    u, v = local(other.start, heading, point)
    across = sin(outward - heading)  # how fast v changes outward
    gap = abs(v) - other.thickness / 2
    is_before = -near < u < other.length + near and 0 < gap < REACH and v * across < 0
    return (gap + 0.01) / abs(across) if is_before and abs(across) > 0.2 else 0.0


def _solids(wall: Wall, yaw: float, sunk: float, lower: float) -> list[Box]:
    """The wall's boxes in a frame, without openings."""
    start, end = local((0, 0), yaw, wall.start), local((0, 0), yaw, wall.end)
    axis = 0 if abs(end[0] - start[0]) >= abs(end[1] - start[1]) else 1
    across = (start[1 - axis] + end[1 - axis]) / 2
    half = wall.thickness / 2
    first, last = wall.top, wall.top if wall.top_at_end is None else wall.top_at_end
    count = max(1, ceil(abs(last - first) / STEP))
    found = []
    for i in range(count):
        begin, stop = (start[axis] + (end[axis] - start[axis]) * k / count for k in (i, i + 1))
        top = first + (last - first) * (i + 0.5) / count
        low, high = [0.0, 0.0], [0.0, 0.0]
        low[axis], high[axis] = min(begin, stop), max(begin, stop)
        low[1 - axis], high[1 - axis] = across - half, across + half
        bottom = wall.bottom - sunk
        found.append(Box(yaw, (low[0], low[1], bottom), (high[0], high[1], top - lower),
                         wall.color))
    return [box for box in found if box.size[2] > LEAST]


def _without(box: Box, others: Iterable[Box]) -> list[Box]:
    """The box less all others of its frame."""
    left = [box]
    for other in others:
        left = [rest for piece in left for rest in _cut(piece, other.low, other.high)]
    return left


def _cut(box: Box, low: Sequence[float], high: Sequence[float]) -> list[Box]:
    """The box less another, in up to six boxes; along the wall first, then in height."""
    if any(a >= box.high[k] - 1e-6 or b <= box.low[k] + 1e-6
           for k, (a, b) in enumerate(zip(low, high))):
        return [box]
    found = []
    rest = box
    for axis in (0, 1, 2):
        for side in (0, 1):
            bound = (low, high)[side][axis]
            if (side == 0 and bound <= rest.low[axis]) or (side == 1
                                                           and bound >= rest.high[axis]):
                continue
            outer, inner = list(rest.high if side == 0 else rest.low), list(
                rest.low if side == 0 else rest.high)
            outer[axis] = inner[axis] = bound
            if side == 0:
                found.append(replace(rest, high=tuple(outer)))
                rest = replace(rest, low=tuple(inner))
            else:
                found.append(replace(rest, low=tuple(outer)))
                rest = replace(rest, high=tuple(inner))
    return found


def cuts_wall(opening: Opening, wall: Wall) -> bool:
    """Whether an opening is cut into a wall."""
    away = abs((direction(wall) - opening.yaw + pi / 2) % pi - pi / 2)
    if away > SLOPE:
        return False
    return overlap(hole(opening), footprint(wall)) > 0.005


def _cuts(wall: Wall, yaw: float, openings: Sequence[Opening]
          ) -> list[tuple[tuple[float, ...], tuple[float, ...]]]:
    """Low and high corners, in a frame, of the holes of openings in a wall."""
    heading = direction(wall)
    found = []
    for opening in openings:
        if not cuts_wall(opening, wall):
            continue
        away = (heading - opening.yaw + pi / 2) % pi - pi / 2
        u, v = local(wall.start, heading, (opening.x, opening.y))
        # along an oblique wall: the part of its center line in the hole, wider on one face
        middle = u - v * tan(away)
        half = opening.width / 2 / cos(away) + wall.thickness / 2 * abs(tan(away))
        ends = [local((0, 0), yaw, turned(wall.start, heading, w, 0.0))
                for w in (middle - half, middle + half)]
        axis = 0 if abs(ends[1][0] - ends[0][0]) >= abs(ends[1][1] - ends[0][1]) else 1
        low, high = [-1e6, -1e6, opening.bottom], [1e6, 1e6, opening.top]
        low[axis] = min(end[axis] for end in ends)
        high[axis] = max(end[axis] for end in ends)
        found.append((tuple(low), tuple(high)))
    return found
