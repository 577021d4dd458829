"""Does a route's actions: the robot drives cycle by cycle, has doors turned, and rides."""
from dataclasses import dataclass, field
from typing import Any, Callable

import numpy as np
from angen import Grid

from angen_apps.robot.interface import CYCLE, Robot, collisions
from angen_apps.robot.localizer import (EVERY, SHARE, Localizer, returns_of, to_world,
                                        unexplained)
from angen_apps.robot.pilot import Pilot, Pose
from angen_apps.robot.route import Action, Drive, Ride, Turn
from angen_apps.robot.route_file import Route
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import length

DEVICE_LIMIT = 60.0  # s of simulated time that a door or elevator may take
DRIVE_SLACK = 30.0  # s beyond thrice the time that a drive should take
SETTLE = 5  # scans at rest until a robot has localized itself at its start


@dataclass
class Track:
    """The true and the estimated places of the robot; a row a cycle, times in s."""

    rows: list[tuple[float, ...]] = field(default_factory=list)  # t, x, y, z, yaw: in truth
    believed: list[tuple[float, float]] = field(default_factory=list)  # x, y
    odometry: list[tuple[float, float]] = field(default_factory=list)  # x, y, by wheels alone
    levels: list[tuple[int, float]] = field(default_factory=list)  # floor, m beside its level

    @property
    def distance(self) -> float:
        """m that it drove in truth."""
        return length([(x, y) for _, x, y, *_ in self.rows])


class Stuck(Failure):
    """A drive, a door or an elevator takes too long."""


