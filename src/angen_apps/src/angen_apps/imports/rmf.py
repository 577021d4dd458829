"""Reads buildings of Open-RMF's traffic editor (building.yaml): pixels with y down, a level each.
"""
from dataclasses import dataclass, replace
from math import atan2, hypot, pi, sin
from pathlib import Path
from statistics import median
from typing import Any, Sequence

import yaml

from angen_apps.imports.flood import rooms_of
from angen_apps.imports.source import FARTHEST
from angen_apps.plan.doors import LEAF_THICK
from angen_apps.plan.finish import finish
from angen_apps.plan.lifts import fitted, shaft
from angen_apps.plan.model import Leaf, Lift, Opening, Plan, Point, Storey, Wall
from angen_apps.plan.names import plain_name, slug
from angen_apps.plan.walls import SLOPE, direction, footprint
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import edges, local, turned
from angen_tools.common.text_file import read_bytes
from angen_tools.common.yaml_file import Entries, YamlFile, line_of

THICK = 0.1  # m of a wall, as the editor builds it
HEIGHT = 2.5  # m of a wall, unless the file says
SLAB = 0.2  # m
DOOR_HEIGHT = 2.1  # m
LAP = 0.03  # m of a leaf before the jamb, where it slides before the wall
SLIDING = ('sliding', 'telescope')  # panels that slide one behind the other are built as one
LIMIT = 20_000  # entries of a list
READ = ('vertices', 'walls', 'doors', 'measurements', 'fiducials', 'elevation', 'drawing')
ALIASES = 100
LEAST_CABIN = 0.6  # m


@dataclass
class _Level:
    """A level's nodes, and its scale in m a pixel."""

    name: str
    nodes: Entries
    scale: float
    elevation: float
    points: list[tuple[float, float]]  # pixels
    called: list[str]
    offset: Point = (0.0, 0.0)  # m, translation to the frame of the first level


def read_rmf(path: Path) -> Plan:
    """The plan of a building; Failure if it cannot be read."""
    return _Building(path).plan()


