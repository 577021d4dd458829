"""States, joints and forces of models that run."""
import numpy as np
import pytest

import angen
from sdf_text import box

SLIDE = '''<model name="slide"><pose>0 5 1 0 0 0</pose><link name="rail"/>
  <link name="car"><gravity>false</gravity></link>
  <joint name="fix" type="fixed"><parent>world</parent><child>rail</child></joint>
  <joint name="along" type="prismatic"><parent>rail</parent><child>car</child><axis>
  <xyz>1 0 0</xyz><limit><lower>-3</lower><upper>3</upper></limit></axis></joint></model>'''


def test_a_state_is_read_back_and_continues(world):
    w = world(box('crate', '0 0 5 0 0 0', '0.2 0.2 0.2') + SLIDE)
    w.set_state('crate', [1, 2, 0, 0, 0, 0], linear=[1, 0, 0], angular=[0, 0, 1], frame='slide')
    pose, linear, angular = w.motion('crate')
    assert np.allclose(pose.ravel(), [1, 7, 1, 0, 0, 0, 1])
    assert np.allclose(linear, [1, 0, 0]) and np.allclose(angular, [0, 0, 1])
    w.run(0.2)
    assert w.motion('crate::link')[0].ravel()[0] == pytest.approx(1.2, abs=1e-3)


def test_a_push_gives_force_by_mass_by_time(world):
    w = world(box('crate', '0 0 9 0 0 0', '0.2 0.2 0.2', mass=4))
    w.push('crate::link', [8, 0, 0], seconds=0.25)
    w.run(0.5)
    assert w.motion('crate')[1][0] == pytest.approx(8 / 4 * 0.25)


def test_joints_are_set_by_name(world):
    w = world(SLIDE)
    w.set_joints('slide', {'along': 1.5})
    assert w.joint_positions[w.joints.index('slide::along')] == pytest.approx(1.5)
    with pytest.raises(angen.Error, match="no joint 'across'"):
        w.set_joints('slide', {'across': 1.5})
    with pytest.raises(angen.Error, match="no model named 'missing'"):
        w.motion('missing')
