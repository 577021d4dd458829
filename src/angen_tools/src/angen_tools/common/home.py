"""A home as the simulator describes it: rooms, their contents and connections (docs/home.md).

Lengths in m, angles in rad, in the world."""
import math
from dataclasses import dataclass, field, is_dataclass
from functools import cache
from typing import Any, Mapping, get_args, get_origin, get_type_hints

from angen_tools.common.catalog import angen_module
from angen_tools.common.clock import time_of_day
from angen_tools.common.geometry import Point, bounds, center, contains, edges, to_segment
from angen_tools.common.geometry import yaw as yaw_of

IN_WALL = 0.1  # m: a thing in a wall, floor or ceiling is in the room
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
        return bounds(self.polygon)

    @property
    def center(self) -> Point:
        """The centroid of its polygon."""
        return center(self.polygon)

    def contains(self, x: float, y: float) -> bool:
        """Whether a place is inside, at any height."""
        return contains(self.polygon, x, y, self.holes)

    def distance(self, x: float, y: float) -> float:
        """To the nearest of its edges, from either side."""
        return min(to_segment((x, y), a, b) for polygon in (self.polygon, *self.holes)
                   for a, b in edges(polygon))

    def at_height(self, z: float) -> bool:
        return self.floor - IN_WALL <= z <= self.ceiling + IN_WALL

    def gap(self, other: 'Room') -> float:
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
    def of(given: Any) -> 'Home':
        """The home of a dict such as `world.home`, or of an angen_msgs/Home."""
        home: Home = _made(Home, given)
        return home

    @staticmethod
    def of_world(world: Any) -> 'Home':
        """The home of an `angen.World`."""
        return Home.of(world.home)

    def room(self, name: str) -> Room | None:
        return next((room for room in self.rooms if room.name == name), None)

    def room_at(self, x: float, y: float, z: float) -> Room | None:
        """The room that a place is in, or in whose wall, floor or ceiling; None outside."""
        here = [room for room in self.rooms if room.at_height(z)]
        inside = next((room for room in here if room.contains(x, y)), None)
        if inside is not None:
            return inside
        away, nearest = min(((room.distance(x, y), i) for i, room in enumerate(here)),
                            default=(IN_WALL, 0))
        return here[nearest] if away < IN_WALL else None

    @property
    def described(self) -> bool:
        """Whether its world says which rooms there are; else they were found between walls."""
        return any(not room.guessed for room in self.rooms)

    @property
    def time_of_day(self) -> float:
        """At simulated time 0, in s since midnight; 0 if the world does not say."""
        return time_of_day(self.start.partition('T')[2] or '0:00')

    def storey(self, number: int) -> Storey | None:
        return next((storey for storey in self.storeys if storey.number == number), None)

    def storey_at(self, z: float) -> int:
        """The number of the storey at a height, 0 in a home without storeys."""
        return int(self.storeys_at(z))

    def storeys_at(self, z: Any) -> Any:
        """As storey_at(), also of an array of heights."""
        described = [(storey.number, storey.elevation) for storey in self.storeys]
        return angen_module().storey_at(described, z)

    def elevation(self, number: int) -> float:
        """The height of a storey's floor; 0 in a home without storeys."""
        storey = self.storey(number)
        return storey.elevation if storey else 0.0


@cache
def _fields(kind: Any) -> dict[str, Any]:
    """The names and types of a dataclass's fields."""
    return get_type_hints(kind)


def _made(kind: Any, given: Any) -> Any:
    """A value of this type, of a part of a dict or of a message."""
    if is_dataclass(kind):
        names = given if isinstance(given, Mapping) else given.__slots__
        read = given.__getitem__ if isinstance(given, Mapping) else given.__getattribute__
        return kind(**{name: _made(each, read(name)) for name, each in _fields(kind).items()
                       if name in names})
    if get_origin(kind) is list:
        each, = get_args(kind)
        return [_made(each, value) for value in getattr(given, 'points', given)]
    if get_origin(kind) is tuple:
        return tuple(given if isinstance(given, (list, tuple)) else _numbers(kind, given))
    return None if isinstance(given, float) and math.isnan(given) else given


def _numbers(kind: Any, given: Any) -> tuple[float, ...]:
    """Those of a message's point or pose."""
    if kind == Point:
        return given.x, given.y
    at, turned = given.position, given.orientation
    quaternion = turned.x, turned.y, turned.z, turned.w
    return at.x, at.y, at.z, *((yaw_of(*quaternion),) if kind == FloorPose else quaternion)
