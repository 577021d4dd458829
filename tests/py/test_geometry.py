"""Queries of shapes, joints and fields of view; tests/angen_apps/plan/test_outlines.py has more."""
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


def test_rays_of_detection_are_in_the_world(world: angen.World) -> None:
    name = 'kitchen_pir0_a'
    rays = world.detection_rays('pir', name)
    assert rays.shape == (48, 8) and np.allclose(np.linalg.norm(rays[:, 3:6], axis=1), 1.0)
    pose = next(pose for _, each, _, pose in world.entities('pir') if each == name)
    assert np.allclose(rays[:, :3], pose[:3]) and set(rays[:, 7]) == {6.0}
    ahead = rays[:, 3:6].mean(axis=0)
    assert np.arctan2(ahead[1], ahead[0]) == pytest.approx(2 * np.arctan2(pose[5], pose[6]),
                                                           abs=0.2)
    assert world.detection_rays('contact', world.sensors('contact')[0]) is None
    with pytest.raises(angen.Error, match="no pir named 'none'"):
        world.detection_rays('pir', 'none')


def test_a_lens_detects_in_its_zones_only() -> None:
    lens = angen.World.from_text('''<sdf version="1.6"><world name="w"><include>
      <uri>model://pir_casas</uri><name>p</name><pose>0 0 2.5 0 1.570796 0</pose></include>
      </world></sdf>''')
    rays = lens.detection_rays('pir', 'p')
    assert rays.shape == (3 * 2 * 2 * 9, 8)  # rows, pairs, zones of a pair, rays
    down = rays[:, 3:6] / -rays[:, 5:6]  # where they are 1 m below
    assert np.abs(down[:, :2]).max() < np.tan(0.2375 + 0.01) and np.abs(down[:, :2]).max() > 0.15
