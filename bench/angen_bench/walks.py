"""A person walks through each door of a home, there and back."""
from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, sin
from pathlib import Path
from typing import Any, Mapping

import numpy as np
from scipy.ndimage import label

from angen_bench.free_map import CELL, free_map

BESIDE = (0.7, 1.0, 1.4, 0.5)  # m from a door to where the person is sent
LIMIT = 60.0  # s for a way
LOOK = 0.1  # s between two looks at the person
NEAR = 0.35  # m from the goal
LEAST_WIDTH = 0.6  # m: narrower doors are not for people
Spot = tuple[float, float]


@dataclass
class Floor:
    """A storey: where a person's middle may be, and the regions of it."""

    z: float
    free: np.ndarray
    west: float
    south: float
    regions: np.ndarray

    @staticmethod
    def of(path: Path, z: float) -> Floor:
        free, west, south = free_map(path, z)
        return Floor(z, free, west, south, label(free)[0])

    def region(self, x: float, y: float) -> int:
        row, column = int((y - self.south) / CELL), int((x - self.west) / CELL)
        inside = 0 <= row < self.free.shape[0] and 0 <= column < self.free.shape[1]
        return int(self.regions[row, column]) if inside else 0


def spots(floor: Floor, door: Mapping[str, Any]) -> tuple[Spot, Spot] | None:
    """A place on each side of a door, from each of which a person can get to the other."""
    x, y, _, yaw = door['pose']
    sides = []
    for sign in (-1, 1):
        sides.append([(x - sign * away * sin(yaw) + aside * cos(yaw),
                       y + sign * away * cos(yaw) + aside * sin(yaw))
                      for away in BESIDE for aside in (0.0, 0.3, -0.3)])
    for first in sides[0]:
        for second in sides[1]:
            region = floor.region(*first)
            if region and region == floor.region(*second):
                return first, second
    return None


def walk(path: Path, home: Mapping[str, Any]) -> tuple[int, list[str]]:
    """The number of doors that a person passed both ways, and the problems with the others."""
    import angen
    floors = {storey['number']: Floor.of(path, storey['elevation']) for storey in home['storeys']}
    rooms = {room['name']: room for room in home['rooms']}
    ways: dict[int, list[tuple[Mapping[str, Any], tuple[Spot, Spot]]]] = {}
    wrong = []
    for door in home['doors']:
        beside = [rooms[name] for name in door['rooms'] if name]
        if door['kind'] == 'window' or not beside or door['width'] < LEAST_WIDTH:
            continue
        number = beside[0]['storey']
        found = spots(floors[number], door)
        if found is None:
            wrong.append(f'{door["name"]}: no place for a person on both sides')
        else:
            ways.setdefault(number, []).append((door, found))
    actors = ''.join(_actor(number, *there[0][1][0], floors[number].z)
                     for number, there in sorted(ways.items()))
    world = angen.World.from_text(path.read_text().replace('</world>', f'{actors}</world>'))
    world.run(1.0)
    done = 0
    for number, there in sorted(ways.items()):
        for door, (first, second) in there:
            person = f'walker{number}'
            what = (_send(world, person, first) or _through(world, person, door, second)
                    or _through(world, person, door, first))
            if what:
                wrong.append(f'{door["name"]}: {what}')
            else:
                done += 1
    return done, wrong


def _actor(number: int, x: float, y: float, z: float) -> str:
    return (f'<actor name="walker{number}"><pose>{x} {y} {z} 0 0 0</pose><script>'
            '<trajectory id="0" type="walking"><waypoint><time>0</time>'
            f'<pose>{x} {y} {z} 0 0 0</pose></waypoint></trajectory></script></actor>')


def _send(world: Any, person: str, goal: Spot, seen: list[Spot] | None = None) -> str:
    """Sends a person; '' once it has arrived, else the state that it ended in."""
    world.command('person', person, f'GoTo {goal[0]:.3f} {goal[1]:.3f}')
    end = world.time + LIMIT
    while world.time < end:
        world.run(LOOK)
        state = world.device('person', person)
        if seen is not None:
            seen.append((state['x'], state['y']))
        if hypot(state['x'] - goal[0], state['y'] - goal[1]) < NEAR and state['mode'] == 'STANDING':
            return ''
        if state['unreachable']:
            return f'unreachable from {state["x"]:.2f} {state["y"]:.2f}'
    return f'{state["mode"]} at {state["x"]:.2f} {state["y"]:.2f} after {LIMIT:g} s'


def _through(world: Any, person: str, door: Mapping[str, Any], goal: Spot) -> str:
    """Sends a person to the other side of a door; its way must lead through the doorway."""
    seen: list[Spot] = []
    what = _send(world, person, goal, seen)
    if what:
        return what
    x, y, _, yaw = door['pose']
    local = [((px - x) * cos(yaw) + (py - y) * sin(yaw), (py - y) * cos(yaw) - (px - x) * sin(yaw))
             for px, py in seen]
    for (u0, v0), (u1, v1) in zip(local, local[1:]):
        if v0 * v1 <= 0 and v0 != v1 and abs(u0 + (u1 - u0) * v0 / (v0 - v1)) < door['width'] / 2:
            return ''
    return 'took another way'
