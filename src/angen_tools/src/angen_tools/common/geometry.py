"""Rotations of SDF and of ROS messages; angles in rad."""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np


def quaternion(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """SDF's rotation about the fixed x, then y, then z axis, as x y z w."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a / 2), math.sin(a / 2)) for a in (roll, pitch, yaw))
    return (sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy)


def yaw(x: float, y: float, z: float, w: float) -> float:
    """The rotation about z of a quaternion."""
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


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
