"""The events and commands of a Kobuki base, on the topics of Gazebo's plug-in."""
import math
from typing import Any, Iterator

import pytest
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import GetModelState, SetModelState
from geometry_msgs.msg import Point, Pose, Quaternion, Twist
from harness import Angen, Inbox, Master, until
from kobuki_msgs.msg import BumperEvent, CliffEvent, MotorPower, WheelDropEvent
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Empty

EYES = 0.03  # m above the floor: the cliff sensors
WHEEL = """<link name="{0}"><pose>0 {1} 0.035 0 0 0</pose><inertial><mass>0.2</mass><inertia>
  <ixx>0.0002</ixx><iyy>0.0003</iyy><izz>0.0002</izz></inertia></inertial><collision name="c">
  <pose>0 0 0 1.5707963 0 0</pose><geometry><cylinder><radius>0.035</radius><length>0.02</length>
  </cylinder></geometry></collision><sensor name="drop_{0}" type="contact"><contact>
  <collision>c</collision></contact></sensor></link><joint name="wheel_{0}_joint"
  type="continuous"><parent>base_footprint</parent><child>{0}</child><axis><xyz>0 1 0</xyz></axis>
  </joint>"""
CASTER = """<collision name="c{0}"><pose>{0} 0 0.01 0 0 0</pose><geometry><sphere>
  <radius>0.01</radius></sphere></geometry><surface><friction><ode><mu>0</mu><mu2>0</mu2></ode>
  </friction></surface></collision>"""
EYE = f"""<sensor name="eye_{{0}}" type="ray"><pose>0.1 {{1}} {EYES} 0 1.5707963267948966 0</pose>
  <ray><scan><horizontal><samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle>
  </horizontal></scan><range><min>0.01</min><max>0.15</max></range></ray></sensor>"""
WORLD = f"""<sdf version="1.6"><world name="default">
  <include><uri>model://ground_plane</uri></include>
  <model name="wall"><static>true</static><link name="l"><pose>0.6 0 0.5 0 0 0</pose>
    <collision name="c"><geometry><box><size>0.2 4 1</size></box></geometry></collision></link>
  </model>
  <model name="stand"><static>true</static><link name="l"><pose>-3 0 0.5 0 0 0</pose>
    <collision name="c"><geometry><box><size>0.1 0.1 1</size></box></geometry></collision></link>
  </model>
  <model name="bot"><link name="base_footprint"><inertial><pose>0 0 0.05 0 0 0</pose>
    <mass>3</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.03</izz></inertia></inertial>
    <collision name="base"><pose>0 0 0.07 0 0 0</pose><geometry><cylinder><radius>0.176</radius>
    <length>0.1</length></cylinder></geometry></collision>{CASTER.format(0.13)}{CASTER.format(-0.13)}
    {EYE.format('left', 0.1)}{EYE.format('front', 0)}{EYE.format('right', -0.1)}
    <sensor name="bumpers" type="contact"><contact><collision>base</collision></contact></sensor>
    </link>{WHEEL.format('left', 0.2)}{WHEEL.format('right', -0.2)}
  <plugin name="kobuki" filename="libgazebo_ros_kobuki.so">
    <wheel_separation>0.4</wheel_separation><velocity_command_timeout>30</velocity_command_timeout>
    <cliff_sensor_left_name>eye_left</cliff_sensor_left_name>
    <cliff_sensor_center_name>eye_front</cliff_sensor_center_name>
    <cliff_sensor_right_name>eye_right</cliff_sensor_right_name>
    <cliff_detection_threshold>0.04</cliff_detection_threshold>
    <wheel_drop_left_sensor_name>drop_left</wheel_drop_left_sensor_name>
    <wheel_drop_right_sensor_name>drop_right</wheel_drop_right_sensor_name>
    <bumper_name>bumpers</bumper_name></plugin></model>
</world></sdf>"""
COMMANDS = "/mobile_base/commands"
EVENTS = "/mobile_base/events"


@pytest.fixture(scope="module")
def node(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
         ) -> Iterator[Angen]:
    with master.serving(WORLD, tmp_path_factory.mktemp("kobuki"), rate=0) as node:
        yield node


