"""A person walks through each door of a home, there and back."""
from __future__ import annotations

import re
from dataclasses import dataclass
from math import hypot
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping

from angen_apps.maps.cells import cell_of
from angen_bench.free_map import free_map, solids
from angen_tools.common.geometry import local, turned

if TYPE_CHECKING:
    from angen import Grid

BODY = 0.25  # m, half a person's width
ROOMY = 0.32  # m from a place to something, at best
BESET = 0.8  # m from a door: models this near are named where a person does not fit
BESIDE = (0.7, 1.0, 1.4, 0.5)  # m from a door to where the person is sent
LIMIT = 60.0  # s for a way
LOOK = 0.1  # s between two looks at the person
NEAR = 0.35  # m from the goal
PERSON = 'walker'
LEAST_WIDTH = 0.6  # m: narrower doors are not for people
Spot = tuple[float, float]


@dataclass
class Floor:
    """A storey: the parts in which a person's middle may be, and where it has more room."""

    parts: Grid
    roomy: Grid

    @staticmethod
    def of(path: Path, z: float) -> Floor:
        return Floor(free_map(path, z, BODY), free_map(path, z, ROOMY))

    def part(self, x: float, y: float, roomy: bool) -> int:
        """The number of the part that a place is in, below 0 if it is in none."""
        cell = cell_of(self.parts, (x, y))
        if cell is None or (roomy and self.roomy.cells[cell] < 0):
            return -1
        return int(self.parts.cells[cell])


def spots(floor: Floor, door: Mapping[str, Any]) -> tuple[Spot, Spot] | None:
    """A place on each side of a door, from each of which a person can get to the other."""
    x, y, _, yaw = door['pose']
    sides = []
    for sign in (-1, 1):
        sides.append([turned((x, y), yaw, aside, sign * away)
                      for away in BESIDE for aside in (0.0, 0.3, -0.3)])
    for roomy in (True, False):
        for first in sides[0]:
            for second in sides[1]:
                part = floor.part(*first, roomy)
                if part >= 0 and part == floor.part(*second, roomy):
                    return first, second
    return None


def walk(path: Path, home: Mapping[str, Any]) -> tuple[int, list[str]]:
    """The number of doors that a person passed both ways, and the problems with the others."""
    named = {door['name']: door for door in home['doors']}
    floors = {room['floor']: Floor.of(path, room['floor']) for room in home['rooms']}
    rooms = {room['name']: room for room in home['rooms']}
    text = path.read_text()
    wrong = []
    done = 0
    for door in home['doors']:
        beside = [rooms[name] for name in door['rooms'] if name]
        if door['kind'] == 'window' or not beside or door['width'] < LEAST_WIDTH:
            continue
        door = _doorway(door, named)
        found = spots(floors[beside[0]['floor']], door)
        if found is None:
            what = 'a person does not fit between ' + ', '.join(_beside(path, door))
        else:
            z = beside[0]['floor']
            # who is in a closet may have no room to pull its door: then from the other side
            what = _there_and_back(text, z, door, *found) and _there_and_back(
                text, z, door, *found[::-1])
        if what:
            wrong.append(f'{door["name"]}: {what}')
        else:
            done += 1
    return done, wrong


def _doorway(door: Mapping[str, Any], named: Mapping[str, Mapping[str, Any]]) -> Mapping[str, Any]:
    """A door, or both leaves of a double door as one: a person opens both."""
    side = re.search('(left|right)([0-9]*)$', door['name'])
    if side is None:
        return door
    other = named.get(door['name'][:side.start()] + {'left': 'right', 'right': 'left'}[side[1]]
                      + side[2])
    if other is None or hypot(*(a - b for a, b in zip(door['pose'][:2], other['pose'][:2]))) > 2.0:
        return door
    middle = [(a + b) / 2 for a, b in zip(door['pose'][:2], other['pose'][:2])]
    return {**door, 'pose': [*middle, *door['pose'][2:]], 'width': door['width'] + other['width']}


def _beside(path: Path, door: Mapping[str, Any]) -> list[str]:
    """The models beside a door, walls among them."""
    x, y, z, _ = door['pose']
    return sorted({shape.model for shape in solids(path, z)
                   if not all(hypot(px - x, py - y) > BESET for px, py in shape.corners)})


def _there_and_back(text: str, z: float, door: Mapping[str, Any], first: Spot, second: Spot
                    ) -> str:
    """In a world of its own, so that a door does not depend on the ways through others."""
    import angen
    actor = _actor(*first, z)
    world = angen.World.from_text(text.replace('</world>', f'{actor}</world>'))
    world.run(1.0)
    return _through(world, door, second) or _through(world, door, first)


def _actor(x: float, y: float, z: float) -> str:
    return (f'<actor name="{PERSON}"><script>'
            '<trajectory id="0" type="walking"><waypoint><time>0</time>'
            f'<pose>{x} {y} {z} 0 0 0</pose></waypoint></trajectory></script></actor>')


def _send(world: Any, goal: Spot, seen: list[Spot]) -> str:
    """Sends a person; '' once it has arrived, else the state that it ended in."""
    world.command('person', PERSON, f'GoTo {goal[0]:.3f} {goal[1]:.3f}')
    end = world.time + LIMIT
    while world.time < end:
        world.run(LOOK)
        state = world.device('person', PERSON)
        seen.append((state['x'], state['y']))
        if hypot(state['x'] - goal[0], state['y'] - goal[1]) < NEAR:
            return ''
        if state['unreachable']:
            return f'unreachable from {state["x"]:.2f} {state["y"]:.2f}'
    return f'{state["mode"]} at {state["x"]:.2f} {state["y"]:.2f} after {LIMIT:g} s'


def _through(world: Any, door: Mapping[str, Any], goal: Spot) -> str:
    """Sends a person to the other side of a door; its way must lead through the doorway."""
    seen: list[Spot] = []
    what = _send(world, goal, seen)
    if what:
        return what
    x, y, _, yaw = door['pose']
    way = [local((x, y), yaw, at) for at in seen]
    half = door['width'] / 2
    for (u0, v0), (u1, v1) in zip(way, way[1:]):
        if v0 * v1 <= 0 and v0 != v1 and abs(u0 + (u1 - u0) * v0 / (v0 - v1)) < half:
            return ''
    return 'took another way'
