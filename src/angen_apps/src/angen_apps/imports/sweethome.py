"""Reads homes of Sweet Home 3D (5.3 and later). The file has cm and y down; plans have m and y up.
"""
from dataclasses import replace
from math import cos, pi, sin
from pathlib import Path
from typing import Iterator

from lxml import etree

from angen_apps.imports.flood import rooms_of
from angen_apps.imports.meshes import Meshes
from angen_apps.imports.source import Xml, home_xml, root_of
from angen_apps.imports.things import Entry, table, what_is
from angen_apps.plan.finish import finish
from angen_apps.plan.model import (Color, Lamp, Leaf, Opening, Piece, Plan, Room, Storey, Wall)
from angen_apps.plan.names import slug
from angen_apps.plan.polygons import base, cleaned, crosses_itself, split
from angen_apps.plan.walls import arc, cuts_wall
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import center, contains, turned

FLUX = 1600.0  # lm of a light of full power; 0.5, the default, is a bulb of 800 lm
DEFAULT_HEIGHT = 2.5  # m
SAME_LEVEL = 0.01  # m
SILL = 0.4  # m: a lower opening without a leaf is a passage
THRESHOLD = 0.3  # m: a glazed door's sill is below this
WALKABLE = 1.8  # m, height of openings that people walk through
FRAME = 0.02  # m of a window's frame above and below its sashes
ROOM_LIMIT = 2000  # corners of a room
PERSON = 'person'  # a figure for the scale, in the table of things
LIMITS = {'wall': 5000, 'room': 1000, 'doorOrWindow': 2000, 'level': 50}


def read_sweethome(path: Path, things: Path | None = None, with_meshes: bool = False) -> Plan:
    """The plan of a .sh3d file or of its Home.xml; Failure if it cannot be read."""
    xml = home_xml(path)
    return _Home(xml, path, things, with_meshes).plan()


