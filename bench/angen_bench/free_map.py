"""The map of places for the middle of a person on a storey of a world file."""
from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.ndimage import distance_transform_edt

from angen_apps.plan.outlines import Shape, shapes_of
from angen_tools.common.catalog import angen_module

CELL = 0.05  # m of the map on which a person's ways are found
BODY = 0.22  # m, radius of a person
STEP_OVER = 0.12  # m: a person steps over lower things
TALL = 1.75  # m


def solids(path: Path, floor: float) -> list[Shape]:
    """The shapes that do not move and are in the way of a person on a floor."""
    return [shape for shape in shapes_of(angen_module().World(str(path))) if not shape.moves
            and shape.bottom < floor + TALL and shape.top > floor + STEP_OVER]


def free_map(path: Path, floor: float, body: float = BODY
             ) -> tuple[np.ndarray, float, float]:
    shapes = solids(path, floor)
    points = np.array([p for s in shapes for p in s.corners] or [(0.0, 0.0)])
    west, south = points.min(axis=0) - 1
    columns, rows = (np.ceil((points.max(axis=0) + 1 - (west, south)) / CELL)).astype(int)
    x = west + (np.arange(columns) + 0.5) * CELL
    y = south + (np.arange(rows) + 0.5) * CELL
    solid = np.zeros((rows, columns), bool)
    for shape in shapes:
        corners = np.array(shape.corners)
        inside = np.ones((rows, columns), bool)
        for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0)):
            inside &= (bx - ax) * (y[:, None] - ay) - (by - ay) * (x[None] - ax) > -1e-9
        solid |= inside
    return distance_transform_edt(~solid) * CELL > body, float(west), float(south)
