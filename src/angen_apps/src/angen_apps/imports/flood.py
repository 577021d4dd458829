"""Rooms between walls, found by flood fill, as polygons."""
from typing import Sequence

import numpy as np
from angen import Grid

from angen_apps.plan.model import Point, Room, Storey
from angen_apps.plan.names import use_of
from angen_apps.plan.polygons import area, hole
from angen_apps.plan.slabs import CELL, at_edge, filled, raster_of
from angen_apps.plan.walls import footprint
from angen_tools.common.geometry import contains

LEAST = 0.8  # m2 of a room
STRAIGHT = 0.055  # m between a polygon and the cells' edges
CLOSED = 0.1  # m beside an opening that is closed for the fill
PILLAR = 0.05  # m2 of the smallest hole in a room
Outline = tuple[Point, ...]


def rooms_of(storey: Storey, ceiling: float, labels: Sequence[tuple[Point, str]],
             known: tuple[np.ndarray, float] | None = None) -> list[Room]:
    """The rooms of a storey between its walls; a label inside names one. `known`: pixels that may
    be in a room, from the origin, and their size."""
    points = [corner for wall in storey.walls for corner in footprint(wall)]
    raster = raster_of(points) if points else None
    if raster is None:
        return []
    walls = [_thick_enough(footprint(wall), wall.thickness) for wall in storey.walls]
    for opening in storey.openings:
        low, high = opening.band
        walls.append(hole(opening, CLOSED, max(0.0, 2 * CELL - (high - low)) / 2))
    solid = filled(raster, walls)
    if known is not None:
        rows, columns = ((middles / known[1]).astype(int) for middles in (raster.y, raster.x))
        high, wide = known[0].shape
        in_y, in_x = (raster.y >= 0) & (rows < high), (raster.x >= 0) & (columns < wide)
        solid[np.ix_(in_y, in_x)] |= ~known[0][np.ix_(rows[in_y], columns[in_x])]
    floor = storey.elevation
    rooms = []
    for outline, holes in _regions(raster.with_cells(np.where(solid, Grid.WALL, Grid.FREE))):
        texts = [text for point, text in labels if contains(outline, *point, holes)]
        text = min(texts, key=lambda t: (len(t), t)) if texts else ''
        rooms.append(Room(text, use_of(text), outline, floor, ceiling, holes=holes))
    return rooms


def _thick_enough(corners: list[Point], thickness: float) -> list[Point]:
    """A footprint that no path of cells crosses."""
    least = 1.5 * CELL
    if thickness >= least:
        return corners
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = corners
    more = (least - thickness) / 2 / max(thickness, 1e-6)
    return [(ax - (dx - ax) * more, ay - (dy - ay) * more),
            (bx - (cx - bx) * more, by - (cy - by) * more),
            (cx + (cx - bx) * more, cy + (cy - by) * more),
            (dx + (dx - ax) * more, dy + (dy - ay) * more)]


def _regions(grid: Grid) -> list[tuple[Outline, tuple[Outline, ...]]]:
    """Outline and holes of the connected free cells that do not reach the edge, in the order of
    the scan."""
    sizes = grid.number_parts()
    outside = at_edge(grid)
    found = []
    for label, size in enumerate(sizes):
        if label in outside or size * CELL * CELL < LEAST:
            continue
        outline, holes = grid.region(label, STRAIGHT, PILLAR)
        holes = sorted(holes, key=area, reverse=True)
        found.append((_rounded(outline), tuple(map(_rounded, holes))))
    return found


def _rounded(polygon: list[Point]) -> Outline:
    return tuple((round(x, 4), round(y, 4)) for x, y in polygon)
