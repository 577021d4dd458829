"""A robot of the running simulator, commanded in its time."""
from __future__ import annotations

import math
import threading
import time
from collections import deque
from typing import Any

from angen_apps.robot.building import Start
from angen_apps.robot.interface import CYCLE, DoorState, Event, LiftState
from angen_apps.robot.pilot import Pose
from angen_apps.robot.states import door_state, lift_state
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import yaw_of
from angen_tools.common.wait import wait
from angen_tools.live.client import Client
from angen_tools.live.states import states_by_name

LIMIT = 10.0  # s of wall time for any message
TRAIL = 200  # messages of odometry that are kept
BUFFER = 1 << 20  # bytes: more than any of its messages


class LiveRobot:
    """See robot.interface.Robot. A context: its end stops the wheels."""

    def __init__(self, client: Client, start: Start, devices: list[tuple[str, str]]) -> None:
        """`devices`: kind and name of the doors and elevators that it commands."""
        import rospy
        from geometry_msgs.msg import Twist
        from nav_msgs.msg import Odometry
        from sensor_msgs.msg import LaserScan
        self._client, self._name = client, start.robot.name
        self._news = threading.Condition()
        self._latest: dict[str, Any] = {}
        self._trail: deque[tuple[float, Pose]] = deque(maxlen=TRAIL)  # times and odometry
        self._odometry, self._scan = start.robot.topic, start.laser.topic
        client.join()
        self._wheels = client.publisher(f'/{self._name}/cmd_vel', Twist)
        self._states: dict[tuple[str, str], Any] = {}
        self.events: list[Event] = []
        for topic, kind in ((self._odometry, Odometry), (self._scan, LaserScan)):
            # On a slow machine it skips messages and does not fall behind.
            rospy.Subscriber(topic, kind, lambda message, topic=topic: self._take(topic, message),
                             queue_size=1, buff_size=BUFFER, tcp_nodelay=True)
            wait(lambda: topic in self._latest, f'no message on {topic}', LIMIT)
        self._follow(devices)

    def _follow(self, devices: list[tuple[str, str]]) -> None:
        """Keeps the states of doors and elevators."""
        import roslib.message
        import rospy
        topics = {(entity.kind, entity.topic, entity.type) for entity in self._client.entities()
                  if (entity.kind, entity.name) in devices}
        for kind, topic, type_name in topics:
            def take(message: Any, kind: str = kind) -> None:
                for name, state in states_by_name(message).items():
                    self._states[kind, name] = state
            rospy.Subscriber(topic, roslib.message.get_message_class(type_name), take)
        for key in devices:
            wait(lambda: key in self._states, f'no state of {key[0]} {key[1]}', LIMIT)

    def __enter__(self) -> LiveRobot:
        return self

    def __exit__(self, *_: object) -> None:
        from geometry_msgs.msg import Twist
        self._wheels.publish(Twist())
        time.sleep(0.1)  # until it is sent

    def _take(self, topic: str, message: Any) -> None:
        with self._news:
            if topic == self._odometry:
                self._trail.append((message.header.stamp.to_sec(), pose_of(message)))
            self._latest[topic] = message
            self._news.notify_all()

    @property
    def now(self) -> float:
        return float(self._latest[self._odometry].header.stamp.to_sec())

    def cycle(self, v: float, w: float) -> None:
        from geometry_msgs.msg import Twist
        twist = Twist()
        twist.linear.x, twist.angular.z = v, w
        until = self.now + CYCLE
        self._wheels.publish(twist)
        with self._news:
            if not self._news.wait_for(lambda: self.now >= until - 1e-6, LIMIT):
                raise Failure('the simulation is paused; rosservice call /gazebo/unpause_physics '
                              'continues it')

    def command(self, kind: str, name: str, text: str) -> None:
        from angen_msgs.srv import SendCommand
        self._client.call('/angen/command', SendCommand, target=f'{kind}/{name}', text=text)

    def door(self, name: str) -> DoorState:
        return door_state(self._states['door', name])

    def lift(self, name: str) -> LiftState:
        return lift_state(self._states['elevator', name])

    def odometry(self) -> Pose:
        return pose_of(self._latest[self._odometry])

    def scan(self) -> Any:
        return self._latest[self._scan]

    def scanned_at(self) -> Pose:
        at = self._latest[self._scan].header.stamp.to_sec()
        with self._news:
            return min(self._trail, key=lambda known: abs(known[0] - at))[1]

    def truth(self) -> tuple[float, float, float, float]:
        """Not known; nothing judges this run while it drives."""
        return (math.nan, math.nan, math.nan, math.nan)


def pose_of(message: Any) -> Pose:
    """The pose of a nav_msgs/Odometry."""
    pose = message.pose.pose
    return Pose(pose.position.x, pose.position.y, yaw_of(pose.orientation))
