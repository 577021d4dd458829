"""Rays against a world's geometry from Python, without ROS: many at once, as NumPy arrays."""
from __future__ import annotations

import angen
import numpy as np

NAME = 'angen_ray_probe'
PROBE = '''<model name="angen_ray_probe"><static>true</static><link name="link">
  <sensor name="probe" type="ray"><update_rate>1000</update_rate>
  <plugin name="probe" filename="angen_ray_probe.py"/></sensor></link></model>'''


class _Probe(angen.Sensor):
    """Casts the rays that wait in `rays`, once."""

    rate = 1000.0
    rays: np.ndarray | None = None
    ranges: np.ndarray | None = None

    def aim(self, view: angen.View) -> np.ndarray | None:
        return _Probe.rays

    def read(self, view: angen.View, ranges: np.ndarray, rng: angen.Rng) -> dict[str, float]:
        if _Probe.rays is not None:
            _Probe.ranges, _Probe.rays = ranges, None
        return {}

    @staticmethod
    def latest() -> np.ndarray | None:
        """The ranges of the rays, once they have been cast."""
        return _Probe.ranges


angen.register('angen_ray_probe.py', 'ray_probe', _Probe)


class Caster:
    """Rays against the present geometry of a world."""

    def __init__(self, world: angen.World) -> None:
        self._world = world
        if NAME not in world.models:
            world.spawn(PROBE, NAME)

    def cast(self, origins: np.ndarray, directions: np.ndarray, reach: np.ndarray | float
             ) -> np.ndarray:
        """Ranges (n,) in m of rays from `origins` (n, 3) along `directions` (n, 3), world frame.

        A range is not below `reach` (m, a number or (n,)) where a ray hits nothing within it.
        Time moves on by a step, or as long as the probe's next reading takes.
        """
        count = len(origins)
        rows = np.zeros((count, 8))
        rows[:, :3], rows[:, 3:6], rows[:, 7] = origins, directions, reach
        _Probe.rays, _Probe.ranges = rows, None
        while (ranges := _Probe.latest()) is None:
            self._world.step()
        return np.minimum(ranges, rows[:, 7])

    def sees(self, origin: np.ndarray, points: np.ndarray, near: float = 0.0) -> np.ndarray:
        """Whether each of points (n, 3) is visible from `origin`; a hit that is at most `near` m
        before a point is of the point.
        """
        lines = points - origin
        far = np.maximum(np.linalg.norm(lines, axis=1), 1e-6)
        ranges = self.cast(np.broadcast_to(origin, points.shape), lines / far[:, None], far)
        return np.asarray(ranges >= far - near - 1e-6)
