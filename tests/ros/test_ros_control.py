"""The package gazebo_ros_control in the node, which CTest builds with tests/examples/ros_control.

That is a substitute for ros_control, which Debian 12 does not have: its controller manager leads
all joints of examples/arm to a position.
"""
import os
import subprocess
import threading
from pathlib import Path
from typing import Iterator

import pytest
import rospy
from gazebo_msgs.srv import GetJointProperties
from harness import ROOT, TREE, Angen, Master, until, without_sanitizer
from std_msgs.msg import Float64
from std_srvs.srv import Empty

PACKAGE = ROOT / 'src/gazebo_ros_control'
LIBRARIES = TREE / 'tests/examples/gazebo_ros_control/devel/lib'
WORLD = """<sdf version="1.6"><world name="default">
  <include><uri>model://ground_plane</uri></include></world></sdf>"""
ARM = (ROOT / 'examples/arm/arm.urdf').read_text()


@pytest.fixture(scope='module')
def arm(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
        ) -> Iterator[Angen]:
    """A node that finds the package, and the arm in it."""
    library = LIBRARIES / 'libgazebo_ros_control_ros.so'
    assert library.exists(), 'ctest builds it: ./angen test ctest'
    before = dict(master.environment)
    master.environment['ANGEN_PLUGIN_PATH'] = str(LIBRARIES)
    with master.serving(WORLD, tmp_path_factory.mktemp('arm')) as angen:
        master.environment = before
        angen.spawn('arm', ARM)
        yield angen


def reached(arm: Angen, joint: str, position: float) -> bool:
    found = arm.call('/gazebo/get_joint_properties', GetJointProperties, joint_name=joint)
    return bool(abs(found.position[0] - position) < 0.02)


def test_controllers_lead_the_joints(arm: Angen) -> None:
    arm.send('/arm/controller_manager/reach', Float64(0.4))
    for joint in ('turn', 'shoulder', 'elbow'):
        until(lambda: reached(arm, joint, 0.4), f'{joint} is there', 20.0)


def test_the_topics_are_theirs(arm: Angen) -> None:
    assert '/arm/joint_states' not in arm.master.topics()
    _, subscribed, _ = arm.master.api.getSystemState('/test')[2]
    assert not [topic for topic, _ in subscribed if topic.endswith('_controller/command')]
    assert 'clone ros-controls' not in arm.log()


def test_a_service_that_waits_for_an_update_does_not_keep_the_model(arm: Angen) -> None:
    arm.call('/gazebo/pause_physics', Empty)
    switch = rospy.ServiceProxy('/arm/controller_manager/switch', Empty)
    waiting = threading.Thread(target=lambda: switch(), daemon=True)
    waiting.start()
    waiting.join(0.5)
    assert waiting.is_alive(), 'it waits'
    arm.delete('arm')
    waiting.join(10.0)
    assert not waiting.is_alive()
    until(lambda: '/arm/controller_manager/switch' not in
          [name for name, _ in arm.master.api.getSystemState('/test')[2][2]], 'it is unregistered')
    arm.call('/gazebo/unpause_physics', Empty)
    arm.spawn('arm', ARM)
    arm.send('/arm/controller_manager/reach', Float64(-0.3))
    until(lambda: reached(arm, 'turn', -0.3), 'another of its name', 20.0)


@without_sanitizer
def test_without_ros_control_the_package_builds_nothing(tmp_path: Path) -> None:
    said = subprocess.run(
        ['cmake', '-S', str(PACKAGE), '-B', str(tmp_path), '-DPYTHON_EXECUTABLE=/usr/bin/python3',
         '-DCMAKE_DISABLE_FIND_PACKAGE_controller_manager=ON'],
        env=dict(os.environ, PATH='/usr/bin:' + os.environ['PATH']), capture_output=True, text=True,
        timeout=120, check=True).stdout
    assert 'nothing to build without ros_control' in said
    subprocess.run(['cmake', '--build', str(tmp_path)], check=True, timeout=120)
    assert not list(tmp_path.rglob('*.so'))
