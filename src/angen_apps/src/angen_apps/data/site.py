"""The home that data comes from: its world, and sensors placed as in the CASAS apartments."""
from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np
from lxml import etree

from angen_apps.residents.floors import Floors
from angen_apps.residents.simulator import Simulator
from angen_apps.robot.entities import Entity, entities_of
from angen_models import plan, world as blocks
from angen_models.catalog import smart_plug
from angen_models.sdf import ANGEN
from angen_tools.common.catalog import kinds, simulator
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.geometry import turned
from angen_tools.common.home import Home, Room
from angen_tools.session.in_process import InProcess
from angen_tools.world import sdf
from angen_tools.world.models import find

CEILING = 0.05  # m below the ceiling where motion sensors are
APART = 1.1  # m: motion sensors of a cell are not nearer to each other
WALL = 0.12  # m from the walls where those of a room are
HIGH = 2.2  # m above the floor
WIDE = math.radians(52.5)  # half of the angle that the sensor of a room sees
CHEST, SPARSE = 1.2, 7  # m above the floor of what it sees of people, at each so many-th free cell
AIR = 300.0  # s between two looks at the temperature
SAMPLES = 25.0  # Hz of motion sensors, a fourth of the default, which costs less
AREAS = ('living', 'kitchen', 'bedroom')  # rooms that have a sensor for all of them
LEFT_OUT = ('plant', 'cup', 'weighing_table', 'pressure_mat')


@dataclass(frozen=True)
class Sensor:
    """One in the data: `id` as datasets call it, `kind` motion, area, door, item, power,
    bell, temperature, light or mains; `source` and `name` of the simulator's sensor, which mains
    has not.
    """

    id: str
    kind: str
    source: str
    name: str
    room: str
    x: float
    y: float
    z: float


LETTERS = {'motion': 'M', 'area': 'M', 'door': 'D', 'item': 'I', 'power': 'S', 'bell': 'B',
           'temperature': 'T', 'light': 'LS'}
MAINS = 'P001'  # the home's power in W, as in the data of CASAS' Kyoto apartments
DOORBELL = (-0.06, 4.3, 1.1, 0.0, 0.0, math.pi)  # beside the entrance, on the landing
BELL = 0.2, 1.1, 0.6  # m beside the frame of an entrance, over its floor, and to its wall at most
STANDBY = 5.0  # W, up to which an appliance is off
HEATING = 21.0  # degrees Celsius; EN 16798-1: 20 at least in living rooms, category II
OWN = ('contact', 'pressure', 'reed')  # on seats, mats, cabinets: a home keeps its own
BY_SOURCE = {'pir': 'motion', 'reed': 'door', 'contact': 'item', 'pressure': 'item',
             'plug': 'power', 'doorbell': 'bell',
             'temperature': 'temperature', 'luminosity': 'light'}


def apartment(path: Path) -> None:
    """Writes the world of one furnished apartment without sensors and people."""
    root, world = blocks.new_world('home')
    blocks.add_world_plugins(world)
    blocks.add_home_site(world)
    blocks.include(world, 'apartment', 'apartment0', (0, 0, 0, 0, 0, 0))
    blocks.add_devices(world, 0)
    for room in plan.FURNITURE:
        for model, name, pose in blocks.furniture_in(room, 0):
            if model not in LEFT_OUT:
                blocks.include(world, model, name, pose)
    blocks.add_openers(world, 0)
    for room, (model, x, y, height, yaw) in plan.APPLIANCES.items():
        blocks.include(world, model, f'{room}_{model}0', (x, y, height, 0, 0, yaw))
    blocks.include(world, 'doorbell', 'entrance_doorbell0', DOORBELL)
    blocks.add_state(world, 'home')
    etree.cleanup_namespaces(root, top_nsmap={'angen': ANGEN})
    write_text(path, f'<?xml version="1.0"?>\n{sdf.text(root)}')


