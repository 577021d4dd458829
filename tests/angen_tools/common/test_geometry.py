"""Rotations, against those of the simulator."""
from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import angen
import numpy as np
import pytest

from angen_tools.common.geometry import quaternion, rotation, yaw_of

BLOCKS = Path(__file__).resolve().parents[3] / 'worlds/models'
EMPTY = BLOCKS.parent / 'empty.world'
TABLE = '''<sdf version="1.6"><model name="table"><static>true</static><link name="body">
  <collision name="top"><geometry><box><size>1 1 0.1</size></box></geometry></collision>
  <collision name="leg"><pose>0 0 -0.4 0 0 0</pose><geometry><box><size>0.1 0.1 0.7</size></box>
  </geometry></collision></link></model></sdf>'''


@pytest.fixture
def world() -> angen.World:
    return angen.World(str(EMPTY))


@pytest.mark.parametrize('rpy', [(0, 0, 0), (0.3, 0, 0), (0, 0.4, 0), (0, 0, -2.5),
                                 (0.5, -0.7, 2.9)])
def test_rotations_are_those_of_sdf(world: angen.World, rpy: tuple[float, float, float]) -> None:
    world.spawn(TABLE, 'table', [1, 2, 3, *rpy])
    row = world.link_poses[world.links.index('table::body')]
    ours = np.array(quaternion(*rpy))
    assert abs(abs(ours @ row[3:]) - 1) < 1e-12


@pytest.mark.parametrize('yaw', [0.0, 1.2, -3.0])
def test_a_yaw_is_found_again(yaw: float) -> None:
    q = SimpleNamespace(**dict(zip('xyzw', quaternion(0.0, 0.0, yaw))))
    assert yaw_of(q) == pytest.approx(yaw)
    assert rotation(q)[:, 0] == pytest.approx([np.cos(yaw), np.sin(yaw), 0.0])
