"""Homes by seed: rooms on both sides of a hall, on storeys with an elevator between them.

Bedrooms have at least 11.5 m2 and 2.75 m (the first) or 7.5 m2 and 2.15 m, ceilings 2.5 m: the
Nationally Described Space Standard (England, 2015) requires that and 2.3 m. Leaves are 0.86 m
wide: Approved Document M (2015) requires 0.75 m clear for a straight approach.
"""
from dataclasses import replace
from math import pi
from random import Random

from angen_apps.plan.finish import finish
from angen_apps.plan.furnished import furnished
from angen_apps.plan.lifts import THICK, add_shaft
from angen_apps.plan.model import Lamp, Leaf, Lift, Opening, Plan, Point, Room, Storey, Wall
from angen_tools.common.geometry import edges, turned

OUTER, INNER = THICK, 0.1  # m, walls
CEILING, RISE = 2.5, 3.0  # m
HALL = 1.5  # m wide
LEAF = 0.86  # m
DOOR_TOP = 2.05
PAST_ENTRANCE = 1.25  # m from its wall to a door that the open leaf of the entrance leaves free
SILL, WINDOW_TOP = 0.95, 2.15  # m
# least area and width, and how much of it varies
SIZES = {'living': (16.0, 3.2, 10.0), 'kitchen': (8.0, 2.4, 5.0), 'bathroom': (4.5, 1.9, 2.5),
         'bedroom': (11.5, 2.75, 5.0), 'bedroom_small': (7.5, 2.15, 4.0), 'work': (7.5, 2.15, 4.0)}
OTHERS = ('bedroom', 'living', 'bedroom_small', 'work', 'bedroom_small')
LANDING = 2.4  # m
LANDING_SIDE = 1.3  # m from its middle to the middle of a wall beside it
SHAFT = (1.7, 1.7)  # m, inner depth and width


def apartment(rooms: int, storeys: int, seed: int) -> Plan:
    """A home of `rooms` rooms besides kitchen, bathroom and hall on each storey.

    Failure if its furniture does not fit.
    """
    return furnished(lambda key: _empty(rooms, storeys, key), seed)


def _empty(rooms: int, storeys: int, seed: str) -> Plan:
    made = []
    widths = Random(f'{seed} widths').uniform(0.0, 1.0)
    for number in range(storeys):
        dice = Random(f'{seed} {number}')
        depths = [3.6 + 0.6 * widths, 3.5 + 0.6 * widths] if storeys > 1 else None
        storey = wing(number, rooms, dice, depths)[0]
        if storeys > 1:
            _landing(storey)
        made.append(storey)
    plan = Plan('apartment', made, latitude=51.5)
    if storeys > 1:
        add_elevator(plan, (-LANDING, HALL / 2), 0.0)
        door(made[0], -LANDING / 2, HALL / 2 - LANDING_SIDE, 0.0, OUTER, True, True, 'house door')
    return finish(plan)


def _rows(rooms: int, dice: Random) -> tuple[list[str], list[str]]:
    kinds = ['kitchen', 'bathroom', *OTHERS[:rooms]]
    dice.shuffle(kinds)
    kinds.sort(key=lambda kind: -SIZES[kind][0])
    rows: tuple[list[str], list[str]] = ([], [])
    for kind in kinds:  # the larger ones first, each to the row with less of it
        min(rows, key=lambda row: sum(SIZES[k][0] for k in row)).append(kind)
    for row in rows:
        dice.shuffle(row)
    return rows


def wing(number: int, rooms: int, dice: Random, depths: list[float] | None
         ) -> tuple[Storey, float, list[float]]:
    """An apartment on a storey, its length and the depths of its rows: north and south of its hall.

    With `depths`, for apartments above each other, its outline depends on them and `rooms` alone.
    """
    z = number * RISE
    storey = Storey(number, f'Floor {number}', z, RISE, RISE - CEILING - 0.01)
    rows = _rows(rooms, dice)
    free = [dice.uniform(3.3, 4.3) for _ in rows]
    is_tower, depths = depths is not None, depths or free
    needed = [sum(max(SIZES[kind][1], (SIZES[kind][0] + dice.uniform(0, SIZES[kind][2]))
                      / (depth - 0.15)) + INNER for kind in row)
              for row, depth in zip(rows, depths)]
    length = max(needed) if not is_tower else max(
        max(needed), sum(SIZES[k][0] + SIZES[k][2] for k in ('kitchen', 'bathroom',
                                                             *OTHERS[:rooms])) / 2 / 3.3)
    _hall(storey, length)
    for row, depth, south in zip(rows, depths, (False, True)):
        _row(storey, row, depth, south, length, dice)
    _outside(storey, length, depths)
    return storey, length, depths


