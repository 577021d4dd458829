"""The events of a Kobuki base, on the topics of Gazebo's plug-in."""
from __future__ import annotations

from pathlib import Path

from geometry_msgs.msg import Twist
from harness import Inbox, Master, end, publisher_of, until
from kobuki_msgs.msg import BumperEvent

WHEEL = """<link name="{0}"><pose>0 {1} 0.035 0 0 0</pose><inertial><mass>0.2</mass><inertia>
  <ixx>0.0002</ixx><iyy>0.0003</iyy><izz>0.0002</izz></inertia></inertial><collision name="c">
  <pose>0 0 0 1.5707963 0 0</pose><geometry><cylinder><radius>0.035</radius><length>0.02</length>
  </cylinder></geometry></collision></link><joint name="wheel_{0}_joint" type="continuous">
  <parent>base_footprint</parent><child>{0}</child><axis><xyz>0 1 0</xyz></axis></joint>"""
CASTER = """<collision name="c{0}"><pose>{0} 0 0.01 0 0 0</pose><geometry><sphere>
  <radius>0.01</radius></sphere></geometry><surface><friction><ode><mu>0</mu><mu2>0</mu2></ode>
  </friction></surface></collision>"""
WORLD = f"""<sdf version="1.6"><world name="default">
  <include><uri>model://ground_plane</uri></include>
  <model name="wall"><static>true</static><link name="l"><pose>0.6 0 0.5 0 0 0</pose>
    <collision name="c"><geometry><box><size>0.2 4 1</size></box></geometry></collision></link>
  </model>
  <model name="bot"><link name="base_footprint"><inertial><pose>0 0 0.05 0 0 0</pose>
    <mass>3</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.03</izz></inertia></inertial>
    <collision name="base"><pose>0 0 0.07 0 0 0</pose><geometry><cylinder><radius>0.176</radius>
    <length>0.1</length></cylinder></geometry></collision>{CASTER.format(0.13)}{CASTER.format(-0.13)}
    </link>{WHEEL.format('left', 0.2)}{WHEEL.format('right', -0.2)}
  <plugin name="kobuki" filename="libgazebo_ros_kobuki.so">
    <wheel_separation>0.4</wheel_separation><velocity_command_timeout>30</velocity_command_timeout>
    <bumper_name>bumpers</bumper_name></plugin></model>
</world></sdf>"""


def test_a_robot_that_bumps_into_a_wall_says_so(master: Master, rospy_node: None,
                                                tmp_path: Path) -> None:
    world = tmp_path / "kobuki.world"
    world.write_text(WORLD)
    process = master.node(world, tmp_path / "log", rate=0)
    try:
        events = Inbox("/mobile_base/events/bumper", BumperEvent)
        drive = publisher_of("/mobile_base/commands/velocity", Twist)
        until(drive.get_num_connections, "the node hears the commands")
        ahead, back = Twist(), Twist()
        ahead.linear.x, back.linear.x = 0.2, -0.2
        drive.publish(ahead)
        events.wait(lambda event: event.state == BumperEvent.PRESSED, "it bumps")
        drive.publish(back)
        until(lambda: events.messages[-1].state == BumperEvent.RELEASED, "it comes free")
        assert {event.bumper for event in events.messages} == {BumperEvent.CENTER}
    finally:
        end(process)
