"""The building, the robot and the person of one search, in this process.

The robot receives the messages of its topics: events, states of doors and elevator, odometry,
scans, depth images. The true poses of robot and person are for the person's own eyes and the judge.
"""
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable

from angen_apps.robot.building import Start
from angen_apps.robot.entities import entities_of
from angen_apps.robot.interface import BUMPER, bumper
from angen_apps.robot.world_robot import WorldRobot
from angen_tools.common.failure import Failure
from angen_tools.session.in_process import InProcess


class Simulation(WorldRobot):
    """One world with its robot. `others` acts before each cycle."""

    def __init__(self, path: Path, seed: int, robot: str) -> None:
        own = InProcess.load(str(path), seed)
        super().__init__(own, robot)
        self.world = own.world
        self.others: Callable[[], None] = lambda: None
        self.sent: list[tuple[float, str, str]] = []  # s, kind, name of the robot's commands
        self.entities = entities_of(own)
        xml, link = bumper(path, robot)
        own.spawn(BUMPER, xml, on=link)

    def start(self, start: Start) -> None:
        """Switches the robot's lidar on."""
        self._lidar = start.laser.name
        self._depth = next((e.name for e in self.entities
                            if (e.kind, e.model) == ('depth', start.robot.model)), '')
        self._world.request('lidar', self._lidar)
        self.wait()
        self.wait()

    def wait(self) -> None:
        self.others()
        super().wait()

    def command(self, kind: str, name: str, text: str) -> None:
        self.sent.append((self.now, kind, name))
        super().command(kind, name, text)

    def depth(self) -> Any | None:
        """The latest depth image, as angen has it; None before the first, and without a camera."""
        if not self._depth:
            return None
        try:
            return SimpleNamespace(**self._world.state('depth', self._depth).values)
        except Failure:
            return None

    def request_depth(self, requested: bool) -> None:
        """Switches the depth camera on or off."""
        if self._depth:
            self._world.request('depth', self._depth, requested)
