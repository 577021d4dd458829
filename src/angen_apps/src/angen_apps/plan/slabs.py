"""Floors and ceilings as boxes: the plan in cells, each room's cells covered by rectangles."""
from __future__ import annotations

from dataclasses import dataclass, field
from math import ceil, floor

import numpy as np

from angen_apps.plan.model import Plan, Point, Storey
from angen_apps.plan.polygons import bounds, rectangle, rectangles
from angen_apps.plan.walls import footprint

CELL = 0.05  # m
CELLS = 4_000_000  # of a storey, at most: 100 m x 100 m
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


@dataclass
class Raster:
    """The cells of a storey: their middles' x and y."""

    west: float
    south: float
    x: np.ndarray
    y: np.ndarray

    @staticmethod
    def of(points: list[Point]) -> Raster | None:
        """A raster around some points; None where they are too far apart."""
        west, south, east, north = bounds(points)
        west, south = CELL * floor((west - MARGIN) / CELL), CELL * floor((south - MARGIN) / CELL)
        columns, rows = ceil((east + MARGIN - west) / CELL), ceil((north + MARGIN - south) / CELL)
        if columns * rows > CELLS:
            return None
        x, y = np.meshgrid(west + (np.arange(columns) + 0.5) * CELL,
                           south + (np.arange(rows) + 0.5) * CELL)
        return Raster(west, south, x, y)

    def filled(self, polygon: list[Point] | tuple[Point, ...]) -> np.ndarray:
        """Which cells' middles a polygon contains."""
        found = np.zeros(self.x.shape, bool)
        self.mark(found, polygon)
        return found

    def mark(self, cells: np.ndarray, polygon: list[Point] | tuple[Point, ...]) -> None:
        """Sets the cells whose middles a polygon contains: an odd number of edges right of them."""
        west, south, east, north = bounds(polygon)
        rows = slice(max(0, int((south - self.south) / CELL) - 1),
                     max(0, int((north - self.south) / CELL) + 2))
        columns = slice(max(0, int((west - self.west) / CELL) - 1),
                        max(0, int((east - self.west) / CELL) + 2))
        x, y = self.x[0, columns], self.y[rows, 0]
        flips = np.zeros((len(y), len(x) + 1), int)
        for (x0, y0), (x1, y1) in zip(polygon, [*polygon[1:], polygon[0]]):
            at = np.nonzero((y0 > y) != (y1 > y))[0]
            if len(at):
                crossing = (x1 - x0) * (y[at] - y0) / (y1 - y0) + x0
                flips[at, np.searchsorted(x, crossing)] += 1
        right = flips.sum(axis=1, keepdims=True) - flips.cumsum(axis=1)[:, :-1]
        cells[rows, columns] |= right % 2 == 1

    def cover(self, cells: np.ndarray, step: int = 1) -> list[Rectangle]:
        """The cells, or blocks of step x step of them, as rectangles in m."""
        side = CELL * step
        return [(round(self.west + column * side, 4), round(self.south + row * side, 4),
                 round(self.west + (column + width) * side, 4),
                 round(self.south + (row + height) * side, 4))
                for row, column, height, width in rectangles(cells)]

    def cover_within(self, cells: np.ndarray, holes: np.ndarray, most: int) -> list[Rectangle]:
        """Like cover(), by blocks of cells for more than `most` rectangles; holes stay."""
        found = self.cover(cells)
        if len(found) <= most:
            return found
        fine = _blocks(holes).repeat(COARSE, 0).repeat(COARSE, 1)[:cells.shape[0], :cells.shape[1]]
        return self.cover(_blocks(cells & ~fine), COARSE) + self.cover(cells & fine)


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
    raster = Raster.of(points) if points else None
    if raster is None:
        return found
    above: list[tuple[float, np.ndarray]] = []  # undersides of floors and their cells
    for storey in sorted(plan.storeys, key=lambda s: -s.elevation):
        holes = np.zeros(raster.x.shape, bool)
        for cutout in storey.cutouts:
            raster.mark(holes, cutout)
        rooms, rest, roofed = _cells(storey, holes, raster)
        through = _through(storey, plan, raster)
        made = found[storey.number]
        _add_ceilings(made, roofed, through, above, raster)
        made.floors = {name: raster.cover(cells) for name, cells in [*rooms.items(), ('', rest)]}
        if sum(map(len, made.floors.values())) > MOST:
            made.floors = {'': raster.cover_within(_union([*rooms.values(), rest]), holes, MOST)}
        above.append((storey.elevation - storey.slab, _union([*rooms.values(), rest])))
    return found


def _through(storey: Storey, plan: Plan, raster: Raster) -> np.ndarray:
    """The holes in the floor of the next level above: shafts and stairs have no ceiling."""
    cells = np.zeros(raster.x.shape, bool)
    higher = [s.elevation for s in plan.storeys if s.elevation > storey.elevation + APART]
    for other in plan.storeys:
        if higher and abs(other.elevation - min(higher)) < APART:
            for cutout in other.cutouts:
                raster.mark(cells, cutout)
    return cells


def _union(parts: list[np.ndarray]) -> np.ndarray:
    return np.asarray(np.logical_or.reduce(parts))


def _points(storey: Storey) -> list[Point]:
    found = [point for room in storey.rooms for point in room.polygon]
    return found + [corner for wall in storey.walls for corner in footprint(wall)]


def _cells(storey: Storey, holes: np.ndarray, raster: Raster
           ) -> tuple[dict[str, np.ndarray], np.ndarray, dict[float, np.ndarray]]:
    """Cells of each room's floor, of walls and thresholds, and of ceilings by their height."""
    taken = np.zeros(raster.x.shape, bool)
    rooms: dict[str, np.ndarray] = {}
    roofed: dict[float, np.ndarray] = {}
    for room in storey.rooms:
        cells = raster.filled(room.polygon)
        for hole in room.holes:
            cells &= ~raster.filled(hole)
        if room.has_ceiling:
            height = round(room.floor + room.ceiling, 4)
            roofed[height] = roofed.get(height, np.zeros_like(cells)) | cells
        if room.has_floor:
            rooms[room.name] = cells & ~taken & ~holes
            taken |= cells
    rest = np.zeros(raster.x.shape, bool)
    for wall in storey.walls:
        if wall.bottom < storey.elevation + 0.1:
            raster.mark(rest, footprint(wall))
    for opening in storey.openings:
        half = opening.width / 2 + CELL
        raster.mark(rest, rectangle(opening.x, opening.y, opening.yaw,
                                    (-half, opening.band[0] - CELL),
                                    (half, opening.band[1] + CELL)))
    walls = rest.copy()
    rest &= ~taken & ~holes
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
                  above: list[tuple[float, np.ndarray]], raster: Raster) -> None:
    """Ceilings where no floor of a storey above closes the room within 0.6 m over it."""
    for height, cells in sorted(roofed.items()):
        open_cells = cells & ~through
        for underside, floors in above:
            if -0.2 < underside - height < 0.6:
                open_cells &= ~floors
        boxes = raster.cover_within(open_cells, through, MOST // 2)
        made.ceilings += [(height, box) for box in boxes]
