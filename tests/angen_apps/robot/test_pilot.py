"""Steering."""
from __future__ import annotations

import math

import numpy as np
import pytest

from angen_apps.robot.pilot import Pilot, Pose


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


def test_the_pilot_arrives_where_its_commands_are_late_and_rare() -> None:
    points = [(0.05 * i, 0.0) for i in range(41)] + [(2.0, 0.05 * i) for i in range(1, 41)]
    pilot = Pilot(points, 0.5, 1.5, 0.5)
    pose, running, aside = Pose(0.0, 0.0, math.pi), (0.0, 0.0), 0.0
    for _ in range(200):
        command = pilot.steer(pose, 0.5)
        if command is None:
            break
        for step in range(50):
            v, w = running if step < 20 else command  # it takes effect 0.2 s after the pose
            pose = pose.then(Pose(v * 0.01, 0.0, w * 0.01))
        running = command
        aside = max(aside, min(math.dist((pose.x, pose.y), point) for point in points))
    assert command is None
    assert math.dist((pose.x, pose.y), (2.0, 2.0)) < 0.2
    assert aside < 0.2
