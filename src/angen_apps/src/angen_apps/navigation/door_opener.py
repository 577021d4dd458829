"""A node that opens the doors on a robot's planned path before it gets there."""
import math
from typing import Any, Mapping, Sequence

import rospy
import tf2_ros
from nav_msgs.msg import Path

from angen_apps.robot.door_client import DoorClient
from angen_tools.common.failure import Failure
from angen_tools.session.live import Live

AHEAD = 2.5  # m of path: a door needs 3 s to open, and its leaf may swing towards the robot
NEAR = 0.8  # m from a hinge to a path through its doorway
LEVEL = 2.0  # m: half the height of a floor
PERIOD = 0.5  # s, simulated


def in_the_way(doors: Mapping[str, Sequence[float]], robot: Sequence[float],
               path: Sequence[tuple[float, float]]) -> list[str]:
    """The doors, by their places, that are on the path within AHEAD of a robot at x, y, z (m)."""
    if not path:
        return []
    start = min(range(len(path)), key=lambda i: math.dist(path[i], robot[:2]))
    ahead, passed = [path[start]], 0.0
    for here, there in zip(path[start:], path[start + 1:]):
        passed += math.dist(here, there)
        if passed > AHEAD:
            break
        ahead.append(there)
    return [name for name, place in doors.items() if abs(place[2] - robot[2]) < LEVEL
            and min(math.dist(point, place[:2]) for point in ahead) < NEAR]


class DoorOpener:
    """Follows the topic plan, and where tf has the robot."""

    def __init__(self) -> None:
        rospy.init_node('door_opener')
        self._base = rospy.get_param('~base_frame', 'base_footprint')
        self._path: list[tuple[float, float]] = []
        self._buffer = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._buffer)
        self._client = DoorClient(Live(patience=math.inf))
        rospy.Subscriber('plan', Path, self._on_plan)

    def _on_plan(self, plan: Any) -> None:
        self._path = [(stamped.pose.position.x, stamped.pose.position.y) for stamped in plan.poses]

    def spin(self) -> None:
        """Opens doors until ROS ends."""
        while not rospy.is_shutdown():
            self._client.follow()
            self._open()
            rospy.sleep(PERIOD)

    def _open(self) -> None:
        try:
            at = self._buffer.lookup_transform('world', self._base, rospy.Time()) \
                .transform.translation
        except tf2_ros.TransformException:
            return  # no localization has published a pose
        shut = {name: entity.pose for (kind, name), entity in self._client.entities.items()
                if kind == 'door' and (state := self._client.door(name)) is not None
                and not state.does('Open')}
        for name in in_the_way(shut, (at.x, at.y, at.z), self._path):
            rospy.loginfo('opening door %s', name)
            try:
                self._client.world.command('door', name, 'Open')
            except Failure as failure:
                rospy.logwarn('%s', failure)


def main() -> None:
    """The node door_opener."""
    DoorOpener().spin()
