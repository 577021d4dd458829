"""Two robots in one world: each hears its own commands, and no name of one is the other's."""
from typing import Iterator

import pytest
from harness import Angen, Cli, Inbox, until
from angen_msgs.msg import Stats
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Image, LaserScan
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage

FIRST = {'base_footprint', 'base_scan', 'camera_rgb_optical_frame', 'camera_depth_optical_frame'}


@pytest.fixture(scope='module')
def second(angen: Angen) -> Iterator[str]:
    """A TurtleBot that was spawned 2 m behind the first one."""
    cli = Cli(angen.master)
    cli.does('spawn', 'model', 'model://turtlebot', 'robot2', '--pose', '3 5 0.01')
    yield 'robot2'
    cli.does('delete', 'robot2')
    left = {topic for topic in angen.master.topics() if topic.startswith('/robot2/')}
    assert left <= {'/robot2/cmd_vel'}  # which this process publishes
    angen.call('/gazebo/reset_world', Empty)  # the first one is where other tests expect it


def pose(message: Odometry) -> tuple[float, float, float, float]:
    at, turn = message.pose.pose.position, message.pose.pose.orientation
    return at.x, at.y, turn.z, turn.w


@pytest.mark.parametrize('command, mine, other', [
    ('/robot2/cmd_vel', '/robot2/odom', '/turtlebot/odom'),
    ('/turtlebot/cmd_vel', '/turtlebot/odom', '/robot2/odom'),
    ('/cmd_vel', '/odom', '/robot2/odom')])
def test_each_answers_its_own_commands_only(angen: Angen, second: str, command: str, mine: str,
                                            other: str) -> None:
    twist = Twist()
    twist.linear.x, twist.angular.z = 0.2, 0.5
    angen.wait('/angen/stats', Stats, lambda stats: stats.awake_bodies == 0)
    with Inbox(mine, Odometry) as robot, Inbox(other, Odometry) as stays:
        at_rest = 'both report that they are at rest'
        start = robot.wait(lambda m: m.twist.twist.linear.x == 0, at_rest)
        rests = pose(stays.wait(lambda m: m.twist.twist.linear.x == 0, at_rest))
        count = len(stays.messages)
        angen.send(command, twist)
        robot.wait(lambda m: m.twist.twist.linear.x > 0.15 and m.twist.twist.angular.z > 0.3,
                   'it drives a curve')
        until(lambda: robot.messages[-1].twist.twist.linear.x == 0, 'it stops after its timeout')
        until(lambda: len(stays.messages) > count + 3, 'the other one says where it is')
        assert {pose(message) for message in stays.messages} == {rests}
    assert robot.messages[-1].pose.pose.position.x != start.pose.pose.position.x


def test_every_frame_has_one_parent_and_hangs_on_the_world(angen: Angen, second: str) -> None:
    parents: dict[str, set[str]] = {}
    expected = FIRST | {f'{second}/{frame}' for frame in FIRST}
    with Inbox('/tf', TFMessage) as moving, Inbox('/tf_static', TFMessage) as fixed:
        def complete() -> bool:
            for message in moving.messages + fixed.messages:
                for each in message.transforms:
                    parents.setdefault(each.child_frame_id, set()).add(each.header.frame_id)
            return expected | {'odom', f'{second}/odom'} <= parents.keys()
        until(complete, 'all frames are published')
    assert [frame for frame, above in parents.items() if len(above) > 1] == []
    for frame in expected:
        names = [frame]
        while names[-1] != 'world':
            names += parents[names[-1]]
        assert names[-3:-1] == ([f'{second}/base_footprint', f'{second}/odom']
                                if frame.startswith(second) else ['base_footprint', 'odom'])


def test_what_they_see_and_tell_is_in_frames_of_their_own(angen: Angen, second: str) -> None:
    for robot, prefix in (('turtlebot', ''), (second, f'{second}/')):
        odometry = angen.wait(f'/{robot}/odom', Odometry)
        assert odometry.header.frame_id == f'{prefix}odom'
        assert odometry.child_frame_id == f'{prefix}base_footprint'
        for topic, kind, frame in (
                ('scan', LaserScan, 'base_scan'),
                ('camera/rgb/image_raw', Image, 'camera_rgb_optical_frame'),
                ('camera/depth/image_raw', Image, 'camera_depth_optical_frame')):
            assert angen.wait(f'/{robot}/{topic}', kind).header.frame_id == prefix + frame
