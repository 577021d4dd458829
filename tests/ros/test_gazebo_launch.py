"""A launch file of others' robots: xacro, empty_world.launch, spawn_model and tf_prefix."""
import subprocess
from pathlib import Path
from typing import Iterator

import pytest
from harness import Angen, Master, end, until
from gazebo_msgs.msg import ModelStates
from sensor_msgs.msg import LaserScan

PACKAGE = """<package format="2"><name>{0}</name><version>1.0.0</version>
<description>of a test</description><maintainer email="a@b.org">a</maintainer>
<license>none</license></package>"""
# In place of ros/xacro, which Debian 12 does not have: it fills in the arguments.
XACRO = """#!/usr/bin/python3
import sys
text = open(sys.argv[1]).read()
for word in sys.argv[2:]:
    name, value = word.split(':=')
    text = text.replace('$(arg %s)' % name, value)
print(text)
"""
ROBOT = """<robot name="theirs" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="base_link"><inertial><mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01"
    ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="$(arg size) 0.2 0.2"/></geometry></collision></link>
  <gazebo reference="base_link"><sensor name="scan" type="ray"><update_rate>10</update_rate>
    <ray><scan><horizontal><samples>90</samples><min_angle>-1</min_angle><max_angle>1</max_angle>
    </horizontal></scan><range><min>0.1</min><max>5</max></range></ray>
    <plugin name="laser" filename="libgazebo_ros_laser.so"><topicName>scan</topicName>
      <frameName>base_scan</frameName></plugin></sensor></gazebo>
</robot>"""
LAUNCH = """<launch>
  <arg name="size" default="0.3"/>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="gui" value="false"/>
  </include>
  <group ns="west">
    <param name="tf_prefix" value="west_frames"/>
    <param name="robot_description"
           command="$(find xacro)/xacro '$(find theirs)/robot.xacro' size:=$(arg size)"/>
    <node name="spawn" pkg="gazebo_ros" type="spawn_model"
          args="-urdf -param robot_description -model theirs -z 0.1"/>
  </group>
</launch>"""


def write_package(folder: Path, name: str, files: dict[str, str]) -> None:
    (folder / name).mkdir()
    (folder / name / 'package.xml').write_text(PACKAGE.format(name))
    for file, text in files.items():
        (folder / name / file).write_text(text)


@pytest.fixture(scope='module')
def launched(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
             ) -> Iterator[Angen]:
    folder = tmp_path_factory.mktemp('launch')
    write_package(folder, 'xacro', {'xacro': XACRO})
    (folder / 'xacro' / 'xacro').chmod(0o755)
    write_package(folder, 'theirs', {'robot.xacro': ROBOT, 'robot.launch': LAUNCH})
    environment = dict(master.environment)
    environment['ROS_PACKAGE_PATH'] = f"{folder}:{environment['ROS_PACKAGE_PATH']}"
    log = folder / 'log'
    with log.open('w') as out:
        process = subprocess.Popen(['roslaunch', 'theirs', 'robot.launch', 'size:=0.4'],
                                   env=environment, text=True, stdout=out, stderr=out)
    angen = Angen(master, process, log)
    try:
        until(lambda: '/west/scan' in master.topics(), 'the robot is there', 90.0)
        yield angen
    finally:
        end(process, 60.0)


def test_xacros_output_is_spawned_in_its_namespace(launched: Angen) -> None:
    states = launched.wait('/gazebo/model_states', ModelStates)
    assert states.name == ['ground_plane', 'theirs']
    described = launched.master.api.getParam('/test', '/west/robot_description')[2]
    assert '<box size="0.4 0.2 0.2"/>' in described


def test_its_frames_have_the_prefix_of_its_namespace(launched: Angen) -> None:
    assert launched.wait('/west/scan', LaserScan).header.frame_id == 'west_frames/base_scan'
