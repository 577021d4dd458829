"""Floors and ceilings as boxes: the plan in cells, each room's cells covered by rectangles."""
from dataclasses import dataclass, field
from math import ceil, floor
from typing import Iterable, Sequence

import numpy as np
from angen import Grid

from angen_apps.plan.model import Plan, Point, Storey
from angen_apps.plan.polygons import hole, rectangles
from angen_apps.plan.walls import footprint
from angen_tools.common.geometry import bounds

CELL = 0.05  # m
CELLS = 4_000_000  # most cells of a floor: 100 m x 100 m
MOST = 500  # rectangles of a storey; oblique walls need more, so that cells are coarser
COARSE = 5  # cells
MARGIN = 0.2  # m around the walls
APART = 0.5  # m between the floors of levels that are not the same
Rectangle = tuple[float, float, float, float]  # west, south, east, north


@dataclass
class Slabs:
    """Rectangles of floors by room, '' between rooms, and of ceilings."""

    floors: dict[str, list[Rectangle]] = field(default_factory=dict)
    ceilings: list[tuple[float, Rectangle]] = field(default_factory=list)  # with z


def raster_of(points: list[Point]) -> Grid | None:
    """Cells around some points; None where they are too far apart."""
    west, south, east, north = bounds(points)
    west, south = CELL * floor((west - MARGIN) / CELL), CELL * floor((south - MARGIN) / CELL)
    columns, rows = ceil((east + MARGIN - west) / CELL), ceil((north + MARGIN - south) / CELL)
    if columns * rows > CELLS:
        return None
    return Grid(np.zeros((rows, columns)), (west, south), CELL)


def filled(raster: Grid, polygons: Iterable[Sequence[Point]]) -> np.ndarray:
    """Which cells' middles some polygons contain."""
    grid = raster.with_cells(np.zeros(raster.cells.shape))
    for polygon in polygons:
        grid.fill(polygon, 1)
    return np.asarray(grid.cells > 0)


def at_edge(grid: Grid) -> set[int]:
    """The numbers of the cells along the edge of a grid."""
    cells = grid.cells
    return set(np.concatenate([cells[0], cells[-1], cells[:, 0], cells[:, -1]]).tolist())


def _cover(raster: Grid, cells: np.ndarray, step: int = 1) -> list[Rectangle]:
    """The cells, or blocks of step x step of them, as rectangles in m."""
    side = CELL * step
    west, south = raster.origin
    return [(round(west + column * side, 4), round(south + row * side, 4),
             round(west + (column + width) * side, 4), round(south + (row + height) * side, 4))
            for row, column, height, width in rectangles(cells)]


def _cover_within(raster: Grid, cells: np.ndarray, holes: np.ndarray, most: int
                  ) -> list[Rectangle]:
    """Like _cover(), by blocks of cells for more than `most` rectangles; holes stay."""
    found = _cover(raster, cells)
    if len(found) <= most:
        return found
    fine = _blocks(holes).repeat(COARSE, 0).repeat(COARSE, 1)[:cells.shape[0], :cells.shape[1]]
    return _cover(raster, _blocks(cells & ~fine), COARSE) + _cover(raster, cells & fine)


def _blocks(cells: np.ndarray) -> np.ndarray:
    """Which blocks of cells contain a true one."""
    rows, columns = (-size % COARSE for size in cells.shape)
    padded = np.pad(cells, ((0, rows), (0, columns)))
    return np.asarray(padded.reshape(padded.shape[0] // COARSE, COARSE, -1, COARSE).any(
        axis=(1, 3)))


def slabs(plan: Plan) -> dict[int, Slabs]:
    """The slabs of each storey, by number."""
    points = [point for storey in plan.storeys for point in _points(storey)]
    found = {storey.number: Slabs() for storey in plan.storeys}
    raster = raster_of(points) if points else None
    if raster is None:
        return found
    above: list[tuple[float, np.ndarray]] = []  # undersides of floors and their cells
    for storey in sorted(plan.storeys, key=lambda s: -s.elevation):
        holes = filled(raster, storey.cutouts)
        rooms, rest, roofed = _cells(storey, holes, raster)
        through = _through(storey, plan, raster)
        made = found[storey.number]
        _add_ceilings(made, roofed, through, above, raster)
        made.floors = {name: _cover(raster, cells) for name, cells in [*rooms.items(), ('', rest)]}
        if sum(map(len, made.floors.values())) > MOST:
            made.floors = {'': _cover_within(raster, _union([*rooms.values(), rest]), holes,
                                             MOST)}
        above.append((storey.elevation - storey.slab, _union([*rooms.values(), rest])))
    return found


def _through(storey: Storey, plan: Plan, raster: Grid) -> np.ndarray:
    """The holes in the floor of the next level above: shafts and stairs have no ceiling."""
    higher = [s.elevation for s in plan.storeys if s.elevation > storey.elevation + APART]
    return filled(raster, [cutout for other in plan.storeys for cutout in other.cutouts
                           if higher and abs(other.elevation - min(higher)) < APART])


def _union(parts: list[np.ndarray]) -> np.ndarray:
    return np.asarray(np.logical_or.reduce(parts))


def _points(storey: Storey) -> list[Point]:
    found = [point for room in storey.rooms for point in room.polygon]
    return found + [corner for wall in storey.walls for corner in footprint(wall)]


def _cells(storey: Storey, holes: np.ndarray, raster: Grid
           ) -> tuple[dict[str, np.ndarray], np.ndarray, dict[float, np.ndarray]]:
    """Cells of each room's floor, of walls and thresholds, and of ceilings by their height."""
    taken = np.zeros(raster.cells.shape, bool)
    rooms: dict[str, np.ndarray] = {}
    roofed: dict[float, np.ndarray] = {}
    for room in storey.rooms:
        cells = filled(raster, [room.polygon]) & ~filled(raster, room.holes)
        if room.has_ceiling:
            height = round(room.floor + room.ceiling, 4)
            roofed[height] = roofed.get(height, np.zeros_like(cells)) | cells
        if room.has_floor:
            rooms[room.name] = cells & ~taken & ~holes
            taken |= cells
    solid: list[Sequence[Point]] = [footprint(wall) for wall in storey.walls
                                    if wall.bottom < storey.elevation + 0.1]
    solid += [hole(opening, CELL, CELL) for opening in storey.openings]
    walls = filled(raster, solid)
    rest = walls & ~taken & ~holes
    if roofed:
        height = max(roofed, key=lambda z: int(roofed[z].sum()))
        near = _grown(roofed[height], 6)
        for other, cells in roofed.items():
            walls &= ~cells if other != height else True
        roofed[height] |= walls & near
    return rooms, rest, roofed


def _grown(cells: np.ndarray, steps: int) -> np.ndarray:
    from scipy.ndimage import binary_dilation
    return np.asarray(binary_dilation(cells, iterations=steps))


def _add_ceilings(made: Slabs, roofed: dict[float, np.ndarray], through: np.ndarray,
                  above: list[tuple[float, np.ndarray]], raster: Grid) -> None:
    """Ceilings where no floor of a storey above closes the room within 0.6 m over it."""
    for height, cells in sorted(roofed.items()):
        open_cells = cells & ~through
        for underside, floors in above:
            if -0.2 < underside - height < 0.6:
                open_cells &= ~floors
        boxes = _cover_within(raster, open_cells, through, MOST // 2)
        made.ceilings += [(height, box) for box in boxes]
