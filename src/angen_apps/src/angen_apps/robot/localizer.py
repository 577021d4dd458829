"""Where a robot is: its odometry, put right by laser scans against the map."""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.ndimage import distance_transform_edt

from angen_apps.maps.gridmap import OCCUPIED, GridMap
from angen_apps.robot.pilot import Pose

GATE = 0.25  # m: a return that is farther from everything on the map is of a door or a person
ROUNDS = 10
ENOUGH = 0.0005  # m, rad: a round that moves it less is the last
EVERY = 3  # of a scan's returns one is taken
FEWEST = 30  # returns below which a scan is not used
# How odometry is weighed against a scan: standard deviations since the last one, and of a return.
PLACE, TURN, RANGE = 0.02, 0.02, 0.05


class Field:
    """Meters from a place to the nearest occupied cell of a map, and the way there."""

    def __init__(self, grid: GridMap) -> None:
        self._grid = grid
        far = distance_transform_edt(grid.cells != OCCUPIED) * grid.resolution
        up, right = np.gradient(far, grid.resolution)
        self._layers = np.stack([far, right, up])

    def at(self, points: np.ndarray) -> np.ndarray:
        """(3, n): distance (m) and its slope along x and y at points (n, 2) in the world, m.

        Between the middles of four cells it is bilinear; off the map it is as at its edge.
        """
        rows, columns = self._grid.cells.shape
        x, y = ((points - self._grid.origin) / self._grid.resolution - 0.5).T
        x, y = np.clip(x, 0, columns - 1.001), np.clip(y, 0, rows - 1.001)
        column, row = x.astype(int), y.astype(int)
        x, y = x - column, y - row
        cells = self._layers
        return ((cells[:, row, column] * (1 - x) + cells[:, row, column + 1] * x) * (1 - y)
                + (cells[:, row + 1, column] * (1 - x) + cells[:, row + 1, column + 1] * x) * y)


class Localizer:
    """Keeps a pose in the world, from odometry and laser scans."""

    def __init__(self, grid: GridMap, start: Pose, odometry: Pose) -> None:
        self.pose = start
        self._odometry = odometry
        self._field = Field(grid)

    def enter(self, grid: GridMap) -> None:
        """Continues on another map: of the floor where an elevator has taken it."""
        self._field = Field(grid)

    def move(self, odometry: Pose) -> Pose:
        """Adds the change of the odometry since the last call."""
        self.pose = self.pose.then(self._odometry.inverse().then(odometry))
        self._odometry = odometry
        return self.pose

    def see(self, returns: np.ndarray) -> Pose:
        """Fits a scan's returns (n, 2), in the robot's frame (m), to the map: least squares about
        the previous pose (Gauss, Newton), each return matched to the nearest cell."""
        start = np.array([self.pose.x, self.pose.y, self.pose.yaw])
        if len(returns) < FEWEST:
            return self.pose
        prior = np.diag([1 / PLACE ** 2, 1 / PLACE ** 2, 1 / TURN ** 2])
        state = start.copy()
        for _ in range(ROUNDS):
            c, s = math.cos(state[2]), math.sin(state[2])
            turned = returns @ np.array([[c, s], [-s, c]])
            far, right, up = self._field.at(turned + state[:2])
            near = far < GATE
            if near.sum() < FEWEST:
                break
            slopes = np.stack([right, up, up * turned[:, 0] - right * turned[:, 1]], axis=1)[near]
            # Returns beside each other are not independent: all together weigh as FEWEST would.
            weight = FEWEST / near.sum() / RANGE ** 2
            left = np.linalg.solve(prior + weight * slopes.T @ slopes,
                                   prior @ (start - state) - weight * slopes.T @ far[near])
            state += left
            if np.abs(left).max() < ENOUGH:
                break
        self.pose = Pose(float(state[0]), float(state[1]), math.remainder(state[2], 2 * math.pi))
        return self.pose


def returns_of(scan: Any, mount: Pose, every: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Of a sensor_msgs/LaserScan each `every`th return (n, 2) in the robot's frame, m, and their
    numbers in the scan; `mount`: the laser on the robot."""
    ranges = np.asarray(scan.ranges[::every])
    angles = scan.angle_min + every * scan.angle_increment * np.arange(len(ranges)) + mount.yaw
    hit = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    points = ranges[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return points[hit] + [mount.x, mount.y], every * np.nonzero(hit)[0]
