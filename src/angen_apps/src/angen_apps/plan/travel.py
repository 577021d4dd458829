"""Opens the leaves of a storey until they touch a wall, a thing or another leaf."""
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil, copysign, cos, degrees, pi
from typing import Iterable, Sequence

from angen_apps.plan.doors import Hung
from angen_apps.plan.model import Leaf, Opening, Plan, Point, Storey
from angen_apps.plan.names import apart
from angen_apps.plan.polygons import overlap
from angen_apps.plan.walls import Box
from angen_tools.common.geometry import bounds

STEP = pi / 60  # between the angles at which a leaf is tried
SLIDE_STEP = 0.04  # m between the places at which a leaf that slides is tried
LEAST_TURN = 0.15  # rad: a leaf that opens less is fixed
LEAST_WAY = 0.1  # m, the same of a leaf that slides
GAPS = (0.01, 0.03, 0.06, 0.1)  # m from a wall to a leaf that slides before it
TOUCH = 0.001  # m of overlap that does not count as contact
REST = 1e-4  # m, the same where a leaf is open: beside its hinge 1 mm would hold it 1 degree back
CLOSE = 0.002  # m: obstacles this close above or below a leaf block it


@dataclass(frozen=True)
class Obstacle:
    """An obstacle of a leaf: corners seen from above, and its heights."""

    name: str
    corners: list[tuple[float, float]]
    bottom: float
    top: float

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """West, south, east, north."""
        return bounds(self.corners)

    def is_near(self, area: tuple[float, float, float, float], reach: float) -> bool:
        """Whether it is within reach of an area: west, south, east, north."""
        west, south, east, north = self.bounds
        return (west < area[2] + reach and east > area[0] - reach
                and south < area[3] + reach and north > area[1] - reach)


def hang(storey: Storey, walls: Sequence[Box], furniture: Sequence[Obstacle], plan: Plan
         ) -> list[Hung]:
    """The leaves of a storey; each opens until an obstacle."""
    solid = [Obstacle('a wall', box.corners(), box.low[2], box.high[2]) for box in walls]
    found: list[Hung] = []
    for opening in storey.openings:
        for i, leaf in enumerate(opening.leaves):
            name = opening.name
            if len(opening.leaves) > 1:
                name = sided(opening, leaf, i)
            found.append(Hung(name, opening, leaf, leaf.turn))
    shut = [Obstacle(f'the leaf {hung.name}', hung.corners(0.0), *hung.heights) for hung in found]
    opened: list[Obstacle] = []
    for i, hung in enumerate(found):
        others = [other for k, other in enumerate(shut) if k != i]
        around = [*solid, *furniture, *others]
        found[i], why = _slid(hung, [*around, *opened]) if hung.leaf.slide else _turned(
            hung, around, opened)
        if why:
            plan.remarks.append(f'{hung.opening.kind} {hung.name} {why} is in its way')
        if found[i].opens:
            opened.append(Obstacle(f'the open leaf {hung.name}', found[i].corners(
                found[i].turn, found[i].leaf.slide), *hung.heights))
    return found


def _turned(hung: Hung, obstacles: Sequence[Obstacle], opened: Sequence[Obstacle]
            ) -> tuple[Hung, str]:
    """A leaf with the angle by which it turns, and the obstacle that stops it.

    It may pass through the place of an open leaf, but does not stop there.
    """
    near = _near(hung, obstacles, hung.width)
    count = max(1, round(abs(hung.turn) / STEP))
    angles = (hung.turn * i / count for i in range(count + 1))
    free, why = _free(((angle, hung.corners(angle)) for angle in angles), near, STEP / 2)
    turn = copysign(free, hung.turn) if why else hung.turn
    around = [(o, TOUCH) for o in _near(hung, opened, hung.width)]
    around += [(o, max(REST, overlap(hung.corners(0.0), o.corners))) for o in near]
    while abs(turn) >= LEAST_TURN and (in_way := next(
            (o for o, touch in around if overlap(hung.corners(turn), o.corners) > touch), None)):
        turn, why = turn - copysign(STEP, turn), in_way.name
    if abs(turn) >= abs(hung.leaf.turn) - 1e-6:
        return hung, ''
    if abs(turn) < LEAST_TURN:
        return replace(hung, turn=0.0), f'does not open: {why}'
    return replace(hung, turn=turn), f'opens by {degrees(abs(turn)):.0f} degrees only: {why}'


def _slid(hung: Hung, obstacles: Sequence[Obstacle]) -> tuple[Hung, str]:
    """A leaf with the distance by which it slides, before the face of the wall with more room."""
    best, most, stopped = hung, -1.0, ''
    for leaf in _beside_wall(hung):
        tried = replace(hung, leaf=leaf)
        count = max(1, ceil(abs(leaf.slide) / SLIDE_STEP))
        ways = (leaf.slide * i / count for i in range(count + 1))
        way, why = _free(((way, tried.corners(0.0, way)) for way in ways),
                         _near(tried, obstacles, tried.width + abs(leaf.slide)), 0.01)
        if way > most + 1e-6:
            best, most, stopped = tried, way, why
        if not why:
            return tried, ''
    if most < LEAST_WAY:
        return replace(hung, leaf=replace(hung.leaf, slide=0.0)), f'does not open: {stopped}'
    slide = most if best.leaf.slide > 0 else -most
    return replace(best, leaf=replace(best.leaf, slide=slide)), \
        f'opens by {most:.2f} m only: {stopped}'


def _beside_wall(hung: Hung) -> list[Leaf]:
    """The leaf, and if it slides before its wall, leaves before both faces of it."""
    leaf, (low, high) = hung.leaf, hung.opening.band
    if low < leaf.hinge[1] < high:
        return [leaf]
    under, over = (0.0, hung.thick) if cos(leaf.shut) > 0 else (hung.thick, 0.0)
    places = [v for gap in GAPS for v in (high + gap + under, low - gap - over)]
    return [leaf, *(replace(leaf, hinge=(leaf.hinge[0], v)) for v in places)]


def _free(places: Iterable[tuple[float, Sequence[Point]]], near: Sequence[Obstacle], back: float
          ) -> tuple[float, str]:
    """How far a leaf gets without a touch, of its places one after the other, and the obstacle
    that stops it, `back` before that."""
    free = 0.0
    for way, corners in places:
        for o in near:
            if overlap(corners, o.corners) > TOUCH:
                return max(0.0, free - back), o.name
        free = abs(way)
    return free, ''


def _near(hung: Hung, obstacles: Sequence[Obstacle], reach: float) -> list[Obstacle]:
    """The obstacles within reach of a hinge, at the heights of its leaf."""
    bottom, top = hung.heights
    return [o for o in obstacles if o.bottom < top + CLOSE and o.top > bottom - CLOSE
            and o.is_near((*hung.hinge, *hung.hinge), reach + 0.1)]


def sided(opening: Opening, leaf: Leaf, index: int) -> str:
    """The name of one of two leaves; a number at its end stays there."""
    side = ('left' if leaf.hinge[0] < 0 else 'right') if len(opening.leaves) == 2 else f'n{index}'
    if opening.name == opening.source:
        return f'{opening.name}_{side}'
    name, number = apart(opening.name)
    return f'{name}_{side}{number}'