class _Home:
    def __init__(self, xml: Xml, path: Path, things: Path | None, with_meshes: bool) -> None:
        self.xml, self.path = xml, path
        self.root = root_of(xml, 'home')
        self.table = table(things)
        self.remarks: list[str] = []
        self.meshes = Meshes(path, xml, self.remarks) if with_meshes else None
        self.height = xml.length(self.root, 'wallHeight', DEFAULT_HEIGHT, 0.1, 100)
        self.storeys = self._levels()
        for tag, most in LIMITS.items():
            if sum(1 for _ in self.root.iter(tag)) > most:
                raise xml.fail(self.root, f'has more than {most} <{tag}>')

    def plan(self) -> Plan:
        for element in self.root.findall('wall'):
            self._wall(element)
        if not any(storey.walls for storey in self.storeys.values()):
            left_out = '' if self.root.find('wall') is None else \
                ' with length, thickness and height'
            raise self.xml.fail(self.root, f'has no <wall>{left_out}; a home needs walls')
        for element in self.root.findall('room'):
            self._room(element)
        for element in self._visible('doorOrWindow'):
            self._opening(element)
        self._join_layers()
        self._find_rooms()
        for element in self._visible('light'):
            self._light(element)
        for element in self._visible('pieceOfFurniture'):
            self._piece(element)
        compass = self.root.find('compass')
        north, latitude = pi / 2, None
        if compass is not None:
            # counted clockwise from the top of the page
            north = pi / 2 - self.xml.number(compass, 'northDirection', 0.0, -100, 100)
            north = (north + pi) % (2 * pi) - pi
            if compass.get('latitude') is not None:
                latitude = self.xml.number(compass, 'latitude', None, -pi / 2, pi / 2) * 180 / pi
        plan = Plan(slug(self.path.stem, 'home'), list(self._numbered()), north, latitude,
                    remarks=self.remarks)
        if self.meshes is not None:
            plan.meshes = self.meshes.files
            if self.meshes.missing:
                self.remarks.append(f'{self.path}: {self.meshes.missing} pieces have no OBJ mesh '
                                    'that can be read and look like boxes')
        return finish(plan)

    def _levels(self) -> dict[str | None, Storey]:
        found: dict[str | None, Storey] = {}
        for element in self.root.findall('level'):
            key = element.get('id')
            if not key or key in found:
                raise self.xml.fail(element, '<level> needs an id of its own')
            found[key] = Storey(0, element.get('name') or key,
                                self.xml.length(element, 'elevation', None, -200, 200),
                                self.xml.length(element, 'height', self.height, 0.05, 100),
                                self.xml.length(element, 'floorThickness', 0.12, 0.0, 10))
        if not found:
            found[None] = Storey(0, 'Ground floor', 0.0, self.height)
        return found

    def _numbered(self) -> list[Storey]:
        """The levels from below, numbered; those at one height keep the order of the file."""
        ordered = sorted(self.storeys.values(), key=lambda storey: storey.elevation)
        for number, storey in enumerate(ordered):
            storey.number = number
        return ordered

    def _storey(self, element: etree._Element) -> Storey:
        key = element.get('level')
        if None in self.storeys:
            return self.storeys[None]
        if key not in self.storeys:
            group = element.getparent()
            if key is None and group is not None and group.tag == 'furnitureGroup':
                return self._storey(group)
            known = ', '.join(str(level) for level in self.storeys)
            raise self.xml.fail(element, f'<{element.tag}> is on the level "{key}", which is '
                                f'missing; there are {known}')
        return self.storeys[key]

    def _remark(self, element: etree._Element, text: str) -> None:
        self.remarks.append(f'{self.xml.name}:{element.sourceline}: {text}')

    def _wall(self, element: etree._Element) -> None:
        xml, storey = self.xml, self._storey(element)
        start = (xml.length(element, 'xStart'), -xml.length(element, 'yStart'))
        end = (xml.length(element, 'xEnd'), -xml.length(element, 'yEnd'))
        thick = xml.length(element, 'thickness', None, 0.0, 20)
        height = xml.length(element, 'height', self.height, 0.0, 100)
        last = xml.length(element, 'heightAtEnd', height, 0.0, 100)
        if thick < 0.005 or max(height, last) < 0.01 or (
                abs(start[0] - end[0]) + abs(start[1] - end[1]) < 0.005):
            self._remark(element, 'a wall without length, thickness or height is left out')
            return
        color = _color(element.get('rightSideColor') or element.get('leftSideColor'),
                       (0.92, 0.92, 0.9))
        extent = xml.number(element, 'arcExtent', 0.0, -2 * pi + 0.01, 2 * pi - 0.01)
        # with y up, clockwise turns become counterclockwise
        points = arc(start, end, -extent)
        heights = [height + (last - height) * i / (len(points) - 1) for i in range(len(points))]
        z = storey.elevation
        pairs = zip(points, points[1:], heights, heights[1:])
        for part, (a, b, first, then) in enumerate(pairs):
            slope = None if abs(then - first) < 1e-4 else z + then
            storey.walls.append(Wall(a, b, thick, z, z + first, slope, color, part))

    def _room(self, element: etree._Element) -> None:
        xml, storey = self.xml, self._storey(element)
        points = cleaned([(xml.length(point, 'x'), -xml.length(point, 'y'))
                          for point in element.findall('point')[:ROOM_LIMIT + 1]])
        if len(element.findall('point')) > ROOM_LIMIT:
            raise xml.fail(element, f'a room has more than {ROOM_LIMIT} corners')
        name = (element.get('name') or '').strip()
        called = f'the room "{name}"' if name else 'a room without a name'
        if len(points) < 3 or not split(points):
            self._remark(element, f'{called} has no area and is left out')
            return
        if crosses_itself(points):
            raise xml.fail(element, f'{called} crosses itself; draw it as a simple polygon')
        outline, *holes = split(points)
        storey.rooms.append(Room(
            name, '', tuple(outline), storey.elevation, storey.height if None not in self.storeys
            else self.height, element.get('floorVisible') != 'false',
            element.get('ceilingVisible') != 'false',
            _color(element.get('floorColor'), (0.65, 0.55, 0.42)),
            tuple(tuple(hole) for hole in holes if contains(outline, *center(hole)))))

    def _box(self, element: etree._Element) -> tuple[float, float, float, float, float, float]:
        """x, y, elevation, width, depth, height of a piece."""
        xml = self.xml
        return (xml.length(element, 'x'), -xml.length(element, 'y'),
                xml.length(element, 'elevation', 0.0, -100, 100),
                xml.length(element, 'width', None, 0.0, 100),
                xml.length(element, 'depth', None, 0.0, 100),
                xml.length(element, 'height', None, 0.0, 100))

    def _yaw(self, element: etree._Element) -> float:
        return -self.xml.number(element, 'angle', 0.0, -1e4, 1e4)

    def _visible(self, tag: str) -> Iterator[etree._Element]:
        """The pieces of furniture with a tag; one on a level that is missing is left out, and one
        that cannot be seen."""
        for element in self.root.iter(tag):
            try:
                self._storey(element)
            except Failure as failure:
                self.remarks.append(f'{failure}; it is left out')
                continue
            why = 'has no size' if min(self._box(element)[3:]) < 1e-3 else ''
            if element.get('visible') == 'false':
                why = 'is not visible'
            if why:
                self._remark(element, f'{tag} "{element.get("name", "")}" {why} and is left out')
            else:
                yield element

    def _opening(self, element: etree._Element) -> None:
        xml, storey = self.xml, self._storey(element)
        x, y, elevation, width, depth, height = self._box(element)
        yaw, mirrored = self._yaw(element), element.get('modelMirrored') == 'true'
        leaves = tuple(self._leaf(sash, width, depth, mirrored)
                       for sash in element.findall('sash'))
        name = element.get('name', '').strip()
        text = f'{element.get("catalogId", "")} {name}'.lower()
        thick = xml.number(element, 'wallThickness', 1.0, 0.0, 1.0) * depth
        away = xml.number(element, 'wallDistance', 0.0, 0.0, 1.0) * depth
        band = (depth / 2 - away - max(thick, 0.02), depth / 2 - away)
        bottom = storey.elevation + elevation
        is_window = 'window' in text or (elevation > SILL and 'door' not in text)
        kind = 'window' if is_window else 'door'
        glass = False
        if not leaves and 'slid' in text:
            leaves = _sliding(width, sum(band) / 2)
        if not leaves:
            glass = is_window
            kind = 'window' if is_window else 'opening'
        elif is_window and elevation < THRESHOLD and height > WALKABLE:  # one walks through it
            kind, bottom, height = 'door', storey.elevation, bottom + height - storey.elevation
        low = max(bottom, storey.elevation)
        opening = Opening(kind, x, y, yaw, width, low, max(bottom + height, low + 0.05), band,
                          leaves, glass, is_window, 'opendoor' in text, source=name)
        if leaves:
            opening = _as_wide_as_leaves(opening)
        storey.openings.append(opening)

    def _join_layers(self) -> None:
        """Joins levels at one height: gives openings to the level of their walls, and rooms of a
        level without walls to one with walls."""
        for storey in self.storeys.values():
            same = [other for other in self.storeys.values() if other is not storey
                    and other.walls and abs(other.elevation - storey.elevation) < SAME_LEVEL]
            if same and not storey.walls:
                same[0].rooms += storey.rooms
                storey.rooms = []
            for opening in list(storey.openings) if same else ():
                at = [each for each in (storey, *same)
                      if any(cuts_wall(opening, wall) for wall in each.walls)]
                storey.openings.remove(opening)
                (at or [storey])[0].openings.append(opening)

    def _find_rooms(self) -> None:
        """The rooms between the walls of each level of a home that has none; their contents tell
        their use."""
        if any(storey.rooms for storey in self.storeys.values()):
            return
        for storey in self.storeys.values():
            if storey.walls:
                storey.rooms = rooms_of(storey, self.height if None in self.storeys
                                        else storey.height, ())
                self.remarks.append(f'{self.path}: has no <room>; {len(storey.rooms)} are found '
                                    f'between the walls of {storey.name}')

    def _leaf(self, sash: etree._Element, width: float, depth: float, mirrored: bool) -> Leaf:
        xml = self.xml
        sign = -1.0 if mirrored else 1.0
        u = (xml.number(sash, 'xAxis', None, -1, 2) - 0.5) * width * sign
        v = (0.5 - xml.number(sash, 'yAxis', None, -1, 2)) * depth
        start = xml.number(sash, 'startAngle', None, -7, 7)
        end = xml.number(sash, 'endAngle', None, -7, 7)
        if abs(sin(start)) > abs(sin(end)) + 1e-3:  # it is drawn open
            start, end = end, start
        turn = max(-pi, min(pi, (end - start) * sign))
        shut = pi - start if mirrored else start
        return Leaf((u, v), xml.number(sash, 'width', None, 0.01, 2) * width, shut, turn)

    def _light(self, element: etree._Element) -> None:
        xml, storey = self.xml, self._storey(element)
        x, y, elevation, width, depth, height = self._box(element)
        name = element.get('name', '').strip()
        sources = element.findall('lightSource')
        yaw = self._yaw(element)
        sign = -1.0 if element.get('modelMirrored') == 'true' else 1.0
        u = v = 0.0
        z = height / 2
        color: Color = (1.0, 0.95, 0.85)
        if sources:
            count = len(sources)
            u = sum(xml.number(s, 'x', None, -2, 3) - 0.5 for s in sources) / count * width * sign
            v = sum(0.5 - xml.number(s, 'y', None, -2, 3) for s in sources) / count * depth
            z = sum(xml.number(s, 'z', None, -2, 3) for s in sources) / count * height
        power = xml.number(element, 'power', 0.5, 0.0, 1.0)
        storey.lamps.append(Lamp(
            name, *turned((x, y), yaw, u, v), storey.elevation + elevation + z, power * FLUX,
            color, name))

    def _piece(self, element: etree._Element) -> None:
        xml, storey = self.xml, self._storey(element)
        x, y, elevation, width, depth, height = self._box(element)
        catalog, name = element.get('catalogId', ''), element.get('name', '').strip()
        entry = what_is(self.table, catalog, name)
        if entry is not None and entry.thing == PERSON:
            self._remark(element, f'"{name}" is a person and is left out')
            return
        if entry is None:
            self._remark(element, f'"{name}" is unknown; it is a box of its size')
            entry = Entry('', '', '', 'box', ())
        tilt = (xml.number(element, 'roll', 0.0, -1e4, 1e4),
                xml.number(element, 'pitch', 0.0, -1e4, 1e4))
        z = storey.elevation + elevation
        yaw = self._yaw(element) - pi / 2
        if any(tilt):  # its frame has the pitch about the width and the roll about the depth
            z += xml.length(element, 'heightInPlan', height, 0.0, 100) / 2
            tilt = (tilt[0], -tilt[1]) if abs(tilt[0]) > 1e-6 else (0.0, -tilt[1])
        piece = Piece(entry.thing or name, x, y, z, yaw, width, depth, height, entry.thing,
                      entry.model, entry.shape, tilt,
                      _color(element.get('color'), (0.75, 0.72, 0.66)),
                      self.meshes.take(element) if self.meshes else '', name)
        storey.pieces.append(piece)
        if element.get('staircaseCutOutShape'):
            self._cut_floor(storey, piece)

    def _cut_floor(self, storey: Storey, piece: Piece) -> None:
        """A staircase passes the floor that is above the middle of its height."""
        for other in self.storeys.values():
            if storey.elevation + 0.5 < other.elevation <= piece.z + piece.height:
                other.cutouts.append(tuple(base(piece)))


