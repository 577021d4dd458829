"""Finds places for activities in a home: things and rooms as spots to stand, sit or lie at."""
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from random import Random
from typing import Iterator

import numpy as np
from scipy.ndimage import binary_erosion, label

from angen_apps.maps.gridmap import RESOLUTION
from angen_apps.residents.activities import OPENS, Step
from angen_apps.residents.floors import Floors
from angen_apps.residents.profiles import MOST
from angen_apps.robot.planner import Point
from angen_tools.common.home import Place, Room, Thing

FAR = 1.9  # m from a standing person to the middle of a bed
TOWARDS = 0.62  # m from the middle of a thing without places to its user
COVERED = 0.12  # m above a seat: a table there, under which the chair is pushed
LONG = 1.4  # m of free cells in a line, on which a person can lie
LENGTH = 1.7  # m between two who lie in one line: 1.6 m are a body
LYING, BESIDE = 0.65, 0.55  # m from the middle of a lying resident to head and feet, and past them
PART, LEAST = 1.0, 0.05  # m2 of floor that a way has to lead to, and of a room
OUTSIDE, ENTRANCE = 'outside', 'entrance'
UNUSED = ('landing', 'outdoor')


@dataclass(frozen=True)
class Spot:
    """The floor point of a resident, and the place of a thing at which it then sits or lies."""

    stand: Point
    storey: int
    z: float
    room: str
    thing: str = ''
    place: Place | None = None

    @property
    def key(self) -> tuple[str, float, float]:
        """The key under which one resident reserves it."""
        at = self.place.pose[:2] if self.place else self.stand
        return self.thing or self.room, round(at[0], 2), round(at[1], 2)


