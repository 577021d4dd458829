"""Open leaves on the map of a storey: where people pass them, and which close off a room."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

import numpy as np
from angen import Grid
from scipy.ndimage import label

from angen_apps.maps.gridmap import FREE, OCCUPIED
from angen_apps.plan.polygons import inside
from angen_apps.residents.survey import PORCH, middles, opening
from angen_apps.robot.planner import distances
from angen_tools.common.home import Door, Room

LEAF = 0.2  # m beyond a door's width from its middle: the farthest end of its leaf


@dataclass(frozen=True)
class Leaf:
    """An open leaf: a window (rows, columns) of the map, the window's cells that the leaf takes,
    and those in the window where a body still passes."""

    window: tuple[slice, slice]
    cells: np.ndarray
    passable: np.ndarray


class Leaves:
    """The leaves of a storey's doors on a map without leaves; `opened` is the map with them.

    `body` is half the width of a person. As the distance to several leaves is the least of those
    to each, one passes all where one passes each: each leaf is tried once.
    """

    def __init__(self, grid: Grid, opened: Grid, doors: Sequence[Door], body: float) -> None:
        self.grid, self.doors = grid, list(doors)
        rows, columns = np.indices(grid.cells.shape)
        self.x, self.y = middles(grid, rows, columns)
        self.passable = (distances(grid, body) >= body) & (grid.cells == FREE)
        self._moved = (grid.cells == FREE) & (opened.cells != FREE)
        self._leaves = self._found(body)

    def _found(self, body: float) -> dict[str, Leaf]:
        """Each door's leaf: the shapes nearer to its middle than to that of another door."""
        most = max((door.width for door in self.doors), default=0.0) + LEAF
        nearest = np.full(self.grid.cells.shape, np.inf)
        for door in self.doors:
            at = self._window(door, most)
            nearest[at] = np.minimum(nearest[at], self._away(door, at))
        margin = math.ceil(body / self.grid.resolution) + 1
        leaves = {}
        for door in self.doors:
            at = self._window(door, door.width + LEAF, margin)
            away = self._away(door, at)
            cells = self._moved[at] & (away < door.width + LEAF) & (away == nearest[at])
            around = self._window(door, door.width + LEAF, 2 * margin)
            tried = self.grid.cells[around].copy()
            inner = tuple(slice(a.start - b.start, a.stop - b.start) for a, b in zip(at, around))
            tried[inner][cells] = OCCUPIED
            clear = distances(self.grid.with_cells(tried), body)
            leaves[door.name] = Leaf(at, cells, ((clear >= body) & (tried == FREE))[inner])
        return leaves

    def _window(self, door: Door, reach: float, margin: int = 0) -> tuple[slice, slice]:
        """The rows and columns within `reach` (m) of a door's middle, and `margin` more."""
        row, column = self.grid.cell(*door.pose[:2])
        half = math.ceil(reach / self.grid.resolution) + 1 + margin
        rows, columns = self.grid.cells.shape
        return (slice(max(row - half, 0), max(min(row + half + 1, rows), 0)),
                slice(max(column - half, 0), max(min(column + half + 1, columns), 0)))

    def _away(self, door: Door, at: tuple[slice, slice]) -> np.ndarray:
        return np.hypot(self.x[at] - door.pose[0], self.y[at] - door.pose[1])

    def passes(self, doors: Sequence[Door]) -> np.ndarray:
        """The cells where a body passes with the leaves of these doors open."""
        passable = self.passable.copy()
        for door in doors:
            leaf = self._leaves[door.name]
            passable[leaf.window] &= leaf.passable
        return passable

    def cells(self, door: Door) -> np.ndarray:
        """The cells (rows, columns) that a door's open leaf takes."""
        found = np.zeros(self.grid.cells.shape, bool)
        leaf = self._leaves[door.name]
        found[leaf.window] = leaf.cells
        return found

    def occupied(self, doors: Sequence[Door]) -> Grid:
        """The map with the leaves of these doors open."""
        cells = self.grid.cells.copy()
        for door in doors:
            leaf = self._leaves[door.name]
            cells[leaf.window][leaf.cells] = OCCUPIED
        return self.grid.with_cells(cells)


class Reach:
    """Which rooms of a storey people get to, and '' for the outside of its main entrance."""

    def __init__(self, rooms: Sequence[Room], entrance: Door | None, x: np.ndarray, y: np.ndarray
                 ) -> None:
        within = [(room.name, inside(room.polygon, x, y)) for room in rooms]
        self._cells = [(name, np.flatnonzero(cells)) for name, cells in within]
        if entrance is not None:
            away = np.hypot(x - entrance.pose[0], y - entrance.pose[1])
            porch = opening(x, y, entrance, PORCH) & (away > PORCH - 0.2)
            for _, cells in within:
                porch &= ~cells
            self._cells.append(('', np.flatnonzero(porch)))

    def rooms(self, passable: np.ndarray) -> set[str]:
        """Those in which the largest connected part has a place."""
        free = largest(passable).ravel()
        return {name for name, cells in self._cells if free[cells].any()}


def largest(cells: np.ndarray) -> np.ndarray:
    """The largest connected part."""
    parts, count = label(cells, np.ones((3, 3), int))
    return parts == 1 + int(np.argmax(np.bincount(parts.ravel())[1:])) if count else cells
