"""Passages between rooms that touch without a wall between them, as in open plans."""
from dataclasses import dataclass
from math import pi

import numpy as np
from angen import Grid
from scipy.ndimage import binary_dilation, label

from angen_apps.plan.model import Opening, Storey
from angen_apps.plan.polygons import hole
from angen_apps.plan.slabs import CELL, filled, raster_of
from angen_apps.plan.walls import footprint

LEAST = 0.6  # m: narrower passages are not for people
PART = 0.2  # m of a passage that more than two rooms share, for two of them
HEIGHT = 2.1  # m
NEAR = 6  # cells between the polygons of rooms that touch
THIN = 0.04  # m across the opening
PASSAGE = 'passage'  # the source of those
AROUND = np.ones((3, 3), bool)  # cells beside each other


@dataclass(frozen=True)
class _Edge:
    """Cells (rows, columns) along which two rooms touch: from south to north for axis 0."""

    axis: int
    rooms: tuple[int, int]
    cells: np.ndarray

    @property
    def width(self) -> float:
        """m along the opening."""
        along = self.cells[1 - self.axis]
        return float(along.max() - along.min() + 1) * CELL


def passages(storey: Storey) -> list[Opening]:
    """Openings where rooms touch for at least 0.6 m without a wall or door."""
    points = [point for room in storey.rooms for point in room.polygon]
    raster = raster_of(points) if points else None
    if raster is None:
        return []
    solid = [footprint(wall) for wall in storey.walls if wall.top > storey.elevation + 0.3]
    solid += [hole(opening, 0.05, 0.1) for opening in storey.openings]
    blocked = filled(raster, solid)
    rooms = np.zeros(raster.cells.shape, int)
    for i, room in enumerate(storey.rooms, 1):
        rooms[filled(raster, [room.polygon]) & (rooms == 0) & ~blocked] = i
    edges = _edges(rooms, blocked)
    wide = _wide(edges, rooms.shape)
    edges = [edge for edge in _apart(edges, rooms.shape)
             if edge.width >= PART and wide[tuple(edge.cells)].any()]
    return [_opening(edge, raster, storey) for edge in sorted(
        edges, key=lambda edge: (edge.axis, edge.rooms, -edge.width))]


def _edges(rooms: np.ndarray, blocked: np.ndarray) -> list[_Edge]:
    """All edges along both axes, each of cells beside each other."""
    found = []
    for axis in (0, 1):
        cells, walls = (rooms, blocked) if axis == 0 else (rooms.T, blocked.T)
        at: dict[tuple[int, int], np.ndarray] = {}
        for gap in range(1, NEAR):
            before, after = cells[:-gap], cells[gap:]
            touch = (before != after) & (before > 0) & (after > 0)
            for k in range(1, gap):  # nothing between them
                touch &= (cells[k:k - gap] == 0) & ~walls[k:k - gap]
            rows, columns = np.nonzero(touch)
            ends = np.sort([before[rows, columns], after[rows, columns]], axis=0)
            for a, b in np.unique(ends, axis=1).T if len(rows) else ():
                here = (ends[0] == a) & (ends[1] == b)
                image = at.setdefault((int(a), int(b)), np.zeros(cells.shape, bool))
                image[rows[here], columns[here]] = True
        for pair, image in at.items():
            spread, count = label(image if axis == 0 else image.T, AROUND)
            found += [_Edge(axis, pair, np.array(np.nonzero(spread == i)))
                      for i in range(1, count + 1)]
    return found


def _wide(edges: list[_Edge], shape: tuple[int, ...]) -> np.ndarray:
    """The cells of edges that, with those of other rooms beside them, let a person through."""
    image = np.zeros(shape, bool)
    for edge in edges:
        image[tuple(edge.cells)] = True
    spread, count = label(binary_dilation(image, AROUND), AROUND)
    spread[~image] = 0
    found = np.zeros(shape, bool)
    for i in range(1, count + 1):
        group = np.array(np.nonzero(spread == i))
        found |= (spread == i) & ((np.ptp(group, axis=1).max() + 1) * CELL >= LEAST)
    return found


def _apart(edges: list[_Edge], shape: tuple[int, ...]) -> list[_Edge]:
    """The edges but those near a wider one of the same rooms, as along an oblique line."""
    taken: dict[tuple[int, int], np.ndarray] = {}
    found = []
    for edge in sorted(edges, key=lambda edge: (-edge.width, edge.axis, edge.rooms)):
        near = taken.setdefault(edge.rooms, np.zeros(shape, bool))
        if near[tuple(edge.cells)].mean() < 0.5:
            found.append(edge)
            image = np.zeros(shape, bool)
            image[tuple(edge.cells)] = True
            near |= binary_dilation(image, AROUND, 2)
    return found


def _opening(edge: _Edge, raster: Grid, storey: Storey) -> Opening:
    along, rows = edge.cells[1 - edge.axis], edge.cells[edge.axis]
    middle = (along.max() + along.min() + 1) / 2 * CELL
    across = (float(np.median(rows)) + 1) * CELL
    west, south = raster.origin
    x, y = (west + middle, south + across) if edge.axis == 0 else (west + across, south + middle)
    return Opening('opening', round(x, 3), round(y, 3), 0.0 if edge.axis == 0 else pi / 2,
                   round(edge.width, 3), storey.elevation, storey.elevation + HEIGHT,
                   (-THIN / 2, THIN / 2), source=PASSAGE)
