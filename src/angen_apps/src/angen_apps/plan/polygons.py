"""Polygons of a plan: area, inside, rectangles that overlap, and the strips of a raster."""
from math import cos, hypot, inf, sin
from typing import Sequence

import numpy as np

from angen_apps.plan.model import Opening, Piece, Point
from angen_tools.common.geometry import edges, turned

NEAR = 0.002  # m between corners that are one


def area(polygon: Sequence[Point]) -> float:
    """The area of a simple polygon, m2, without a sign."""
    return abs(signed_area(polygon))


def signed_area(polygon: Sequence[Point]) -> float:
    x, y = np.array(polygon, float).T
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)


def inside(polygon: Sequence[Point], x: np.ndarray, y: np.ndarray,
           holes: Sequence[Sequence[Point]] = ()) -> np.ndarray:
    """Whether each of the points x, y is in a polygon and in none of its holes, see
    geometry.contains()."""
    (low_x, low_y), (high_x, high_y) = np.min(polygon, axis=0), np.max(polygon, axis=0)
    found = np.asarray((x >= low_x) & (x <= high_x) & (y >= low_y) & (y <= high_y))
    x, y = np.asarray(x)[found], np.asarray(y)[found]
    odd = np.zeros(np.shape(x), bool)
    for (x0, y0), (x1, y1) in edges(polygon):
        if y0 == y1:
            continue
        odd ^= ((y0 > y) != (y1 > y)) & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
    for each in holes:
        odd &= ~inside(each, x, y)
    found[found] = odd
    return found


def cleaned(polygon: Sequence[Point]) -> list[Point]:
    """Without corners that are within 2 mm of the one before, and without spikes."""
    points = [(round(x, 4), round(y, 4)) for x, y in polygon]
    changed = True
    while changed and len(points) > 3:
        changed = False
        for i, (x, y) in enumerate(points):
            (ax, ay), (bx, by) = points[i - 1], points[(i + 1) % len(points)]
            u, v = (x - ax, y - ay), (bx - x, by - y)
            turns_back = u[0] * v[0] + u[1] * v[1] < 0 and abs(
                u[0] * v[1] - u[1] * v[0]) < 2e-3 * min(hypot(*u), hypot(*v))
            if hypot(*u) < NEAR or turns_back:
                del points[i]
                changed = True
                break
    return points


def split(polygon: Sequence[Point]) -> list[list[Point]]:
    """The loops of a polygon that touches itself, largest first: its outline and then its holes."""
    loops, done = [cleaned(_with_touches(cleaned(polygon)))], []
    while loops:
        points = loops.pop()
        at = _twice(points)
        if at is None:
            done.append(points)
        else:
            i, k = at
            loops += [cleaned(part) for part in (points[i:k], points[k:] + points[:i])]
    return sorted((loop for loop in done if len(loop) > 2 and area(loop) > 1e-3), key=area,
                  reverse=True)


def _twice(points: list[Point]) -> tuple[int, int] | None:
    for i, (x, y) in enumerate(points):
        for k in range(i + 2, len(points) - (i == 0)):
            if hypot(points[k][0] - x, points[k][1] - y) < NEAR:
                return i, k
    return None


def _with_touches(points: list[Point]) -> list[Point]:
    """The corners, and on each edge those corners of others that it passes."""
    found: list[Point] = []
    for i, (ax, ay) in enumerate(points):
        bx, by = points[(i + 1) % len(points)]
        length = hypot(bx - ax, by - ay)
        found.append((ax, ay))
        on_edge = []
        for x, y in points:
            along = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / max(length, 1e-9)
            away = abs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / max(length, 1e-9)
            if away < NEAR / 2 and NEAR < along < length - NEAR:
                on_edge.append((along, (x, y)))
        found += [point for _, point in sorted(on_edge)]
    return found


def crosses_itself(polygon: Sequence[Point]) -> bool:
    """Whether two edges that are not neighbors cross."""
    points = np.array(polygon, float)
    after = np.roll(points, -1, axis=0)

    def side(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
        return (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) \
            - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])

    for i in range(len(points)):
        a, b = points[i], after[i]
        c, d = points[i + 1:], after[i + 1:]
        left, right = side(a, b, c), side(a, b, d)
        near, far = side(c, d, a), side(c, d, b)
        # clearly on both sides: corners that touch, within 0.1 mm on 10 cm, are drawn so
        if np.any((left * right < 0) & (near * far < 0) & (np.abs(left) > 1e-5)
                  & (np.abs(right) > 1e-5) & (np.abs(near) > 1e-5) & (np.abs(far) > 1e-5)):
            return True
    return False


