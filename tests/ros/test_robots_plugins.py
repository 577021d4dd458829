"""Plug-ins of robots made for Gazebo, on the topics and in the frames of Gazebo's plug-ins."""
import math
import struct
from typing import Any, Iterator

import pytest
from harness import Angen, Inbox, Master, until
from gazebo_msgs.msg import ContactsState
from gazebo_msgs.srv import GetJointProperties
from geometry_msgs.msg import Vector3Stamped, Wrench, WrenchStamped
from sensor_msgs.msg import (CameraInfo, Image, Imu, JointState, NavSatFix, PointCloud, PointCloud2,
                             Range)
from std_msgs.msg import Float64
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

WORLD = """<sdf version="1.6"><world name="default">
  <include><uri>model://sun</uri></include><include><uri>model://ground_plane</uri></include>
  <model name="wall"><static>true</static><link name="link"><pose>2.1 0 1 0 0 0</pose>
    <collision name="c"><geometry><box><size>0.2 8 2</size></box></geometry></collision>
    <visual name="c"><geometry><box><size>0.2 8 2</size></box></geometry></visual></link></model>
</world></sdf>"""
LENS = """<horizontal_fov>1.047</horizontal_fov><image><width>64</width><height>48</height>
  <format>R8G8B8</format></image><clip><near>0.05</near><far>8</far></clip>"""
# On the front of the body: inside of it rays would hit the body.
RAYS = """<pose>0.2 0 0 0 0 0</pose><ray><scan>
  <horizontal><samples>21</samples><min_angle>-0.2</min_angle>
  <max_angle>0.2</max_angle></horizontal><vertical><samples>3</samples><min_angle>-0.1</min_angle>
  <max_angle>0.1</max_angle></vertical></scan><range><min>0.05</min><max>5</max></range></ray>"""


def sensor(kind: str, name: str, body: str, library: str, parameters: str) -> str:
    return f"""<gazebo reference="body"><sensor type="{kind}" name="{name}">
      <update_rate>20</update_rate>{body}<plugin name="{name}" filename="lib{library}.so">
      <robotNamespace>/bot</robotNamespace>{parameters}</plugin></sensor></gazebo>"""


def plugin(name: str, library: str, parameters: str) -> str:
    return f"""<gazebo><plugin name="{name}" filename="lib{library}.so">
      <robotNamespace>/bot</robotNamespace>{parameters}</plugin></gazebo>"""


def link(name: str, size: float, mass: float) -> str:
    return f"""<link name="{name}"><inertial><mass value="{mass}"/><inertia ixx="0.01" iyy="0.01"
      izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry>
      <box size="{size} {size} {size}"/></geometry></collision></link>"""


def arm(side: str, y: float, more: str = '') -> str:
    return link(side, 0.02, 0.2) + f"""<joint name="{side}_joint" type="revolute">
      <parent link="body"/><child link="{side}"/><origin xyz="0 {y} 0.2"/><axis xyz="0 1 0"/>
      <limit lower="-1.5" upper="1.5" effort="20" velocity="4"/>{more}</joint>"""


