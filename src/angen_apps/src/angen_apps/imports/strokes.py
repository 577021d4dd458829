"""Walls in a picture: its dark pixels without noise, as boxes along x and y."""
import numpy as np
from scipy.ndimage import (binary_closing, binary_opening, distance_transform_edt, find_objects,
                           label, maximum_filter)

from angen_apps.imports.gaps import THICKEST
from angen_apps.plan.polygons import rectangles

LEAST_STUB = 0.08  # m across of a shorter piece of wall, as between a corner and a door
LEAST_WALL = 0.25  # m of a wall along: shorter dark spots are text and dirt
LONGER = 1.3  # times as long as thick are walls that are found first
THICK_SHARE = 0.98  # share of the places in walls that are not thicker than the thickest
FILLED = 0.8  # share of the rectangle around a part that is nearly straight
JOINT = 2  # pixels between walls that meet
BAND = 256  # rows that are looked at together
Box = tuple[int, int, int, int]  # west, south, east, north


def cleaned_walls(dark: np.ndarray, scale: float) -> np.ndarray:
    """The dark pixels without noise: specks are removed, holes of a pixel or two filled."""
    closed = binary_closing(np.pad(dark, 3), np.ones((3, 3)))[3:-3, 3:-3]
    opened = closed if scale >= 0.03 else binary_opening(closed, np.ones((2, 2)))
    labels, count = label(opened, np.ones((3, 3)))
    low, high = np.full((2, count + 1), 1 << 30), np.full((2, count + 1), -1)
    for first in range(0, len(labels), BAND):  # the places of all pixels would take much memory
        places = np.nonzero(labels[first:first + BAND])
        index = labels[first:first + BAND][places]
        for axis, values in enumerate((places[0] + first, places[1])):
            np.minimum.at(low[axis], index, values)
            np.maximum.at(high[axis], index, values)
    kept = ((high - low + 1) * scale >= LEAST_WALL).any(axis=0)
    kept[0] = False
    return by_label(kept, labels)


def by_label(values: np.ndarray, labels: np.ndarray) -> np.ndarray:
    """The value of each pixel's label: by bands, as numpy takes 8 bytes for each label."""
    found = np.empty(labels.shape, values.dtype)
    for first in range(0, len(labels), BAND):
        found[first:first + BAND] = values[labels[first:first + BAND]]
    return found


def areas(labels: np.ndarray, count: int) -> np.ndarray:
    """The number of pixels of each label, also by bands."""
    found = np.zeros(count + 1, int)
    for first in range(0, len(labels), BAND):
        found += np.bincount(labels[first:first + BAND].ravel(), minlength=count + 1)
    return found


def straight_walls(dark: np.ndarray, scale: float) -> list[Box]:
    """In pixels: runs along x and y, their edges straightened."""
    found: list[Box] = []
    left = dark.copy()
    least = max(2, round(LEAST_WALL / scale))
    # first runs longer than walls are thick: across a thick wall there are runs, too
    for length in sorted({least, max(least, round(LONGER * _thickness(dark, scale)))})[::-1]:
        for upright in (False, True):
            found += _runs(left.T if upright else left, length, upright)
    for row, column, high, wide in _rest(left):
        if max(high, wide) >= least or min(high, wide) * scale >= LEAST_STUB:
            found.append((column, row, column + wide, row + high))
    return _joined(_without_edges(found, dark.shape), dark.shape)


def _rest(cells: np.ndarray) -> list[tuple[int, int, int, int]]:
    """The rectangles of pixels outside of runs, such as the stub between a corner and a door."""
    labels, count = label(cells)
    found = []
    for k, (rows, columns) in enumerate(slices(labels, count), 1):
        part = labels[rows, columns] == k
        full = [np.nonzero(part.mean(axis=axis) >= 0.5)[0] for axis in (1, 0)]
        parts = rectangles(part)
        if all(map(len, full)):
            (row, high), (column, wide) = ((int(f[0]), int(f[-1] - f[0] + 1)) for f in full)
            inside = part[row:row + high, column:column + wide]
            if inside.sum() > FILLED * max(inside.size, part.sum()):
                parts = [(row, column, high, wide)]
        found += [(rows.start + row, columns.start + column, high, wide)
                  for row, column, high, wide in parts]
    return found