def _sliding(width: float, v: float) -> tuple[Leaf, ...]:
    """Two panes: one slides before the other, which is fixed."""
    half = width / 2
    return (Leaf((-half, v + 0.005), half, 0.0, 0.0, half - 0.02),
            Leaf((half, v - 0.005), half + 0.01, pi, 0.0))


def _as_wide_as_leaves(opening: Opening) -> Opening:
    """A hole is as wide as its leaves; the frame around them is wall."""
    ends = [u for leaf in opening.leaves
            for u in (leaf.hinge[0], leaf.hinge[0] + leaf.width * cos(leaf.shut))]
    low, high = min(ends) - 0.005, max(ends) + 0.005
    middle = (low + high) / 2
    x, y = opening.point(middle, 0.0)
    leaves = tuple(replace(leaf, hinge=(leaf.hinge[0] - middle, leaf.hinge[1]))
                   for leaf in opening.leaves)
    frame = FRAME if opening.kind == 'window' and opening.top - opening.bottom > 4 * FRAME else 0.0
    return replace(opening, x=x, y=y, width=high - low, leaves=leaves,
                   bottom=opening.bottom + frame, top=opening.top - frame)


def _color(text: str | None, otherwise: Color) -> Color:
    """The color of AARRGGBB."""
    try:
        value = int(text or '', 16)
    except ValueError:
        return otherwise
    r, g, b = ((value >> shift & 255) / 255 for shift in (16, 8, 0))
    return round(r, 3), round(g, 3), round(b, 3)