def rectangle(x: float, y: float, yaw: float, low: Point, high: Point) -> list[Point]:
    """The corners of a rectangle given in a frame at x, y turned by yaw."""
    return [turned((x, y), yaw, u, v)
            for u, v in ((low[0], low[1]), (high[0], low[1]), high, (low[0], high[1]))]


def hole(opening: Opening, longer: float = 0.0, deeper: float = 0.0) -> list[Point]:
    """The corners of an opening seen from above, so much longer and deeper on both sides."""
    half = opening.width / 2 + longer
    low, high = opening.band
    return rectangle(opening.x, opening.y, opening.yaw, (-half, low - deeper),
                     (half, high + deeper))


def base(piece: Piece, front: float = 0.0) -> list[Point]:
    """The corners of a piece seen from above, so much longer at its front."""
    half = piece.depth / 2, piece.width / 2
    return rectangle(piece.x, piece.y, piece.yaw, (-half[0], -half[1]),
                     (half[0] + front, half[1]))


def to_segments(x: np.ndarray, y: np.ndarray, a: Point, b: Point) -> np.ndarray:
    """The distance of each of the points x, y to a segment, see geometry.to_segment()."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    share = np.clip(((x - a[0]) * dx + (y - a[1]) * dy) / ((dx * dx + dy * dy) or 1.0), 0.0, 1.0)
    return np.hypot(x - a[0] - share * dx, y - a[1] - share * dy)


def reach_of(x: float, y: float, yaw: float, walls: np.ndarray, far: float) -> float:
    """The distance from a point along a direction to the nearest of edges, x y x y each, at most
    `far`."""
    if not len(walls):
        return far
    dx, dy = cos(yaw), sin(yaw)
    ex, ey = walls[:, 2] - walls[:, 0], walls[:, 3] - walls[:, 1]
    cross = dx * ey - dy * ex
    with np.errstate(divide='ignore', invalid='ignore'):
        t = ((walls[:, 0] - x) * ey - (walls[:, 1] - y) * ex) / cross
        s = ((walls[:, 0] - x) * dy - (walls[:, 1] - y) * dx) / cross
    hit = (np.abs(cross) > 1e-9) & (t > 0.02) & (np.abs(s - 0.5) <= 0.5 + 1e-9)
    return float(min(far, t[hit].min())) if hit.any() else far


def overlap(first: Sequence[Point], second: Sequence[Point]) -> float:
    """The depth of overlap of two convex polygons, m; not above 0 if they are apart."""
    depth = inf
    for polygon in (first, second):
        x0, y0 = polygon[-1]
        for x1, y1 in polygon:
            length = hypot(x1 - x0, y1 - y0)
            if length > 1e-9:
                ux, uy = (y0 - y1) / length, (x1 - x0) / length
                p = [x * ux + y * uy for x, y in first]
                q = [x * ux + y * uy for x, y in second]
                depth = min(depth, min(max(p), max(q)) - max(min(p), min(q)))
                if depth <= 0:
                    return depth
            x0, y0 = x1, y1
    return depth


def rectangles(cells: np.ndarray) -> list[tuple[int, int, int, int]]:
    """Covers the true cells by rectangles without overlap: (row, column, rows, columns) each."""
    left = cells.copy()
    flat = left.ravel()
    found: list[tuple[int, int, int, int]] = []
    at = 0
    while at < flat.size:
        at += int(flat[at:].argmax())
        if not flat[at]:
            break
        row, column = divmod(at, left.shape[1])
        run = left[row, column:]
        width = int(np.argmin(run)) if not run.all() else len(run)
        height, rows = 1, np.ones(1, bool)
        while len(rows) and rows.all():  # some rows at a time
            rows = left[row + height:row + height + 64, column:column + width].all(axis=1)
            height += len(rows) if rows.all() else int(rows.argmin())
        left[row:row + height, column:column + width] = False
        found.append((row, column, height, width))
    return found
