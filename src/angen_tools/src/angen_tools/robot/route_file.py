"""A patrol's route, read from its YAML file: where to go, and how fast."""
from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from angen_tools.common.failure import Failure
from angen_tools.robot.planner import Point


@dataclass(frozen=True)
class Waypoint:
    name: str
    floor: int
    at: Point  # m, in the world
    line: int


@dataclass(frozen=True)
class Lift:
    """An elevator: its name, and where a robot stands in its cabin and before it (m)."""

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
        """Failure that names a waypoint and its line."""
        return Failure(f'{self.path}:{waypoint.line}: waypoint {waypoint.name}: {what}')


# key: least and greatest value that it may have, and the one that it has where it is not given
NUMBERS = {'clearance': (0.05, 1.0, 0.22), 'speed': (0.02, 2.0, 0.5), 'turn': (0.1, 5.0, 1.5),
           'acceleration': (0.05, 5.0, 0.5), 'door_room': (0.05, 1.0, 0.3)}
KEYS = ('robot', *NUMBERS, 'elevator', 'waypoints')


def read_route(path: Path) -> Route:
    """The route of a file; Failure says file, line, what is wrong and what would be right."""
    try:
        text = path.read_text()
    except (OSError, UnicodeDecodeError) as error:
        raise Failure(f'{path}: cannot be read: {getattr(error, "strerror", error)}') from None
    try:
        root = yaml.compose(text, yaml.SafeLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, 'problem_mark', None)
        line = mark.line + 1 if mark else 1
        raise Failure(f'{path}:{line}: is not YAML: {getattr(error, "problem", error)}') from None
    return _Reader(path).route(root)


class _Reader:
    """Takes a file's nodes apart."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def _fail(self, node: Any, what: str) -> Failure:
        line = node.start_mark.line + 1 if node is not None else 1
        return Failure(f'{self._path}:{line}: {what}')

    def route(self, root: Any) -> Route:
        entries = self._entries(root, 'a route', KEYS)
        if 'waypoints' not in entries:
            raise self._fail(root, 'has no waypoints: give a list of {name, floor, at: [x, y]}')
        listed = entries['waypoints']
        if not isinstance(listed, yaml.SequenceNode) or not listed.value:
            raise self._fail(listed, 'waypoints must be a list of {name, floor, at: [x, y]}')
        numbers = {key: self._number(entries[key], key, low, high) if key in entries else usual
                   for key, (low, high, usual) in NUMBERS.items()}
        robot = self._text(entries['robot'], 'robot') if 'robot' in entries else 'turtlebot'
        lift = self._lift(entries['elevator']) if 'elevator' in entries else None
        return Route(self._path, [self._waypoint(node) for node in listed.value], robot,
                     elevator=lift, **numbers)

    def _entries(self, node: Any, what: str, keys: tuple[str, ...]) -> dict[str, Any]:
        if not isinstance(node, yaml.MappingNode):
            raise self._fail(node, f'{what} must have {", ".join(keys)}')
        found: dict[str, Any] = {}
        for key, value in node.value:
            if key.value not in keys:
                raise self._fail(key, f"'{key.value}' is not known; known are {', '.join(keys)}")
            if key.value in found:
                raise self._fail(key, f"'{key.value}' is there twice")
            found[key.value] = value
        return found

    def _all(self, node: Any, what: str, keys: tuple[str, ...]) -> dict[str, Any]:
        found = self._entries(node, what, keys)
        for key in keys:
            if key not in found:
                raise self._fail(node, f'{what} has no {key}; it must have {", ".join(keys)}')
        return found

    def _waypoint(self, node: Any) -> Waypoint:
        entries = self._all(node, 'a waypoint', ('name', 'floor', 'at'))
        name = self._text(entries['name'], 'name')
        floor = self._number(entries['floor'], 'floor', 0, 1000)
        if floor != int(floor):
            raise self._fail(entries['floor'], f'floor is {floor:g}, must be 0, 1, …')
        return Waypoint(name, int(floor), self._point(entries['at'], 'at'),
                        node.start_mark.line + 1)

    def _lift(self, node: Any) -> Lift:
        entries = self._all(node, 'elevator', ('name', 'cabin', 'landing'))
        return Lift(self._text(entries['name'], 'name'), self._point(entries['cabin'], 'cabin'),
                    self._point(entries['landing'], 'landing'))

    def _text(self, node: Any, what: str) -> str:
        if not isinstance(node, yaml.ScalarNode) or not node.value.strip():
            raise self._fail(node, f'{what} must be a name')
        return str(node.value)

    def _point(self, node: Any, what: str) -> Point:
        if not isinstance(node, yaml.SequenceNode) or len(node.value) != 2:
            raise self._fail(node, f'{what} must be [x, y] in m')
        x, y = (self._number(part, what, -1000, 1000) for part in node.value)
        return x, y

    def _number(self, node: Any, what: str, low: float, high: float) -> float:
        text = node.value if isinstance(node, yaml.ScalarNode) else 'no number'
        try:
            value = float(text)
        except ValueError:
            raise self._fail(node, f"{what} is '{text}', must be a number") from None
        if not (math.isfinite(value) and low <= value <= high):
            raise self._fail(node, f'{what} is {value:g}, must be {low:g} to {high:g}')
        return value
