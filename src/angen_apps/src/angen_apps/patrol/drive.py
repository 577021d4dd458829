"""The patrol itself: the robot does its route's actions on a node that is stepped."""
import random
from typing import Callable

from angen_apps.patrol.report import BEGINS
from angen_apps.patrol.scene import Scene
from angen_apps.robot.driver import Driver, Track
from angen_apps.robot.interface import CYCLE
from angen_apps.robot.route import Action, Drive
from angen_apps.robot.route_file import Route
from angen_apps.robot.world_robot import WorldRobot
from angen_tools.common.geometry import yaw
from angen_tools.session import Event, State
from angen_tools.session.messages import twist
from angen_tools.session.stepped import Stepped

PAUSE = 5  # cycles, at most, between two actions
LAST = 10  # cycles at the end
NOTED = ('pir', 'switch')  # kinds of sensors whose detections are printed on the way
DONE = ('opened', 'closed', 'idle', 'doors opened')  # events at which doors and elevators stop


class RosRobot(WorldRobot):
    """A robot of the stepped node."""

    def __init__(self, route: Route, scene: Scene, world: Stepped) -> None:
        super().__init__(world, route.robot, scene.start.laser.name)
        self._stepped = world
        self._doors = [door.name for doors in scene.doors.values() for door in doors]
        self._lifts = [route.elevator.name] if route.elevator else []
        self._states: dict[tuple[str, str], State] = {}
        self._due: list[Event] = []  # whose states are not read yet
        # of each door: times (s) and angles (rad from shut), as published
        self.door_angles: dict[str, list[tuple[float, float]]] = {name: [] for name in self._doors}

    def connect(self) -> None:
        """Subscribes and advertises, and takes time back to 0."""
        from geometry_msgs.msg import Twist
        from std_msgs.msg import String
        world = self._stepped
        world.states('door')
        world.advertise(f'{self._name}/cmd_vel', Twist)
        for kind in ('Door', 'Elevator'):
            world.advertise(f'gazebo/{kind}_controller', String)
        devices = [('door', name) for name in self._doors]
        devices += [('elevator', name) for name in self._lifts]
        world.begin([('drive', self._name), ('lidar', self._lidar), *devices], CYCLE)
        for key in devices:
            self._states[key] = world.state(*key)
        self.events += world.events()

    def cycle(self, v: float, w: float) -> None:
        self._stepped.send(f'{self._name}/cmd_vel', twist(v, w))
        seen = len(self.events)
        self.wait()
        self.take_angles()
        self._due += [event for event in self.events[seen:] if event.event in DONE
                      and (event.kind, event.source) in self._states]
        # The state has its new mode a tick after the event, which may be in the next cycle.
        tick = self._stepped.tick
        ready = self.now - tick + 1e-6
        for event in [event for event in self._due if event.time <= ready]:
            self._states[event.kind, event.source] = self._world.state(
                event.kind, event.source, event.time + tick)
        self._due = [event for event in self._due if event.time > ready]

    def take_angles(self) -> None:
        """Keeps the angles of doors that have come."""
        for state in self._world.states('door'):
            if state.name in self.door_angles:
                self.door_angles[state.name].append((state.time, state['position']))

    def _state(self, kind: str, name: str) -> State:
        """Of doors and elevators those that each run knows at that time."""
        if (kind, name) in self._states:
            return self._states[kind, name]
        late = CYCLE / 2 if kind == 'lidar' else 0.0
        return self._world.state(kind, name, self.now - late)

    def truth(self) -> tuple[float, float, float, float]:
        pose = next(entity.pose for entity in self._world.entities('drive')
                    if entity.name == self._name)
        return (*pose[:3], yaw(*pose[3:]))


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
