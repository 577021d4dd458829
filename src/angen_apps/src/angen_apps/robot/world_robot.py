"""A robot in a world, in this process or in ROS."""
from types import SimpleNamespace
from typing import Any

from angen_apps.robot.door_client import DoorState
from angen_apps.robot.interface import BASE, CYCLE, LiftState
from angen_apps.robot.pilot import Pose
from angen_tools.common.geometry import yaw
from angen_tools.session import Event, State, World


class WorldRobot:
    """See robot.interface.Robot."""

    def __init__(self, world: World, name: str, lidar: str = '') -> None:
        self._world, self._name, self._lidar = world, name, lidar
        self.events: list[Event] = []

    @property
    def now(self) -> float:
        return self._world.now

    def cycle(self, v: float, w: float) -> None:
        self._world.command('drive', self._name, f'{v!r} {w!r}')
        self.wait()

    def wait(self) -> None:
        """Lets CYCLE pass; the robot does nothing."""
        self._world.run(CYCLE)
        self.events += self._world.events()

    def command(self, kind: str, name: str, text: str) -> None:
        self._world.command(kind, name, text)

    def _state(self, kind: str, name: str) -> State:
        return self._world.state(kind, name)

    def door(self, name: str) -> DoorState:
        return DoorState(self._state('door', name)['mode'])

    def lift(self, name: str) -> LiftState:
        state = self._state('elevator', name)
        return LiftState(state['mode'], state['door_mode'], state['target_floor'],
                         state['position'])

    def odometry(self) -> Pose:
        return pose_of(self._state('drive', self._name))

    def scan(self) -> Any:
        return SimpleNamespace(**self._state('lidar', self._lidar).values)

    def scanned_at(self) -> Pose:
        return self.odometry()

    def truth(self) -> tuple[float, float, float, float]:
        return self.place(f'{self._name}::{BASE}')

    def place(self, link: str) -> tuple[float, float, float, float]:
        """The true place of a link: x, y, z (m), yaw (rad)."""
        x, y, z, *turned = self._world.pose(link)
        return x, y, z, yaw(*turned)


def pose_of(state: State) -> Pose:
    """The pose of odometry."""
    return Pose(state['x'], state['y'], state['yaw'])
