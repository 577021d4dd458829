"""Rotations, against those of the simulator."""
from types import SimpleNamespace

import angen
import numpy as np
import pytest

from angen_tools.common.geometry import quaternion, rotation, yaw_of


@pytest.mark.parametrize('rpy', [(0, 0, 0), (0.3, 0, 0), (0, 0.4, 0), (0, 0, -2.5),
                                 (0.5, -0.7, 2.9)])
def test_rotations_are_those_of_sdf(world: angen.World, table: str,
                                    rpy: tuple[float, float, float]) -> None:
    world.spawn(table, 'table', [1, 2, 3, *rpy])
    row = world.link_poses[world.links.index('table::body')]
    ours = np.array(quaternion(*rpy))
    assert abs(abs(ours @ row[3:]) - 1) < 1e-12


@pytest.mark.parametrize('yaw', [0.0, 1.2, -3.0])
def test_a_yaw_is_found_again(yaw: float) -> None:
    q = SimpleNamespace(**dict(zip('xyzw', quaternion(0.0, 0.0, yaw))))
    assert yaw_of(q) == pytest.approx(yaw)
    assert rotation(q)[:, 0] == pytest.approx([np.cos(yaw), np.sin(yaw), 0.0])
