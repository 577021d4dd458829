"""The patrol itself: the robot drives its route cycle by cycle, has doors turned, and rides."""
from __future__ import annotations

import math
import random
from dataclasses import dataclass, field
from typing import Any, Callable

import numpy as np

from angen_tools.common.failure import Failure
from angen_tools.common.geometry import yaw_of
from angen_tools.maps.gridmap import STOREY, GridMap
from angen_tools.patrol.lockstep import Lockstep
from angen_tools.patrol.sight import room_of
from angen_tools.robot.localizer import Localizer, returns_of
from angen_tools.robot.pilot import Pilot, Pose
from angen_tools.robot.planner import Door
from angen_tools.robot.route import Action, Drive, Ride, Turn
from angen_tools.robot.route_file import Route

BUMPER = 'patrol_bumper'  # the sensor on the robot that detects all that it touches
CYCLE = 0.1  # s from one command to the next
DEVICE_LIMIT = 60.0  # s of simulated time that a door or elevator may take
DRIVE_SLACK = 30.0  # s beyond thrice the time that a drive should take
PAUSE = 5  # cycles, at most, between two actions
LAST = 10  # cycles at the end
DETECTIONS = (('pir', 'motion'), ('switch', 'opened'))  # kinds and events
DONE = ('opened', 'closed', 'idle', 'doors opened')  # events at which doors and elevators stop


@dataclass
class Track:
    """Where the robot was, and where it took itself to be; a row a cycle, times in s."""

    rows: list[tuple[float, ...]] = field(default_factory=list)  # t, x, y, z, yaw: in truth
    believed: list[tuple[float, float]] = field(default_factory=list)  # x, y
    odometry: list[tuple[float, float]] = field(default_factory=list)  # x, y, by wheels alone
    reached: list[tuple[float, str]] = field(default_factory=list)
    levels: list[tuple[int, float]] = field(default_factory=list)  # floor, m beside its level


@dataclass(frozen=True)
class Scene:
    """What the robot knows of the building before it starts."""

    start: Pose
    mount: Pose  # the laser on the robot
    scan: str  # topics
    odometry: str
    maps: dict[int, GridMap]  # of floors, with doors open
    landmarks: dict[int, GridMap]  # what a laser may meet: leaves stand open and shut
    doors: dict[int, list[Door]]
    beams: dict[str, float]  # of a switch: rad of its door from shut at which its beam is free
    floor: int
    body: np.ndarray  # (n, 3) points of the robot's surface, m
    world: Any  # angen.World without robots, for rays


def pose_of(pose: Any) -> Pose:
    """A geometry_msgs/Pose from above."""
    return Pose(pose.position.x, pose.position.y, yaw_of(pose.orientation))


def floor_of(z: float) -> int:
    """The floor that something at height z (m) belongs to."""
    return math.floor((z + 0.5) / STOREY)


