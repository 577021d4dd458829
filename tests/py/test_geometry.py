"""Queries of shapes, joints and fields of view; tests/angen_apps/plan/test_outlines.py has more."""
from __future__ import annotations

from pathlib import Path

import angen
import numpy as np
import pytest

BUILDING = Path(__file__).resolve().parents[2] / 'worlds/angen.world'


@pytest.fixture(scope='module')
def world() -> angen.World:
    return angen.World(str(BUILDING))


def test_a_joint_is_described_in_the_world(world: angen.World) -> None:
    hinge = world.joint('kitchen_door0::hinge')
    assert (hinge['type'], hinge['model'], hinge['child']) == ('revolute', 'kitchen_door0', 'door')
    assert hinge['anchor'][:2] == pytest.approx((2.405, 3.94)) and hinge['axis'][2] == 1
    assert hinge['limits'] == pytest.approx((-1.57, 0.001)) and hinge['position'] == -1.57
    with pytest.raises(angen.Error, match="no joint 'kitchen_door0::handle'"):
        world.joint('kitchen_door0::handle')


def test_fields_of_view_are_those_of_the_models(world: angen.World) -> None:
    right, left, far = world.field_of_view('pir', 'kitchen_pir0_a')
    assert right == -left and left > 0.5 and far == 6
    right, left, far = world.field_of_view('camera', 'turtlebot_camera')
    assert left - right == pytest.approx(1.02, abs=0.05) and far == np.inf
    assert world.field_of_view('contact', world.sensors('contact')[0]) is None
    with pytest.raises(angen.Error, match="no pir named 'none'"):
        world.field_of_view('pir', 'none')