class Site:
    """A home to live in: world, description, floors, and its sensors by rule or of its own.

    `rare_air`: the thermometers that it places read every AIR s only, which is cheaper.
    """

    def __init__(self, path: Path, seed: int, placed: bool = True, light: bool = False,
                 rare_air: bool = False) -> None:
        with simulator() as angen:
            self.world = angen.World(str(path), seed)
            bare = angen.World(str(path), seed)
        for kind, _, model, _ in self.world.entities():
            if kind in ('person', 'drive') and model in self.world.models:
                self.world.delete(model)
        self.home = Home.of_world(self.world)
        if not self.home.rooms:
            raise Failure(f'{path}: describes no rooms; see docs/home.md')
        self.floors = Floors(bare, self.home)
        bare.step()  # climates tell their rooms from then on
        self.with_air = {room for kind, name, _, _ in bare.entities() if kind == 'climate'
                         for room in bare.device(kind, name)['names']}
        self.simulator = Simulator(InProcess(self.world, long_steps=True), self.home)
        if placed:
            self._clear()
            _Placer(self, light, rare_air).place()
        self._heat()
        self.sensors = self.listed()
        if placed:
            self.sensors.append(Sensor(MAINS, 'mains', '', 'mains', '', 0.0, 0.0, 0.0))

    def _clear(self) -> None:
        """Deletes the world's sensors that the rules replace or that are not in the data: light
        unread sensors cost an hour a day."""
        for kind, name, model, _ in self.world.entities():
            if kind in kinds('sensor') and kind not in OWN:
                self.world.delete(name)

    def _heat(self) -> None:
        """Radiators heat every home whose world does not say to which temperature."""
        if '<heating>' in self.world.save():
            return
        for kind, name, _, _ in self.world.entities():
            if kind == 'climate':
                self.simulator.command(kind, name, f'Heat {HEATING:g}')

    def listed(self) -> list[Sensor]:
        """The sensors by id, counted from 1 by kind in the order of their names."""
        found: dict[str, list[tuple[str, str, Entity]]] = {}
        for entity in entities_of(InProcess(self.world)):
            kind = BY_SOURCE.get(entity.kind)
            if kind is None:
                continue
            if kind == 'motion' and entity.name.startswith('area_'):
                kind = 'area'
            found.setdefault(LETTERS[kind], []).append((entity.name, kind, entity))
        sensors = []
        for letter in sorted(found):
            for number, (name, kind, entity) in enumerate(sorted(found[letter],
                                                                 key=lambda e: e[0]), 1):
                x, y, z = (round(value, 3) for value in entity.pose[:3])
                sensors.append(Sensor(f'{letter}{number:03d}', kind, entity.kind, name,
                                      entity.room, x, y, z))
        return sensors


def corner(room: Room, number: int) -> tuple[float, float]:
    """Beside a corner of a room, inside."""
    at = room.polygon[number % len(room.polygon)]
    cx, cy = room.center
    share = 2 * WALL / math.dist(at, (cx, cy))
    return at[0] + (cx - at[0]) * share, at[1] + (cy - at[1]) * share


def facing(room: Room, number: int) -> tuple[float, float, float]:
    """Beside a corner, and the yaw from there to the room's middle."""
    x, y = corner(room, number)
    cx, cy = room.center
    return x, y, math.atan2(cy - y, cx - x)


def _altered(model: str, alter: Callable[[etree._Element], None]) -> str:
    """The text of a model that costs less after its description was altered."""
    path = find(model)
    if path is None:
        raise Failure(f'{model} is not found')
    root = sdf.read(path)
    alter(root)
    return sdf.text(root)


def _sample_rarely(root: etree._Element) -> None:
    """Gives a motion sensor a low sample rate."""
    for plugin in root.iter('plugin'):
        etree.SubElement(plugin, 'sample_rate').text = f'{SAMPLES:g}'


def _read_rarely(root: etree._Element) -> None:
    """Gives a thermometer the rate at which the recorder looks at it."""
    for rate in root.iter('update_rate'):
        rate.text = repr(1.0 / AIR)


