"""The patrol itself: the robot does its route's actions on a node that is stepped."""
from __future__ import annotations

import random
from typing import Any, Callable

from angen_apps.patrol.lockstep import Lockstep
from angen_apps.patrol.report import BEGINS
from angen_apps.patrol.scene import Scene
from angen_apps.robot.driver import Driver, Track
from angen_apps.robot.interface import CYCLE, DoorState, Event, LiftState
from angen_apps.robot.pilot import Pose
from angen_apps.robot.route import Action, Drive
from angen_apps.robot.route_file import Route
from angen_apps.robot.states import door_state, lift_state
from angen_tools.common.geometry import yaw_of

PAUSE = 5  # cycles, at most, between two actions
LAST = 10  # cycles at the end
NOTED = ('pir', 'switch')  # kinds of sensors whose detections are printed on the way
DONE = ('opened', 'closed', 'idle', 'doors opened')  # events at which doors and elevators stop


class RosRobot:
    """A robot of the node of this process's master; see robot.interface.Robot."""

    def __init__(self, route: Route, scene: Scene, lockstep: Lockstep) -> None:
        self._name, self._lockstep = route.robot, lockstep
        self._odometry, self._scan = scene.start.robot.topic, scene.start.laser.topic
        self._cmd_vel = f'/{route.robot}/cmd_vel'
        self._doors = [door.name for doors in scene.doors.values() for door in doors]
        self._lifts = [route.elevator.name] if route.elevator else []
        self._states: dict[tuple[str, str], Any] = {}
        self._seen_events = 0
        self._due: list[Event] = []  # whose states are not read yet

    @property
    def now(self) -> float:
        return self._lockstep.now

    @property
    def events(self) -> list[Event]:
        return self._lockstep.events

    def connect(self) -> None:
        """Subscribes and advertises, and takes time back to 0."""
        from geometry_msgs.msg import Twist
        from nav_msgs.msg import Odometry
        from sensor_msgs.msg import LaserScan
        from std_msgs.msg import String

        from angen_msgs.msg import DoorState, ElevatorState
        lockstep = self._lockstep
        lockstep.subscribe(self._odometry, Odometry)
        lockstep.subscribe(self._scan, LaserScan)
        for name in self._doors:
            lockstep.subscribe(f'/angen/door/{name}', DoorState, keep=True)
        for name in self._lifts:
            lockstep.subscribe(f'/angen/elevator/{name}', ElevatorState, keep=True)
        lockstep.advertise(self._cmd_vel, Twist)
        for kind in ('Door', 'Elevator'):
            lockstep.advertise(f'/gazebo/{kind}_controller', String)
        lockstep.begin()
        for kind, names in (('door', self._doors), ('elevator', self._lifts)):
            for name in names:
                self._states[kind, name] = lockstep.latest(f'/angen/{kind}/{name}')

    def door_angles(self) -> dict[str, list[tuple[float, float]]]:
        """Times (s) and angles (rad from shut) of each door, as published."""
        return {name: [(m.header.stamp.to_sec(), m.position)
                       for m in self._lockstep.kept[f'/angen/door/{name}']]
                for name in self._doors}

    def cycle(self, v: float, w: float) -> None:
        from geometry_msgs.msg import Twist
        twist = Twist()
        twist.linear.x, twist.angular.z = v, w
        self._lockstep.send(self._cmd_vel, twist)
        self._lockstep.run()
        self._due += [event for event in self.events[self._seen_events:] if event.event in DONE
                      and (event.kind, event.source) in self._states]
        self._seen_events = len(self.events)
        # The state has its new mode a tick after the event, which may be in the next cycle.
        ready = self.now - self._lockstep.tick + 1e-6
        for event in [event for event in self._due if event.time <= ready]:
            self._states[event.kind, event.source] = self._lockstep.latest(
                f'/angen/{event.kind}/{event.source}', event.time + self._lockstep.tick)
        self._due = [event for event in self._due if event.time > ready]

    def command(self, kind: str, name: str, text: str) -> None:
        from std_msgs.msg import String
        self._lockstep.send(f'/gazebo/{kind.title()}_controller', String(f'{text}, {name}'))

    def door(self, name: str) -> DoorState:
        return door_state(self._states['door', name])

    def lift(self, name: str) -> LiftState:
        return lift_state(self._states['elevator', name])

    def odometry(self) -> Pose:
        pose = self._lockstep.latest(self._odometry, self.now).pose.pose
        return Pose(pose.position.x, pose.position.y, yaw_of(pose.orientation))

    def scan(self) -> Any:
        return self._lockstep.latest(self._scan, self.now - CYCLE / 2)

    def scanned_at(self) -> Pose:
        return self.odometry()  # both are of the end of the cycle

    def truth(self) -> tuple[float, float, float, float]:
        pose = next(entity.pose for entity in self._lockstep.entities('drive')
                    if entity.name == self._name)
        return pose.position.x, pose.position.y, pose.position.z, yaw_of(pose.orientation)


class Patrol:
    """One run of a route's actions.

    `watch` is called after each cycle with the time (s), the finished share, and the action;
    `note` at each waypoint with the time and what happened on the way there.
    """

    def __init__(self, route: Route, scene: Scene, robot: RosRobot, seed: int,
                 watch: Callable[[float, float, str], None], note: Callable[[float, str], None]
                 ) -> None:
        self._scene, self._robot = scene, robot
        self._chance = random.Random(seed)
        self._driver = Driver(robot, route, scene.landmarks, scene.start.mount,
                              lambda: watch(robot.now, self._share, self._driver.text))
        self._note_line = note
        self._share = 0.0
        self._noted_events = 0
        self.reached: list[tuple[float, str]] = []

    @property
    def track(self) -> Track:
        return self._driver.track

    def run(self, actions: list[Action]) -> None:
        """Does all of it, in order; Failure names what did not happen."""
        self._driver.begin(self._scene.start.pose, self._scene.start.floor)
        for number, action in enumerate(actions):
            self._share = number / len(actions)
            self._driver.do(action)
            if isinstance(action, Drive) and action.name:
                self.reached.append((self._robot.now, action.name))
                self._note_line(self._robot.now,
                                f'reached {action.name}{self._detections(action.name)}')
            for _ in range(self._chance.randrange(PAUSE)):
                self._driver.cycle()
        for _ in range(LAST):
            self._driver.cycle()

    def _detections(self, waypoint: str) -> str:
        """The sensors of its room that reacted on the way there, to the robot or to a door."""
        events = self._robot.events[self._noted_events:]
        self._noted_events += len(events)
        names = dict.fromkeys(event.source for event in events
                              if event.kind in NOTED and event.event in BEGINS[event.kind]
                              and self._scene.rooms.get(event.source) == waypoint.split()[0])
        return f'; reacted to the robot or a door: {", ".join(names)}' if names else ''
