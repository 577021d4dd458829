"""Ways over a map: the shortest that keeps its distance, and its crossings of doors."""
import math
from dataclasses import dataclass

import numpy as np
from angen import Grid
from scipy.ndimage import distance_transform_edt
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

from angen_apps.maps import cells
from angen_apps.maps.gridmap import FREE
from angen_tools.common.geometry import to_segment

Point = tuple[float, float]
NEAR_COST = 4.0  # how much more a cell beside an obstacle costs than one in the open
OPEN = 0.25  # m beyond the robot's radius where the open begins


def distances(grid: Grid, reach: float) -> np.ndarray:
    """Meters (rows, columns) from a cell's middle to the edge of the next cell that is not free,
    cut at `reach`. Beyond the map nothing is free."""
    free = np.pad(grid.cells == FREE, 1)
    rows, columns = free.shape
    # a lattice of half cells: middles have odd indices, edges and corners even ones
    lattice = np.ones((2 * rows + 1, 2 * columns + 1), bool)
    for dy in range(3):
        for dx in range(3):
            lattice[dy:dy + 2 * rows:2, dx:dx + 2 * columns:2] &= free
    far = distance_transform_edt(lattice)[3:-3:2, 3:-3:2] * grid.resolution / 2
    return np.minimum(far, reach)


class Planner:
    """Shortest ways for a round robot of `radius` (m) over a map; prefers the open."""

    def __init__(self, grid: Grid, radius: float) -> None:
        self.grid = grid
        clear = distances(grid, radius + OPEN)
        self.passable = (clear >= radius) & (grid.cells == FREE)  # rows, columns: where it fits
        cost = 1 + NEAR_COST * np.clip((radius + OPEN - clear) / OPEN, 0, 1)
        self._graph = step_costs(self.passable, cost)

    def is_free(self, point: Point) -> bool:
        """Whether the robot fits there."""
        return cells.has(self.grid, self.passable, point)

    def nearest(self, point: Point, reach: float) -> Point | None:
        """The point, or the nearest place within `reach` (m) where the robot fits."""
        return cells.nearest(self.grid, self.passable, point, reach)

    def costs(self, start: Point) -> np.ndarray:
        """The cost of the way from start to each cell (rows, columns), in m of open floor."""
        columns = self.passable.shape[1]
        row, column = self.grid.cell(*start)
        found = dijkstra(self._graph, indices=row * columns + column)
        return found.reshape(self.passable.shape) * self.grid.resolution

    def way(self, start: Point, goal: Point) -> list[Point] | None:
        """Points from start to goal, about a cell apart; None if there is no way."""
        if not (self.is_free(start) and self.is_free(goal)):
            return None
        found = self._search(self.grid.cell(*start), self.grid.cell(*goal))
        if found is None:
            return None
        points = [start, *(self.grid.point(*cell) for cell in found[1:-1]), goal]
        return smooth(points)

    def _search(self, start: tuple[int, int], goal: tuple[int, int]
                ) -> list[tuple[int, int]] | None:
        """Cells from start to goal."""
        columns = self.passable.shape[1]
        first, here = (row * columns + column for row, column in (start, goal))
        came = dijkstra(self._graph, indices=first, return_predecessors=True)[1]
        if here != first and came[here] < 0:
            return None
        found = [goal]
        while here != first:
            here = int(came[here])
            found.append(divmod(here, columns))
        return found[::-1]


def step_costs(passable: np.ndarray, cost: np.ndarray) -> csr_matrix:
    """The cost of a step from each passable cell to each of its eight neighbors: its length in
    cells times the cost of the cell that it leads to. Cells are counted row by row."""
    rows, columns = passable.shape
    index = np.arange(rows * columns).reshape(rows, columns)
    starts, ends, weights = [], [], []
    for dy, dx in ((0, 1), (1, -1), (1, 0), (1, 1)):
        here = np.s_[:rows - dy, max(-dx, 0):columns - max(dx, 0)]
        there = np.s_[dy:, max(dx, 0):columns - max(-dx, 0)]
        both = passable[here] & passable[there]
        for a, b in ((here, there), (there, here)):
            starts.append(index[a][both])
            ends.append(index[b][both])
            weights.append(math.hypot(dx, dy) * cost[b][both])
    return csr_matrix((np.concatenate(weights), (np.concatenate(starts), np.concatenate(ends))),
                      shape=(rows * columns, rows * columns))


