"""The building, the robot and the person of one search, in this process (`import angen`).

The robot receives the messages of its topics: events, states of doors and elevator, odometry,
scans, depth images. The true poses of robot and person are for the person's own eyes and the judge.
"""
from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable

import numpy as np

from angen_apps.robot.building import Start
from angen_apps.robot.entities import entities_of
from angen_apps.robot.interface import BASE, BUMPER, CYCLE, DoorState, Event, LiftState, bumper
from angen_apps.robot.pilot import Pose
from angen_tools.common.catalog import angen_module, simulator
from angen_tools.common.geometry import yaw


class Simulation:
    """One world with its robot; see robot.interface.Robot. `others` acts before each cycle."""

    def __init__(self, path: Path, seed: int, robot: str) -> None:
        with simulator() as angen:
            self.world = angen.World(str(path), seed)
        self._name = robot
        self.events: list[Event] = []
        self.others: Callable[[], None] = lambda: None
        self.sent: list[tuple[float, str, str]] = []  # s, kind, name of the robot's commands
        self.entities = entities_of(self.world)
        xml, link = bumper(path, robot)
        self.world.spawn(xml, BUMPER, on=link)

    def start(self, start: Start) -> None:
        """Switches the robot's lidar on."""
        self._lidar = start.laser.name
        self._depth = next((e.name for e in self.entities
                            if (e.kind, e.model) == ('depth', start.robot.model)), '')
        self.world.request('lidar', self._lidar)
        self.wait()
        self.wait()

    def wait(self) -> None:
        """Lets CYCLE pass; the robot does nothing."""
        self.others()
        self.world.run(CYCLE)
        self.events += [Event(*event) for event in self.world.events()]

    @property
    def now(self) -> float:
        return float(self.world.time)

    def cycle(self, v: float, w: float) -> None:
        self.world.command('drive', self._name, values=[v, w])
        self.wait()

    def command(self, kind: str, name: str, text: str) -> None:
        self.sent.append((self.now, kind, name))
        with simulator():
            self.world.command(kind, name, text)

    def door(self, name: str) -> DoorState:
        return DoorState(self.world.device('door', name)['mode'])

    def lift(self, name: str) -> LiftState:
        state = self.world.device('elevator', name)
        return LiftState(state['mode'], state['door_mode'], state['target_floor'],
                         state['position'])

    def odometry(self) -> Pose:
        state = self.world.device('drive', self._name)
        return Pose(state['x'], state['y'], state['yaw'])

    def scan(self) -> Any:
        return SimpleNamespace(**self.world.sensor('lidar', self._lidar))

    def scanned_at(self) -> Pose:
        return self.odometry()

    def depth(self) -> Any | None:
        """The latest depth image, as angen has it; None before the first, and without a camera."""
        if not self._depth:
            return None
        try:
            return SimpleNamespace(**self.world.sensor('depth', self._depth))
        except angen_module().Error:
            return None

    def request_depth(self, requested: bool) -> None:
        """Switches the depth camera on or off."""
        if self._depth:
            self.world.request('depth', self._depth, requested)

    def truth(self) -> tuple[float, float, float, float]:
        return self.place(f'{self._name}::{BASE}')

    def place(self, link: str) -> tuple[float, float, float, float]:
        """The true place of a link: x, y, z (m), yaw (rad)."""
        row = np.asarray(self.world.link_poses)[self.world.links.index(link)]
        return float(row[0]), float(row[1]), float(row[2]), yaw(*row[3:])
