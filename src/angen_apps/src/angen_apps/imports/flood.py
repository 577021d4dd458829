"""Rooms between walls, found by flood fill, as polygons."""
from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import Sequence

import numpy as np
from scipy.ndimage import find_objects, label

from angen_apps.plan.model import Point, Room, Storey
from angen_apps.plan.names import use_of
from angen_apps.plan.polygons import area, contains, rectangle
from angen_apps.plan.slabs import CELL, Raster
from angen_apps.plan.walls import footprint

LEAST = 0.8  # m2 of a room
STRAIGHT = 0.055  # m between a polygon and the cells' edges
CLOSED = 0.1  # m beside an opening that is closed for the fill
Corner = tuple[int, int]


@dataclass(frozen=True)
class _Region:
    outline: list[Point]
    holes: list[list[Point]]


def rooms_of(storey: Storey, ceiling: float, labels: Sequence[tuple[Point, str]],
             known: tuple[np.ndarray, float] | None = None) -> list[Room]:
    """The rooms of a storey between its walls; a label inside names one. `known`: pixels that may
    be in a room, from the origin, and their size."""
    points = [corner for wall in storey.walls for corner in footprint(wall)]
    raster = Raster.of(points) if points else None
    if raster is None:
        return []
    solid = np.zeros(raster.x.shape, bool)
    for wall in storey.walls:
        raster.mark(solid, _thick_enough(footprint(wall), wall.thickness))
    for opening in storey.openings:
        half = opening.width / 2 + CLOSED
        low, high = opening.band
        wider = max(0.0, 2 * CELL - (high - low)) / 2
        raster.mark(solid, rectangle(opening.x, opening.y, opening.yaw,
                                     (-half, low - wider), (half, high + wider)))
    if known is not None:
        rows, columns = (raster.y / known[1]).astype(int), (raster.x / known[1]).astype(int)
        high, wide = known[0].shape
        inside = (raster.x >= 0) & (raster.y >= 0) & (rows < high) & (columns < wide)
        solid |= inside & ~known[0][np.clip(rows, 0, high - 1), np.clip(columns, 0, wide - 1)]
    floor = storey.elevation
    rooms = []
    for region in regions(~solid, raster):
        texts = [text for point, text in labels if contains(region.outline, *point)
                 and not any(contains(hole, *point) for hole in region.holes)]
        text = min(texts, key=lambda t: (len(t), t)) if texts else ''
        rooms.append(Room(text, use_of(text), tuple(region.outline), floor, ceiling,
                          holes=tuple(tuple(hole) for hole in region.holes)))
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


def regions(free: np.ndarray, raster: Raster) -> list[_Region]:
    """The connected free cells that do not reach the edge, in the order of the scan."""
    labels, count = label(free)
    outside = set(np.unique(np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]])))
    sizes = np.bincount(labels.ravel(), minlength=count + 1) * CELL * CELL
    found = []
    for index, where in enumerate(find_objects(labels), 1):
        if index in outside or sizes[index] < LEAST:
            continue
        south, west = where[0].start, where[1].start
        loops = [_in_meters([(r + south, c + west) for r, c in loop], raster)
                 for loop in outlines(labels[where] == index)]
        loops.sort(key=area, reverse=True)
        holes = [loop for loop in loops[1:] if area(loop) > 0.05]
        found.append(_Region(loops[0], holes))
    return found


def _in_meters(loop: list[Corner], raster: Raster) -> list[Point]:
    points = [(raster.west + column * CELL, raster.south + row * CELL) for row, column in loop]
    return [(round(x, 4), round(y, 4)) for x, y in straightened(points)]


def outlines(cells: np.ndarray) -> list[list[Corner]]:
    """The loops of (row, column) corners around the true cells, inside on the left."""
    padded = np.pad(cells, 1)
    after: dict[Corner, list[Corner]] = {}

    def edge(a: Corner, b: Corner) -> None:
        after.setdefault(a, []).append(b)

    inner = padded.copy()
    inner[1:-1, 1:-1] &= (padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2]
                          & padded[1:-1, 2:])
    for row, column in zip(*np.nonzero(padded & ~inner)):
        r, c = int(row) - 1, int(column) - 1
        if not padded[row - 1, column]:
            edge((r, c), (r, c + 1))
        if not padded[row, column + 1]:
            edge((r, c + 1), (r + 1, c + 1))
        if not padded[row + 1, column]:
            edge((r + 1, c + 1), (r + 1, c))
        if not padded[row, column - 1]:
            edge((r + 1, c), (r, c))
    loops = []
    while after:
        start = min(after)
        loop, here, before = [], start, (0, 0)
        while True:
            choices = after[here]
            # where two loops touch, turn left: the loop stays simple
            following = min(choices, key=lambda p: _turn(before, (p[0] - here[0], p[1] - here[1])))
            choices.remove(following)
            if not choices:
                del after[here]
            way = (following[0] - here[0], following[1] - here[1])
            if way != before:
                loop.append(here)
            here, before = following, way
            if here == start:
                break
        loops.append(loop)
    return loops


def _turn(before: Corner, way: Corner) -> int:
    """0 for a turn to the left, 1 straight on, 2 to the right; rows go up."""
    cross = before[1] * way[0] - before[0] * way[1]
    return 1 - cross if before != (0, 0) else 1


def straightened(points: list[Point]) -> list[Point]:
    """A loop without corners that are nearer than STRAIGHT to the line between others."""
    if len(points) < 5:
        return points
    far = max(range(len(points)), key=lambda i: hypot(points[i][0] - points[0][0],
                                                      points[i][1] - points[0][1]))
    return _half(points[:far + 1])[:-1] + _half([*points[far:], points[0]])[:-1]


def _half(points: list[Point]) -> list[Point]:
    kept = [False] * len(points)
    kept[0] = kept[-1] = True
    spans = [(0, len(points) - 1)]
    while spans:
        i, k = spans.pop()
        (ax, ay), (bx, by) = points[i], points[k]
        length = hypot(bx - ax, by - ay)
        worst, at = STRAIGHT, -1
        for m in range(i + 1, k):
            x, y = points[m]
            away = abs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / length if length > 1e-9 \
                else hypot(x - ax, y - ay)
            if away > worst:
                worst, at = away, m
        if at >= 0:
            kept[at] = True
            spans += [(i, at), (at, k)]
    return [point for point, keep in zip(points, kept) if keep]
