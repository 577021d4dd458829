"""Passages between rooms that touch without a wall between them, as in open plans."""
from __future__ import annotations

from math import pi

import numpy as np
from scipy.ndimage import label

from angen_apps.plan.model import Opening, Storey
from angen_apps.plan.polygons import rectangle
from angen_apps.plan.slabs import CELL, Raster
from angen_apps.plan.walls import footprint

LEAST = 0.6  # m: narrower passages are not for people
HEIGHT = 2.1  # m
NEAR = 6  # cells between the polygons of rooms that touch
THIN = 0.04  # m across the opening


def passages(storey: Storey) -> list[Opening]:
    """An opening for each pair of rooms that touch for at least 0.6 m without a wall or door."""
    points = [point for room in storey.rooms for point in room.polygon]
    raster = Raster.of(points) if points else None
    if raster is None:
        return []
    blocked = np.zeros(raster.x.shape, bool)
    for wall in storey.walls:
        if wall.top > storey.elevation + 0.3:
            raster.mark(blocked, footprint(wall))
    for opening in storey.openings:
        half = opening.width / 2 + 0.05
        raster.mark(blocked, rectangle(
            opening.x, opening.y, opening.yaw, (-half, opening.band[0] - 0.1),
            (half, opening.band[1] + 0.1)))
    rooms = np.zeros(raster.x.shape, int)
    for i, room in enumerate(storey.rooms, 1):
        rooms[raster.filled(room.polygon) & (rooms == 0) & ~blocked] = i
    found: list[Opening] = []
    pairs: set[tuple[int, int]] = set()
    for axis in (0, 1):
        found += _along(storey, raster, rooms, blocked, axis, pairs)
    return found


def _along(storey: Storey, raster: Raster, rooms: np.ndarray, blocked: np.ndarray, axis: int,
           pairs: set[tuple[int, int]]) -> list[Opening]:
    """Passages across an axis of the cells: 0 from south to north, 1 from west to east."""
    cells, walls = (rooms, blocked) if axis == 0 else (rooms.T, blocked.T)
    adjacent: dict[tuple[int, int], list[np.ndarray]] = {}  # rows and columns of cells
    for gap in range(1, NEAR):
        before, after = cells[:-gap], cells[gap:]
        touch = (before != after) & (before > 0) & (after > 0)
        for k in range(1, gap):  # nothing between them
            touch &= (cells[k:k - gap] == 0) & ~walls[k:k - gap]
        rows, columns = np.nonzero(touch)
        ends = np.sort([before[rows, columns], after[rows, columns]], axis=0)
        for a, b in np.unique(ends, axis=1).T if len(rows) else ():
            here = (ends[0] == a) & (ends[1] == b)
            adjacent.setdefault((int(a), int(b)), []).append(np.array([rows[here], columns[here]]))
    found = []
    for pair, places in sorted(adjacent.items()):
        rows, columns = _largest(np.concatenate(places, axis=1))
        width = (columns.max() - columns.min() + 1) * CELL
        if width < LEAST or pair in pairs:
            continue
        pairs.add(pair)
        middle = (columns.max() + columns.min() + 1) / 2 * CELL
        across = (float(np.median(rows)) + 1) * CELL
        x, y = (raster.west + middle, raster.south + across) if axis == 0 else (
            raster.west + across, raster.south + middle)
        found.append(Opening('opening', round(x, 3), round(y, 3), 0.0 if axis == 0 else pi / 2,
                             round(width, 3), storey.elevation, storey.elevation + HEIGHT,
                             (-THIN / 2, THIN / 2), source='passage'))
    return found


def _largest(cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows and columns of the widest group of cells that are beside each other."""
    low = cells.min(axis=1)
    at = np.zeros(cells.max(axis=1) - low + 1, bool)
    at[tuple(cells - low[:, None])] = True
    spread, count = label(at, structure=np.ones((3, 3)))
    best = max(range(1, count + 1), key=lambda i: int((spread == i).any(axis=0).sum()))
    rows, columns = np.nonzero(spread == best)
    return rows + low[0], columns + low[1]