class _Placer:
    """Places sensors by rule: over things and behind doors, at doors, in rooms, at the mains."""

    def __init__(self, site: Site, light: bool, rare_air: bool) -> None:
        self.site, self.light, self.rare_air = site, light, rare_air
        self.world, self.home = site.world, site.home
        self.lived = [room for room in self.home.rooms
                      if room.storey in site.floors.grids
                      and room.use not in ('landing', 'outdoor')]

    def place(self) -> None:
        for room in self.lived:
            self._cells(room)
            if room.use in AREAS:
                self._area(room)
            if room.name in self.site.with_air:
                thermometer = 'model://temperature_sensor'
                self._spawn(_altered(thermometer, _read_rarely) if self.rare_air else thermometer,
                            f'{room.name}_temperature', (*corner(room, 0), room.floor + 1.5, 0.0))
            if self.light:
                x, y, yaw = facing(room, 1)
                self._spawn('model://luminosity_sensor', f'{room.name}_light',
                            (x, y, room.floor + HIGH, yaw))
        for door in self.home.doors:
            if door.kind == 'door':
                self._contact(door.name)
        for thing in self.home.things:
            for i, place in enumerate(thing.places):
                if thing.type == 'bed' and place.posture == 'lie':
                    x, y, _, yaw = place.pose
                    z = self.site.floors.support(place)
                    self._spawn('model://pressure_mat', f'{thing.name}_mat_{i}', (x, y, z, yaw))
            self._plug(thing.name)
        self._bell()

    def _spawn(self, what: str, name: str, pose: tuple[float, float, float, float],
               pitch: float = 0.0) -> None:
        x, y, z, yaw = pose
        with simulator(f'{name}: '):
            if name in self.world.models:  # in a saved home
                self.world.delete(name)
            self.world.spawn(what, name, [x, y, z, 0.0, pitch, yaw])

    def _cells(self, room: Room) -> None:
        """Motion sensors at the ceiling, each over a cell of the floor that people use."""
        places = [place.pose[:2] for thing in self.home.things if thing.room == room.name
                  for place in thing.places]
        for door in self.home.doors:
            if door.kind != 'window' and room.name in door.rooms:
                x, y, _, yaw = door.pose
                inside = [turned((x, y), yaw, 0.0, away) for away in (-0.7, 0.7)]
                places += [at for at in inside if room.contains(*at)]
        places.append(room.center)
        kept: list[tuple[float, float]] = []
        for x, y in places:
            if room.contains(x, y) and all(math.dist((x, y), other) >= APART for other in kept):
                kept.append((x, y))
        for i, (x, y) in enumerate(kept):
            self._spawn(_altered('model://pir_casas', _sample_rarely), f'cell_{room.name}_{i:02d}',
                        (x, y, room.ceiling - CEILING, 0.0), math.pi / 2)

    def _area(self, room: Room) -> None:
        """A motion sensor for a whole room, in the corner from which furniture hides least."""
        corners = len(room.polygon)
        best = max(((k + 2) % corners for k in range(corners)),
                   key=lambda number: round(self._seen(room, number), 1))
        x, y, yaw = facing(room, best)
        self._spawn(_altered('model://pir_pyroelectric', _sample_rarely), f'area_{room.name}',
                    (x, y, room.floor + HIGH, yaw))

    def _seen(self, room: Room, number: int) -> float:
        """The share of a room's free floor where a sensor in a corner has a person in sight."""
        floors = self.site.floors
        grid, free = floors.grids[room.storey], floors.floor_of(room)
        rows, columns = (part[::SPARSE] for part in np.nonzero(free))
        if not len(rows):
            return 0.0
        x, y, yaw = facing(room, number)
        begin = np.array([x, y, room.floor + HIGH])
        ways = np.column_stack([grid.x[columns], grid.y[rows],
                                np.full(len(rows), room.floor + CHEST)]) - begin
        lengths = np.linalg.norm(ways, axis=1)
        clear = self.world.cast(np.broadcast_to(begin, ways.shape), ways / lengths[:, None],
                                float(lengths.max()))
        aside = np.remainder(np.arctan2(ways[:, 1], ways[:, 0]) - yaw + math.pi,
                             2 * math.pi) - math.pi
        return float(((np.asarray(clear) > lengths - WALL) & (abs(aside) < WIDE)).mean())

    def _contact(self, door: str) -> None:
        """A reed contact at the upper edge of a leaf, on a model with links base and door."""
        entities = self.world.entities()
        model = next((model for kind, name, model, _ in entities
                      if (kind, name) == ('door', door)), '')
        if any(kind == 'reed' and owner == model for kind, _, owner, _ in entities):
            return
        if not {f'{model}::base', f'{model}::door'} <= set(self.world.links):
            return
        width = next(d.width for d in self.home.doors if d.name == door)
        along = min(0.93, width - 0.07)
        xml = (f'<sensor name="{door}_contact" type="custom"><plugin name="reed" '
               'filename="libreed_contact.so"><magnet_link>door</magnet_link>'
               f'<magnet>{along:.3f} -0.015 2.078</magnet></plugin></sensor>')
        with simulator(f'{door}: '):
            self.world.spawn(xml, f'{door}_contact', [along, -0.015, 2.09, 0.0, 0.0, 0.0],
                             on=f'{model}::base')

    def _bell(self) -> None:
        """A doorbell at the wall beside the main entrance, outside, unless the home has one."""
        door, porch = self.site.floors.entrance(), self.site.floors.porch()
        if door is None or porch is None \
                or any(kind == 'doorbell' for kind, *_ in self.world.entities()):
            return
        x, y, z, yaw = door.pose
        out = (-math.sin(yaw), math.cos(yaw))
        if (porch[0][0] - x) * out[0] + (porch[0][1] - y) * out[1] < 0:
            out = (-out[0], -out[1])
        height = self.home.elevation(porch[1]) + BELL[1]
        for side in (1, -1):
            along = side * (door.width / 2 + BELL[0])
            start = (x + along * math.cos(yaw) + BELL[2] * out[0],
                     y + along * math.sin(yaw) + BELL[2] * out[1], height)
            away = float(self.world.cast([start], [(-out[0], -out[1], 0.0)], 2 * BELL[2])[0])
            if away < 2 * BELL[2]:
                self._spawn('model://doorbell', 'entrance_doorbell',
                            (start[0] - away * out[0], start[1] - away * out[1], height,
                             math.atan2(out[1], out[0])))
                return

    def _plug(self, thing: str) -> None:
        """A smart plug that feeds the appliance there."""
        load = next((f'{kind}/{name}' for kind, name, model, _ in self.world.entities()
                     if model == thing and kind in ('stove', 'appliance', 'heater')), '')
        if load:
            pose = self.world.motion(thing)[0]
            model = smart_plug(f'{thing}_plug', load, standby=STANDBY)
            text = f'<sdf version="1.6">{etree.tostring(model, encoding="unicode")}</sdf>'
            self._spawn(text, f'{thing}_plug', (float(pose[0]), float(pose[1]),
                                                float(pose[2]) + 0.3, 0.0))