class Places:
    """The spots of a home, found when they are first needed."""

    def __init__(self, floors: Floors) -> None:
        self.floors, self.home = floors, floors.home
        self._rooms = {room.name: room for room in self.home.rooms}
        self._spots: dict[tuple[str, str], list[Spot]] = {}

    def use(self, room: str) -> str:
        """The use of a room."""
        return self._rooms[room].use if room in self._rooms else 'outdoor'

    def rooms_of(self, use: str) -> list[Room]:
        return [room for room in self._reached if room.use == use]

    @cached_property
    def _reached(self) -> list[Room]:
        """Rooms that people get to, with floor of their own."""
        return [room for room in self.home.rooms if room.name in self.floors.reached
                and self.floors.floor_of(room).sum() * RESOLUTION ** 2 > LEAST]

    def spots(self, step: Step) -> list[Spot]:
        """The spots for a step, the best first; empty if no thing and no room serves."""
        posture = 'stand' if step.posture == 'roam' else step.posture
        found = [spot for what in step.at for spot in self._of(what, posture)]
        if not found and step.room:
            found = self.free(step.room, Random(step.room), 1)
        return found

    def free(self, use: str, numbers: Random, count: int) -> list[Spot]:
        """Places on the open floor of rooms of a use."""
        rooms = self.rooms_of(use)
        if not rooms:
            return []
        room = rooms[numbers.randrange(len(rooms))]
        z = self.home.elevation(room.storey)
        return [Spot(point, room.storey, z, room.name)
                for point in self.floors.spots(room.name, count, numbers)]

    def beside(self, spots: list[Spot], numbers: Random) -> Spot:
        """A place on the open floor of the room of these, where others have all of them."""
        if not spots:
            return self.anywhere()
        first = spots[0]
        points = self.floors.spots(first.room, 1, numbers) if first.room in self._rooms else []
        return Spot(points[0], first.storey, first.z, first.room) if points else self.anywhere()

    def anywhere(self, numbers: Random | None = None) -> Spot:
        """A place in the largest room, where nothing else serves; the same without numbers."""
        room = max((r for r in self._reached if r.use not in UNUSED),
                   key=lambda r: (r.area, r.name))
        point = self.floors.spots(room.name, 1, numbers or Random(room.name))[0]
        return Spot(point, room.storey, self.home.elevation(room.storey), room.name)

    @cached_property
    def on_floor(self) -> list[Spot]:
        """Places for as many residents without a bed as a home may have: in a bedroom first, or
        else in the largest room."""
        found: list[Spot] = []
        last: list[Spot] = []
        rooms = [room for room in self._reached if room.use not in UNUSED]
        for room in sorted(rooms, key=lambda r: (r.use != 'bedroom', -r.area, r.name)):
            z = self.home.elevation(room.storey)
            for at, yaw, divides in self._beds(room):
                (last if divides else found).append(
                    Spot(at, room.storey, z, room.name, '', Place('lie', (*at, z, yaw))))
                if len(found) == MOST:
                    return found
        for spot in last:
            if all(math.dist(spot.stand, other.stand) > LENGTH for other in found
                   if other.storey == spot.storey):
                found.append(spot)
        return found

    def _beds(self, room: Room) -> Iterator[tuple[Point, float, bool]]:
        """Places on the open floor where people can lie, the yaw of each, and whether a person
        who lies there is in the way: far from doors first."""
        free, whole = self.floors.floor_of(room), self.floors.free[room.storey]
        grid = self.floors.grids[room.storey]
        x, y = np.meshgrid(grid.x, grid.y)
        cells = round(LONG / RESOLUTION)
        lines = [(binary_erosion(free, np.ones(shape, bool)), yaw)
                 for shape, yaw in (((1, cells), 0.0), ((cells, 1), math.pi / 2))]
        px, py = (np.concatenate([part[line] for line, _ in lines]) for part in (x, y))
        turned = np.concatenate([np.full(line.sum(), yaw) for line, yaw in lines])
        near = np.full(len(px), np.inf)
        for door in self.home.doors:
            if door.kind != 'window' and room.name in door.rooms:
                near = np.minimum(near, np.hypot(px - door.pose[0], py - door.pose[1]))
        order = np.lexsort((turned, py, px, -near))
        while len(order):
            best = order[0]
            point, yaw = (float(px[best]), float(py[best])), float(turned[best])
            divides = _divides(whole, x - point[0], y - point[1], yaw)
            yield point, yaw, divides
            away = np.hypot(px[order] - point[0], py[order] - point[1])
            taken = (away <= LONG / 4) & (turned[order] == yaw) if divides else away <= LENGTH
            order = order[~taken]

    def _of(self, what: str, posture: str) -> list[Spot]:
        key = (what, posture)
        if key not in self._spots:
            self._spots[key] = list(self._find(what, posture))
        return self._spots[key]

    def _find(self, what: str, posture: str) -> list[Spot]:
        if what == OUTSIDE:
            return self._porch()
        if what == ENTRANCE:
            return self._inside()
        use, _, kind = what.rpartition(' ')
        found = []
        for thing in sorted(self.home.things, key=lambda t: t.name):
            if thing.type == kind and (not use or self.use(thing.room) == use):
                found += self._at(thing, posture)
        return found

    def _at(self, thing: Thing, posture: str) -> list[Spot]:
        room = self._rooms.get(thing.room)
        if room is None or room.storey not in self.floors.grids:
            return []
        floor = self.home.elevation(room.storey)
        places = [place for place in thing.places if place.posture == posture]
        if posture == 'stand' and not places:
            places = self._fronts(thing, floor)
        leaf = self.floors.fronts.leaf(thing) if thing.type in OPENS else None
        found = []
        for place in places:
            x, y = place.pose[0], place.pose[1]
            stand = self.floors.near(x, y, floor, FAR if posture == 'lie' else 1.1, leaf)
            if stand is None:
                continue
            seat = None
            if posture != 'stand':
                support = self.floors.support(place)
                if posture == 'sit' and support > place.pose[2] + COVERED:
                    continue
                seat = replace(place, pose=(x, y, support, place.pose[3]))
            found.append(Spot(stand, room.storey, floor, thing.room, thing.name, seat))
        return found

    def _fronts(self, thing: Thing, floor: float) -> list[Place]:
        """Before a thing that names no place: ahead of it, or else beside it."""
        x, y, _, qx, qy, qz, qw = thing.pose
        yaw = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
        return [Place('stand', (x + TOWARDS * math.cos(yaw), y + TOWARDS * math.sin(yaw), floor,
                                yaw + math.pi))]

    def _porch(self) -> list[Spot]:
        porch = self.floors.porch()
        if porch is None:
            return []
        point, storey = porch
        z = self.home.elevation(storey)
        room = self.home.room_at(*point, z + 0.1)
        return [Spot(point, storey, z, room.name if room else '')]

    def _inside(self) -> list[Spot]:
        """Behind the entrance's door, clear of its leaf, or before that of a landing."""
        door, porch = self.floors.entrance(), self.floors.porch()
        if door is None or porch is None:
            return []
        z = self.home.elevation(porch[1])
        for x, y in ((2 * door.pose[0] - porch[0][0], 2 * door.pose[1] - porch[0][1]), porch[0]):
            point = self.floors.near(x, y, z)
            room = self.home.room_at(x, y, z + 0.1)
            if point and room:
                return [Spot(point, porch[1], z, room.name)]
        return []


def _divides(free: np.ndarray, x: np.ndarray, y: np.ndarray, yaw: float) -> bool:
    """Whether a person who lies at x = y = 0 separates parts of a floor from each other."""
    along = np.abs(math.cos(yaw) * x + math.sin(yaw) * y)
    across = math.cos(yaw) * y - math.sin(yaw) * x
    left, _ = label(free & (np.hypot(np.maximum(along - LYING, 0.0), across) > BESIDE),
                    np.ones((3, 3), int))
    sizes = np.sort(np.bincount(left.ravel())[1:])
    return len(sizes) > 1 and bool(sizes[-2] * RESOLUTION ** 2 > PART)
