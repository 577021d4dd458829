"""A home as the simulator describes it: rooms, their contents and connections (docs/home.md).

Lengths in m, angles in rad, in the world."""
from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Mapping, Sequence

from angen_tools.common.clock import time_of_day
from angen_tools.common.geometry import yaw as yaw_of

ON_FLOOR = 0.5  # m below its floor that belong to a storey
IN_WALL = 0.1  # m: a thing in a wall, floor or ceiling is in the room
Point = tuple[float, float]
FloorPose = tuple[float, float, float, float]  # x y z yaw
Pose = tuple[float, float, float, float, float, float, float]  # x y z and quaternion x y z w


@dataclass(frozen=True)
class Storey:
    number: int
    name: str
    elevation: float
    height: float


@dataclass(frozen=True)
class Room:
    """`floor` and `ceiling` are heights in the world, `area` in m2."""

    name: str
    use: str
    storey: int
    polygon: list[Point]
    holes: list[list[Point]]
    floor: float
    ceiling: float
    area: float
    guessed: bool

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """The least and greatest x and y: x0, y0, x1, y1."""
        xs, ys = zip(*self.polygon)
        return min(xs), min(ys), max(xs), max(ys)

    @property
    def center(self) -> Point:
        """The centroid of its polygon."""
        x = y = twice = 0.0
        (x0, y0) = self.polygon[0]
        for (ax, ay), (bx, by) in _edges(self.polygon):
            cross = (ax - x0) * (by - y0) - (bx - x0) * (ay - y0)
            twice += cross
            x += cross * (ax + bx - 2 * x0)
            y += cross * (ay + by - 2 * y0)
        return x0 + x / (3 * twice), y0 + y / (3 * twice)

    def contains(self, x: float, y: float) -> bool:
        """Whether a place is inside, at any height."""
        return _inside(self.polygon, x, y) and not any(_inside(hole, x, y) for hole in self.holes)

    def distance(self, x: float, y: float) -> float:
        """To the nearest of its edges, from either side."""
        return min(_away(a, b, x, y) for polygon in (self.polygon, *self.holes)
                   for a, b in _edges(polygon))

    def at_height(self, z: float) -> bool:
        return self.floor - IN_WALL <= z <= self.ceiling + IN_WALL

    def gap(self, other: Room) -> float:
        """Between the nearest edges of two rooms."""
        return min(min(other.distance(x, y) for x, y in self.polygon),
                   min(self.distance(x, y) for x, y in other.polygon))


@dataclass(frozen=True)
class Place:
    """The position of a person who uses a thing: `pose` of the feet, the seat or the middle."""

    posture: str
    pose: FloorPose


@dataclass(frozen=True)
class Thing:
    name: str
    type: str
    room: str
    pose: Pose
    places: list[Place]


@dataclass(frozen=True)
class Door:
    """A door, window or opening; `rooms` on its left and right, '' outside. `partner` is the other
    leaf of a double door."""

    name: str
    kind: str
    rooms: tuple[str, str]
    width: float
    height: float
    pose: FloorPose
    partner: str = ''

    def other(self, room: str) -> str:
        """The room on its other side."""
        return self.rooms[1] if room == self.rooms[0] else self.rooms[0]


@dataclass(frozen=True)
class Landing:
    storey: int
    room: str
    pose: FloorPose


@dataclass(frozen=True)
class Elevator:
    name: str
    pose: Pose
    landings: list[Landing]


