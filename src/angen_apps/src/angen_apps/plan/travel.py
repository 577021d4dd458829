"""Opens the leaves of a storey until they touch a wall, a thing or another leaf."""
from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil, copysign, cos, degrees, pi
from typing import Sequence

from angen_apps.plan.doors import Hung
from angen_apps.plan.model import Leaf, Opening, Plan, Storey
from angen_apps.plan.polygons import overlap
from angen_apps.plan.walls import Box

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
    turn, why = _free_turn(hung, obstacles)
    around = [(o, TOUCH) for o in _near(hung, opened, hung.width)]
    around += [(o, max(REST, overlap(hung.corners(0.0), o.corners)))
               for o in _near(hung, obstacles, hung.width)]
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
        way, why = _free_way(tried, obstacles)
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


def _free_way(hung: Hung, obstacles: Sequence[Obstacle]) -> tuple[float, str]:
    """The way of a leaf without a touch, and the obstacle that stops it."""
    near = _near(hung, obstacles, hung.width + abs(hung.leaf.slide))
    count = max(1, ceil(abs(hung.leaf.slide) / SLIDE_STEP))
    free = 0.0
    for i in range(count + 1):
        way = hung.leaf.slide * i / count
        corners = hung.corners(0.0, way)
        for o in near:
            if overlap(corners, o.corners) > TOUCH:
                return max(0.0, free - 0.01), o.name
        free = abs(way)
    return free, ''


def _near(hung: Hung, obstacles: Sequence[Obstacle], reach: float) -> list[Obstacle]:
    """The obstacles within reach of a hinge, at the heights of its leaf."""
    bottom, top = hung.heights
    x, y = hung.hinge
    reach += 0.1
    return [o for o in obstacles if o.bottom < top + CLOSE and o.top > bottom - CLOSE
            and min(c[0] for c in o.corners) < x + reach
            and max(c[0] for c in o.corners) > x - reach
            and min(c[1] for c in o.corners) < y + reach
            and max(c[1] for c in o.corners) > y - reach]


def sided(opening: Opening, leaf: Leaf, index: int) -> str:
    """The name of one of two leaves; a number at its end stays there."""
    side = ('left' if leaf.hinge[0] < 0 else 'right') if len(opening.leaves) == 2 else f'n{index}'
    if opening.name == opening.source:
        return f'{opening.name}_{side}'
    stem = opening.name.rstrip('0123456789')
    joint = '' if stem.endswith('_') else '_'
    return f'{stem}{joint}{side}{opening.name[len(stem):]}'


def _free_turn(hung: Hung, obstacles: Sequence[Obstacle]) -> tuple[float, str]:
    """The angle of a leaf without a touch, and the obstacle that stops it."""
    near = _near(hung, obstacles, hung.width)
    sign = -1.0 if hung.turn < 0 else 1.0
    count = max(1, round(abs(hung.turn) / STEP))
    free = 0.0
    for i in range(count + 1):
        angle = hung.turn * i / count
        corners = hung.corners(angle)
        for o in near:
            if overlap(corners, o.corners) > TOUCH:
                return sign * max(0.0, abs(free) - STEP / 2), o.name
        free = angle
    return hung.turn, ''
