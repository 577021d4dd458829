"""A drive with a person in the way, with a robot on a map."""
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable

import numpy as np
import pytest
from angen import Grid

from angen_apps.go.trip import TRIES, Goal, Trip
from angen_apps.maps.gridmap import FREE, OCCUPIED
from angen_apps.robot.door_client import DoorState
from angen_apps.robot.interface import CYCLE, Event, LiftState
from angen_apps.robot.pilot import Pose
from angen_apps.robot.route_file import NUMBERS, Route, Waypoint
from angen_tools.common.failure import Failure

ROUTE = Route(Path('r.yaml'), [], 'robot', elevator=None,
              **{key: usual for key, (_, _, usual) in NUMBERS.items()})
BODY = 0.18  # m, the robot's radius
FAR = np.arange(0.12, 6.5, 0.03)


class Person:
    """A disc, m, that is there until `leaves` s."""

    def __init__(self, x: float, y: float, leaves: float = math.inf) -> None:
        self.at, self.radius, self.leaves = (x, y), 0.23, leaves


class MappedRobot:
    """Sees the map and a person, and does not get through them: its wheels slip then."""

    def __init__(self, grid: Grid, start: Pose, person: Person) -> None:
        self.grid, self.pose, self.wheels, self.person = grid, start, Pose(0, 0, 0), person
        self.now, self.scanned = 0.0, -1.0
        self.touched = 0
        self.events: list[Event] = []

    def cycle(self, v: float, w: float) -> None:
        step = Pose(v * CYCLE, 0.0, w * CYCLE)
        there = self.pose.then(step)
        self.wheels = self.wheels.then(step)
        self.now += CYCLE
        if (self.now < self.person.leaves
                and math.dist((there.x, there.y), self.person.at) < BODY + self.person.radius):
            there = Pose(self.pose.x, self.pose.y, there.yaw + 0.1)
            self.touched += 1
        self.pose = there

    def scan(self) -> Any:
        if self.now > self.scanned:
            self.scanned, self.seen = self.now, self.look()
        return self.seen

    def look(self) -> Any:
        angles = np.radians(np.arange(-180.0, 180.0, 2.0))
        ways = np.stack([np.cos(angles + self.pose.yaw), np.sin(angles + self.pose.yaw)], axis=1)
        points = np.array([self.pose.x, self.pose.y]) + ways[:, None] * FAR[:, None]
        cells = np.floor((points - self.grid.origin) / self.grid.resolution).astype(int)
        rows, columns = self.grid.cells.shape
        cells = np.clip(cells, 0, (columns - 1, rows - 1))
        hit = self.grid.cells[cells[..., 1], cells[..., 0]] == OCCUPIED
        if self.now < self.person.leaves:
            hit |= np.hypot(*(points - self.person.at).transpose(2, 0, 1)) < self.person.radius
        ranges = np.where(hit.any(axis=1), FAR[hit.argmax(axis=1)], math.inf)
        return SimpleNamespace(ranges=ranges, angle_min=-math.pi, angle_increment=math.radians(2),
                               range_min=0.12, range_max=8.0)

    def command(self, kind: str, name: str, text: str) -> None:
        raise AssertionError('there is no device')

    def door(self, name: str) -> DoorState:
        raise AssertionError('there is no door')

    def lift(self, name: str) -> LiftState:
        raise AssertionError('there is no elevator')

    def odometry(self) -> Pose:
        return self.wheels

    def scanned_at(self) -> Pose:
        return self.wheels

    def truth(self) -> tuple[float, float, float, float]:
        return self.pose.x, self.pose.y, 0.0, self.pose.yaw


def hall(width: float) -> Grid:
    """6 m long, with a niche at its end, so that it looks different everywhere."""
    cells = np.full((int(width / 0.05) + 2, 122), FREE, np.int8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    cells[1:5, 30:34] = cells[-6:, 100:104] = OCCUPIED
    return Grid(cells, (0.0, 0.0), 0.05, 0)


def drive(width: float, person: Person, believed: Pose | None = None, goal: Goal | None = None
          ) -> tuple[MappedRobot, Callable[[], Waypoint], list[str]]:
    grid, start = hall(width), Pose(0.7, width / 2, 0.0)
    robot, notes = MappedRobot(grid, start, person), []  # type: ignore[var-annotated]
    survey: Any = SimpleNamespace(maps={0: grid}, landmarks={0: grid}, doors={0: []})
    at: Any = SimpleNamespace(pose=believed or start, floor=0, mount=Pose(0, 0, 0))
    end = Waypoint('end', 0, (5.0, width / 2), 1)
    trip = Trip(robot, ROUTE, survey, at, goal or (lambda _: end),
                lambda _floor, _planner: None, notes.append, lambda *_: None)
    return robot, trip.run, notes


def test_it_drives_around_a_person_who_stays() -> None:
    robot, run, notes = drive(2.4, Person(3.0, 1.2))
    run()
    assert math.dist((robot.pose.x, robot.pose.y), (5.0, 1.2)) < 0.1
    assert not robot.touched
    assert len(notes) == 1 and 'something is in its way at 2.8, 1.' in notes[0]


def test_it_stops_beside_a_person_in_the_middle_of_a_room() -> None:
    def middle(planners: Any) -> Waypoint:
        at = planners[0].nearest((4.0, 1.2), 2.0)
        if at is None:
            raise Failure('full')
        return Waypoint('room', 0, at, 0)

    robot, run, notes = drive(2.4, Person(4.0, 1.2), goal=middle)
    run()
    assert 0.4 < math.dist((robot.pose.x, robot.pose.y), (4.0, 1.2)) < 1.0
    assert not robot.touched and len(notes) <= 3


def test_it_waits_for_a_person_who_leaves() -> None:
    robot, run, notes = drive(1.0, Person(3.0, 0.5, leaves=30.0))
    run()
    assert math.dist((robot.pose.x, robot.pose.y), (5.0, 0.5)) < 0.1
    assert robot.now > 30.0 and not robot.touched and notes


def test_it_yields_to_a_person_who_waits_for_it() -> None:
    """A person at its goal, who leaves once the robot has made room."""
    person = Person(4.6, 0.5)
    robot, run, notes = drive(1.0, person)
    moved, nearest = robot.cycle, [9.0]

    def cycle(v: float, w: float) -> None:
        moved(v, w)
        away = math.dist((robot.pose.x, robot.pose.y), person.at)
        nearest[0] = min(nearest[0], away)
        if away > nearest[0] + 0.6:
            person.leaves = min(person.leaves, robot.now)

    setattr(robot, 'cycle', cycle)
    run()
    assert math.dist((robot.pose.x, robot.pose.y), (5.0, 0.5)) < 0.1
    assert notes and not robot.touched and person.leaves < 60.0


def test_it_gives_up_where_no_one_leaves_and_reports_it() -> None:
    robot, run, notes = drive(1.0, Person(3.0, 0.5))
    with pytest.raises(Failure, match=f'no way leads .* gave up after {TRIES} tries'):
        run()
    assert len(notes) == TRIES and not robot.touched and robot.now < 300.0


def test_it_finds_out_that_it_is_elsewhere() -> None:
    robot, run, _ = drive(2.4, Person(-9.0, 0.0), believed=Pose(2.6, 1.6, 1.2))
    run()
    assert math.dist((robot.pose.x, robot.pose.y), (5.0, 1.2)) < 0.1
