"""Says which doors of a home people do not pass, which rooms they do not reach, and why."""
from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Iterator

import numpy as np

from angen_apps.residents.floors import BODY, CLEAR, TALL, Floors
from angen_tools.common.catalog import simulator
from angen_tools.common.home import Door, Home, Room

SIDEWAYS = 0.36  # m in which a person walks who turns, which those of the simulator do not
LARGEST = 1000.0  # m2 of floor
OPENS = 1.0  # rad: a leaf that opens less is itself in the way
LOW, BESIDE = 0.15, 0.6  # m above a floor of what is in the way, and from the way


def ways_in(path: Path) -> list[str]:
    """The same of a world's file, if it is a home: maps of more floor take memory and time."""
    with simulator() as angen:
        world = angen.World(str(path))
        home = Home.of_world(world)
        if not 0.0 < sum(room.area for room in home.rooms) < LARGEST:
            return []
        return ways(Floors(angen.World(str(path)), home), world)


def ways(floors: Floors, world: Any) -> list[str]:
    """The counts of doors and rooms, and a line for each that is closed to people; `world` is not
    that of the floors, which loses its doors."""
    home = floors.home
    doors = [door for door in home.doors if door.kind == 'door'
             and home.storey_at(door.pose[2]) in floors.grids
             and (all(door.rooms) or door.name == home.entrance)]
    rooms = [room for room in home.rooms if room.use != 'outdoor']
    barred = [door for door in doors if door.name in floors.barred]
    lost = [room for room in rooms if room.name not in floors.reached]
    return [f'people have a way through {len(doors) - len(barred)} of {len(doors)} doors and to '
            f'{len(rooms) - len(lost)} of {len(rooms)} rooms',
            *(f'no way through {door.name}: {_barred(floors, world, door)}' for door in barred),
            *(f'no way to {room.name}: {_lost(floors, room)}' for room in lost)]


def _barred(floors: Floors, world: Any, door: Door) -> str:
    room, leaf = floors.barred[door.name], floors.leaves.get(door.name)
    turn = abs(leaf.open - leaf.shut) if leaf else math.pi
    if turn < OPENS:
        return f'its leaf opens by {math.degrees(turn):.0f} degrees only'
    near = min(_beside(floors, world, door), default=(0.0, 'a wall'))[1]
    turns = '; a real person turns sideways' if room >= SIDEWAYS else ''
    return f'{near} leaves {room:.2f} m of {2 * BODY:.2f} m{turns}' if room else \
        f'{near} is in the way'


def _beside(floors: Floors, world: Any, door: Door) -> Iterator[tuple[float, str]]:
    """Things near the way through a door, and m to it."""
    x, y, z, yaw = door.pose
    floor = floors.home.elevation(floors.home.storey_at(z))
    way = np.array([(x - across * math.sin(yaw), y + across * math.cos(yaw))
                    for across in np.linspace(-CLEAR, CLEAR, 15)])
    things = {thing.name for thing in floors.home.things}
    for model, _, _, _, corners in world.shapes:
        if model in things and len(corners) and corners[:, 2].max() > floor + LOW \
                and corners[:, 2].min() < floor + TALL:
            low, high = corners[:, :2].min(axis=0), corners[:, :2].max(axis=0)
            away = float(np.hypot(*np.maximum(np.maximum(low - way, way - high), 0.0).T).min())
            if away < BESIDE:
                yield round(away, 3), model


def _lost(floors: Floors, room: Room) -> str:
    doors = [door for door in floors.home.doors
             if door.kind != 'window' and room.name in door.rooms]
    if room.storey not in floors.grids:
        return 'no elevator leads to its floor'
    if not doors:
        return 'it has no door'
    barred = [door.name for door in doors if door.name in floors.barred]
    if len(barred) == len(doors):
        return f'there is none through {" and ".join(barred)}'
    beside = {name for door in doors for name in door.rooms if door.name not in barred}
    if not beside & floors.reached:
        return f'there is none to {" and ".join(sorted(beside - {room.name, ""}))}'
    return 'what stands there leaves none'
