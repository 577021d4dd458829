"""Steering, finding out where one is, doors and lines of sight by geometry, and the tables."""
from __future__ import annotations

import math

import numpy as np
import pytest
from angen_tools.doors import find_door, find_hinge
from angen_tools.gridmap import FREE, OCCUPIED, GridMap
from angen_tools.localizer import Localizer
from angen_tools.patrol_report import first_detection, moving
from angen_tools.pilot import Pilot, Pose
from angen_tools.planner import Door
from angen_tools.sight import View, hidden, room_of


def box(width: int = 80, height: int = 60) -> GridMap:
    """A room with a pillar; 0.05 m a cell."""
    cells = np.full((height, width), FREE, np.int8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    cells[10:16, 50:54] = OCCUPIED
    return GridMap(cells, (0.0, 0.0), 0.05, 0)


def scan_from(grid: GridMap, pose: Pose) -> np.ndarray:
    """What a laser there measures: the middles of the cells that rays meet, in its frame."""
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


def test_a_pose_and_its_inverse_are_nothing() -> None:
    pose = Pose(1.0, -2.0, 2.5)
    for nothing in (pose.then(pose.inverse()), pose.inverse().then(pose)):
        assert (nothing.x, nothing.y, nothing.yaw) == pytest.approx((0, 0, 0), abs=1e-12)


def test_the_pilot_follows_a_line_and_stops_at_its_end() -> None:
    points = [(0.05 * i, 0.0) for i in range(41)] + [(2.0, 0.05 * i) for i in range(1, 41)]
    pilot = Pilot(points, 0.5, 1.5, 0.5)
    pose, speeds, aside = Pose(0.0, 0.0, math.pi), [0.0], 0.0
    for _ in range(600):
        command = pilot.steer(pose, 0.1)
        if command is None:
            break
        speeds.append(command[0])
        for _ in range(10):
            pose = pose.then(Pose(command[0] * 0.01, 0.0, command[1] * 0.01))
        aside = max(aside, min(math.dist((pose.x, pose.y), point) for point in points))
    assert command is None
    assert math.dist((pose.x, pose.y), (2.0, 2.0)) < 0.1
    assert aside < 0.1
    assert max(speeds) <= 0.5
    assert np.abs(np.diff(speeds)).max() <= 0.05 + 1e-9


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


def test_a_hinge_is_found_by_two_poses_of_its_leaf() -> None:
    # the leaf's middle, half a metre from an axis at 2, 1
    hinge = find_hinge([(0, 0, 0), (2.5, 1.0, 0.0)], [(0, 0, 0), (2.0, 0.5, -math.pi / 2)])
    assert hinge.at == pytest.approx((2.0, 1.0))
    assert hinge.turn == pytest.approx(-math.pi / 2)
    assert find_hinge([(0, 0, 0)], [(0, 0, 0)]) is None


def test_a_door_is_what_two_maps_do_not_share() -> None:
    shut, opened = box(), box()
    shut.cells[20, 20:38] = OCCUPIED  # from x = 1.0 to 1.9 at y = 1.025
    opened.cells[2:20, 20] = OCCUPIED
    hinge = find_hinge([(1.0, 1.025, 0.0)], [(1.0, 1.025, -math.pi / 2)])
    assert hinge is None or hinge.at == pytest.approx((1.0, 1.025))
    door = find_door('d', hinge, shut, opened)
    assert door.width == pytest.approx(0.9, abs=0.05)
    assert door.shut == pytest.approx(0.0, abs=0.06)
    assert door.open - door.shut == pytest.approx(-math.pi / 2)


def test_a_leaf_hides_what_is_behind_it_and_not_above() -> None:
    door = Door('d', (0.0, 0.0), 0.0, -math.pi / 2, 1.0, top=2.0)
    origin = np.array([0.5, -2.0, 2.5])
    points = np.array([[0.5, 2.0, 0.2], [0.5, 2.0, 2.4], [3.0, 2.0, 0.2], [0.5, -1.0, 0.2]])
    assert hidden(origin, points, door, np.zeros(4)).tolist() == [True, False, False, False]
    assert not hidden(origin, points, door, np.full(4, -1.57)).any()


def test_a_view_has_angles_and_a_reach() -> None:
    view = View(np.zeros(3), np.eye(3), math.pi / 4, 0.1, 5.0)
    points = np.array([[1, 0, 0], [1, 0.9, 0], [1, 1.1, 0], [6, 0, 0], [1, 0, 0.5], [-1, 0, 0]])
    assert view.holds(points).tolist() == [True, True, False, False, False, False]


def test_a_detection_counts_from_when_the_robot_moves() -> None:
    moved = np.array([5.0, 5.1, 9.0])
    assert first_detection(2.0, [(1.0, 1.5), (3.0, 3.5), (4.0, 6.0)], moved) == pytest.approx(4.9)
    assert first_detection(2.0, [(8.95, 9.2)], moved) == pytest.approx(8.95)
    assert first_detection(2.0, [(1.0, 1.5), (3.0, 3.5)], moved) is None
    assert first_detection(None, [(1.0, 1.5)], moved) is None


def test_turning_is_moving() -> None:
    track = np.array([[0.1, 0, 0, 0, 0], [0.2, 0, 0, 0, 0], [0.3, 0, 0, 0, 0.1],
                      [0.4, 0.1, 0, 0, 0.1]])
    assert moving(track).tolist() == [0.3, 0.4]


@pytest.mark.parametrize('sensor, room', [
    ('kitchen_pir0_a', 'kitchen0'), ('livingroom_switch12', 'livingroom12'),
    ('entrance_lux1', 'entrance1'), ('p1', 'p1'), ('elevator', 'elevator')])
def test_a_sensor_tells_its_room(sensor: str, room: str) -> None:
    assert room_of(sensor) == room
