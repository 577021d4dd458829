"""Apartment buildings by seed: apartments on both sides of a corridor with an elevator.

The apartments of a side are wings with a court between them, so that each room has a window.
"""
from dataclasses import replace
from math import pi
from random import Random

from angen_apps.plan.apartment import (CEILING, HALL, LANDING, OUTER, add_elevator, apartment, door,
                                       wing)
from angen_apps.plan.finish import finish
from angen_apps.plan.furnished import furnished
from angen_apps.plan.model import Lamp, Plan, Point, Room, Storey, Wall
from angen_apps.plan.names import LETTERS

COURT = 6.0  # m between the wings of a side


def building(rooms: int, storeys: int, apartments: int, seed: int) -> Plan:
    """`apartments` on each storey, each with `rooms` rooms besides kitchen, bathroom and hall.

    Failure if their furniture does not fit.
    """
    if apartments == 1:
        return apartment(rooms, storeys, seed)
    return furnished(lambda key: _empty(rooms, storeys, apartments, key), seed)


def _empty(rooms: int, storeys: int, apartments: int, seed: str) -> Plan:
    depth = 3.6 + 0.6 * Random(f'{seed} widths').uniform(0.0, 1.0)
    plan = Plan('building', [_storey(number, rooms, apartments, depth, seed)
                             for number in range(storeys)], latitude=51.5)
    south, _ = _ends(apartments, depth)
    if storeys > 1:
        add_elevator(plan, (-LANDING / 2, south), pi / 2)
    return finish(plan)


def _ends(apartments: int, depth: float) -> tuple[float, float]:
    """The middles of the corridor's south and north wall."""
    last = (apartments - 1) // 2 * (2 * depth + HALL + COURT)
    return -depth, HALL + depth + last


def _storey(number: int, rooms: int, apartments: int, depth: float, seed: str) -> Storey:
    made: Storey | None = None
    for i in range(apartments):
        part = wing(number, rooms, Random(f'{seed} {number} {i}'), [depth, depth])[0]
        made = made or replace(part, walls=[], openings=[], rooms=[], lamps=[])
        y = i // 2 * (2 * depth + HALL + COURT)
        west = i % 2 == 1
        _add(made, part, (-LANDING, y + HALL) if west else (0.0, y), west, LETTERS[i])
    assert made is not None
    _corridor(made, apartments, depth)
    return made


def _add(storey: Storey, part: Storey, at: Point, turned: bool, letter: str) -> None:
    """Adds an apartment, its origin at a point; turned, its entrance is at its east."""
    sign, yaw = (-1.0, pi) if turned else (1.0, 0.0)

    def placed(point: Point) -> Point:
        return at[0] + sign * point[0], at[1] + sign * point[1]

    storey.walls += [replace(wall, start=placed(wall.start), end=placed(wall.end))
                     for wall in part.walls]
    storey.rooms += [replace(room, name=f'{room.use}_{letter}',
                             polygon=tuple(map(placed, room.polygon))) for room in part.rooms]
    for opening in part.openings:
        x, y = placed((opening.x, opening.y))
        storey.openings.append(replace(opening, x=x, y=y, yaw=opening.yaw + (
            yaw if opening.yaw <= 0.0 else -yaw)))
    for lamp in part.lamps:
        x, y = placed((lamp.x, lamp.y))
        storey.lamps.append(replace(lamp, x=x, y=y))


def _corridor(storey: Storey, apartments: int, depth: float) -> None:
    """The way to the apartments: walls where it is outside, lamps, and the way in from outside."""
    z, half = storey.elevation, OUTER / 2
    south, north = _ends(apartments, depth)
    tall, wings = 2 * depth + HALL, (apartments + 1) // 2
    for x, count in ((0.0, wings), (-LANDING, apartments // 2)):
        tops = [south + i * (tall + COURT) + tall for i in range(count)]
        nexts = [top + COURT for top in tops[:-1]] + [north]
        storey.walls += [Wall((x, low), (x, high), OUTER, z, z + CEILING)
                         for low, high in zip(tops, nexts) if high > low + 1e-6]
    storey.walls += [Wall((-LANDING, y), (0.0, y), OUTER, z, z + CEILING)
                     for y in (south, north)]
    storey.rooms.append(Room('corridor', 'hall', (
        (half - LANDING, south + half), (-half, south + half), (-half, north - half),
        (half - LANDING, north - half)), z, CEILING))
    storey.lamps += [Lamp('', -LANDING / 2, HALL / 2 + i * (tall + COURT), z + CEILING - 0.3, 800.0)
                     for i in range(wings)]
    if storey.number == 0:
        door(storey, -LANDING / 2, north, 0.0, OUTER, False, True, 'main entrance')