ROBOT = f"""<robot name="bot">{link('body', 0.3, 20.0)}{arm('left', 0.3)}
  {arm('right', -0.3, '<mimic joint="left_joint" multiplier="-1"/>')}
  {arm('third', 0.5)}
  {sensor('camera', 'eye', f'<camera>{LENS}</camera>', 'gazebo_ros_camera',
          '''<updateRate>0.0</updateRate><cameraName>eye</cameraName>
          <imageTopicName>image_raw</imageTopicName><frameName>eye_optical</frameName>
          <hackBaseline>0.07</hackBaseline><distortionK1>0.01</distortionK1>''')}
  {sensor('multicamera', 'eyes', f'<camera name="left">{LENS}</camera><camera name="right">{LENS}'
          '</camera>', 'gazebo_ros_multicamera', '<cameraName>eyes</cameraName>'
          '<frameName>eyes_frame</frameName><hackBaseline>0.1</hackBaseline>')}
  {sensor('depth', 'kinect', f'<camera>{LENS}</camera>', 'gazebo_ros_openni_kinect',
          '''<cameraName>kinect</cameraName><imageTopicName>rgb/image_raw</imageTopicName>
          <cameraInfoTopicName>rgb/camera_info</cameraInfoTopicName>
          <pointCloudTopicName>depth/points</pointCloudTopicName>
          <frameName>kinect_optical</frameName><pointCloudCutoff>0.5</pointCloudCutoff>''')}
  {sensor('contact', 'bumper', '<contact><collision>body_collision</collision></contact>',
          'gazebo_ros_bumper', '<bumperTopicName>bumper</bumperTopicName>'
          '<frameName>body</frameName>')}
  {sensor('ray', 'block', RAYS, 'gazebo_ros_block_laser',
          '<topicName>block</topicName><frameName>block_frame</frameName>')}
  {sensor('gpu_ray', 'puck', RAYS, 'gazebo_ros_velodyne_gpu_laser',
          '<topicName>velodyne_points</topicName><frameName>velodyne</frameName>')}
  {sensor('ray', 'range', RAYS, 'gazebo_ros_range', '<topicName>range</topicName><fov>0.4</fov>'
          '<frameName>range_frame</frameName><radiation>infrared</radiation>')}
  {sensor('ray', 'sonar', RAYS, 'hector_gazebo_ros_sonar',
          '<topicName>sonar/front</topicName><frameId>sonar_link</frameId>')}
  {plugin('gps', 'hector_gazebo_ros_gps', '<bodyName>body</bodyName><frameId>gps_link</frameId>')}
  {plugin('imu', 'hector_gazebo_ros_imu', '<bodyName>body</bodyName><topicName>raw_imu</topicName>'
          '<updateRate>100</updateRate><rateGaussianNoise>0.1 0.2 0.3</rateGaussianNoise>'
          '<accelGaussianNoise>0.5</accelGaussianNoise><yawGaussianNoise>0.02</yawGaussianNoise>')}
  {plugin('push', 'gazebo_ros_force', '<bodyName>third</bodyName><topicName>push</topicName>')}
  {plugin('ft', 'gazebo_ros_ft_sensor', '<jointName>third_joint</jointName>'
          '<topicName>ft</topicName><updateRate>50</updateRate>')}
  {plugin('f3d', 'gazebo_ros_f3d', '<bodyName>body</bodyName><topicName>f3d</topicName>'
          '<updateRate>50</updateRate>')}
  {plugin('path', 'gazebo_ros_joint_pose_trajectory', '<topicName>path</topicName>')}
  {plugin('control', 'gazebo_ros_control', '')}
  <transmission name="t"><type>transmission_interface/SimpleTransmission</type>
    <joint name="left_joint"><hardwareInterface>hardware_interface/PositionJointInterface
    </hardwareInterface></joint><actuator name="m"/></transmission>
</robot>"""


@pytest.fixture(scope='module')
def bot(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
        ) -> Iterator[Angen]:
    """The node with the world, and the robot in it."""
    with master.serving(WORLD, tmp_path_factory.mktemp('robots')) as angen:
        angen.spawn('bot', ROBOT, z=0.15)
        yield angen


def test_spawning_warns_of_ros_control_alone(bot: Angen) -> None:
    said = bot.log()
    assert 'clone ros-controls/ros_control' in said
    assert '(ignored)' not in said, said