class _Building:
    def __init__(self, path: Path) -> None:
        data = read_bytes(path)
        if data.count(b'*') + data.count(b'&') > ALIASES:
            _reject_aliases(path, data)
        self.file = YamlFile(path)
        self.path = path
        self.remarks: list[str] = []
        self.root = self._mapping(self.file.root, 'the building')
        if 'levels' not in self.root:
            raise self.file.fail(self.file.root, 'has no levels; it is not a building of the '
                                 'traffic editor')

    def plan(self) -> Plan:
        levels = [self._level(key, node) for key, node
                  in self._mapping(self.root['levels'], 'levels').items()]
        if not levels:
            raise self.file.fail(self.root['levels'], 'the building has no level')
        levels.sort(key=lambda level: level.elevation)
        _align(levels, [self._fiducials(level) for level in levels])
        storeys = []
        for number, level in enumerate(levels):
            above = levels[number + 1].elevation if number + 1 < len(levels) else None
            height = HEIGHT if above is None else max(0.5, above - level.elevation)
            storey = Storey(number, level.name, level.elevation, height, SLAB)
            self._walls(level, storey)
            self._doors(level, storey)
            storeys.append(storey)
        if not any(storey.walls for storey in storeys):
            raise self.file.fail(self.root['levels'], 'no level has walls')
        plan = Plan(slug(self.path.name.partition('.')[0], 'building'), storeys,
                    remarks=self.remarks)
        self._lifts(plan, levels)
        for storey, level in zip(storeys, levels):
            labels = [(self._meters(level, point), text)
                      for point, text in zip(level.points, level.called) if text]
            storey.rooms = rooms_of(storey, HEIGHT, labels)
            for lift in plan.lifts:
                if lift.stops[0] <= storey.number <= lift.stops[-1]:
                    storey.cutouts.append(shaft(lift))
        self._report_unread()
        return finish(plan)

    def _mapping(self, node: Any, what: str) -> Entries:
        if not isinstance(node, yaml.MappingNode):
            raise self.file.fail(node, f'{what} must be a mapping')
        if len(node.value) > LIMIT:
            raise self.file.fail(node, f'{what} has more than {LIMIT} entries')
        return Entries((str(getattr(key, 'value', '')), value) for key, value in node.value)

    def _list(self, node: Any, what: str) -> list[Any]:
        if node is None:
            return []
        if not isinstance(node, yaml.SequenceNode):
            raise self.file.fail(node, f'{what} must be a list')
        if len(node.value) > LIMIT:
            raise self.file.fail(node, f'{what} has more than {LIMIT} entries')
        return list(node.value)

    def _typed(self, node: Any, what: str) -> Any:
        """The value of [type, value]."""
        items = self._list(node, what)
        if len(items) != 2:
            raise self.file.fail(node, f'{what} must be [type, value]')
        return items[1]

    def _level(self, name: str, node: Any) -> _Level:
        nodes = self._mapping(node, f'the level {name}')
        elevation = nodes.of('elevation', self.file.number, 0.0, -200, 1000)
        points, called = [], []
        for vertex in self._list(nodes.get('vertices'), 'vertices'):
            items = self._list(vertex, 'a vertex')
            if len(items) < 2:
                raise self.file.fail(vertex, 'a vertex must be [x, y, z, name]')
            points.append((self.file.number(items[0], 'x', -1e6, 1e6),
                           self.file.number(items[1], 'y', -1e6, 1e6)))
            text = str(items[3].value) if len(items) > 3 and isinstance(
                items[3], yaml.ScalarNode) else ''
            called.append(text.strip())
        level = _Level(name, nodes, 1.0, elevation, points, called)
        level.scale = self._scale(level, node)
        for (x, y), vertex in zip(points, self._list(nodes.get('vertices'), 'vertices')):
            if max(abs(x), abs(y)) * level.scale > FARTHEST:
                raise self.file.fail(vertex, f'a vertex is more than {FARTHEST:g} m from the '
                                     'origin; check the measurements')
        return level

    def _scale(self, level: _Level, node: Any) -> float:
        scales = []
        for item in self._list(level.nodes.get('measurements'), 'measurements'):
            a, b, values = self._edge(level, item, 'a measurement')
            if 'distance' not in values:
                raise self.file.fail(item, 'a measurement has no distance')
            distance = self.file.number(self._typed(values['distance'], 'distance'), 'distance',
                                        1e-3, 1e5)
            pixels = hypot(a[0] - b[0], a[1] - b[1])
            if pixels < 1e-6:
                raise self.file.fail(item, 'a measurement is between two vertices at one place')
            scales.append(distance / pixels)
        if not scales:
            raise self.file.fail(node, f'the level {level.name} has no measurements; the scale of '
                                 'its drawing is unknown')
        middle = median(scales)
        away = max(abs(scale / middle - 1) for scale in scales)
        if away > 0.002:
            self.remarks.append(f'{self.path}:{line_of(node)}: the measurements of {level.name} '
                                f'differ by {100 * away:.1f} %; their median counts')
        return middle

    def _edge(self, level: _Level, node: Any, what: str
              ) -> tuple[Point, Point, Entries]:
        """Two vertices in pixels, and the properties of [from, to, {…}]."""
        items = self._list(node, what)
        if len(items) < 2:
            raise self.file.fail(node, f'{what} must be [from, to, properties]')
        ends = []
        for item in items[:2]:
            index = self.file.number(item, f'a vertex of {what}', 0, max(len(level.points) - 1, 0))
            if index != int(index) or not level.points:
                raise self.file.fail(item, f'a vertex of {what} must be a whole number')
            ends.append(level.points[int(index)])
        values = self._mapping(items[2], f'properties of {what}') if len(items) > 2 else Entries()
        return ends[0], ends[1], values

    def _meters(self, level: _Level, point: Point) -> Point:
        return (point[0] * level.scale + level.offset[0],
                -point[1] * level.scale + level.offset[1])

    def _fiducials(self, level: _Level) -> dict[str, Point]:
        found = {}
        for item in self._list(level.nodes.get('fiducials'), 'fiducials'):
            items = self._list(item, 'a fiducial')
            if len(items) > 2 and isinstance(items[2], yaml.ScalarNode):
                at = (self.file.number(items[0], 'x', -1e6, 1e6),
                      self.file.number(items[1], 'y', -1e6, 1e6))
                found[str(items[2].value)] = self._meters(level, at)
        return found

    def _walls(self, level: _Level, storey: Storey) -> None:
        z = level.elevation
        for item in self._list(level.nodes.get('walls'), 'walls'):
            a, b, values = self._edge(level, item, 'a wall')
            height = self.file.number(self._typed(values['texture_height'], 'texture_height'),
                                      'texture_height', 0.01, 100) \
                if 'texture_height' in values else HEIGHT
            start, end = self._meters(level, a), self._meters(level, b)
            if hypot(end[0] - start[0], end[1] - start[1]) < 0.01:
                self.remarks.append(f'{self.path}:{line_of(item)}: a wall without length is left '
                                    'out')
                continue
            storey.walls.append(Wall(start, end, THICK, z, z + height))

    def _doors(self, level: _Level, storey: Storey) -> None:
        for item in self._list(level.nodes.get('doors'), 'doors'):
            a, b, values = self._edge(level, item, 'a door')
            texts = Entries((key, self._typed(value, key)) for key, value in values.items())
            kind = texts.of('type', self.file.text, 'hinged')
            start, end = self._meters(level, a), self._meters(level, b)
            width = hypot(end[0] - start[0], end[1] - start[1])
            if not 0.2 < width < 20:
                self.remarks.append(f'{self.path}:{line_of(item)}: a door of {width:.2f} m is '
                                    'left out')
                continue
            yaw = atan2(end[1] - start[1], end[0] - start[0])
            start, width = _clear(storey.walls, start, yaw, width)
            end = turned(start, yaw, width, 0.0)
            leaves = self._leaves(item, kind, width, texts)
            name = plain_name(str(getattr(texts.get('name'), 'value', '') or ''), '')
            storey.openings.append(Opening(
                'door', (start[0] + end[0]) / 2, (start[1] + end[1]) / 2, yaw, width,
                level.elevation, level.elevation + DOOR_HEIGHT, (-THICK / 2, THICK / 2), leaves,
                name=name, source=name))

    def _leaves(self, item: Any, kind: str, width: float, texts: Entries
                ) -> tuple[Leaf, ...]:
        degrees = texts.of('motion_degrees', self.file.number, 90.0, -360, 360)
        way = texts.of('motion_direction', self.file.number, 1.0, -10, 10)
        at_end = texts.of('motion_axis', self.file.text, '') == 'end'
        turn = (1 if way > 0 else -1) * min(abs(degrees), 170) * pi / 180
        half = width / 2
        if kind == 'hinged' and not at_end:
            return (Leaf((-half + 0.005, 0.0), width - 0.01, 0.0, turn),)
        if kind == 'hinged':
            return (Leaf((half - 0.005, 0.0), width - 0.01, pi, -turn),)
        if kind == 'double_hinged':
            ratio = texts.of('right_left_ratio', self.file.number, 1.0, 0.05, 20)
            left = width / (1 + ratio)
            return (Leaf((-half + 0.005, 0.0), left - 0.01, 0.0, turn),
                    Leaf((half - 0.005, 0.0), width - left - 0.01, pi, -turn))
        v = THICK / 2 + 0.01  # it slides along the wall's face
        west = Leaf((-half - LAP, v), (width if kind in SLIDING else half) + LAP, 0.0, 0.0)
        east = Leaf((half + LAP, v + LEAF_THICK), west.width, pi, 0.0)
        if kind in SLIDING:
            return (replace(east if at_end else west, slide=-width),)
        if kind in ('double_sliding', 'double_telescope'):
            return replace(west, slide=-half), replace(east, slide=-half)
        raise self.file.fail(item, f'the door is {kind}, must be hinged, double_hinged, '
                             'sliding, double_sliding, telescope or double_telescope')

    def _lifts(self, plan: Plan, levels: list[_Level]) -> None:
        numbers = {level.name: i for i, level in enumerate(levels)}
        for name, node in self.root.of('lifts', self._mapping, {}).items():
            values = self._mapping(node, f'the lift {name}')
            number = {key: self.file.number(values[key], key, -1e6, 1e6)
                      for key in ('x', 'y', 'width', 'depth') if key in values}
            if len(number) < 4:
                raise self.file.fail(node, f'the lift {name} needs x, y, width and depth')
            yaw = values.of('yaw', self.file.number, 0.0, -100, 100)
            reference = values.of('reference_floor_name', self.file.text, levels[0].name)
            if reference not in numbers:
                raise self.file.fail(node, f'the lift {name} refers to the level "{reference}", '
                                     'which is missing')
            stops = sorted(numbers[level] for level in self._stops(values, node, name)
                           if level in numbers)
            doors = list(values.of('doors', self._mapping, {}).values())
            if len(stops) < 1 or not doors:
                self.remarks.append(f'{self.path}:{line_of(node)}: the lift {name} has no stop or '
                                    'no door and is left out')
                continue
            at = (number['x'], number['y'])
            x, y = self._meters(levels[numbers[reference]], at)
            lift = self._lift(name, node, (x, y, yaw), number, doors, stops)
            around = [wall for storey in plan.storeys if stops[0] <= storey.number <= stops[-1]
                      for wall in storey.walls]
            fit = fitted(lift, around)
            if min(fit.width, fit.depth) < LEAST_CABIN:
                raise self.file.fail(node, f'the lift {name} has walls in its cabin')
            if (fit.width, fit.depth) != (lift.width, lift.depth):
                self.remarks.append(
                    f'{self.path}:{line_of(node)}: the cabin of {name} is {fit.width:.2f} x '
                    f'{fit.depth:.2f} m, as its shaft has no room for {lift.width:g} x '
                    f'{lift.depth:g} m and doors')
            plan.lifts.append(fit)

    def _stops(self, values: Entries, node: Any, name: str) -> list[str]:
        if 'level_doors' in values:
            return [level for level, doors in self._mapping(
                values['level_doors'], 'level_doors').items() if self._list(doors, 'level_doors')]
        return [self.file.text(values[key], key) for key in ('lowest_floor', 'highest_floor')
                if key in values]

    def _lift(self, name: str, node: Any, place: tuple[float, float, float],
              number: dict[str, float], doors: list[Any], stops: list[int]) -> Lift:
        if not (LEAST_CABIN <= number['width'] <= 20 and LEAST_CABIN <= number['depth'] <= 20):
            raise self.file.fail(node, f'the lift {name} has a width or depth beyond 0.6 to 20 m')
        door = self._mapping(doors[0], 'a door of a lift')
        u = door.of('x', self.file.number, 0.0, -50, 50)
        v = door.of('y', self.file.number, number['depth'] / 2, -50, 50)
        if len(doors) > 1:
            self.remarks.append(f'{self.path}:{line_of(node)}: the lift {name} has {len(doors)} '
                                'doors; the first is built')
        x, y, yaw = place
        if abs(v) >= abs(u):  # its width is across the doorway
            heading = yaw + (pi / 2 if v > 0 else -pi / 2)
            wide, deep = number['width'], number['depth']
        else:
            heading = yaw + (0.0 if u > 0 else pi)
            wide, deep = number['depth'], number['width']
        doorway = door.of('width', self.file.number, 1.2, 0.3, 20)
        return Lift(plain_name(name, 'lift'), x, y, heading, wide, deep, tuple(stops), doorway)

    def _report_unread(self) -> None:
        skipped: dict[str, int] = {}
        for node in self._mapping(self.root['levels'], 'levels').values():
            for key, value in self._mapping(node, 'a level').items():
                if key not in READ and isinstance(value, (yaml.SequenceNode, yaml.MappingNode)) \
                        and value.value:
                    skipped[key] = skipped.get(key, 0) + len(value.value)
        if skipped:
            self.remarks.append(f'{self.path}: not read: ' + ', '.join(
                f'{count} {key}' for key, count in sorted(skipped.items())))
        self.remarks.append(f'{self.path}: rooms are found between the walls; a vertex with a '
                            'name gives its room that name')


