"""A robot of the running simulator, commanded in its time."""
from __future__ import annotations

import math
import time
from collections import deque

from angen_apps.robot.building import Start
from angen_apps.robot.interface import CYCLE
from angen_apps.robot.pilot import Pose
from angen_apps.robot.world_robot import WorldRobot, pose_of
from angen_tools.session.live import Live
from angen_tools.session.messages import twist

TRAIL = 200  # messages of odometry that are kept


class LiveRobot(WorldRobot):
    """A context: its end stops the wheels."""

    def __init__(self, world: Live, start: Start, devices: list[tuple[str, str]]) -> None:
        """`devices`: kind and name of the doors and elevators that it commands."""
        from geometry_msgs.msg import Twist
        super().__init__(world, start.robot.name, start.laser.name)
        self._wheels = world.publisher(f'{self._name}/cmd_vel', Twist)
        self._trail: deque[tuple[float, Pose]] = deque(maxlen=TRAIL)  # times and odometry
        world.states('drive')
        for kind, name in [('drive', self._name), ('lidar', self._lidar), *devices]:
            world.state(kind, name)
        self._follow()

    def __enter__(self) -> LiveRobot:
        return self

    def __exit__(self, *_: object) -> None:
        self._wheels.publish(twist(0.0, 0.0))
        time.sleep(0.1)  # until it is sent

    @property
    def now(self) -> float:
        return self._trail[-1][0]

    def _follow(self) -> None:
        self._trail.extend((state.time, pose_of(state)) for state in self._world.states('drive')
                           if state.name == self._name)

    def cycle(self, v: float, w: float) -> None:
        self._wheels.publish(twist(v, w))
        self._world.state('drive', self._name, self.now + CYCLE)  # waits for it
        self._follow()

    def odometry(self) -> Pose:
        return self._trail[-1][1]

    def scanned_at(self) -> Pose:
        at = self._world.state('lidar', self._lidar).time
        return min(self._trail, key=lambda known: abs(known[0] - at))[1]

    def truth(self) -> tuple[float, float, float, float]:
        """Not known; nothing judges this run while it drives."""
        return (math.nan, math.nan, math.nan, math.nan)