def drive(kobuki: Angen, speed: float) -> None:
    twist = Twist()
    twist.linear.x = speed
    kobuki.send(f"{COMMANDS}/velocity", twist)


def put(kobuki: Angen, x: float, z: float) -> None:
    pose = Pose(Point(x, 0, z), Quaternion(0, 0, 0, 1))
    kobuki.call("/gazebo/set_model_state", SetModelState,
                model_state=ModelState(model_name="bot", pose=pose))


@pytest.fixture
def kobuki(node: Angen) -> Angen:
    """At rest at x = -1."""
    drive(node, 0.0)
    put(node, -1, 0)
    passes(node, 1.0)
    return node


def passes(kobuki: Angen, seconds: float) -> None:
    """Waits for a simulated time."""
    with Inbox("/clock", Clock) as clock:
        now = clock.wait(lambda _: True, "the time").clock.to_sec()
        clock.wait(lambda later: later.clock.to_sec() > now + seconds, f"{seconds} s pass")


def place(kobuki: Angen) -> float:
    state: Any = kobuki.call("/gazebo/get_model_state", GetModelState, model_name="bot")
    return float(state.pose.position.x)


def test_a_robot_that_bumps_into_a_wall_says_so(kobuki: Angen) -> None:
    with Inbox(f"{EVENTS}/bumper", BumperEvent) as events:
        drive(kobuki, 0.2)
        events.wait(lambda event: event.state == BumperEvent.PRESSED, "it bumps")
        drive(kobuki, -0.2)
        until(lambda: events.messages[-1].state == BumperEvent.RELEASED, "it comes free")
    assert {event.bumper for event in events.messages} == {BumperEvent.CENTER}


def test_a_robot_on_a_stand_misses_the_floor_once(kobuki: Angen) -> None:
    with Inbox(f"{EVENTS}/cliff", CliffEvent) as cliffs, \
            Inbox(f"{EVENTS}/wheel_drop", WheelDropEvent) as drops:
        for turn in (0, 1):
            put(kobuki, -3, 0.98)
            until(lambda: len(cliffs.messages) == 6 * turn + 3, "it misses the floor")
            until(lambda: len(drops.messages) == 4 * turn + 2, "its wheels hang")
            put(kobuki, -1, 0)
            until(lambda: len(cliffs.messages) == 6 * turn + 6, "it finds the floor")
            until(lambda: len(drops.messages) == 4 * turn + 4, "its wheels do")
    parts, wheels = (0, 1, 2), (0, 1)
    assert [(e.sensor, e.state) for e in cliffs.messages] == 2 * (
        [(part, CliffEvent.CLIFF) for part in parts] + [(part, CliffEvent.FLOOR) for part in parts])
    assert [(e.wheel, e.state) for e in drops.messages] == 2 * (
        [(wheel, WheelDropEvent.DROPPED) for wheel in wheels]
        + [(wheel, WheelDropEvent.RAISED) for wheel in wheels])
    for event in cliffs.messages:  # the angle, in units of Gazebo's plug-in; 16 bits of it
        if event.state == CliffEvent.CLIFF:
            assert event.bottom == 0
        else:
            angle = (event.bottom + 65536) / 76123.0
            assert 0.995 / math.tan(angle) == pytest.approx(EYES, abs=0.003)


def test_motors_that_are_off_do_not_move_it(kobuki: Angen) -> None:
    kobuki.send(f"{COMMANDS}/motor_power", MotorPower(MotorPower.OFF))
    drive(kobuki, -0.2)
    passes(kobuki, 2.0)
    assert place(kobuki) == pytest.approx(-1, abs=0.02)
    kobuki.send(f"{COMMANDS}/motor_power", MotorPower(MotorPower.ON))
    drive(kobuki, -0.2)
    until(lambda: place(kobuki) < -1.3, "it drives")


def test_odometry_is_zero_where_it_is_reset(kobuki: Angen) -> None:
    with Inbox("/odom", Odometry) as odometry:
        drive(kobuki, -0.2)
        odometry.wait(lambda odom: odom.pose.pose.position.x < -0.3, "it drives")
        drive(kobuki, 0.0)
        kobuki.send(f"{COMMANDS}/reset_odometry", Empty())
        until(lambda: abs(odometry.messages[-1].pose.pose.position.x) < 0.01, "it is zero")
