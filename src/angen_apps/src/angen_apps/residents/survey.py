"""Which places of a storey people can walk on, by rays."""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED, RESOLUTION
from angen_apps.plan.polygons import in_room
from angen_tools.common.catalog import angen_module
from angen_tools.common.home import Door, Home

TALL = 2.0  # m: higher things are not obstacles
STEP = 0.06  # m: a higher thing on the floor is an obstacle
DROP = 0.3  # m: deeper ground is not walkable
HEIGHTS = (0.2, 1.0, 1.8)  # m above the floor where walls are looked for
PAST = 1e-4  # m beyond a surface: the start of the next ray
MARGIN = 1.5  # m around the rooms
DEEP = 0.35  # m to both sides of a door's middle that belong to its opening
JOINT = 0.03  # m beside a leaf, to the other one of a double door
PORCH = 1.2  # m outside the entrance where people come and go
OPENS_IN = 20.0  # s, at most


def storey_at(home: Home, z: float) -> int:
    """The storey whose floor is nearest below a height."""
    return min(home.storeys, key=lambda s: (abs(s.elevation - z), s.number)).number


def elevation(home: Home, storey: int) -> float:
    return float(next(s.elevation for s in home.storeys if s.number == storey))


def survey(world: Any, home: Home, storey: int) -> Grid:
    """The map of a storey: free where only floor is below TALL."""
    rooms = [room for room in home.rooms if room.storey == storey]
    corners = np.array([corner for room in rooms for corner in room.polygon])
    west, south = np.floor((corners.min(axis=0) - MARGIN) / RESOLUTION) * RESOLUTION
    columns, rows = np.ceil((corners.max(axis=0) + MARGIN - (west, south))
                            / RESOLUTION).astype(int)
    grid = Grid(np.full((rows, columns), OCCUPIED), (float(west), float(south)), RESOLUTION,
                storey)
    row, column = np.indices(grid.cells.shape)
    x, y = (part.ravel() for part in middles(grid, row, column))
    within = np.zeros(len(x), bool)
    for room in rooms:
        within |= in_room(room, x, y)
    floor = elevation(home, storey)
    for door in home.doors:
        if door.kind != 'window' and storey_at(home, door.pose[2]) == storey:
            outside = door.name == home.entrance
            within |= opening(x, y, door, PORCH + 0.2 if outside else DEEP)
    free = np.zeros(len(x), bool)
    free[within] = _clear(world, x[within], y[within], floor)
    grid.cells[free.reshape(grid.cells.shape) & ~_surfaces(world, grid, floor)] = FREE
    return grid


def _clear(world: Any, x: np.ndarray, y: np.ndarray, floor: float) -> np.ndarray:
    """The cells with only floor below TALL, by rays from above."""
    origins = np.column_stack([x, y, np.full(len(x), floor + TALL)])
    down = np.broadcast_to([0.0, 0.0, -1.0], origins.shape)
    ranges = world.cast(origins, down, TALL + DROP + 0.01)
    return np.asarray((ranges > TALL - STEP) & (ranges < TALL + DROP))


def _surfaces(world: Any, grid: Grid, floor: float) -> np.ndarray:
    """Which cells (rows, columns) hold an upright surface, as of a wall, by level rays: those
    from above begin inside shapes as high as a wall."""
    found = np.zeros(grid.cells.shape, bool)
    for axis, count in ((0, grid.cells.shape[0]), (1, grid.cells.shape[1])):
        across = grid.origin[1 - axis] + (np.arange(count) + 0.5) * RESOLUTION
        starts = np.array([(a, floor + height) for a in across for height in HEIGHTS])
        origins = np.insert(starts, axis, grid.origin[axis], axis=1)
        end = grid.origin[axis] + grid.cells.shape[1 - axis] * RESOLUTION
        ways = np.eye(3)[axis]
        while len(origins):
            reach = end - origins[:, axis]
            ranges = world.cast(origins, np.broadcast_to(ways, origins.shape), reach)
            origins = origins[ranges < reach - PAST]
            origins[:, axis] += ranges[ranges < reach - PAST]
            at = np.floor((origins[:, :2] - grid.origin) / RESOLUTION).astype(int)
            found[at[:, 1], at[:, 0]] = True
            origins = origins + PAST * ways
    return found


def middles(grid: Grid, rows: np.ndarray, columns: np.ndarray
            ) -> tuple[np.ndarray, np.ndarray]:
    return (grid.origin[0] + (columns + 0.5) * grid.resolution,
            grid.origin[1] + (rows + 0.5) * grid.resolution)


def delete(world: Any, *kinds: str) -> None:
    for kind, _, model, _ in list(world.entities()):
        if kind in kinds and model in world.models:
            world.delete(model)


def open_all(world: Any, home: Home) -> None:
    """Has all doors stand open."""
    doors = [door.name for door in home.doors
             if door.kind == 'door' and door.name in world.devices('door')]
    for door in doors:
        try:
            world.command('door', door, 'Open')
        except angen_module().Error:
            continue  # it is locked, or has no drive
    end = world.time + OPENS_IN
    while doors and world.time < end:
        world.run(0.5)
        doors = [door for door in doors if world.device('door', door)['mode'] != 'OPEN']


def opening(x: np.ndarray, y: np.ndarray, door: Door, deep: float) -> np.ndarray:
    """Which places are in a door's opening, `deep` (m) to both sides of its middle."""
    c, s = math.cos(door.pose[3]), math.sin(door.pose[3])
    half = door.width / 2 + JOINT
    found = (np.abs(x - door.pose[0]) <= half + deep) & (np.abs(y - door.pose[1]) <= half + deep)
    dx, dy = x[found] - door.pose[0], y[found] - door.pose[1]
    found[found] = (np.abs(c * dx + s * dy) <= half) & (np.abs(c * dy - s * dx) <= deep)
    return np.asarray(found)