@pytest.mark.parametrize('topic, kind, frame', [
    ('/bot/eye/image_raw', Image, 'eye_optical'),
    ('/bot/eye/camera_info', CameraInfo, 'eye_optical'),
    ('/bot/eyes/left/image_raw', Image, 'eyes_frame'),
    ('/bot/eyes/right/camera_info', CameraInfo, 'eyes_frame'),
    ('/bot/kinect/rgb/image_raw', Image, 'kinect_optical'),
    ('/bot/kinect/rgb/camera_info', CameraInfo, 'kinect_optical'),
    ('/bot/kinect/depth/image_raw', Image, 'kinect_optical'),
    ('/bot/kinect/depth/camera_info', CameraInfo, 'kinect_optical'),
    ('/bot/kinect/depth/points', PointCloud2, 'kinect_optical'),
    ('/bot/bumper', ContactsState, 'body'),
    ('/bot/block', PointCloud, 'block_frame'),
    ('/bot/velodyne_points', PointCloud2, 'velodyne'),
    ('/bot/range', Range, 'range_frame'),
    ('/bot/sonar/front', Range, 'sonar_link'),
    ('/bot/fix', NavSatFix, 'gps_link'),
    ('/bot/fix_velocity', Vector3Stamped, 'gps_link'),
    ('/bot/raw_imu', Imu, 'body'),
    ('/bot/ft', WrenchStamped, 'third'),
    ('/bot/f3d', WrenchStamped, 'world'),
    ('/bot/joint_states', JointState, ''),
])
def test_topics_and_frames_are_gazebos(bot: Angen, topic: str, kind: Any, frame: str) -> None:
    assert bot.wait(topic, kind).header.frame_id == frame


def test_cameras_see_the_wall_and_say_how(bot: Angen) -> None:
    image = bot.wait('/bot/eye/image_raw', Image)
    assert (image.width, image.height, image.encoding) == (64, 48, 'rgb8')
    column = [image.data[image.step * row + 3 * 32] for row in range(48)]
    foot = next(row for row in range(24, 48) if column[row] != column[20])
    # The wall's foot is 2 m ahead of the camera and 0.15 m below it.
    assert foot == math.ceil(23.5 + 0.15 / 2.0 * 32 / math.tan(1.047 / 2))
    info = bot.wait('/bot/eye/camera_info', CameraInfo)
    assert info.D[0] == pytest.approx(0.01)
    assert info.P[3] == pytest.approx(-0.07 * info.K[0])
    assert bot.wait('/bot/eyes/left/camera_info', CameraInfo).P[3] == 0.0
    right = bot.wait('/bot/eyes/right/camera_info', CameraInfo)
    assert right.P[3] == pytest.approx(-0.1 * right.K[0])
    depth = bot.wait('/bot/kinect/depth/image_raw', Image)
    assert depth.encoding == '32FC1'
    middle = struct.unpack_from('<f', depth.data, 4 * (20 * 64 + 32))[0]
    assert middle == pytest.approx(2.0, abs=0.01)
    with Inbox('/bot/eye/image_raw', Image) as images:
        until(lambda: len(images.messages) > 10, 'pictures')
        stamps = [each.header.stamp.to_sec() for each in images.messages]
    steps = [b - a for a, b in zip(stamps, stamps[1:])]
    assert min(steps) == pytest.approx(0.05, abs=1e-6)  # the sensor's rate where the plug-in's is 0


def test_rays_measure_the_wall(bot: Angen) -> None:
    floor = 0.15 / math.sin(0.1)  # the lowest rays hit it before the wall
    assert bot.wait('/bot/range', Range).range == pytest.approx(floor, abs=0.01)
    said = bot.wait('/bot/range', Range)
    assert said.radiation_type == Range.INFRARED and said.field_of_view == pytest.approx(0.4)
    sonar = bot.wait('/bot/sonar/front', Range)
    assert sonar.range == pytest.approx(floor, abs=0.01)
    assert sonar.field_of_view == pytest.approx(0.2)
    block = bot.wait('/bot/block', PointCloud)
    assert len(block.points) == len(block.channels[0].values) > 40
    on_wall = [p for p in block.points if p.z > -0.1]
    assert on_wall and all(abs(p.x - 1.8) < 0.01 for p in on_wall)
    puck = bot.wait('/bot/velodyne_points', PointCloud2)
    assert [f.name for f in puck.fields] == ['x', 'y', 'z', 'intensity', 'ring', 'time']
    rings = {struct.unpack_from('<H', puck.data, i * puck.point_step + 16)[0]
             for i in range(puck.width)}
    assert rings == {0, 1, 2}