def _clear(walls: Sequence[Wall], start: Point, yaw: float, width: float) -> tuple[Point, float]:
    """The part of a doorway that is free of crossing walls which end in it."""
    low, high = 0.0, width
    for wall in walls:
        if abs(sin(direction(wall) - yaw)) < sin(SLOPE):  # the doorway is cut into it
            continue
        within = _within([local(start, yaw, corner) for corner in footprint(wall)])
        if not within:
            continue
        first, last = min(within), max(within)
        if first < 0.01 < last < width / 3:
            low = max(low, last)
        elif width * 2 / 3 < first < width - 0.01 < last:
            high = min(high, first)
    return turned(start, yaw, low, 0.0), high - low


def _within(corners: Sequence[Point]) -> list[float]:
    """Where, along a doorway, a wall's outline is within it or crosses its faces."""
    half = THICK / 2
    found = [u for u, v in corners if abs(v) <= half]
    for (u0, v0), (u1, v1) in edges(corners):
        found += [u0 + (u1 - u0) * (face - v0) / (v1 - v0) for face in (-half, half)
                  if (v0 - face) * (v1 - face) < 0]
    return found


def _reject_aliases(path: Path, data: bytes) -> None:
    count = 0
    for event in yaml.parse(data, yaml.CSafeLoader):
        count += isinstance(event, yaml.AliasEvent)
        if count > ALIASES:
            raise Failure(f'{path}:{event.start_mark.line + 1}: has more than {ALIASES} aliases')


def _align(levels: list[_Level], fiducials: list[dict[str, Point]]) -> None:
    """Moves each level so that its fiducials are, in the mean, over those of the first level."""
    for level, own in zip(levels[1:], fiducials[1:]):
        common = sorted(own.keys() & fiducials[0].keys())
        if common:
            away = [(fiducials[0][name][0] - own[name][0], fiducials[0][name][1] - own[name][1])
                    for name in common]
            level.offset = (sum(x for x, _ in away) / len(away),
                            sum(y for _, y in away) / len(away))
