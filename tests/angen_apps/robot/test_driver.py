"""A route's actions with an ideal robot."""
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from angen import Grid

from angen_apps.maps.gridmap import FREE
from angen_apps.robot.driver import DEVICE_LIMIT, Driver, Stuck
from angen_apps.robot.door_client import DoorState
from angen_apps.robot.interface import (BUMPER, CYCLE, Event, LiftState, bumper_of,
                                        collisions)
from angen_apps.robot.pilot import Pose
from angen_apps.robot.route import Drive, Ride, Turn
from angen_apps.robot.route_file import Lift, Route

ROUTE = Route(Path('r.yaml'), [], 'robot', 0.22, 0.5, 1.5, 0.5, 0.3,
              Lift('lift', (0.0, 0.0), (1.0, 0.0)))
LINE = [(0.05 * i, 0.0) for i in range(41)]


class IdealRobot:
    """Moves as it is commanded; a command is done `answers` s later, or never."""

    def __init__(self, answers: float = 1.0) -> None:
        self.now, self.pose, self.answers = 0.0, Pose(0.0, 0.0, 0.0), answers
        self.events: list[Event] = []
        self.sent: list[tuple[float, str]] = []
        self.speeds: list[float] = []

    def cycle(self, v: float, w: float) -> None:
        self.pose = self.pose.then(Pose(v * CYCLE, 0.0, w * CYCLE))
        self.now += CYCLE
        self.speeds.append(v)

    def command(self, kind: str, name: str, text: str) -> None:
        self.sent.append((self.now, text))

    def _done(self) -> bool:
        return bool(self.sent) and self.now >= self.sent[-1][0] + self.answers

    def door(self, name: str) -> DoorState:
        return DoorState('OPEN' if self._done() else 'CLOSED')

    def lift(self, name: str) -> LiftState:
        return (LiftState('IDLE', 'OPEN', 1, 4.001) if self._done()
                else LiftState('IDLE', 'OPEN', 0, 0.0))

    def odometry(self) -> Pose:
        return self.pose

    def scan(self) -> Any:
        return SimpleNamespace(ranges=[20.0] * 4, angle_min=0.0, angle_increment=1.0,
                               range_min=0.1, range_max=10.0)

    def scanned_at(self) -> Pose:
        return self.pose

    def truth(self) -> tuple[float, float, float, float]:
        return self.pose.x, self.pose.y, 0.0, self.pose.yaw


def driver(robot: IdealRobot, **more: Any) -> Driver:
    grids = {floor: Grid(np.full((40, 60), FREE), (-0.5, -1.0), 0.05, floor, 4.0 * floor)
             for floor in (0, 1)}
    made = Driver(robot, ROUTE, grids, Pose(0, 0, 0), lambda: None, **more)
    made.begin(Pose(0.0, 0.0, 0.0), 0)
    return made


def test_it_drives_to_the_end_and_stops() -> None:
    robot = IdealRobot()
    drive = driver(robot)
    assert drive.do(Drive(LINE, 0))
    assert math.dist((robot.pose.x, robot.pose.y), LINE[-1]) < 0.05
    assert robot.speeds[-1] == 0.0 and max(robot.speeds) == pytest.approx(0.5)
    assert len(drive.track.rows) == len(robot.speeds)


def test_it_stops_while_it_may_not_drive_and_then_continues() -> None:
    robot = IdealRobot()
    drive = driver(robot, may_go=lambda: not 3.0 < robot.now < 8.0)
    assert drive.do(Drive(LINE, 0))
    held = [v for t, v in enumerate(robot.speeds) if 4.5 < t * CYCLE < 8.0]
    assert held and max(held) == 0.0
    assert math.dist((robot.pose.x, robot.pose.y), LINE[-1]) < 0.05


def test_it_brakes_where_it_gives_up() -> None:
    robot = IdealRobot()
    drive = driver(robot, give_up=lambda: robot.pose.x > 1.0)
    assert not drive.do(Drive(LINE, 0))
    assert 1.0 < robot.pose.x < 1.5 and robot.speeds[-1] == 0.0


def test_it_waits_for_a_door_but_not_for_ever() -> None:
    robot = IdealRobot(answers=2.0)
    assert driver(robot).do(Turn('d', True))
    assert [text for _, text in robot.sent] == ['Open'] and robot.now >= 2.0
    with pytest.raises(Stuck, match='door d has not done Open within 60 s'):
        driver(IdealRobot(answers=2 * DEVICE_LIMIT)).do(Turn('d', True))


def test_a_ride_takes_it_to_the_other_floor() -> None:
    robot = IdealRobot()
    drive = driver(robot)
    assert drive.do(Ride(1, True))
    assert drive.floor == 1 and [text for _, text in robot.sent] == ['Floor1']
    assert drive.track.levels == [(1, pytest.approx(0.001))]


def test_wheels_may_touch_the_floor_and_other_touches_are_counted() -> None:
    assert bumper_of(['body', 'left_wheel', 'caster_front']).count('<collision>') == 1
    events = [Event(1.0, BUMPER, 'contact', 'pressed', 'by wall'),
              Event(2.0, BUMPER, 'contact', 'released', ''),
              Event(3.0, 'chair', 'contact', 'pressed', '')]
    assert collisions(events) == [(1.0, 'by wall')]
