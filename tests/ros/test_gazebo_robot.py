"""A robot made for Gazebo on a launch file's server: it drives true to its odometry, and its topics
and frames are where navigation wants them."""
import math
import subprocess
from typing import Any, Iterator

import pytest
from harness import Angen, Inbox, Master, end, until
from angen_msgs.srv import List, Spawn
from geometry_msgs.msg import Pose, Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, JointState, LaserScan
from tf2_msgs.msg import TFMessage

WORLD = """<sdf version="1.4"><world name="default">
  <include><uri>model://sun</uri></include>
  <include><uri>model:///ground_plane</uri></include>
  <include><uri>model://not_there</uri></include>
  <physics type="ode"><ode><constraints>
    <contact_surface_layer>0.01</contact_surface_layer></constraints></ode></physics>
  <model name="wall"><static>true</static><link name="link"><inertial><mass>1</mass>
    <inertia><ixx>nan</ixx></inertia></inertial><pose>2 0 0.5 0 0 0</pose>
    <collision name="c"><geometry><box><size>0.2 8 1</size></box></geometry></collision></link>
  </model>
  <plugin name="unknown" filename="libtheir_world.so"/>
</world></sdf>"""


def wheel(side: str, y: float) -> str:
    return f"""
  <link name="{side}_wheel">
    <collision><geometry><cylinder radius="0.035" length="0.02"/></geometry></collision>
    <inertial><mass value="0.05"/><inertia ixx="2e-5" ixy="0" ixz="0" iyy="2e-5" iyz="0"
      izz="3e-5"/></inertial>
  </link>
  <joint name="{side}_joint" type="continuous"><parent link="base_link"/>
    <child link="{side}_wheel"/><origin xyz="0 {y} 0.025" rpy="-1.5708 0 0"/><axis xyz="0 0 1"/>
  </joint>
  <gazebo reference="{side}_wheel"><mu1>0.3</mu1><mu2>0.3</mu2><kp>500000</kp><kd>10</kd>
    <minDepth>0.001</minDepth></gazebo>"""


ROBOT = f"""<robot name="two_wheels">
  <link name="base_footprint"/>
  <joint name="base_joint" type="fixed"><parent link="base_footprint"/><child link="base_link"/>
    <origin xyz="0 0 0.01"/></joint>
  <link name="base_link">
    <collision><origin xyz="0 0 0.08"/><geometry><box size="0.16 0.14 0.1"/></geometry></collision>
    <inertial><origin xyz="-0.02 0 0.04"/><mass value="1"/><inertia ixx="0.003" ixy="0" ixz="0"
      iyy="0.003" iyz="0" izz="0.003"/></inertial>
  </link>
  {wheel('left', 0.08)}{wheel('right', -0.08)}
  <link name="caster">
    <collision><geometry><sphere radius="0.01"/></geometry></collision>
    <inertial><mass value="0.01"/><inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0"
      izz="1e-6"/></inertial>
  </link>
  <joint name="caster_joint" type="fixed"><parent link="base_link"/><child link="caster"/>
    <origin xyz="-0.06 0 0"/></joint>
  <gazebo reference="caster"><mu1>0</mu1><mu2>0</mu2><minDepth>0.001</minDepth></gazebo>
  <link name="imu_link"/>
  <joint name="imu_joint" type="fixed"><parent link="base_link"/><child link="imu_link"/>
    <origin xyz="0 0 0.05"/></joint>
  <link name="base_scan"/>
  <joint name="scan_joint" type="fixed"><parent link="base_link"/><child link="base_scan"/>
    <origin xyz="0 0 0.15"/></joint>
  <gazebo reference="base_scan"><sensor type="ray" name="scanner"><update_rate>5</update_rate>
    <ray><scan><horizontal><samples>360</samples><min_angle>0</min_angle>
      <max_angle>6.28319</max_angle></horizontal></scan>
      <range><min>0.12</min><max>3.5</max></range></ray>
    <plugin name="scan" filename="libgazebo_ros_laser.so"><topicName>scan</topicName>
      <frameName>base_scan</frameName></plugin></sensor></gazebo>
  <gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so">
    <leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint>
    <wheelSeparation>0.16</wheelSeparation><wheelDiameter>0.07</wheelDiameter>
    <wheelAcceleration>1</wheelAcceleration><wheelTorque>10</wheelTorque><updateRate>30</updateRate>
    <publishWheelJointState>true</publishWheelJointState><theirs>1</theirs></plugin></gazebo>
  <gazebo><plugin name="imu" filename="libgazebo_ros_imu.so"><bodyName>imu_link</bodyName>
    <frameName>imu_link</frameName><topicName>imu</topicName><updateRate>50</updateRate>
  </plugin></gazebo>
  <gazebo><plugin name="truth" filename="libgazebo_ros_p3d.so"><bodyName>base_footprint</bodyName>
    <topicName>truth</topicName><frameName>map</frameName></plugin></gazebo>
</robot>"""


