"""Localizes a robot: its odometry, corrected by laser scans against the map."""
import math
from typing import Any

import numpy as np
from angen import Grid
from scipy.ndimage import distance_transform_edt

from angen_apps.maps.gridmap import FREE, OCCUPIED
from angen_apps.robot.pilot import Pose

GATE = 0.25  # m: a return that is farther from everything on the map is of a door or a person
ROUNDS = 10
ENOUGH = 0.0005  # m, rad: a round that moves it less is the last
EVERY = 3  # one of so many returns of a scan is taken
FEWEST = 30  # returns below which a scan is not used
UNEXPLAINED = 0.15  # m: a return at this distance from all cells of the map is of something else
# The search for a pose over a whole floor:
FITS, SHARE = 0.1, 0.7  # m from the map; the part of a scan's returns that do not lie farther
EACH, TURNS, RAYS = 4, 48, 60  # one of EACH free cells; directions; returns
BEST = 8  # places that are looked at closely
NEAR_FIRST = 0.002  # m of misfit that a meter from the previous pose counts as
# The weights of odometry and a scan: standard deviations since the last one, and of a return.
PLACE, TURN, RANGE = 0.02, 0.02, 0.05


class Field:
    """Meters from a place to the nearest occupied cell of a map, and the way there."""

    def __init__(self, grid: Grid) -> None:
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

    def near(self, cells: np.ndarray, most: float) -> np.ndarray:
        """Meters (...) from cells (..., 2: column, row) to the map, cut at `most`, as off the map.
        """
        rows, columns = self._grid.cells.shape
        row, column = cells[..., 1], cells[..., 0]
        on = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        far = self._layers[0][np.where(on, row, 0), np.where(on, column, 0)]
        return np.where(on, np.minimum(far, most), most)


def to_world(points: np.ndarray, pose: Pose) -> np.ndarray:
    """Points (n, 2) of a frame in the world."""
    c, s = math.cos(pose.yaw), math.sin(pose.yaw)
    return points @ np.array([[c, s], [-s, c]]) + [pose.x, pose.y]


def unexplained(points: np.ndarray, field: Field) -> np.ndarray:
    """Which points (n, 2) in the world the map has nothing near."""
    return np.asarray(field.at(points)[0] > UNEXPLAINED)


class Localizer:
    """Keeps a pose in the world, from odometry and laser scans."""

    def __init__(self, grid: Grid, start: Pose, odometry: Pose) -> None:
        self.pose = start
        self._odometry = odometry
        self.enter(grid)

    def enter(self, grid: Grid) -> None:
        """Continues on another map: of the floor where an elevator has taken it."""
        self._grid, self._field = grid, Field(grid)

    @property
    def field(self) -> Field:
        """The field of the map that it is on."""
        return self._field

    def share(self, returns: np.ndarray) -> float:
        """The part of a scan's returns (n, 2) that lie on the map; 1 of too few."""
        if len(returns) < FEWEST:
            return 1.0
        cells = (to_world(returns, self.pose) - self._grid.origin) / self._grid.resolution
        return float((self._field.near(np.floor(cells).astype(int), GATE) < FITS).mean())

    def find(self, returns: np.ndarray) -> bool:
        """Searches the floor for the pose that a scan fits best; whether it fits there. Keeps its
        pose otherwise."""
        if len(returns) < FEWEST:
            return False
        before, best, share = self.pose, self.pose, 0.0
        for pose in self._candidates(returns[::max(1, len(returns) // RAYS)]):
            self.pose = pose
            for _ in range(ROUNDS):
                self.see(returns)
            here = self.share(returns)
            if here > share + 0.02:
                best, share = self.pose, here
        self.pose = best if share >= SHARE else before
        return share >= SHARE

    def _candidates(self, returns: np.ndarray) -> list[Pose]:
        """The poses on free cells where the returns are nearest to the map, the best first."""
        grid = self._grid
        rows, columns = (axis[::EACH] for axis in np.nonzero(grid.cells == FREE))
        places = np.stack([columns, rows], axis=1)
        away = (places + 0.5) * grid.resolution + grid.origin - (self.pose.x, self.pose.y)
        cost = NEAR_FIRST * np.hypot(*away.T)
        found: list[tuple[float, Pose]] = []
        for turn in range(TURNS):
            yaw = 2 * math.pi * turn / TURNS
            ends = np.rint(to_world(returns, Pose(0.0, 0.0, yaw)) / grid.resolution).astype(int)
            miss = cost + self._field.near(places[:, None] + ends, GATE).mean(axis=1)
            for i in np.argsort(miss)[:BEST]:
                x, y = grid.point(int(rows[i]), int(columns[i]))
                found.append((float(miss[i]), Pose(x, y, math.remainder(yaw, 2 * math.pi))))
        kept: list[Pose] = []
        for _, pose in sorted(found, key=lambda each: each[0]):
            if all(math.dist((pose.x, pose.y), (other.x, other.y)) > 2 * GATE or
                   abs(math.remainder(pose.yaw - other.yaw, 2 * math.pi)) > 0.3 for other in kept):
                kept.append(pose)
        return kept[:BEST]

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
    """Each `every`th return of a sensor_msgs/LaserScan (n, 2) in the robot's frame, m, and their
    numbers in the scan; `mount`: the laser on the robot."""
    ranges = np.asarray(scan.ranges[::every])
    angles = scan.angle_min + every * scan.angle_increment * np.arange(len(ranges)) + mount.yaw
    hit = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    points = ranges[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return points[hit] + [mount.x, mount.y], every * np.nonzero(hit)[0]