@dataclass(frozen=True)
class Home:
    entrance: str = ''
    north: float = math.pi / 2
    latitude: float | None = None
    start: str = ''
    storeys: list[Storey] = field(default_factory=list)
    rooms: list[Room] = field(default_factory=list)
    things: list[Thing] = field(default_factory=list)
    doors: list[Door] = field(default_factory=list)
    elevators: list[Elevator] = field(default_factory=list)

    @staticmethod
    def of_dict(home: Mapping[str, Any]) -> Home:
        """The home of a dict such as `world.home`."""
        def corners(polygon: Sequence[Sequence[float]]) -> list[Point]:
            return [(x, y) for x, y in polygon]

        return Home(
            home['entrance'], home['north'], home['latitude'], home['start'],
            [Storey(**storey) for storey in home['storeys']],
            [Room(r['name'], r['use'], r['storey'], corners(r['polygon']),
                  [corners(hole) for hole in r['holes']], r['floor'], r['ceiling'], r['area'],
                  r['guessed']) for r in home['rooms']],
            [Thing(t['name'], t['type'], t['room'], _seven(t['pose']),
                   [Place(place['posture'], _four(place['pose'])) for place in t['places']])
             for t in home['things']],
            [Door(d['name'], d['kind'], (d['rooms'][0], d['rooms'][1]), d['width'], d['height'],
                  _four(d['pose']), d.get('partner', '')) for d in home['doors']],
            [Elevator(e['name'], _seven(e['pose']),
                      [Landing(at['storey'], at['room'], _four(at['pose']))
                       for at in e['landings']]) for e in home['elevators']])

    @staticmethod
    def of_world(world: Any) -> Home:
        """The home of an `angen.World`."""
        return Home.of_dict(world.home)

    @staticmethod
    def of_message(message: Any) -> Home:
        """The home of an angen_msgs/Home."""
        return Home(
            message.entrance, message.north,
            None if math.isnan(message.latitude) else message.latitude, message.start,
            [Storey(s.number, s.name, s.elevation, s.height) for s in message.storeys],
            [Room(r.name, r.use, r.storey, _corners(r.polygon), [_corners(h) for h in r.holes],
                  r.floor, r.ceiling, r.area, r.guessed) for r in message.rooms],
            [Thing(t.name, t.type, t.room, _pose(t.pose),
                   [Place(p.posture, _flat(p.pose)) for p in t.places]) for t in message.things],
            [Door(d.name, d.kind, (d.rooms[0], d.rooms[1]), d.width, d.height, _flat(d.pose),
                  d.partner) for d in message.doors],
            [Elevator(e.name, _pose(e.pose), [Landing(at.storey, at.room, _flat(at.pose))
                                              for at in e.landings]) for e in message.elevators])

    def room(self, name: str) -> Room | None:
        return next((room for room in self.rooms if room.name == name), None)

    def room_at(self, x: float, y: float, z: float) -> Room | None:
        """The room that a place is in, or in whose wall, floor or ceiling; None outside."""
        nearest, distance = None, IN_WALL
        for room in self.rooms:
            if not room.at_height(z):
                continue
            if room.contains(x, y):
                return room
            away = room.distance(x, y)
            if away < distance:
                nearest, distance = room, away
        return nearest

    @property
    def described(self) -> bool:
        """Whether its world says which rooms there are; else they were found between walls."""
        return any(not room.guessed for room in self.rooms)

    @property
    def time_of_day(self) -> float:
        """At simulated time 0, in s since midnight; 0 where the world does not say."""
        return time_of_day(self.start.partition('T')[2] or '0:00')

    def storey(self, number: int) -> Storey | None:
        return next((storey for storey in self.storeys if storey.number == number), None)

    def storey_at(self, z: float) -> int:
        """The number of the highest storey whose floor is not above z, or else of the lowest."""
        below = [storey for storey in self.storeys if storey.elevation - ON_FLOOR <= z]
        return next((storey.number for storey in below[-1:] or self.storeys), 0)

    def elevation(self, number: int) -> float:
        """The height of a storey's floor; 0 in a home without storeys."""
        storey = self.storey(number)
        return storey.elevation if storey else 0.0


def _edges(polygon: list[Point]) -> list[tuple[Point, Point]]:
    return list(zip(polygon, polygon[1:] + polygon[:1]))


def _inside(polygon: list[Point], x: float, y: float) -> bool:
    inside = False
    for (ax, ay), (bx, by) in _edges(polygon):
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            inside = not inside
    return inside


def _away(a: Point, b: Point, x: float, y: float) -> float:
    along = (b[0] - a[0], b[1] - a[1])
    length = along[0] ** 2 + along[1] ** 2
    share = ((x - a[0]) * along[0] + (y - a[1]) * along[1]) / length if length else 0.0
    share = min(max(share, 0.0), 1.0)
    return math.hypot(x - a[0] - share * along[0], y - a[1] - share * along[1])


def _four(values: Sequence[float]) -> FloorPose:
    x, y, z, yaw = values
    return x, y, z, yaw


def _seven(values: Sequence[float]) -> Pose:
    x, y, z, *turned = values
    return x, y, z, turned[0], turned[1], turned[2], turned[3]


def _corners(polygon: Any) -> list[Point]:
    return [(point.x, point.y) for point in polygon.points]


def _pose(pose: Any) -> Pose:
    at, turned = pose.position, pose.orientation
    return at.x, at.y, at.z, turned.x, turned.y, turned.z, turned.w


def _flat(pose: Any) -> FloorPose:
    x, y, z, *turned = _pose(pose)
    return x, y, z, yaw_of(*turned)