class Driver:
    """Drives one robot. `landmarks`: of each floor, what a laser may hit; `mount`: the laser on
    the robot. `watch` is called after each cycle. `may_go` says before each cycle of a drive
    whether the robot may drive on; while it may not, it waits. `give_up` says whether to end a
    drive before its end."""

    def __init__(self, robot: Robot, route: Route, landmarks: dict[int, Grid], mount: Pose,
                 watch: Callable[[], None], may_go: Callable[[], bool] = lambda: True,
                 give_up: Callable[[], bool] = lambda: False) -> None:
        self._robot, self.route, self._landmarks = robot, route, landmarks
        self._mount, self._watch = mount, watch
        self._may_go, self._give_up = may_go, give_up
        self._dt = CYCLE
        self._used: Any = None  # the latest scan by which it has localized itself
        self._seen: Any = None  # the latest scan, and where the wheels were when it was read
        self._seen_at: Pose | None = None
        self._found = np.zeros((0, 2))
        self.text = ''
        self.floor = 0
        self.left: list[tuple[float, float]] = []  # points left of the line that it drives
        self.track = Track()

    @property
    def pose(self) -> Pose:
        """The robot's estimate of where it is."""
        return self._localizer.pose

    def begin(self, start: Pose, floor: int) -> None:
        """Localizes the robot, which is about at `start`."""
        odometry = self._robot.odometry()
        self._origin = start.then(odometry.inverse())
        self._localizer = Localizer(self._landmarks[floor], start, odometry)
        self.floor = floor
        self._settle()

    def _settle(self) -> None:
        for _ in range(SETTLE):
            self.cycle()
            self._localizer.see(self._returns())

    def _returns(self) -> np.ndarray:
        """The returns of the latest scan, as the robot would see them from its present place."""
        scan = self._robot.scan()
        if scan is self._seen and self._seen_at is self._odometry:
            return self._found
        self._seen, self._seen_at = scan, self._odometry
        self._found = returns_of(scan, self._mount, EVERY)[0]
        then = self._robot.scanned_at()
        if then != self._odometry:
            self._found = to_world(self._found, self._odometry.inverse().then(then))
        return self._found

    @property
    def foreign(self) -> np.ndarray:
        """The points of the latest scan that are not on the map: (n, 2) in the world, m."""
        points = to_world(self._returns(), self.pose)
        return points[unexplained(points, self._localizer.field)]

    @property
    def share(self) -> float:
        """The part of the latest scan that is where the map has something."""
        return self._localizer.share(self._returns())

    def localize(self) -> bool:
        """Stops, and searches its floor if its scan does not fit; returns whether it fits then."""
        self._settle()
        returns = self._returns()
        return self._localizer.share(returns) >= SHARE or self._localizer.find(returns)

    def cycle(self, v: float = 0.0, w: float = 0.0) -> Pose:
        """Commands the wheels for a cycle; the estimated pose after it."""
        before = self._robot.now
        self._robot.cycle(v, w)
        took = self._robot.now - before  # more than a cycle where messages are late
        self._dt = took if took > 1.01 * CYCLE else CYCLE
        self._odometry = odometry = self._robot.odometry()
        pose = self._localizer.move(odometry)
        # While it waits, doors turn, which are not on the map.
        if (v or w) and self._robot.scan() is not self._used:
            pose = self._localizer.see(self._returns())
            self._used = self._seen
        wheels = self._origin.then(odometry)
        self.track.rows.append((self._robot.now, *self._robot.truth()))
        self.track.believed.append((pose.x, pose.y))
        self.track.odometry.append((wheels.x, wheels.y))
        self._watch()
        return pose

    def do(self, action: Action) -> bool:
        """Executes an action; returns whether it was completed. Failure if it is impossible."""
        if isinstance(action, Drive):
            return self._drive(action)
        if isinstance(action, Turn):
            self._turn(action)
        else:
            self._ride(action)
        return True

    def _drive(self, drive: Drive) -> bool:
        limit = self._robot.now + DRIVE_SLACK + 3 * length(drive.points) / self.route.speed
        pilot = Pilot(drive.points, self.route.speed, self.route.turn, self.route.acceleration)
        self.text = f'to {drive.name}' if drive.name else 'driving'
        pose = self.cycle()
        arrived = True
        while True:
            self.left = pilot.left
            arrived = arrived and not self._give_up()
            command = (pilot.steer(pose, self._dt) if arrived and self._may_go()
                       else pilot.stop(self._dt))
            if command is None:
                if pilot.arrived or not arrived:
                    return arrived
                command = 0.0, 0.0
            pose = self.cycle(*command)
            if self._robot.now > limit:
                raise self._stuck(drive)

    def _stuck(self, drive: Drive) -> Stuck:
        touched = collisions(self._robot.events)
        x, y = drive.points[-1]
        return Stuck(f'the robot is stuck at {self.pose.x:.2f}, {self.pose.y:.2f} on floor '
                     f'{drive.floor}, on its way to {x:.2f}, {y:.2f}'
                     + (f'; it was touched {touched[-1][1]}' if touched else ''))

    def _turn(self, turn: Turn) -> None:
        verb = 'Open' if turn.open else 'Close'
        self._command('door', turn.door, verb, lambda: self._robot.door(turn.door).has_done(verb))

    def _ride(self, ride: Ride) -> None:
        if self.route.elevator is None:
            raise Failure(f'{self.route.path}: names no elevator')
        name = self.route.elevator.name
        level = self._landmarks[ride.floor].height
        self._command('elevator', name, f'Floor{ride.floor}',
                      lambda: self._robot.lift(name).stands_open(ride.floor, level))
        self.track.levels.append((ride.floor, self._robot.lift(name).position - level))
        if ride.aboard:
            self._localizer.enter(self._landmarks[ride.floor])
            self.floor = ride.floor

    def _command(self, kind: str, name: str, text: str, done: Callable[[], bool]) -> None:
        self.text = f'{text}, {name}'
        if not done():
            self._robot.command(kind, name, text)
        limit = self._robot.now + DEVICE_LIMIT
        while not done():
            self.cycle()
            if self._robot.now > limit:
                raise Stuck(f'{kind} {name} has not done {text} within {DEVICE_LIMIT:g} s')
