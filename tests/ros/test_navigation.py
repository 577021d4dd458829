"""The interface of amcl and move_base: frames, maps, open doors; and the nodes that their launch
file gives them. The run itself is in docs/navigation.md: CI has no navigation stack."""
import subprocess
import sys
from pathlib import Path
from typing import Iterator

import pytest
import roslaunch
import rospy
import tf2_ros
from angen_msgs.msg import DoorState
from geometry_msgs.msg import PoseStamped, TransformStamped
from harness import WORLD, Angen, Inbox, Master, end, until, world_file
from nav_msgs.msg import OccupancyGrid, Path as Plan
from tf2_msgs.msg import TFMessage

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / 'src/angen_apps/scripts'
HOUSE = WORLD.replace('<pose>5 5 0.01', '<pose>1.6 -0.45 0.01').replace(
    '</world>', ''.join(f'''<model name="{name}"><static>true</static><pose>{pose}</pose>
    <link name="link"><collision name="c"><geometry><box><size>{size}</size></box></geometry>
    </collision></link></model>''' for name, pose, size in (
        ('slab', '0 0 -0.1 0 0 0', '12 12 0.2'), ('wall', '-3 0 0.5 0 0 0', '0.1 8 1'),
        ('upper_slab', '0 0 3.9 0 0 0', '12 12 0.2'), ('upper_wall', '3 0 4.5 0 0 0', '0.1 8 1')))
    + '</world>')


def script(master: Master, name: str, *words: str) -> subprocess.Popen[str]:
    return subprocess.Popen([sys.executable, str(SCRIPTS / name), *words], text=True,
                            env=master.environment)


@pytest.fixture(scope='module')
def site(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
         ) -> Iterator[Angen]:
    """./angen run odom_parent:=none, and an amcl that knows the robot's place."""
    world = world_file(HOUSE, tmp_path_factory.mktemp('site'))
    maps = script(master, 'map_publisher', str(world), '_frame_id:=map')
    broadcaster = tf2_ros.StaticTransformBroadcaster()
    placed = TransformStamped(child_frame_id='odom')
    placed.header.frame_id = 'map'
    placed.transform.translation.x, placed.transform.translation.y = 1.6, -0.45
    placed.transform.rotation.w = 1.0
    broadcaster.sendTransform(placed)
    try:
        with master.serving(world, world.parent, odom_parent='none') as node:
            yield node
    finally:
        broadcaster.pub_tf.unregister()  # latched: other tests must not see it
        assert end(maps) == 0
        master.api.deleteParam('/test', '/map_publisher')


def test_the_frames_are_whole_and_none_has_two_parents(site: Angen) -> None:
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer)
    with Inbox('/tf', TFMessage) as moving, Inbox('/tf_static', TFMessage) as fixed:
        until(lambda: buffer.can_transform('map', 'base_scan', rospy.Time()), 'the frames')
        until(lambda: len(moving.messages) > 5, 'transforms')
        fixed.wait(lambda m: any(each.child_frame_id == 'map' for each in m.transforms), 'map')
        parents: dict[str, set[str]] = {}
        for message in moving.messages + fixed.messages:
            for each in message.transforms:
                parents.setdefault(each.child_frame_id, set()).add(each.header.frame_id)
    listener.unregister()
    assert {frame: parents[frame] for frame in ('map', 'odom', 'base_footprint')} == {
        'map': {'world'}, 'odom': {'map'}, 'base_footprint': {'odom'}}
    assert all(len(above) == 1 for above in parents.values()), parents
    there = buffer.lookup_transform('world', 'base_footprint', rospy.Time()).transform.translation
    assert (there.x, there.y) == pytest.approx((1.6, -0.45), abs=0.01)
    assert site.wait('/map', OccupancyGrid).header.frame_id == 'map'


def test_a_door_on_the_path_opens_and_no_other_one(site: Angen) -> None:
    opener = script(site.master, 'door_opener', 'plan:=/test_plan')
    try:
        aside, through = (Plan(poses=[PoseStamped() for _ in range(40)]) for _ in range(2))
        for i, (one, other) in enumerate(zip(aside.poses, through.poses)):
            one.pose.position.x = 1.6 + 0.1 * i
            other.pose.position.x = 1.6 - 0.1 * i
            one.pose.position.y = other.pose.position.y = -0.45
        with Inbox('/angen/door/bathroom0', DoorState) as states:
            site.send('/test_plan', aside)
            began = rospy.get_time()
            until(lambda: rospy.get_time() > began + 3.0, 'time advances')
            assert {m.mode for m in states.messages} == {DoorState.CLOSED}
            site.send('/test_plan', through)
            states.wait(lambda m: m.mode == DoorState.OPEN, 'the door opens')
        site.spawn('kitchen_door0', 'model://kitchen_door', 0.0, 6.0, 0.02)
        for each in through.poses:
            each.pose.position.x, each.pose.position.y = each.pose.position.x - 0.6, 5.55
        site.send('/test_plan', through)
        site.wait('/angen/door/kitchen0', DoorState, lambda m: m.mode == DoorState.OPEN)
    finally:
        assert end(opener) == 0


def test_the_launch_file_has_what_the_stack_reads() -> None:
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader().load(str(ROOT / 'launch/navigation.launch'), config,
                                         argv=['gui:=false', 'x:=2.5'])
    assert {(node.package, node.name) for node in config.nodes} == {
        ('amcl', 'amcl'), ('move_base', 'move_base'), ('angen_apps', 'door_opener')}
    values = {name: param.value for name, param in config.params.items()}
    assert values['/amcl/initial_pose_x'] == 2.5 and values['/amcl/use_map_topic'] is True
    for costmap, frame in (('global_costmap', 'map'), ('local_costmap', 'odom')):
        assert values[f'/move_base/{costmap}/global_frame'] == frame
        assert values[f'/move_base/{costmap}/robot_base_frame'] == 'base_footprint'
        assert values[f'/move_base/{costmap}/robot_radius'] > 0.177  # of its widest collision
    assert values['/move_base/DWAPlannerROS/max_vel_trans'] < 0.7  # the limit of its wheels