class Patrol:
    """One run of a route's actions.

    `watch` is called after each cycle with the time (s), the share that is done, and what goes on;
    `note` at each waypoint with the time and what happened on the way there.
    """

    def __init__(self, route: Route, scene: Scene, lockstep: Lockstep, seed: int,
                 watch: Callable[[float, float, str], None], note: Callable[[float, str], None]
                 ) -> None:
        self._route, self._scene, self._lockstep = route, scene, lockstep
        self._chance = random.Random(seed)
        self._watch, self._note_line = watch, note
        self._text = ''
        self._states: dict[tuple[str, str], Any] = {}
        self._seen_events = self._noted_events = 0
        self.track = Track()

    def door_angles(self) -> dict[str, list[tuple[float, float]]]:
        """Times (s) and angles (rad from shut) of each door, as published."""
        return {name: [(m.header.stamp.to_sec(), m.position)
                       for m in self._lockstep.kept[f'/angen/door/{name}']]
                for kind, name in self._devices if kind == 'door'}

    def connect(self) -> None:
        """Subscribes and advertises, and takes time back to 0."""
        from geometry_msgs.msg import Twist
        from nav_msgs.msg import Odometry
        from sensor_msgs.msg import LaserScan
        from std_msgs.msg import String

        from angen_msgs.msg import DoorState, ElevatorState
        lockstep = self._lockstep
        lockstep.subscribe(self._scene.odometry, Odometry)
        lockstep.subscribe(self._scene.scan, LaserScan)
        self._devices = {('door', door.name): DoorState
                         for doors in self._scene.doors.values() for door in doors}
        if self._route.elevator:
            self._devices['elevator', self._route.elevator.name] = ElevatorState
        for (kind, name), message in self._devices.items():
            lockstep.subscribe(f'/angen/{kind}/{name}', message, keep=True)
        self._cmd_vel = f'/{self._route.robot}/cmd_vel'
        lockstep.advertise(self._cmd_vel, Twist)
        for kind in ('Door', 'Elevator'):
            lockstep.advertise(f'/gazebo/{kind}_controller', String)
        lockstep.begin()

    def run(self, actions: list[Action]) -> None:
        """Does all of it, in order; Failure names what did not happen."""
        for key in self._devices:
            self._states[key] = self._lockstep.latest('/angen/%s/%s' % key)
        self._begin()
        steps: dict[type, Callable[[Any], None]] = {Drive: self._drive, Turn: self._turn,
                                                    Ride: self._ride}
        for number, action in enumerate(actions):
            self._share = number / len(actions)
            steps[type(action)](action)
            for _ in range(self._chance.randrange(PAUSE)):
                self._cycle()
        for _ in range(LAST):
            self._cycle()

    def _begin(self) -> None:
        """Finds out where it stands: about the scene's start."""
        odometry = self._odometry()
        self._origin = self._scene.start.then(odometry.inverse())
        self._localizer = Localizer(self._scene.landmarks[self._scene.floor], self._scene.start,
                                    odometry)
        self._share = 0.0
        for _ in range(5):
            self._cycle()
            self._localizer.see(self._returns())

    def _odometry(self) -> Pose:
        now = self._lockstep.now
        return pose_of(self._lockstep.latest(self._scene.odometry, now).pose.pose)

    def _returns(self) -> Any:
        scan = self._lockstep.latest(self._scene.scan, self._lockstep.now - CYCLE / 2)
        return returns_of(scan, self._scene.mount)

    def _cycle(self, v: float = 0.0, w: float = 0.0) -> Pose:
        """Commands the wheels for a cycle; where the robot takes itself to be after it."""
        from geometry_msgs.msg import Twist
        twist = Twist()
        twist.linear.x, twist.angular.z = v, w
        self._lockstep.send(self._cmd_vel, twist)
        now = self._lockstep.run()
        self._take_states()
        odometry = self._odometry()
        pose = self._localizer.move(odometry)
        if v or w:  # while it stands, doors turn, which are not on the map
            pose = self._localizer.see(self._returns())
        self._note(now, pose, odometry)
        self._watch(now, self._share, self._text)
        return pose

    def _take_states(self) -> None:
        """The state of each door and elevator that came to rest in this cycle."""
        events = self._lockstep.events
        for event in events[self._seen_events:]:
            key = event.kind, event.source
            if key in self._devices and event.event in DONE:
                self._states[key] = self._lockstep.latest('/angen/%s/%s' % key,
                                                          event.header.stamp.to_sec())
        self._seen_events = len(events)

    def _note(self, now: float, pose: Pose, odometry: Pose) -> None:
        truth = next(entity.pose for entity in self._lockstep.entities('drive')
                     if entity.name == self._route.robot)
        wheels = self._origin.then(odometry)
        self.track.rows.append((now, truth.position.x, truth.position.y, truth.position.z,
                                yaw_of(truth.orientation)))
        self.track.believed.append((pose.x, pose.y))
        self.track.odometry.append((wheels.x, wheels.y))

    def _drive(self, drive: Drive) -> None:
        length = sum(math.dist(a, b) for a, b in zip(drive.points, drive.points[1:]))
        limit = self._lockstep.now + DRIVE_SLACK + 3 * length / self._route.speed
        pilot = Pilot(drive.points, self._route.speed, self._route.turn, self._route.acceleration)
        self._text = f'to {drive.name}' if drive.name else 'driving'
        pose = self._cycle()
        while (command := pilot.steer(pose, CYCLE)) is not None:
            pose = self._cycle(*command)
            if self._lockstep.now > limit:
                touched = [event.detail for event in self._lockstep.events
                           if event.source == BUMPER and event.event == 'pressed']
                x, y = drive.points[-1]
                raise Failure(f'the robot is stuck at {pose.x:.2f}, {pose.y:.2f} on floor '
                              f'{drive.floor}, on its way to {x:.2f}, {y:.2f}'
                              + (f'; it was touched {touched[-1]}' if touched else ''))
        if drive.name:
            self.track.reached.append((self._lockstep.now, drive.name))
            self._note_line(self._lockstep.now,
                            f'reached {drive.name}{self._detections(drive.name)}')

    def _detections(self, waypoint: str) -> str:
        """The sensors of its room that reacted on the way there, to the robot or to a door."""
        events = self._lockstep.events[self._noted_events:]
        self._noted_events += len(events)
        names = dict.fromkeys(event.source for event in events
                              if (event.kind, event.event) in DETECTIONS
                              and room_of(event.source) == waypoint.split()[0])
        return f'; sensors that reacted: {", ".join(names)}' if names else ''

    def _turn(self, turn: Turn) -> None:
        from angen_msgs.msg import DoorState
        wanted = DoorState.OPEN if turn.open else DoorState.CLOSED
        self._command('door', turn.door, f'{"Open" if turn.open else "Close"}, {turn.door}',
                      lambda state: state.mode == wanted)

    def _ride(self, ride: Ride) -> None:
        from angen_msgs.msg import ElevatorState
        if self._route.elevator is None:
            raise Failure(f'{self._route.path}: names no elevator')
        name = self._route.elevator.name
        level = STOREY * ride.floor
        state = self._command(
            'elevator', name, f'Floor{ride.floor}, {name}',
            lambda s: s.mode == ElevatorState.IDLE and s.target_floor == ride.floor
            and s.door_mode == ElevatorState.DOOR_OPEN and abs(s.position - level) < 0.1)
        self.track.levels.append((ride.floor, state.position - level))
        if ride.aboard:
            self._localizer.enter(self._scene.landmarks[ride.floor])

    def _command(self, kind: str, name: str, text: str, done: Callable[[Any], bool]) -> Any:
        from std_msgs.msg import String
        self._text = text
        if not done(self._states[kind, name]):
            self._lockstep.send(f'/gazebo/{kind.title()}_controller', String(text))
        limit = self._lockstep.now + DEVICE_LIMIT
        while not done(self._states[kind, name]):
            self._cycle()
            if self._lockstep.now > limit:
                raise Failure(f'{kind} {name} has not done {text} within {DEVICE_LIMIT:g} s')
        return self._states[kind, name]
