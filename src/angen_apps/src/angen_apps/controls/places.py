"""Places of a home to which a menu sends people and robots."""
import math
from dataclasses import dataclass, field
from typing import Any, Iterator

from angen_tools.common.home import FloorPose, Home, Room
from angen_tools.common.geometry import local, turned, yaw_of

INSIDE = 0.8  # m from the middle of a door into its room
SEAT = 0.5  # m around the place of a person who sits or lies, where a seat may be in the way
STEP = 0.4  # m between places of a room that are tried last
AROUND = 0.3  # m from obstacles that a mover needs
APART = 0.7  # m between the middles of two who stand
LOW, HIGH = 0.1, 1.5  # m over the floor: shapes between these are obstacles
BOX, CYLINDER = 0, 2  # types of angen_msgs/SceneShape


@dataclass(frozen=True)
class Box:
    """An obstacle on the floor: its middle, turn and half lengths."""

    x: float
    y: float
    yaw: float
    half: tuple[float, float]

    def distance(self, x: float, y: float) -> float:
        return math.hypot(*(max(0.0, abs(way) - half) for way, half in zip(
            local((self.x, self.y), self.yaw, (x, y)), self.half)))


@dataclass(frozen=True)
class Taken:
    """The obstacles: things, and people and robots, by their middles."""

    things: list[Box] = field(default_factory=list)
    movers: list[tuple[float, float]] = field(default_factory=list)

    def apart(self, x: float, y: float) -> bool:
        return all(math.dist((x, y), other) > APART for other in self.movers)

    def is_free(self, x: float, y: float) -> bool:
        return self.apart(x, y) and all(box.distance(x, y) > AROUND for box in self.things)


def things(scene: Any, floor: float, movers: set[str]) -> list[Box]:
    """Boxes and cylinders of an angen_msgs/Scene that stand on a floor, without those of some
    models."""
    found = []
    for shape in scene.shapes:
        link = scene.links[shape.link]
        at, low = link.pose.position, floor + LOW
        z, half = at.z + shape.pose.position.z, shape.size.z / 2
        if shape.type not in (BOX, CYLINDER) or link.model in movers or not (
                z + half > low and z - half < floor + HIGH):
            continue
        yaw, own = yaw_of(link.pose.orientation), shape.pose.position
        found.append(Box(*turned((at.x, at.y), yaw, own.x, own.y),
                         yaw + yaw_of(shape.pose.orientation),
                         (shape.size.x / 2, shape.size.y / 2)))
    return found


def rooms(home: Home, z: float) -> list[Room]:
    """Those of the storey of a mover at height z."""
    storey = home.storey_at(z) if home.rooms else None
    return [room for room in home.rooms if room.storey == storey]


def place(home: Home, room: Room, taken: Taken) -> FloorPose | None:
    """A place to use a thing, or inside a door, or in the middle, or anywhere in the room;
    None if no place is free."""
    at_things = (at for at in _at_things(home, room) if taken.apart(*at[:2]))
    others = (at for at in _others(home, room) if taken.is_free(*at[:2]))
    return next((at for places in (at_things, others) for at in places
                 if room.contains(*at[:2])), None)


def _at_things(home: Home, room: Room) -> Iterator[FloorPose]:
    spots = [spot for thing in home.things if thing.room == room.name for spot in thing.places]
    seats = [spot.pose[:2] for spot in spots if spot.posture != 'stand']
    for spot in spots:
        if spot.posture == 'stand' and all(math.dist(spot.pose[:2], seat) > SEAT
                                           for seat in seats):
            yield spot.pose


def _others(home: Home, room: Room) -> Iterator[FloorPose]:
    for door in home.doors:
        if door.kind != 'window' and room.name in door.rooms:
            x, y, z, yaw = door.pose
            heading = yaw + math.pi / 2 * (1 if door.rooms[0] == room.name else -1)
            yield (*turned((x, y), heading, INSIDE, 0.0), z, heading)
    west, south, east, north = room.bounds
    grid = [(west + STEP * i, south + STEP * j)
            for i in range(1, math.ceil((east - west) / STEP))
            for j in range(1, math.ceil((north - south) / STEP))]
    for x, y in [room.center, *sorted(grid, key=lambda at: math.dist(at, room.center))]:
        if room.distance(x, y) > AROUND:
            yield (x, y, room.floor, 0.0)
