"""Places of a home to which a menu sends people and robots."""
from __future__ import annotations

import math
from typing import Iterator

from angen_tools.common.home import FloorPose, Home, Room

INSIDE = 0.8  # m from the middle of a door into its room
SEAT = 0.5  # m around the place of one who sits or lies, where a seat may be in the way


def places(home: Home, z: float) -> list[tuple[str, FloorPose]]:
    """The rooms of the storey of a mover at height z, each with a place in it."""
    if not home.rooms:
        return []
    storey = home.storey_at(z)
    return [(room.name, place(home, room)) for room in home.rooms if room.storey == storey]


def place(home: Home, room: Room) -> FloorPose:
    """Where one stands to use a thing, or inside the first door, or the middle of a room."""
    return next((at for at in _candidates(home, room) if room.contains(*at[:2])),
                (*room.center, room.floor, 0.0))


def _candidates(home: Home, room: Room) -> Iterator[FloorPose]:
    spots = [spot for thing in home.things if thing.room == room.name for spot in thing.places]
    seats = [spot.pose[:2] for spot in spots if spot.posture != 'stand']
    for spot in spots:
        if spot.posture == 'stand' and all(math.dist(spot.pose[:2], seat) > SEAT
                                           for seat in seats):
            yield spot.pose
    for door in home.doors:
        if door.kind != 'window' and room.name in door.rooms:
            x, y, z, yaw = door.pose
            heading = yaw + math.pi / 2 * (1 if door.rooms[0] == room.name else -1)
            yield (x + INSIDE * math.cos(heading), y + INSIDE * math.sin(heading), z, heading)
