"""The TurtleBot's lidar, cameras, bumper and joints, and a room camera, as subscribers see them."""
import math
import struct

import pytest
from angen_msgs.srv import List
from harness import Angen, Inbox, until
from gazebo_msgs.msg import ContactsState
from geometry_msgs.msg import Twist, Vector3
from sensor_msgs.msg import CameraInfo, Image, JointState, LaserScan, PointCloud2

SHAPE = "<geometry><box><size>0.1 4 2</size></box></geometry>"
WALL = f"""<model name="wall"><static>true</static><link name="link">
  <collision name="c">{SHAPE}</collision>
  <visual name="v">{SHAPE}<material><diffuse>0.9 0.2 0.1 1</diffuse></material></visual>
  </link></model>"""
LENS_X = 0.13     # of the camera in the robot, m


@pytest.fixture(scope="module")
def wall(angen: Angen):
    """A wall 1.95 m before the robot's origin."""
    angen.spawn("wall", WALL, 7, 5, 1)
    yield
    angen.delete("wall")


def test_the_scan_is_published_with_and_without_the_robots_name(angen: Angen, wall: None) -> None:
    for topic in ("/scan", "/turtlebot/scan"):
        scan = angen.wait(topic, LaserScan, lambda m: min(m.ranges) < 5)
        assert scan.header.frame_id == "base_scan" and len(scan.ranges) == 720
        ahead = scan.ranges[round(-scan.angle_min / scan.angle_increment)]
        assert ahead == pytest.approx(1.95, abs=0.06)
        assert math.isinf(scan.ranges[0]) and scan.ranges[0] > 0
        assert scan.angle_increment * 720 == pytest.approx(2 * math.pi, rel=1e-5)


def test_colour_comes_with_its_lens(angen: Angen, wall: None) -> None:
    image = angen.wait("/camera/rgb/image_raw", Image)
    assert (image.height, image.width, image.encoding) == (240, 320, "rgb8")
    assert image.header.frame_id == "camera_rgb_optical_frame"
    red, green, blue = image.data[3 * (120 * 320 + 160):][:3]
    assert red > green > blue
    info = angen.wait("/camera/rgb/camera_info", CameraInfo)
    assert info.header.frame_id == image.header.frame_id
    assert info.K[0] == pytest.approx(160 / math.tan(1.047198 / 2))
    assert info.K[2] == 159.5 and info.K[5] == 119.5


def test_depth_and_points_agree(angen: Angen, wall: None) -> None:
    image = angen.wait("/camera/depth/image_raw", Image)
    assert (image.encoding, image.step) == ("32FC1", 1280)
    pixel = 100 * 320 + 60
    depth, = struct.unpack_from("<f", image.data, 4 * pixel)
    assert depth == pytest.approx(1.95 - LENS_X, abs=0.01)
    cloud = angen.wait("/camera/depth/points", PointCloud2)
    assert (cloud.height, cloud.width, cloud.point_step) == (240, 320, 12)
    assert cloud.header.frame_id == "camera_depth_optical_frame"
    x, y, z = struct.unpack_from("<fff", cloud.data, 12 * pixel)
    focal = 160 / math.tan(1.047198 / 2)
    assert z == pytest.approx(depth, abs=0.005)
    assert x == pytest.approx((60 - 159.5) / focal * z, abs=1e-4)
    assert y == pytest.approx((100 - 119.5) / focal * z, abs=1e-4)


def test_the_bumper_and_the_joints_are_published(angen: Angen) -> None:
    contacts = angen.wait("/bumper", ContactsState)
    assert contacts.states == []
    joints = angen.wait("/joint_states", JointState)
    assert joints.name == ["left_wheel_joint", "right_wheel_joint"]
    assert len(joints.position) == len(joints.velocity) == len(joints.effort) == 2


def test_wheels_turn_as_fast_as_the_robot_drives(angen: Angen) -> None:
    with Inbox("/joint_states", JointState) as states:
        angen.send("/cmd_vel", Twist(linear=Vector3(x=0.2)))
        states.wait(lambda s: min(s.effort) > 0.0, "wheels that drive", 20)
        turning = states.wait(lambda s: min(s.velocity) > 3.0, "wheels that turn", 20)
        angen.send("/cmd_vel", Twist())
        states.wait(lambda s: max(s.effort) < 0.0, "wheels that brake", 20)
    angen.wait("/joint_states", JointState, lambda s: max(map(abs, s.velocity)) == 0.0)
    assert turning.velocity[0] == pytest.approx(turning.velocity[1], rel=0.05)


def test_a_room_camera_is_a_model_of_its_own(angen: Angen, wall: None) -> None:
    angen.spawn("c1", "model://camera", 6, 5, 1)
    entity, = angen.call("/angen/list", List, kind="camera").entities[:1]
    assert (entity.name, entity.topic) == ("c1", "/angen/camera/c1/image_raw")
    image = angen.wait("/angen/camera/c1/image_raw", Image)
    assert image.header.frame_id == "c1_optical_frame" and len(image.data) == 320 * 240 * 3
    angen.delete("c1")
    until(lambda: "/angen/camera/c1/image_raw" not in angen.master.topics(), "its topic ends")