def _row(storey: Storey, kinds: list[str], depth: float, south: bool, length: float, dice: Random
         ) -> None:
    """The rooms of one side of the hall, each with its door, window and lamp."""
    z = storey.elevation
    least = [max(SIZES[kind][1], SIZES[kind][0] / (depth - 0.15)) + INNER for kind in kinds]
    spare = length - sum(least)
    parts = [dice.uniform(0.5, 1.5) for _ in kinds]
    west = 0.0
    wall = 0.0 if south else HALL  # the middle of the wall to the hall
    far = wall + (-depth if south else depth)
    sign = -1 if south else 1
    for i, (kind, wide) in enumerate(zip(kinds, least)):
        east = length if i == len(kinds) - 1 else west + wide + spare * parts[i] / sum(parts)
        low = west + (OUTER if i == 0 else INNER) / 2
        high = east - (OUTER if i == len(kinds) - 1 else INNER) / 2
        near, end = wall + sign * INNER / 2, far - sign * OUTER / 2
        use = kind.partition('_')[0]
        storey.rooms.append(Room('', use, ((low, near), (high, near), (high, end), (low, end)), z,
                                 CEILING))
        if i:
            storey.walls.append(Wall((west, wall), (west, far), INNER, z, z + CEILING))
        at = dice.uniform(low + LEAF / 2 + 0.25, high - LEAF / 2 - 0.25)
        door(storey, at, wall, 0.0, INNER, sign > 0, dice.random() < 0.5)
        _window(storey, (low + high) / 2, far, min(1.2, high - low - 0.8), sign > 0)
        storey.lamps.append(Lamp('', (low + high) / 2, (near + end) / 2, z + CEILING - 0.3, 800.0))
        west = east


def door(storey: Storey, x: float, y: float, yaw: float, thick: float, into_y: bool,
         hinge_left: bool, source: str = 'door') -> None:
    """A door whose leaf opens toward the +y or -y of its opening."""
    half, z = LEAF / 2 + 0.005, storey.elevation
    face = thick / 2 if into_y else -thick / 2
    turn = pi / 2 if into_y else -pi / 2
    leaf = Leaf((-LEAF / 2, face), LEAF, 0.0, turn) if hinge_left else Leaf(
        (LEAF / 2, face), LEAF, pi, -turn)
    storey.openings.append(Opening('door', x, y, yaw, 2 * half, z, z + DOOR_TOP,
                                   (-thick / 2, thick / 2), (leaf,), source=source))


def _window(storey: Storey, x: float, y: float, width: float, north: bool) -> None:
    z, half = storey.elevation, OUTER / 2
    inner = -half if north else half
    leaf = Leaf((-width / 2 + 0.005, inner), width - 0.01, 0.0, -pi / 2 if north else pi / 2)
    storey.openings.append(Opening('window', x, y, 0.0, width, z + SILL, z + WINDOW_TOP,
                                   (-half, half), (leaf,), source='window'))


def _hall(storey: Storey, length: float) -> None:
    z = storey.elevation
    storey.walls += [Wall((0.0, y), (length, y), INNER, z, z + CEILING) for y in (0.0, HALL)]
    low, high = INNER / 2, HALL - INNER / 2
    storey.rooms.append(Room('', 'hall', ((OUTER / 2, low), (length - OUTER / 2, low),
                                          (length - OUTER / 2, high), (OUTER / 2, high)), z,
                             CEILING))
    storey.lamps.append(Lamp('', length / 2, HALL / 2, z + CEILING - 0.3, 800.0))


def _outside(storey: Storey, length: float, depths: list[float]) -> None:
    """The outer walls and the entrance."""
    z = storey.elevation
    north, south = HALL + depths[0], -depths[1]
    corners = [(0.0, south), (length, south), (length, north), (0.0, north)]
    storey.walls += [Wall(a, b, OUTER, z, z + CEILING) for a, b in edges(corners)]
    door(storey, 0.0, HALL / 2, -pi / 2, OUTER, True, _entrance_opens_north(storey), 'front door')


def _entrance_opens_north(storey: Storey) -> bool:
    """Whether the leaf of the entrance opens to the north wall of the hall, or to the south wall:
    the one at which it leaves the doors free. A door that it would close off is moved."""
    doors = {y: min((o for o in storey.openings if o.kind == 'door' and o.y == y),
                    key=lambda o: o.x) for y in (HALL, 0.0)}
    y = HALL if doors[HALL].x >= PAST_ENTRANCE or doors[HALL].x >= doors[0.0].x else 0.0
    near = doors[y]
    storey.openings[storey.openings.index(near)] = replace(near, x=max(near.x, PAST_ENTRANCE))
    return y == HALL


def _landing(storey: Storey) -> None:
    """The landing before the entrance."""
    z = storey.elevation
    west, middle = -LANDING, HALL / 2
    a, b = OUTER / 2, LANDING_SIDE
    half = b - a
    storey.rooms.append(Room('', 'landing', ((west + a, middle - half), (-a, middle - half),
                                             (-a, middle + half), (west + a, middle + half)), z,
                             CEILING))
    storey.walls += [Wall((0.0, y), (west, y), OUTER, z, z + CEILING)
                     for y in (middle - b, middle + b)]
    storey.walls.append(Wall((west, middle - b), (west, middle + b), OUTER, z, z + CEILING))
    storey.lamps.append(Lamp('', west / 2, middle, z + CEILING - 0.3, 800.0))


def add_elevator(plan: Plan, at: Point, yaw: float) -> None:
    """An elevator that stops on all storeys: its doorway is in the wall at a point and opens to
    the direction `yaw`; its shaft is behind that wall."""
    back = -(OUTER / 2 + SHAFT[0] / 2 + 0.15)  # the cabin's middle
    x, y = turned(at, yaw, back, 0.0)
    plan.lifts.append(Lift('elevator', x, y, yaw, SHAFT[1] - 0.12, SHAFT[0] - 0.2,
                           tuple(storey.number for storey in plan.storeys), front=-0.12 - back))
    for storey in plan.storeys:
        add_shaft(storey, plan.lifts[0], at, SHAFT, storey.elevation + CEILING)