def test_the_gps_stands_at_its_reference(bot: Angen) -> None:
    fix = bot.wait('/bot/fix', NavSatFix)
    assert fix.latitude == pytest.approx(49.9, abs=1e-5)
    assert fix.longitude == pytest.approx(8.9, abs=1e-5)


def test_the_imu_says_how_large_its_errors_are(bot: Angen) -> None:
    said = bot.wait('/bot/raw_imu', Imu)
    assert said.angular_velocity_covariance == pytest.approx(
        (0.01, 0, 0, 0, 0.04, 0, 0, 0, 0.09))
    assert said.linear_acceleration_covariance == pytest.approx(
        (0.25, 0, 0, 0, 0.25, 0, 0, 0, 0.25))
    assert said.orientation_covariance == pytest.approx((0, 0, 0, 0, 0, 0, 0, 0, 4e-4))
    with Inbox('/bot/raw_imu', Imu) as box:
        until(lambda: len(box.messages) > 300, 'readings')
        rates = [each.angular_velocity.z for each in box.messages]
    mean = sum(rates) / len(rates)
    variance = sum((rate - mean) ** 2 for rate in rates) / (len(rates) - 1)
    assert variance == pytest.approx(said.angular_velocity_covariance[8], rel=0.3)


def test_forces_are_felt(bot: Angen) -> None:
    bumper = bot.wait('/bot/bumper', ContactsState, lambda m: m.states)
    assert 'ground_plane' in bumper.states[0].collision2_name
    weight = (20.0 + 3 * 0.2) * 9.8
    assert sum(s.total_wrench.force.z for s in bumper.states) == pytest.approx(weight, rel=0.03)
    assert bot.wait('/bot/f3d', WrenchStamped).wrench.force.z == pytest.approx(weight, rel=0.03)
    hung = bot.wait('/bot/ft', WrenchStamped).wrench.force
    assert math.hypot(hung.x, hung.z) == pytest.approx(0.2 * 9.8, rel=0.05)


def test_a_wrench_pushes_the_third_arm(bot: Angen) -> None:
    def load() -> float:
        force = bot.wait('/bot/ft', WrenchStamped).wrench.force
        return math.hypot(force.x, force.z)

    push = Wrench()
    push.force.z = -2.0
    bot.send('/bot/push', push)
    until(lambda: load() == pytest.approx(0.2 * 9.8 + 2.0, rel=0.05), 'the arm is pushed')
    bot.send('/bot/push', Wrench())
    until(lambda: load() == pytest.approx(0.2 * 9.8, rel=0.05), 'and released')


def test_joints_take_positions_and_trajectories(bot: Angen) -> None:
    with Inbox('/bot/joint_states', JointState) as states:
        bot.send('/bot/left_joint_position_controller/command', Float64(0.6))
        states.wait(lambda m: abs(m.position[m.name.index('left_joint')] - 0.6) < 0.01,
                    'the joint is there')
    path = JointTrajectory(joint_names=['third_joint'])
    for time, angle in ((0.5, -0.4), (1.0, 0.3)):
        point = JointTrajectoryPoint(positions=[angle])
        point.time_from_start.nsecs = int(1e9 * time) % 10**9
        point.time_from_start.secs = int(time)
        path.points.append(point)
    bot.send('/bot/path', path)

    def angle_of(joint: str) -> float:
        answer = bot.call('/gazebo/get_joint_properties', GetJointProperties,
                          joint_name=f'bot::{joint}')
        return float(answer.position[0])

    until(lambda: abs(angle_of('third_joint') - 0.3) < 0.01, 'the trajectory ends')
    assert angle_of('right_joint') == pytest.approx(-0.6, abs=0.02)  # it mimics the left one