def _without_edges(boxes: list[Box], shape: tuple[int, ...]) -> list[Box]:
    """Without boxes of a pixel or two along a thicker one: edges of walls that are a little
    askew."""
    thick = np.zeros(shape, bool)
    for west, south, east, north in boxes:
        if min(east - west, north - south) > JOINT:
            thick[south:north, west:east] = True
    thick = np.pad(thick, 1)

    def is_edge(west: int, south: int, east: int, north: int) -> bool:
        wide, high = east - west, north - south
        beside = ((thick[south, west + 1:east + 1], thick[north + 1, west + 1:east + 1])
                  if wide > high else
                  (thick[south + 1:north + 1, west], thick[south + 1:north + 1, east + 1]))
        return min(wide, high) <= JOINT and max(side.mean() for side in beside) > 0.5

    return [box for box in boxes if not is_edge(*box)]


def _thickness(dark: np.ndarray, scale: float) -> float:
    """The thickness of the thickest walls, in pixels."""
    beside = int(THICKEST / scale / 2) + 3  # pixels that decide about those of a band
    padded = np.pad(dark, 1)
    found = [np.zeros(0)]
    for first in range(0, len(padded), BAND):
        before = min(first, beside)
        cells = padded[first - before:first + BAND + beside]
        if cells.all():
            continue  # nothing is beside a wall
        away = distance_transform_edt(cells)
        middle = (away > 0) & (away == maximum_filter(away, 3)) & (2 * away * scale <= THICKEST)
        found.append(away[before:before + BAND][middle[before:before + BAND]])
    thick = np.concatenate(found)
    return float(2 * np.quantile(thick, THICK_SHARE)) if len(thick) else 0.0


def _runs(cells: np.ndarray, length: int, upright: bool) -> list[Box]:
    """The boxes of runs of some length along a picture's rows, and takes them out of it."""
    runs = binary_opening(cells, np.ones((1, length)))
    labels, count = label(runs)
    found: list[Box] = []
    for k, where in enumerate(slices(labels, count), 1):
        for row, column, high, wide in _bands(labels[where] == k):
            south, west = where[0].start + row, where[1].start + column
            found.append((south, west, south + high, west + wide) if upright
                         else (west, south, west + wide, south + high))
    cells &= ~runs
    return found


def _joined(boxes: list[Box], shape: tuple[int, ...]) -> list[Box]:
    """The boxes, longer by a pixel or two where another one begins so near to an end."""
    walls = np.zeros(shape, bool)
    for west, south, east, north in boxes:
        walls[south:north, west:east] = True
    found = []
    for west, south, east, north in boxes:
        wide, high = east - west, north - south
        left, right = _nearby(walls[south:north], west, east) if 2 * wide >= high else (0, 0)
        below, above = _nearby(walls[:, west:east].T, south, north) if 2 * high >= wide else (0, 0)
        found.append((west - left, south - below, east + right, north + above))
    return found


def _nearby(lines: np.ndarray, low: int, high: int) -> tuple[int, int]:
    """Pixels before `low` and after `high` to the next wall; 0 if it is not near."""
    before, after = lines[:, :low][:, ::-1][:, :JOINT + 1], lines[:, high:high + JOINT + 1]
    return (int(before.any(axis=0).argmax()) if before.any() else 0,
            int(after.any(axis=0).argmax()) if after.any() else 0)


def slices(labels: np.ndarray, count: int) -> list[tuple[slice, slice]]:
    return [where for where in find_objects(labels, count) if where is not None]


def _bands(part: np.ndarray) -> list[tuple[int, int, int, int]]:
    """A run's rectangles: one if it is nearly straight, otherwise those that cover it."""
    filled = part.mean()
    if filled > FILLED:
        rows = np.nonzero(part.mean(axis=1) >= 0.5)[0]
        if len(rows):
            return [(int(rows[0]), 0, int(rows[-1] - rows[0] + 1), part.shape[1])]
    return rectangles(part)
