"""Finds people in a robot's own measurements: arcs in a scan, figures in a depth image."""
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from angen_apps.robot.localizer import Field, returns_of, to_world, unexplained
from angen_apps.robot.pilot import Pose
from angen_tools.common.geometry import local

GAP = 0.15  # m between two returns of the same thing
FEWEST = 6  # returns of a person
RADIUS = (0.15, 0.36)  # m, of a body at the height of the laser
CHORD = (0.22, 0.65)  # m, between the first and the last return
ROUGH = 0.02  # m, root mean square beside the circle
REACH = 5.5  # m: farther away, a person has too few returns
STRAIGHT = 0.6  # most rms beside the circle, as a share of that beside a line

# A figure in a depth image:
FRONT, BACK = 0.45, 0.15  # m before and behind the middle of the arc
LOW, HIGH = 0.2, 1.3  # m: it fills the heights between these that are in view
OVER = 0.95  # m: its width is measured above furniture beside it
FILLED = 0.85
WIDEST = 0.8  # m
ROWS_AT_LEAST = 20


@dataclass(frozen=True)
class Arc:
    """The round side of something: its middle in the world, and its radius; m."""

    x: float
    y: float
    radius: float
    far: float  # from the robot

    @property
    def at(self) -> tuple[float, float]:
        return self.x, self.y


def find_arcs(scan: Any, mount: Pose, pose: Pose, field: Field) -> list[Arc]:
    """The round things of a person's size where the map is free."""
    points, numbers = returns_of(scan, mount)
    if not len(points):
        return []
    world = to_world(points, pose)
    foreign = unexplained(world, field)
    found = []
    for group in groups(world, numbers, foreign):
        arc = fit_arc(world[group], np.array([pose.x, pose.y]))
        if arc is not None and arc.far <= REACH:
            found.append(arc)
    return found


def groups(points: np.ndarray, numbers: np.ndarray, chosen: np.ndarray) -> list[np.ndarray]:
    """Rows of neighbors in a scan that belong together, all of them chosen."""
    rows = np.nonzero(chosen)[0]
    if len(rows) < FEWEST:
        return []
    apart = np.linalg.norm(np.diff(points[rows], axis=0), axis=1)
    breaks = np.nonzero((apart > GAP) | (np.diff(numbers[rows]) > 3))[0] + 1
    found = np.split(rows, breaks)
    if len(found) > 1 and numbers[rows[0]] + len(numbers) - numbers[rows[-1]] < 4 \
            and np.linalg.norm(points[rows[0]] - points[rows[-1]]) < GAP:
        found[0] = np.concatenate([found.pop(), found[0]])  # across the scan's seam
    return [group for group in found if len(group) >= FEWEST]


def fit_arc(points: np.ndarray, eye: np.ndarray) -> Arc | None:
    """The circle (least squares) through points (n, 2) that are seen from `eye`; None if they
    are not on the near side of a circle of a person's size."""
    chord = float(np.linalg.norm(points[0] - points[-1]))
    if not CHORD[0] <= chord <= CHORD[1]:
        return None
    middle = points.mean(axis=0)
    local = points - middle
    matrix = np.column_stack([2 * local, np.ones(len(local))])
    solution, _, rank, _ = np.linalg.lstsq(matrix, (local ** 2).sum(axis=1), rcond=None)
    if rank < 3:
        return None
    radius = math.sqrt(max(solution[2] + solution[0] ** 2 + solution[1] ** 2, 0.0))
    if not RADIUS[0] <= radius <= RADIUS[1]:
        return None
    center = middle + solution[:2]
    rough = float(np.sqrt(np.mean((np.linalg.norm(points - center, axis=1) - radius) ** 2)))
    flat = float(np.linalg.svd(local, compute_uv=False)[-1] / math.sqrt(len(local)))
    far = float(np.linalg.norm(center - eye))
    if rough > ROUGH or rough > STRAIGHT * flat or far < np.linalg.norm(middle - eye):
        return None
    return Arc(float(center[0]), float(center[1]), radius, far)


@dataclass(frozen=True)
class Figure:
    """Something upright in a depth image: what of it is in view; m."""

    top: float  # height of its highest point
    width: float


def find_figure(depth: Any, camera: tuple[float, float, float], pose: Pose, arc: Arc
                ) -> Figure | None:
    """The figure of a person at the place of an arc; None if there is none.

    `camera`: x, y ahead and left on the robot and height above the floor, m; level, looks ahead.
    """
    image = np.asarray(depth.depth).reshape(int(depth.height), int(depth.width))
    eye = pose.then(Pose(camera[0], camera[1], 0.0))
    ahead, left = local((eye.x, eye.y), eye.yaw, (arc.x, arc.y))
    if ahead < 0.6:
        return None
    column = depth.center_x - depth.focal * left / ahead
    if not 0.05 * image.shape[1] <= column <= 0.95 * image.shape[1]:
        return None
    rows, columns = np.mgrid[0:image.shape[0], 0:image.shape[1]]
    height = camera[2] - (rows - depth.center_y) / depth.focal * image
    beside = np.abs((columns - column) / depth.focal * image)
    with np.errstate(invalid='ignore'):
        there = (image > ahead - FRONT) & (image < ahead + BACK) & (height > LOW)
        core = there & (beside < 0.08)
        upper = min(HIGH, camera[2] + depth.center_y / depth.focal * (ahead - 0.25))
        wide = there & (beside < 0.7) & (height > min(OVER, 0.75 * upper))
    levels = np.unique((height[core] / 0.05).astype(int))
    heights = np.arange(int(LOW / 0.05) + 1, int(upper / 0.05))
    if len(heights) < 4 or not wide.any() or np.isin(heights, levels).mean() < FILLED:
        return None
    spread = ((columns - column) / depth.focal * image)[wide]
    width = float(np.percentile(spread, 98) - np.percentile(spread, 2))
    if width > WIDEST or core.any(axis=1).sum() < ROWS_AT_LEAST:
        return None
    return Figure(float(height[core].max()), width)