def smooth(points: list[Point], width: int = 5) -> list[Point]:
    """The points with each coordinate averaged over its neighbors; the ends stay."""
    if len(points) < 3:
        return points
    line = np.array(points)
    result = line.copy()
    for i in range(1, len(line) - 1):
        half = min(width, i, len(line) - 1 - i)
        result[i] = line[i - half:i + half + 1].mean(axis=0)
    return [(x, y) for x, y in result.tolist()]


@dataclass(frozen=True)
class Door:
    """A door: its leaf turns about the hinge from `shut` to `open` (rad, in the world), or slides
    along its wall to either side."""

    name: str
    hinge: Point
    shut: float
    open: float
    width: float  # m
    top: float = math.inf  # m, z of the leaf's upper edge
    partner: str = ''  # the other leaf of a double door
    slides: bool = False
    bottom: float = -math.inf  # m, z of the leaf's lower edge

    def tip(self, angle: float) -> Point:
        return (self.hinge[0] + self.width * math.cos(angle),
                self.hinge[1] + self.width * math.sin(angle))

    @property
    def middle(self) -> Point:
        """The middle of the shut leaf."""
        tip = self.tip(self.shut)
        return (self.hinge[0] + tip[0]) / 2, (self.hinge[1] + tip[1]) / 2

    def room_for(self, point: Point) -> float:
        """Meters from a point to the nearest place that the leaf sweeps."""
        if self.slides:
            far = self.width * math.cos(self.shut), self.width * math.sin(self.shut)
            (x0, y0), (x1, y1) = self.hinge, self.tip(self.shut)
            return to_segment(point, (x0 - far[0], y0 - far[1]), (x1 + far[0], y1 + far[1]))
        away = (point[0] - self.hinge[0], point[1] - self.hinge[1])
        low, high = sorted((self.shut, self.open))
        turn = math.atan2(away[1], away[0]) - low
        turn -= 2 * math.pi * math.floor(turn / (2 * math.pi))
        if turn <= high - low:
            return max(math.hypot(*away) - self.width, 0.0)
        return min(to_segment(point, self.hinge, self.tip(a)) for a in (low, high))

    def crosses(self, a: Point, b: Point) -> bool:
        """Whether a step from a to b crosses the shut leaf."""
        return _cross(a, b, self.hinge, self.tip(self.shut))


def _cross(a: Point, b: Point, c: Point, d: Point) -> bool:
    def left(p: Point, q: Point, r: Point) -> bool:
        return (q[0] - p[0]) * (r[1] - p[1]) > (q[1] - p[1]) * (r[0] - p[0])
    return left(a, b, c) != left(a, b, d) and left(c, d, a) != left(c, d, b)


@dataclass(frozen=True)
class Passage:
    """A door on a way: stop at point `before`, have it opened; at point `after`, have it shut."""

    door: Door
    before: int
    after: int


class NoRoom(ValueError):
    """A way begins or ends where a door on it cannot turn."""


def passages(way: list[Point], doors: list[Door], room: float) -> list[Passage]:
    """The doors on a way, in order, with places `room` (m) clear of their leaves; of a double door
    both leaves, as one alone leaves the robot little room.

    NoRoom names a door in whose swing the way begins or ends.
    """
    found: list[Passage] = []
    for i in range(len(way) - 1):
        for door in doors:
            if not door.crosses(way[i], way[i + 1]):
                continue
            leaves = [door, *(other for other in doors if other.name == door.partner)]

            def is_clear(point: Point) -> bool:
                return min(leaf.room_for(point) for leaf in leaves) >= room

            before = next((j for j in range(i, -1, -1) if is_clear(way[j])), None)
            after = next((j for j in range(i + 1, len(way)) if is_clear(way[j])), None)
            if before is None or after is None:
                raise NoRoom(f'within the swing of door {door.name}')
            found += [Passage(leaf, before, after) for leaf in leaves
                      if Passage(leaf, before, after) not in found]
    return found