@pytest.fixture(scope='module')
def server(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
           ) -> Iterator[Angen]:
    """gzserver with the world, and the robot in it."""
    folder = tmp_path_factory.mktemp('gazebo')
    (folder / 'their.world').write_text(WORLD)
    log = folder / 'log'
    with log.open('w') as out:
        process = subprocess.Popen(
            ['rosrun', 'gazebo_ros', 'gzserver', '-e', 'ode', '--verbose',
             str(folder / 'their.world'), '__name:=gazebo'],
            env=master.environment, text=True, stdout=out, stderr=out)

    def serves() -> bool:
        assert process.poll() is None, log.read_text()
        return '/angen/ready' in master.topics()

    until(serves, 'the node serves', 60.0)
    angen = Angen(master, process, log)
    done = angen.call('/angen/spawn', Spawn, name='bot', xml=ROBOT, pose=Pose())
    assert done.success, done.message
    yield angen
    end(process)


def test_the_world_of_others_loads_with_warnings(server: Angen) -> None:
    said = server.log()
    for words in ("model 'model://not_there' is not found", '<ixx> is not finite',
                  'libtheir_world.so is not found'):
        assert words in said, words
    assert '<theirs> is not a parameter of libgazebo_ros_diff_drive.so' in said


def test_it_drives_true_to_its_odometry_and_stands_on_its_wheels(server: Angen) -> None:
    def place() -> tuple[float, float, float]:
        answer = server.call('/angen/list', List, kind='model')
        pose = next(e.pose for e in answer.entities if e.name == 'bot')
        return pose.position.x, pose.position.y, pose.position.z

    twist = Twist()
    twist.linear.x = 0.2
    with Inbox('/odom', Odometry) as odometry:
        at_rest = odometry.wait(lambda m: abs(m.twist.twist.linear.x) < 1e-3, 'it is at rest')
        assert abs(at_rest.pose.pose.position.z) < 0.003  # not in the floor, whose layer is 10 mm
        start = place()
        server.send('/cmd_vel', twist)
        far = odometry.wait(lambda m: m.pose.pose.position.x > start[0] + 0.5, 'it drives')
        assert far.twist.twist.linear.x == pytest.approx(0.2, abs=0.02)
        server.send('/cmd_vel', Twist())
        until(lambda: abs(odometry.messages[-1].twist.twist.linear.x) < 1e-4, 'it stops')
        last = odometry.messages[-1]
        stamps = [m.header.stamp.to_sec() for m in odometry.messages]
    assert (last.header.frame_id, last.child_frame_id) == ('odom', 'base_footprint')
    assert math.hypot(place()[0] - last.pose.pose.position.x,
                      place()[1] - last.pose.pose.position.y) < 0.005
    steps = [b - a for a, b in zip(stamps, stamps[1:])]
    assert sum(steps) / len(steps) == pytest.approx(1 / 30, rel=0.05)


def test_its_truth_names_the_link(server: Angen) -> None:
    truth = server.wait('/truth', Odometry)
    assert (truth.header.frame_id, truth.child_frame_id) == ('map', 'base_footprint')


def test_its_scan_goes_all_around_in_its_frame(server: Angen) -> None:
    scan = server.wait('/scan', LaserScan)
    assert scan.header.frame_id == 'base_scan'
    assert (len(scan.ranges), scan.angle_min) == (360, 0.0)
    assert scan.angle_max == pytest.approx(6.28319, abs=1e-5)
    odometry = server.wait('/odom', Odometry)
    assert scan.ranges[0] == pytest.approx(1.9 - odometry.pose.pose.position.x, abs=0.02)
    assert math.isinf(scan.ranges[180])


@pytest.mark.parametrize('topic, kind', [('/imu', Imu), ('/joint_states', JointState)])
def test_imu_and_joints_are_published(server: Angen, topic: str, kind: Any) -> None:
    message = server.wait(topic, kind)
    if kind is Imu:
        assert message.header.frame_id == 'base_footprint'  # libsdformat lumps it, as in Gazebo
        listed = server.call('/angen/list', List, kind='imu').entities[0]
        assert listed.pose.position.z == pytest.approx(0.06, abs=0.004)
        assert message.linear_acceleration.z == pytest.approx(9.8, abs=0.1)
    else:
        assert message.name == ['left_joint', 'right_joint'] and len(message.position) == 2


def test_nothing_is_above_odom_and_no_frame_is_robot_state_publishers(server: Angen) -> None:
    parents: dict[str, set[str]] = {}
    with Inbox('/tf', TFMessage) as moving, Inbox('/tf_static', TFMessage) as fixed:
        moving.wait(lambda m: any(t.child_frame_id == 'base_footprint' for t in m.transforms),
                    'odometry is a transform')
        until(lambda: fixed.messages, 'fixed frames')
        for message in moving.messages + fixed.messages:
            for each in message.transforms:
                parents.setdefault(each.child_frame_id, set()).add(each.header.frame_id)
    assert parents['base_footprint'] == {'odom'}
    assert not {'odom', 'base_link', 'base_scan', 'imu_link', 'left_wheel'} & set(parents)


def test_a_second_one_in_a_namespace_is_apart(server: Angen) -> None:
    xml = ROBOT.replace('<leftJoint>', '<robotNamespace>/tb3_0</robotNamespace><leftJoint>')
    pose = Pose()
    pose.position.y = 2.0
    assert server.call('/angen/spawn', Spawn, name='second', xml=xml, pose=pose).success
    with Inbox('/odom', Odometry) as first:
        server.wait('/tb3_0/odom', Odometry, lambda m: m.pose.pose.position.y > 1.9)
        assert all(m.pose.pose.position.y < 1.0 for m in first.messages)
    server.delete('second')
