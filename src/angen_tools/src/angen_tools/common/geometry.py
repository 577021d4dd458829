"""Rotations of SDF and of ROS messages, frames in the plane, and distances; rad and m."""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Iterable, Sequence

if TYPE_CHECKING:
    import numpy as np

Point = tuple[float, float]


def quaternion(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """SDF's rotation about the fixed x, then y, then z axis, as x y z w."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a / 2), math.sin(a / 2)) for a in (roll, pitch, yaw))
    return (sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy)


def yaw(x: float, y: float, z: float, w: float) -> float:
    """The rotation about z of a quaternion."""
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def turned(origin: Point, yaw: float, u: float, v: float) -> Point:
    """The point (u, v) of a frame at `origin` turned by `yaw`."""
    c, s = math.cos(yaw), math.sin(yaw)
    return origin[0] + u * c - v * s, origin[1] + u * s + v * c


def local(origin: Point, yaw: float, point: Point) -> Point:
    """A point in the frame at `origin` turned by `yaw`."""
    dx, dy, c, s = point[0] - origin[0], point[1] - origin[1], math.cos(yaw), math.sin(yaw)
    return dx * c + dy * s, dy * c - dx * s


def to_segment(point: Point, a: Point, b: Point) -> float:
    """The distance of a point from the segment between two others."""
    x, y, dx, dy = point[0] - a[0], point[1] - a[1], b[0] - a[0], b[1] - a[1]
    length = dx * dx + dy * dy
    share = min(max((x * dx + y * dy) / length, 0.0), 1.0) if length else 0.0
    return math.hypot(x - share * dx, y - share * dy)


def length(points: Sequence[Point]) -> float:
    """The length of the line through points."""
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


def edges(polygon: Sequence[Point]) -> list[tuple[Point, Point]]:
    return list(zip(polygon, [*polygon[1:], polygon[0]]))


def contains(polygon: Sequence[Point], x: float, y: float,
             holes: Sequence[Sequence[Point]] = ()) -> bool:
    """Whether a point is inside and in none of the holes, by the even-odd rule."""
    found = False
    for (x0, y0), (x1, y1) in edges(polygon):
        if (y0 > y) != (y1 > y) and x < (x1 - x0) * (y - y0) / (y1 - y0) + x0:
            found = not found
    return found and not any(contains(hole, x, y) for hole in holes)


def bounds(points: Iterable[Point]) -> tuple[float, float, float, float]:
    """West, south, east, north of some points."""
    x, y = zip(*points)
    return float(min(x)), float(min(y)), float(max(x)), float(max(y))


def center(polygon: Sequence[Point]) -> Point:
    """The centroid of a polygon; the mean of its corners if it has no area."""
    x = y = twice = 0.0
    x0, y0 = polygon[0]
    for (ax, ay), (bx, by) in edges(polygon):
        cross = (ax - x0) * (by - y0) - (bx - x0) * (ay - y0)
        twice += cross
        x += cross * (ax + bx - 2 * x0)
        y += cross * (ay + by - 2 * y0)
    if abs(twice) < 2e-9:
        xs, ys = zip(*polygon)
        return sum(xs) / len(xs), sum(ys) / len(ys)
    return x0 + x / (3 * twice), y0 + y / (3 * twice)


def yaw_of(q: Any) -> float:
    """The rotation about z of a geometry_msgs/Quaternion."""
    return yaw(q.x, q.y, q.z, q.w)


def rotation(q: Any) -> np.ndarray:
    """The 3 x 3 matrix of a geometry_msgs/Quaternion."""
    return rotation_of(q.x, q.y, q.z, q.w)


def rotation_of(x: float, y: float, z: float, w: float) -> np.ndarray:
    """The 3 x 3 matrix of a quaternion."""
    import numpy as np
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
