"""Lines of sight in a world's geometry, without ROS."""
from typing import Any

import numpy as np


def sees(world: Any, origin: np.ndarray, points: np.ndarray, near: float = 0.0) -> np.ndarray:
    """Whether each of points (n, 3) is visible from `origin`; a hit that is at most `near` m
    before a point is of the point.
    """
    lines = points - origin
    far = np.maximum(np.linalg.norm(lines, axis=1), 1e-6)
    ways = np.where(far[:, None] > 1e-6, lines / far[:, None], [0.0, 0.0, 1.0])  # not to itself
    ranges = world.cast(np.broadcast_to(origin, points.shape), ways, far)
    return np.asarray(ranges >= far - near - 1e-6)
