"""Knowledge of a home for locating: the ways between its rooms, and its sensors."""
import math
from dataclasses import dataclass, field
from typing import Iterable

import numpy as np

from angen_apps.plan.polygons import inside
from angen_apps.robot.entities import Entity
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home, Room

GRID = 0.25        # m between the places of a room at which an RFID tag may be
TAG_HEIGHT = 1.0   # m
KINDS = ('pir', 'rfid', 'pressure')


@dataclass
class Site:
    """A home: `ways` are (room, room, door), the door '' where none is between."""

    home: Home
    ways: list[tuple[int, int, str]]
    sensors: dict[tuple[str, str], tuple[Entity, int]]  # by kind and name, with number of room
    _places: dict[tuple[str, int, float], np.ndarray] = field(default_factory=dict)

    @property
    def rooms(self) -> list[Room]:
        return self.home.rooms

    def of_kind(self, kind: str) -> dict[str, int]:
        """The room of each sensor of a kind."""
        return {name: room for (k, name), (_, room) in self.sensors.items() if k == kind}

    def tag_places(self, reader: str, room: int, distance: float, slack: float) -> np.ndarray:
        """Places (n, 2) of a room that are `distance` from a reader and before it, m."""
        key = (reader, room, distance)
        if key not in self._places:
            self._places[key] = self._search(reader, self.rooms[room], distance, slack)
        return self._places[key]

    def _search(self, reader: str, room: Room, distance: float, slack: float) -> np.ndarray:
        sensor, _ = self.sensors['rfid', reader]
        x0, y0, x1, y1 = room.bounds
        x, y = np.meshgrid(np.arange(x0 + GRID / 2, x1, GRID), np.arange(y0 + GRID / 2, y1, GRID))
        away = np.stack([x.ravel(), y.ravel()], 1) - sensor.place[:2]
        height = room.floor + TAG_HEIGHT - sensor.place[2]
        ranges = np.sqrt((away ** 2).sum(axis=1) + height ** 2)
        ahead = away @ [math.cos(sensor.flat.yaw), math.sin(sensor.flat.yaw)] > 0.0
        chosen = (np.abs(ranges - distance) < slack) & ahead & inside(
            room.polygon, x.ravel(), y.ravel(), room.holes)
        return away[chosen] + sensor.place[:2]


def make_site(home: Home, entities: Iterable[Entity]) -> Site:
    """The home with the sensors in its rooms; Failure if it has no rooms."""
    if not home.rooms:
        raise Failure('the world has no rooms; describe them by <angen:room> (docs/home.md)')
    number = {room.name: i for i, room in enumerate(home.rooms)}
    ways = []
    for door in home.doors:
        if door.kind != 'window' and door.rooms[0] != door.rooms[1] and '' not in door.rooms:
            a, b = sorted(number[room] for room in door.rooms)
            ways.append((a, b, door.name if door.kind == 'door' else ''))
    for lift in home.elevators:
        stops = [number[landing.room] for landing in lift.landings if landing.room]
        ways += [(a, b, '') for a, b in zip(stops, stops[1:])]
    return Site(home, ways, {(entity.kind, entity.name): (entity, number[entity.room])
                             for entity in entities if entity.kind in KINDS and entity.room})
