"""The map of places for the middle of a person on a storey of a world file."""
from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import distance_transform_edt

from angen_apps.plan.outlines import Shape, shapes_of
from angen_tools.common.catalog import angen_module

if TYPE_CHECKING:
    from angen import Grid

CELL = 0.05  # m of the map on which a person's ways are found
BODY = 0.22  # m, radius of a person
STEP_OVER = 0.12  # m: a person steps over lower things
TALL = 1.75  # m


def solids(path: Path, floor: float) -> list[Shape]:
    """The shapes that do not move and are in the way of a person on a floor."""
    return [shape for shape in shapes_of(angen_module().World(str(path))) if not shape.moves
            and shape.bottom < floor + TALL and shape.top > floor + STEP_OVER]


def free_map(path: Path, floor: float, body: float = BODY) -> Grid:
    """Its free cells have numbers from 0 on, those of a connected part the same one."""
    grids = angen_module().Grid
    shapes = solids(path, floor)
    points = np.array([p for s in shapes for p in s.corners] or [(0.0, 0.0)])
    west, south = points.min(axis=0) - 1
    columns, rows = (np.ceil((points.max(axis=0) + 1 - (west, south)) / CELL)).astype(int)
    grid = grids(np.full((rows, columns), grids.FREE), (west, south), CELL)
    for shape in shapes:
        grid.fill(shape.corners, grids.WALL)
    free = distance_transform_edt(grid.cells != grids.WALL) * CELL > body
    found = grid.with_cells(np.where(free, grids.FREE, grids.WALL))
    found.number_parts()
    return found
