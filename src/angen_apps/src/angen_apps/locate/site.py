"""Rooms, what joins them, and which sensor is in which: what locating knows of a home."""
from __future__ import annotations

import math
import re
from collections import Counter
from dataclasses import dataclass, field
from typing import Any, Iterable, Mapping, Sequence

import numpy as np

from angen_apps.maps.gridmap import floor_of

WALL = 0.06        # m: what hangs in a wall is in its room
BESIDE = 0.6       # m from the middle of a door to the rooms on its sides
LEAF = 0.5         # m from a door's hinge to its middle
NEXT = 0.3         # m: rooms nearer than this touch
LANDING = 2.0      # m from an elevator's cabin to the rooms that it serves
GRID = 0.25        # m between the places of a room at which an RFID tag may be
TAG_HEIGHT = 1.0   # m
NAMED = re.compile(r'(.+?)_(?:pir|lux|switch|rfid|mat)(\d+)')


@dataclass(frozen=True)
class Thing:
    """A sensor or device, and where it is."""

    kind: str
    name: str
    at: tuple[float, float, float]
    yaw: float


@dataclass(frozen=True)
class Room:
    """A box of air with a name."""

    name: str
    low: tuple[float, float, float]
    high: tuple[float, float, float]

    @property
    def center(self) -> np.ndarray:
        return (np.array(self.low) + np.array(self.high)) / 2

    def holds(self, point: Sequence[float]) -> bool:
        return all(a - WALL <= v <= b + WALL for a, v, b in zip(self.low, point, self.high))

    def gap(self, other: Room) -> float:
        """Distance to another room, m."""
        return math.hypot(*(max(a - d, c - b, 0.0) for a, b, c, d in
                            zip(self.low, self.high, other.low, other.high)))


@dataclass
class Site:
    """A home: `ways` are (room, room, door), the door '' where none is between."""

    rooms: list[Room]
    ways: list[tuple[int, int, str]]
    things: dict[tuple[str, str], tuple[Thing, int]] = field(default_factory=dict)
    _places: dict[tuple[str, int, float], np.ndarray] = field(default_factory=dict)

    def room_at(self, point: Sequence[float]) -> int | None:
        """The number of the room at a place (m)."""
        return next((i for i, room in enumerate(self.rooms) if room.holds(point)), None)

    def of_kind(self, kind: str) -> dict[str, int]:
        """The room of each sensor of a kind."""
        return {name: room for (k, name), (_, room) in self.things.items() if k == kind}

    def tag_places(self, reader: str, room: int, distance: float, slack: float) -> np.ndarray:
        """Places (n, 2) of a room that are `distance` from a reader and before it, m."""
        key = (reader, room, distance)
        if key not in self._places:
            self._places[key] = self._search(reader, room, distance, slack)
        return self._places[key]

    def _search(self, reader: str, room: int, distance: float, slack: float) -> np.ndarray:
        thing, _ = self.things['rfid', reader]
        low, high = self.rooms[room].low, self.rooms[room].high
        x, y = np.meshgrid(np.arange(low[0] + GRID / 2, high[0], GRID),
                           np.arange(low[1] + GRID / 2, high[1], GRID))
        away = np.stack([x.ravel() - thing.at[0], y.ravel() - thing.at[1]], 1)
        height = low[2] + TAG_HEIGHT - thing.at[2]
        ranges = np.sqrt((away ** 2).sum(axis=1) + height ** 2)
        ahead = away @ [math.cos(thing.yaw), math.sin(thing.yaw)] > 0.0
        chosen = (np.abs(ranges - distance) < slack) & ahead
        return away[chosen] + thing.at[:2]


def make_site(climates: Iterable[tuple[Sequence[float], Mapping[str, Sequence[Any]]]],
              things: Iterable[Thing]) -> Site:
    """The home of climates, (x y z of the model, its `rooms` and perhaps `names`), and things.

    A climate's model stands unturned, as a flat does.
    """
    things = list(things)
    rooms: list[Room] = []
    for origin, state in climates:
        boxes = np.asarray(state['rooms'], float).reshape(-1, 2, 3) + np.asarray(origin)
        names = list(state.get('names', ()))
        for i, (low, high) in enumerate(boxes):
            name = f'{names[i]}{floor_of(low[2])}' if len(names) == len(boxes) else ''
            rooms.append(Room(name, (low[0], low[1], low[2]), (high[0], high[1], high[2])))
    rooms = [room if room.name else Room(_named_by(room, things, i), room.low, room.high)
             for i, room in enumerate(rooms)]
    site = Site(rooms, [])
    for thing in things:
        number = site.room_at(thing.at)
        if thing.kind == 'door':
            _add_door(site, thing)
        elif thing.kind == 'elevator':
            _add_elevator(site, thing)
        elif number is not None:
            site.things[thing.kind, thing.name] = (thing, number)
    _add_openings(site)
    return site


def _named_by(room: Room, things: Sequence[Thing], number: int) -> str:
    """What most of the sensors in it are called after: kitchen_pir0_a is in kitchen0."""
    found = Counter(''.join(match.groups()) for thing in things if room.holds(thing.at)
                    for match in [NAMED.match(thing.name)] if match)
    return found.most_common(1)[0][0] if found else f'room{number}'


def _add_door(site: Site, door: Thing) -> None:
    """A door's origin is on its hinge at the floor, x along the shut leaf."""
    x, y, z = door.at
    c, s = math.cos(door.yaw), math.sin(door.yaw)
    sides = {site.room_at((x + c * LEAF - s * side, y + s * LEAF + c * side, z + 1.0))
             for side in (BESIDE, -BESIDE)}
    if len(sides) == 2 and None not in sides:
        a, b = sorted(room for room in sides if room is not None)
        site.ways.append((a, b, door.name))


def _add_elevator(site: Site, elevator: Thing) -> None:
    x, y, _ = elevator.at
    near = [i for i, room in enumerate(site.rooms)
            if math.hypot(max(room.low[0] - x, x - room.high[0], 0.0),
                          max(room.low[1] - y, y - room.high[1], 0.0)) < LANDING]
    site.ways += [(a, b, '') for a, b in zip(near, near[1:])]


def _add_openings(site: Site) -> None:
    """A room without any door is open to all that it touches."""
    has_door = {room for a, b, door in site.ways if door for room in (a, b)}
    for i, room in enumerate(site.rooms):
        site.ways += [(i, j, '') for j, other in enumerate(site.rooms)
                      if i != j and i not in has_door and room.gap(other) < NEXT]
