"""A patrol's route, read from its YAML file: where to go, and how fast."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from angen_apps.robot.planner import Point
from angen_apps.shipped import shipped
from angen_tools.common.failure import Failure
from angen_tools.common.yaml_file import YamlFile, is_list, line_of


@dataclass(frozen=True)
class Waypoint:
    name: str
    floor: int
    at: Point  # m, in the world
    line: int


@dataclass(frozen=True)
class Lift:
    """An elevator: its name, and the robot's places in its cabin and before it (m)."""

    name: str
    cabin: Point
    landing: Point


@dataclass(frozen=True)
class Route:
    """The contents of a route's file; lengths in m, m/s, rad/s, m/s2."""

    path: Path
    waypoints: list[Waypoint]
    robot: str
    clearance: float
    speed: float
    turn: float
    acceleration: float
    door_room: float
    elevator: Lift | None

    def wrong(self, waypoint: Waypoint, what: str) -> Failure:
        """Failure that names a waypoint, and its line in a file."""
        where = f'{self.path}:{waypoint.line}: waypoint ' if waypoint.line else ''
        return Failure(f'{where}{waypoint.name}: {what}')


# key: least and greatest value that it may have, and the one that it has where it is not given
NUMBERS = {'clearance': (0.05, 1.0, 0.22), 'speed': (0.02, 2.0, 0.5), 'turn': (0.1, 5.0, 1.5),
           'acceleration': (0.05, 5.0, 0.5), 'door_room': (0.05, 1.0, 0.3)}
WAYPOINT, LIFT = ('name', 'floor', 'at'), ('name', 'cabin', 'landing')
KEYS = ('robot', *NUMBERS, 'elevator', 'waypoints')


def read_route(path: Path) -> Route:
    """The route of a file; Failure has the file, the line, the error and its fix."""
    return _Reader(path).route()


def default_route() -> Path:
    """The route of this package."""
    return shipped('patrol.yaml')


class _Reader(YamlFile):

    def route(self) -> Route:
        entries = self.entries(self.root, 'a route', KEYS)
        if 'waypoints' not in entries:
            raise self.fail(self.root, 'has no waypoints: give a list of {name, floor, at: [x, y]}')
        listed = self.list(entries['waypoints'], 'waypoints')
        numbers = {key: entries.of(key, self.number, usual, low, high)
                   for key, (low, high, usual) in NUMBERS.items()}
        return Route(self.path, [self._waypoint(node) for node in listed],
                     entries.of('robot', self.text, 'turtlebot'),
                     elevator=entries.of('elevator', self._lift), **numbers)

    def _waypoint(self, node: Any) -> Waypoint:
        entries = self.entries(node, 'a waypoint', WAYPOINT, WAYPOINT)
        name = self.text(entries['name'], 'name')
        floor = self.number(entries['floor'], 'floor', 0, 1000)
        if floor != int(floor):
            raise self.fail(entries['floor'], f'floor is {floor:g}, must be 0, 1, …')
        return Waypoint(name, int(floor), self._point(entries['at'], 'at'),
                        line_of(node))

    def _lift(self, node: Any, what: str) -> Lift:
        entries = self.entries(node, what, LIFT, LIFT)
        return Lift(self.text(entries['name'], 'name'), self._point(entries['cabin'], 'cabin'),
                    self._point(entries['landing'], 'landing'))

    def _point(self, node: Any, what: str) -> Point:
        if not is_list(node) or len(node.value) != 2:
            raise self.fail(node, f'{what} must be [x, y] in m')
        x, y = (self.number(part, what, -1000, 1000) for part in node.value)
        return x, y
