"""Steering."""
import math

import numpy as np
import pytest

from angen_apps.robot.pilot import Pilot, Pose


def test_a_pose_and_its_inverse_are_nothing() -> None:
    pose = Pose(1.0, -2.0, 2.5)
    for nothing in (pose.then(pose.inverse()), pose.inverse().then(pose)):
        assert (nothing.x, nothing.y, nothing.yaw) == pytest.approx((0, 0, 0), abs=1e-12)


@pytest.mark.parametrize('period, late, aside_most', [
    (0.1, 0.0, 0.1), (0.5, 0.2, 0.2)])  # s; a command takes effect that late
def test_the_pilot_follows_a_line_and_stops_at_its_end(period: float, late: float,
                                                       aside_most: float) -> None:
    points = [(0.05 * i, 0.0) for i in range(41)] + [(2.0, 0.05 * i) for i in range(1, 41)]
    pilot = Pilot(points, 0.5, 1.5, 0.5)
    pose, running, speeds, aside = Pose(0.0, 0.0, math.pi), (0.0, 0.0), [0.0], 0.0
    for _ in range(round(60 / period)):
        command = pilot.steer(pose, period)
        if command is None:
            break
        speeds.append(command[0])
        for step in range(round(period / 0.01)):
            v, w = running if step * 0.01 < late - 1e-9 else command
            pose = pose.then(Pose(v * 0.01, 0.0, w * 0.01))
        running = command
        aside = max(aside, min(math.dist((pose.x, pose.y), point) for point in points))
    assert command is None
    assert math.dist((pose.x, pose.y), (2.0, 2.0)) < aside_most
    assert aside < aside_most
    assert max(speeds) <= 0.5
    assert np.abs(np.diff(speeds)).max() <= 0.5 * period + 1e-9
