"""Knowledge of a home for locating: rooms, the openings between them, and their sensors."""
from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Iterable, Sequence

import numpy as np

from angen_tools.common.failure import Failure
from angen_tools.common.home import Home, Room

GRID = 0.25        # m between the places of a room at which an RFID tag may be
TAG_HEIGHT = 1.0   # m


@dataclass(frozen=True)
class Thing:
    """A sensor, and where it is."""

    kind: str
    name: str
    at: tuple[float, float, float]
    yaw: float


@dataclass
class Site:
    """A home: `ways` are (room, room, door), the door '' where none is between."""

    home: Home
    ways: list[tuple[int, int, str]]
    things: dict[tuple[str, str], tuple[Thing, int]] = field(default_factory=dict)
    _places: dict[tuple[str, int, float], np.ndarray] = field(default_factory=dict)

    @property
    def rooms(self) -> list[Room]:
        return self.home.rooms

    def room_at(self, point: Sequence[float]) -> int | None:
        """The number of the room at a place (m)."""
        room = self.home.room_at(*point)
        return None if room is None else self.rooms.index(room)

    def of_kind(self, kind: str) -> dict[str, int]:
        """The room of each sensor of a kind."""
        return {name: room for (k, name), (_, room) in self.things.items() if k == kind}

    def tag_places(self, reader: str, room: int, distance: float, slack: float) -> np.ndarray:
        """Places (n, 2) of a room that are `distance` from a reader and before it, m."""
        key = (reader, room, distance)
        if key not in self._places:
            self._places[key] = self._search(reader, self.rooms[room], distance, slack)
        return self._places[key]

    def _search(self, reader: str, room: Room, distance: float, slack: float) -> np.ndarray:
        thing, _ = self.things['rfid', reader]
        x0, y0, x1, y1 = room.bounds
        x, y = np.meshgrid(np.arange(x0 + GRID / 2, x1, GRID), np.arange(y0 + GRID / 2, y1, GRID))
        away = np.stack([x.ravel() - thing.at[0], y.ravel() - thing.at[1]], 1)
        height = room.floor + TAG_HEIGHT - thing.at[2]
        ranges = np.sqrt((away ** 2).sum(axis=1) + height ** 2)
        ahead = away @ [math.cos(thing.yaw), math.sin(thing.yaw)] > 0.0
        inside = [room.contains(*place) for place in zip(x.ravel(), y.ravel())]
        chosen = (np.abs(ranges - distance) < slack) & ahead & inside
        return away[chosen] + thing.at[:2]


def make_site(home: Home, things: Iterable[Thing]) -> Site:
    """The home with the sensors in its rooms; Failure where it has no rooms."""
    if not home.rooms:
        raise Failure('the world has no rooms; describe them by <angen:room> (docs/home.md)')
    number = {room.name: i for i, room in enumerate(home.rooms)}
    site = Site(home, [])
    for door in home.doors:
        if door.kind != 'window' and door.rooms[0] != door.rooms[1] and '' not in door.rooms:
            a, b = sorted(number[room] for room in door.rooms)
            site.ways.append((a, b, door.name if door.kind == 'door' else ''))
    for lift in home.elevators:
        stops = [number[landing.room] for landing in lift.landings if landing.room]
        site.ways += [(a, b, '') for a, b in zip(stops, stops[1:])]
    for thing in things:
        room = site.room_at(thing.at)
        if room is not None:
            site.things[thing.kind, thing.name] = (thing, room)
    return site
