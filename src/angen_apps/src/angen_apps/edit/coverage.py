"""The part of a floor in which sensors detect somebody, by rays and zones of the simulator."""
from base64 import b64encode
from math import ceil
from typing import Any

import numpy as np
from angen import Grid
from scipy.ndimage import binary_dilation

from angen_apps.maps.gridmap import models_with
from angen_tools.common.geometry import bounds
from angen_tools.common.home import Home, Room

CELL = 0.1  # m
CELLS = 500_000  # a larger floor has no map
BODY, STEP = 0.2, 0.1  # m: half the width of a person, and how far at least one who walks gets
FOOT = 0.1  # m over the floor from which a body is seen
STANDING, FALLEN = 1.7, 0.3  # m: the height of who stands, and of who lies on the floor
BUSY = 0.35  # m: where something is higher nobody stands


def coverage(world: Any, number: int) -> dict[str, Any] | None:
    """What the sensors of a storey see of its rooms while doors are as they are now; None without
    rooms. Changes the world: people and robots go. Masks are bits of cells, row after row from the
    south; `share`: of the floor on which one can stand, seen by motion sensors."""
    home = Home.of_world(world)
    rooms = [room for room in home.rooms if room.storey == number and room.use != 'outdoor']
    floor = home.elevation(number) if rooms else 0.0
    grid = _grid(rooms, number, floor)
    if grid is None:
        return None
    for model in [*world.devices('person'), *models_with(world, 'left_wheel_joint')]:
        world.delete(model)
    free = (grid.cells > 0) & _is_free(world, grid, floor)
    moves = np.zeros_like(free)
    sensors = []
    for kind, name in _sensors(world, home, number):
        rays = world.detection_rays(kind, name)
        if rays is None:
            continue
        points = _seen(world, rays)
        standing = _cells(points, grid, floor + STANDING, BODY + STEP)
        fallen = _cells(points, grid, floor + FALLEN, BODY)
        if kind == 'pir':
            moves |= standing
        sensors.append({'kind': kind, 'name': name, **_cropped(standing, fallen)})
    seen = free & moves
    return {'origin': grid.origin, 'side': CELL, 'rows': grid.cells.shape[0],
            'columns': grid.cells.shape[1], 'free': _bits(free), 'sensors': sensors,
            'share': _share(seen, free),
            'rooms': {room.name: _share(seen[here], free[here]) for i, room in enumerate(rooms, 1)
                      for here in [grid.cells == i] if free[here].any()}}


def _grid(rooms: list[Room], number: int, floor: float) -> Grid | None:
    """The cells of some rooms, each with the number of its room from 1 on, or 0."""
    if not rooms:
        return None
    west, south, east, north = bounds([point for room in rooms for point in room.polygon])
    columns, rows = ceil((east - west) / CELL), ceil((north - south) / CELL)
    if not 0 < columns * rows <= CELLS:
        return None
    grid = Grid(np.zeros((rows, columns)), (west, south), CELL, number, floor)
    for i, room in reversed(list(enumerate(rooms, 1))):  # the first that has a place, as room_at()
        grid.fill(room.polygon, i)
        for hole in room.holes:
            grid.fill(hole, 0)
    return grid


def _sensors(world: Any, home: Home, number: int) -> list[tuple[str, str]]:
    """Kind and name of the sensors on a storey."""
    entities = world.entities()
    named = {kind: set(world.sensors(kind)) for kind, *_ in entities}
    return [(kind, name) for kind, name, _, pose in entities
            if name in named[kind] and home.storey_at(pose[2]) == number]


def _is_free(world: Any, grid: Grid, floor: float) -> np.ndarray:
    """The cells (rows, columns) over which nothing is where somebody would stand."""
    x, y = np.meshgrid(grid.x, grid.y)
    origins = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, floor + STANDING)])
    reach = STANDING - BUSY
    ranges = world.cast(origins, np.broadcast_to([0.0, 0.0, -1.0], origins.shape), reach)
    return np.asarray(ranges >= reach).reshape(x.shape)


def _seen(world: Any, rays: np.ndarray) -> np.ndarray:
    """Points (n, 3) every CELL along rays, as far as they get."""
    origins, ways, least, most = rays[:, :3], rays[:, 3:6], rays[:, 6], rays[:, 7]
    ends = least + world.cast(origins + least[:, None] * ways, ways, most - least)
    away = least[:, None] + np.arange(0.0, float((ends - least).max(initial=0.0)) + CELL, CELL)
    points = origins[:, None] + away[..., None] * ways[:, None]
    return np.asarray(points[away <= ends[:, None]])


def _cells(points: np.ndarray, grid: Grid, top: float, reach: float) -> np.ndarray:
    """The cells from which a body up to that height gets to one of the points, in the same room."""
    points = points[(points[:, 2] >= grid.height + FOOT) & (points[:, 2] <= top)]
    rows, columns = grid.cells.shape
    row = np.floor((points[:, 1] - grid.origin[1]) / CELL).astype(int)
    column = np.floor((points[:, 0] - grid.origin[0]) / CELL).astype(int)
    inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
    hit = np.zeros((rows, columns), bool)
    hit[row[inside], column[inside]] = True
    span = np.arange(-round(reach / CELL), round(reach / CELL) + 1)
    body = np.hypot(*np.meshgrid(span, span)) * CELL <= reach + 1e-9
    found = np.zeros_like(hit)
    for room in np.unique(grid.cells[hit]):
        here = grid.cells == room
        found |= room > 0 and binary_dilation(hit & here, body) & here
    return found


def _cropped(standing: np.ndarray, fallen: np.ndarray) -> dict[str, Any]:
    """Both masks within the box around them: its row, column, rows, and columns."""
    rows, columns = np.nonzero(standing | fallen)
    if not len(rows):
        return {'box': [0, 0, 0, 0], 'standing': '', 'fallen': ''}
    part = slice(rows.min(), rows.max() + 1), slice(columns.min(), columns.max() + 1)
    return {'box': [int(rows.min()), int(columns.min()), *standing[part].shape],
            'standing': _bits(standing[part]), 'fallen': _bits(fallen[part])}


def _bits(cells: np.ndarray) -> str:
    return b64encode(np.packbits(cells, bitorder='little').tobytes()).decode()


def _share(cells: np.ndarray, among: np.ndarray) -> float:
    return round(float(cells.sum()) / max(int(among.sum()), 1), 4)
