"""Cells of a grid that a mask (rows, columns) contains: at a place, near it, and connected ones."""
import numpy as np
from angen import Grid
from scipy.ndimage import label

Point = tuple[float, float]


def cell_of(grid: Grid, point: Point) -> tuple[int, int] | None:
    """Row and column of the cell of a point; None beyond the grid."""
    row, column = grid.cell(*point)
    rows, columns = grid.cells.shape
    return (row, column) if 0 <= row < rows and 0 <= column < columns else None


def has(grid: Grid, mask: np.ndarray, point: Point) -> bool:
    """Whether the mask contains the cell of a point."""
    cell = cell_of(grid, point)
    return cell is not None and bool(mask[cell])


def nearest(grid: Grid, mask: np.ndarray, point: Point, reach: float) -> Point | None:
    """The point, if the mask contains its cell; else the middle of the nearest cell in the mask, if
    one is within `reach` (m)."""
    if has(grid, mask, point):
        return point
    rows, columns = np.nonzero(mask)
    away = np.hypot(grid.x[columns] - point[0], grid.y[rows] - point[1])
    best = int(away.argmin()) if len(away) else -1
    if best < 0 or away[best] > reach:
        return None
    return grid.point(int(rows[best]), int(columns[best]))


def largest(mask: np.ndarray, reached: np.ndarray | None = None) -> np.ndarray:
    """The largest connected part of a mask. If some parts have cells in `reached`, the others do
    not count: a niche or a room out of reach may be larger."""
    parts, count = label(mask, np.ones((3, 3)))
    if not count:
        return mask
    sizes = np.bincount(parts.ravel())
    sizes[0] = 0
    known = np.setdiff1d([] if reached is None else parts[reached], [0]).astype(int)
    if len(known):
        sizes[np.setdiff1d(np.arange(len(sizes)), known)] = 0
    return np.asarray(parts == sizes.argmax())
