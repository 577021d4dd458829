"""The place of the robot, by scans and odometry."""
import math

import numpy as np
import pytest
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED
from angen_apps.robot.localizer import Localizer
from angen_apps.robot.pilot import Pose


def box(width: int = 80, height: int = 60) -> Grid:
    """A room with a pillar; 0.05 m a cell."""
    cells = np.full((height, width), FREE, np.int8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    cells[10:16, 50:54] = OCCUPIED
    return Grid(cells, (0.0, 0.0), 0.05, 0)


def scan_from(grid: Grid, pose: Pose) -> np.ndarray:
    """A laser's scan there: the middles of the cells that rays hit, in its frame."""
    found = []
    for angle in np.arange(0, 2 * math.pi, math.radians(2)):
        for far in np.arange(0.1, 6.0, 0.01):
            point = pose.x + far * math.cos(angle), pose.y + far * math.sin(angle)
            if grid.cells[grid.cell(*point)] == OCCUPIED:
                middle = grid.point(*grid.cell(*point))
                there = pose.inverse().then(Pose(*middle, 0.0))
                found.append((there.x, there.y))
                break
    return np.array(found)


def test_a_scan_puts_a_wrong_pose_right() -> None:
    grid, truth = box(), Pose(1.3, 1.6, 0.4)
    localizer = Localizer(grid, Pose(1.37, 1.53, 0.47), Pose(0, 0, 0))
    scan = scan_from(grid, truth)
    for _ in range(5):
        pose = localizer.see(scan)
    assert math.dist((pose.x, pose.y), (truth.x, truth.y)) < 0.02
    assert abs(pose.yaw - truth.yaw) < 0.01


def test_odometry_moves_the_pose_in_its_own_direction() -> None:
    localizer = Localizer(box(), Pose(1.0, 1.0, math.pi / 2), Pose(5.0, 5.0, 0.0))
    pose = localizer.move(Pose(5.5, 5.0, 0.1))
    assert (pose.x, pose.y, pose.yaw) == pytest.approx((1.0, 1.5, math.pi / 2 + 0.1))


def test_a_scan_of_nothing_changes_nothing() -> None:
    start = Pose(1.0, 1.0, 0.0)
    assert Localizer(box(), start, Pose(0, 0, 0)).see(np.zeros((0, 2))) == start


def test_a_lost_robot_finds_itself_in_the_whole_room() -> None:
    grid, truth = box(), Pose(2.9, 1.1, -2.0)
    scan = scan_from(grid, truth)
    localizer = Localizer(grid, Pose(1.0, 2.2, 0.5), Pose(0, 0, 0))
    assert localizer.share(scan) < 0.5
    assert localizer.find(scan)
    pose = localizer.pose
    assert math.dist((pose.x, pose.y), (truth.x, truth.y)) < 0.05
    assert abs(math.remainder(pose.yaw - truth.yaw, 2 * math.pi)) < 0.02
    assert localizer.share(scan) > 0.95


def test_a_scan_that_fits_nowhere_leaves_the_pose_as_it_was() -> None:
    start = Pose(1.0, 2.2, 0.5)
    localizer = Localizer(box(), start, Pose(0, 0, 0))
    ring = np.array([(0.9 * math.cos(a), 0.9 * math.sin(a)) for a in np.arange(0, 6.28, 0.05)])
    assert not localizer.find(ring) and localizer.pose == start
