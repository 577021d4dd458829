"""Evidence of ambient sensors about a person, unless the robot itself causes it."""
import math
from dataclasses import dataclass, field

import numpy as np

from angen_tools.session import Event
from angen_apps.seek.belief import DEVICE, LIGHT, Belief
from angen_apps.seek.home import DOORWAY, Home

OWN = 5.0  # s after a command of the robot its device's changes are the robot's doing
OWN_LIFT = 40.0  # s: a ride, with its doors
MOVED = 1.5  # s after it moved a PIR may still detect the robot
ROBOT_NEAR = 1.0  # m
BEGINS = ('pressed', 'opened', 'opening', 'closing', 'closed')
POINT = {'pressure': 0.6, 'contact': 0.8, 'reed': 1.5, 'cabinet': 1.3, 'window': 1.3,
         'switch': DOORWAY + 0.5}  # m around a sensor or device


@dataclass
class RobotNow:
    """The robot's estimate of its pose, and its action."""

    x: float
    y: float
    floor: int
    last_moved: float  # s
    commanded: dict[tuple[str, str], float] = field(default_factory=dict)  # s, by kind and name

    def commanded_lately(self, kind: str, name: str, now: float, span: float) -> bool:
        return now - self.commanded.get((kind, name), -1e9) < span


class Ambient:
    """Weighs a belief by the events of the building, STEP by STEP."""

    def __init__(self, home: Home, belief: Belief) -> None:
        self._home, self._belief = home, belief
        self._motion: dict[str, bool] = {}
        self._said: dict[tuple[int, int, int], float] = {}  # s, by the place of an event
        self._places = {(e.kind, e.name): e for e in home.entities}
        self._doors = {door.name: (floor, door) for floor, door in home.all_doors()}
        self.last: tuple[str, float] | None = None  # the last sensor that detected a person; s

    def step(self, events: list[Event], robot: RobotNow, now: float) -> None:
        """Updates the belief by the messages of a STEP that ends at `now` (s)."""
        moved = set()
        for event in events:
            if event.kind == 'pir':
                self._motion[event.source] = event.event == 'motion'
                if event.event == 'motion':
                    moved.add(event.source)
            elif event.kind == 'door':
                self._door(event, robot)
            elif event.kind == 'elevator':
                self._lift(event, robot)
            elif event.kind == 'luminosity':
                self._light(event)
            elif event.kind in POINT and event.event in BEGINS:
                self._point(event, robot)
        beside = self._home.around(robot.x, robot.y, robot.floor, ROBOT_NEAR)
        for pir in self._home.pirs:
            motion = pir.name in moved or self._motion.get(pir.name, False)
            near = (pir.sees | pir.through_doors)[beside].any()
            if near and now - robot.last_moved < MOVED + pir.memory:
                continue
            if self._own_door_in_view(pir.sees | pir.through_doors, robot, now, pir.memory):
                continue
            self._belief.pir(pir, motion)
            if pir.name in moved:
                self.last = pir.name, now

    def _own_door_in_view(self, sees: np.ndarray, robot: RobotNow, now: float, memory: float
                          ) -> bool:
        for (kind, name), when in robot.commanded.items():
            if kind == 'door' and now - when < OWN + memory and name in self._doors:
                floor, door = self._doors[name]
                x, y = door.middle
                if sees[self._home.around(x, y, floor, DOORWAY)].any():
                    return True
        return False

    def _new(self, x: float, y: float, floor: int, event: Event) -> bool:
        """Whether this is not the same as what another sensor of the same place has just said."""
        key = round(x), round(y), floor
        known = event.time - self._said.get(key, -1e9) < 3.0
        self._said[key] = event.time
        return not known

    def _door(self, event: Event, robot: RobotNow) -> None:
        if event.event not in ('opening', 'closing') or event.source not in self._doors \
                or robot.commanded_lately('door', event.source, event.time, OWN):
            return
        floor, door = self._doors[event.source]
        x, y = door.middle
        if self._new(x, y, floor, event):
            reach = DOORWAY if event.event == 'opening' else DOORWAY + 1.0
            self._belief.near(self._home.around(x, y, floor, reach), DEVICE)
        self.last = f'door {event.source}', event.time

    def _lift(self, event: Event, robot: RobotNow) -> None:
        if robot.commanded_lately('elevator', event.source, event.time, OWN_LIFT):
            return
        if event.event == 'arrived' and event.detail.startswith('floor '):
            floor = int(event.detail.split()[1])
            self._belief.near(self._home.by_lift & (self._home.floor == floor), DEVICE)
            self.last = f'elevator {event.source}', event.time

    def _light(self, event: Event) -> None:
        sensor = self._places.get((event.kind, event.source))
        if sensor is None:
            return
        room = self._home.room[self._home.cell_at(sensor.pose[0], sensor.pose[1], sensor.floor)]
        self._belief.near(self._home.room == room, LIGHT)
        self.last = event.source, event.time

    def _point(self, event: Event, robot: RobotNow) -> None:
        place = self._places.get((event.kind, event.source))
        if place is None:
            return
        x, y = place.pose[:2]
        if robot.floor == place.floor and np.hypot(robot.x - x, robot.y - y) < ROBOT_NEAR:
            return
        if event.kind == 'switch' and self._robots_door(x, y, place.floor, robot, event.time):
            return
        if self._new(x, y, place.floor, event):
            self._belief.near(self._home.around(x, y, place.floor, POINT[event.kind]), DEVICE)
        self.last = event.source, event.time

    def _robots_door(self, x: float, y: float, floor: int, robot: RobotNow, now: float) -> bool:
        """Whether the robot has just commanded the door at a place."""
        return any(where == floor and math.dist(door.middle, (x, y)) < 1.0
                   and robot.commanded_lately('door', name, now, OWN)
                   for name, (where, door) in self._doors.items())
