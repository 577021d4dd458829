"""A node that opens the doors on a robot's planned path before it gets there."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Sequence

import rospy
import tf2_ros
from angen_msgs.msg import Command, DoorState
from nav_msgs.msg import Path

from angen_tools.live.devices import Devices

AHEAD = 2.5  # m of path: a door needs 3 s to open, and its leaf may swing towards the robot
NEAR = 0.8  # m from a hinge to a path through its doorway
LEVEL = 2.0  # m: half a storey
PERIOD = 0.5  # s, simulated
SHUT = (DoorState.CLOSED, DoorState.CLOSING, DoorState.AJAR)


@dataclass
class Doorway:
    """A door: its hinge, and its state."""

    name: str
    place: tuple[float, float, float]  # m
    mode: int = DoorState.OPEN

    @staticmethod
    def of(entity: Any) -> Doorway:
        doorway = Doorway(entity.name, (0.0, 0.0, 0.0))
        doorway.move(entity)
        return doorway

    def move(self, entity: Any) -> None:
        at = entity.pose.position
        self.place = at.x, at.y, at.z

    def take(self, state: Any) -> None:
        self.mode = state.mode


def in_the_way(doorways: Sequence[Doorway], robot: Sequence[float],
               path: Sequence[tuple[float, float]]) -> list[Doorway]:
    """The doors that are not open and on the path within AHEAD of a robot at x, y, z (m)."""
    if not path:
        return []
    start = min(range(len(path)), key=lambda i: math.dist(path[i], robot[:2]))
    ahead, passed = [path[start]], 0.0
    for here, there in zip(path[start:], path[start + 1:]):
        passed += math.dist(here, there)
        if passed > AHEAD:
            break
        ahead.append(there)
    return [door for door in doorways
            if door.mode in SHUT and abs(door.place[2] - robot[2]) < LEVEL
            and min(math.dist(point, door.place[:2]) for point in ahead) < NEAR]


class DoorOpener:
    """Follows the topic plan, and where tf has the robot."""

    def __init__(self) -> None:
        rospy.init_node('door_opener')
        self._base = rospy.get_param('~base_frame', 'base_footprint')
        self._path: list[tuple[float, float]] = []
        self._buffer = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._buffer)
        self._commands = rospy.Publisher('/angen/command', Command, queue_size=10)
        self._doors = Devices(['door'], Doorway.of, Doorway.take, renew=Doorway.move)
        rospy.Subscriber('plan', Path, self._on_plan)

    def _on_plan(self, plan: Any) -> None:
        self._path = [(stamped.pose.position.x, stamped.pose.position.y) for stamped in plan.poses]

    def spin(self) -> None:
        """Opens doors until ROS ends."""
        while not rospy.is_shutdown():
            if self._doors.changed:
                self._doors.survey()
            self._open()
            rospy.sleep(PERIOD)

    def _open(self) -> None:
        try:
            at = self._buffer.lookup_transform('world', self._base, rospy.Time()) \
                .transform.translation
        except tf2_ros.TransformException:
            return  # no localization has published a pose
        doors = list(self._doors.of('door').values())
        for door in in_the_way(doors, (at.x, at.y, at.z), self._path):
            rospy.loginfo('opening door %s', door.name)
            self._commands.publish(Command(target=f'door/{door.name}', text='Open'))


def main() -> None:
    """The node door_opener."""
    DoorOpener().spin()
