"""Records the reports of a home's sensors while residents live there, and the cause of each."""
from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Iterator, NamedTuple

from angen_apps.data.cabins import Cabins
from angen_apps.data.faults import Happened
from angen_apps.data.site import AIR, Sensor, Site
from angen_apps.residents.chance import chance, spread
from angen_apps.residents.household import Household

ON = {'motion', 'pressed', 'opened', 'on'}
OFF = {'still', 'released', 'closed', 'off'}
VALUES = {'motion': ('ON', 'OFF'), 'area': ('ON', 'OFF'), 'door': ('OPEN', 'CLOSE'),
          'item': ('PRESENT', 'ABSENT'), 'power': ('ON', 'OFF')}
ACTIVE = {values[0] for values in VALUES.values()}
DEGREES = 0.5  # least step of temperature
RECENT = 3.0  # s: a resident who moved within this time may have caused motion
PUSHED = 0.02  # m
HAND = 30.0  # s: a resident who commanded a device within this time has moved it
NEAR = 1.5  # m: a resident within this distance may have sat down there, or is in a cell
CLOSE = 2.0  # m: a resident who moves within this distance may have been detected
CELL = 0.4  # m around the middle of a cell: a sensor must detect motion there
RINGS, TAP = 'rang', 'TAP'  # event of a doorbell, and value of its button
VISITOR = ('', '', 'visitor')  # whose a ring is of one who only comes to the door
LEAST = 1.0  # s: the resident must move there this long
STRIDE = 0.3  # s between two places of a track
FALSE = 'false alarm'  # detail of its events
NOISE = ('', '', 'noise')  # whose it is
START = ('', '', 'start')
MAINS = ('', '', 'power')
WATTS = 5.0  # least change of the mains' power that is reported
FRIDGE = 80.0  # W of a compressor, and the minutes for which it runs and rests: 0.7 kWh a day
RUNS, RESTS = (12.0, 20.0), (22.0, 36.0)
FIRST = 0.01  # s, in which sensors report the state in which they start
HOLD = 2.5  # s before and after, within which an event counts


class Event(NamedTuple):
    """One of a sensor. `cause`: motion, seat, hand, visitor, air, light, power, start, or
    noise."""

    time: float
    sensor: str
    value: str
    resident: str
    activity: str
    cause: str


class Missed(NamedTuple):
    """A resident moved over a sensor's cell without an event."""

    start: float
    end: float
    sensor: str
    resident: str


class Moved(NamedTuple):
    """A resident who stays at a place moved there."""

    time: float
    resident: str


class Step(NamedTuple):
    """The place of a walking resident."""

    time: float
    resident: str
    x: float
    y: float
    storey: int


@dataclass
class Recording:
    """The results of a run."""

    events: list[Event]
    missed: list[Missed]
    power: dict[str, list[tuple[float, float]]]  # W from a time on, by device
    track: list[Step]
    faults: list[Happened]
    moves: list[Moved] = field(default_factory=list)


class Recorder:
    """Follows a household; heard() is called after each part of time."""

    def __init__(self, site: Site, household: Household) -> None:
        self.site, self.household = site, household
        self.recording = Recording([], [], {}, [], [])
        self._by_name = {(s.source, s.name): s for s in site.sensors}
        storeys = {room.name: room.storey for room in site.home.rooms}
        self._storeys = {s.id: storeys.get(s.room, site.home.storey_at(s.z)) for s in site.sensors}
        self._on: dict[str, float] = {}  # when sensors came on
        self._last_on: dict[str, float] = {}
        self._whose: dict[str, tuple[str, str, str]] = {}
        self._air: dict[str, float] = {}
        self._loads = [(kind, name) for kind, name, _, _ in site.world.entities()
                       if kind in ('lamp', 'stove', 'appliance', 'heater')]
        self.cabins = Cabins(site.world)
        self._acted = -1
        self._mains = next((s for s in site.sensors if s.kind == 'mains'), None)
        self._reported = math.nan
        self._looked = 0.0  # s, at power
        self._over: dict[tuple[int, str], tuple[float, float]] = {}  # a cell: first and last time
        self._cells = [s for s in site.sensors if s.kind == 'motion' and s.name.startswith('cell')]
        self._left: list[Missed] = []
        self._stepped: dict[str, float] = {}
        self._late: dict[tuple[str, str], list[tuple[str, str, str]]] = {}  # whose delayed are

    def start(self) -> None:
        """Records the sensors' reports at the start of a run."""
        self.household.heard = self.heard
        self.household.add(self._air_process())
        for thing in self.site.home.things:
            if thing.type == 'fridge':
                self.household.add(self._cool(thing.name))
        self.heard()

    def heard(self) -> None:
        if 0.0 < self.household.now == self._looked:
            return  # less than a tick has passed: commands are executed in the next one
        for resident in self.household.residents:
            if not resident.away and not resident.walks and self._is_pushed(resident):
                resident.look()
            if resident.walks:
                self._follow(resident)
                if resident.looked - self._stepped.get(resident.name, -math.inf) >= STRIDE:
                    self._stepped[resident.name] = resident.looked
                    x, y = resident.at
                    self.recording.track.append(
                        Step(resident.looked, resident.name, x, y, resident.storey))
            elif not resident.away and resident.moved > self._stepped.get(resident.name, 0.0):
                self._stepped[resident.name] = resident.moved
                self.recording.moves.append(Moved(resident.moved, resident.name))
        for time, source, kind, event, detail in self.site.world.events():
            if kind == 'person' and event in ('opens', 'closes'):
                self.household.acts['door', detail] = (float(time), source)
            if kind == 'fault':
                self._note_fault(float(time), source, event, detail)
            elif kind == 'elevator':
                self.cabins.event(float(time), source)
            sensor = self._by_name.get((kind, source))
            if sensor is not None:
                self._note(float(time), sensor, event, detail)
        if self._looked == 0.0 < self.household.now:
            self._note_open()
        self.cabins.look()
        self._note_power()
        self._looked = self.household.now

    def _note_open(self) -> None:
        """Records which contacts were open at the start."""
        opened, closed = VALUES['door']
        first = {event.sensor: event.value for event in reversed(self.recording.events)}
        for sensor in self.site.sensors:
            if sensor.source != 'reed':
                continue
            state = self.site.simulator.state('reed', sensor.name)
            if first.get(sensor.id) == closed or \
                    sensor.id not in first and not state.get('closed', True):
                self._add(0.0, sensor, opened, START)

    def _note_fault(self, time: float, source: str, fault: str, detail: str) -> None:
        kind, _, what = detail.partition(': ')
        sensor = self._by_name.get((kind, source))
        if sensor is None:
            return
        self.recording.faults.append(Happened(time, sensor.id, fault, what))
        if fault == 'delay':  # who is there when it comes is not who caused it
            for event in what.rpartition(' by ')[0].split(', '):
                if event in ON or event in OFF:
                    self._late.setdefault((sensor.id, event), []).append(self._cause(time, sensor))

    def _note(self, time: float, sensor: Sensor, event: str, detail: str) -> None:
        late = self._late.get((sensor.id, event))
        if detail == FALSE:
            self._add(time, sensor, VALUES[sensor.kind][0 if event in ON else 1], NOISE)
        elif late:
            self._add(time, sensor, VALUES[sensor.kind][0 if event in ON else 1], late.pop(0))
        elif sensor.kind == 'light' and event == 'changed':
            lux = self.site.world.sensor('luminosity', sensor.name)['illuminance']
            self._add(time, sensor, f'{min(100, round(lux))}', self._lit(sensor))
        elif sensor.kind == 'bell' and event == RINGS:
            whose = self._cause(time, sensor)
            self._add(time, sensor, TAP, whose if whose[0] else VISITOR)
        elif event in ON:
            self._last_on[sensor.id] = time
            self._on[sensor.id] = time
            self._whose[sensor.id] = whose = self._cause(time, sensor, detail.rpartition(', ')[2])
            self._add(time, sensor, VALUES[sensor.kind][0], whose)
        elif event in OFF and sensor.kind in VALUES:
            self._on.pop(sensor.id, None)
            whose = self._cause(time, sensor) if sensor.kind in ('door', 'power') \
                else self._whose.get(sensor.id, NOISE)
            self._add(time, sensor, VALUES[sensor.kind][1], whose)

    def _add(self, time: float, sensor: Sensor, value: str, whose: tuple[str, str, str]) -> None:
        self.recording.events.append(Event(round(time, 6), sensor.id, value, *whose))

    def _cause(self, time: float, sensor: Sensor, met: str = '') -> tuple[str, str, str]:
        """Resident, activity and cause of a sensor's detection; `met`: who its zones met."""
        if time < FIRST:
            return START
        residents = [r for r in self.household.residents if not r.away
                     and r.storey == self._storeys[sensor.id]]
        if sensor.kind in ('door', 'power', 'bell'):
            who = self._hand(time, sensor)
            resident = next((r for r in self.household.residents if r.name == who), None)
            return (who, resident.item.activity, 'hand') if resident else ('', '', 'noise')
        near = sorted((math.dist(r.at, (sensor.x, sensor.y)), r.number, r) for r in residents)
        if sensor.kind == 'item':
            sits = next((r for away, _, r in near if away < NEAR), None)
            return (sits.name, sits.item.activity, 'seat') if sits else ('', '', 'noise')
        cell = sensor.kind == 'motion'
        ranked: list[tuple[Any, ...]] = []
        for away, _, r in near:
            moves, inside = self._moves(r, time), cell and away < NEAR
            if inside and r.name == met or moves and (
                    not cell or away < CLOSE or r.room == sensor.room):
                ranked.append((not moves or r.name != met, not (moves and inside),
                               *((r.name != met, away) if cell else (
                                   r.room != sensor.room, self._to_room(r, sensor.room))),
                               r.number, r))
        found = min(ranked)[-1] if ranked else None
        return (found.name, found.item.activity, 'motion') if found else ('', '', 'noise')

    def _to_room(self, resident: Any, room: str) -> float:
        """m from a resident to the nearest doorway of a room; 0 if it has none."""
        return min((math.dist(resident.at, door.pose[:2]) for door in self.site.home.doors
                    if door.kind != 'window' and room in door.rooms), default=0.0)

    def _moves(self, resident: Any, time: float) -> bool:
        """Whether a resident walks, has moved a moment before, or was pushed by a leaf."""
        return resident.walks or time - resident.moved < RECENT or self._is_pushed(resident)

    def _is_pushed(self, resident: Any) -> bool:
        """Whether a standing resident is not where it was seen: others and leaves push."""
        if resident.posture != 'stand':
            return False
        body = self.site.simulator.body(resident.name)
        return math.dist(resident.at, (body.x, body.y)) > PUSHED

    def _hand(self, time: float, sensor: Sensor) -> str:
        """The resident who last commanded the device of a contact or plug."""
        words = {sensor.name, sensor.name.removesuffix('_contact'),
                 sensor.name.removesuffix('_plug')}
        models = {f'{kind}/{name}': model for kind, name, model, _ in self.household.devices}
        best = (-math.inf, '')
        for (kind, name), (when, who) in self.household.acts.items():
            if kind != 'person' and time - when < HAND and \
                    ({name, models.get(f'{kind}/{name}', '')} & words):
                best = max(best, (when, who))
        return best[1]

    def _lit(self, sensor: Sensor) -> tuple[str, str, str]:
        for (kind, _), (when, who) in self.household.acts.items():
            if kind == 'lamp' and self.site.world.time - when < 5.0:
                resident = next(r for r in self.household.residents if r.name == who)
                return who, resident.item.activity, 'light'
        return '', '', 'light'

    def _follow(self, resident: Any) -> None:
        """Records the cells that a resident walks over, and those whose sensor detected nothing."""
        now = resident.looked
        inside = {(i, resident.name) for i, cell in enumerate(self._cells)
                  if math.dist((cell.x, cell.y), resident.at) < CELL
                  and self._storeys[cell.id] == resident.storey}
        for key in sorted(key for key in self._over if key[1] == resident.name):
            if key in inside:
                continue
            since, last = self._over.pop(key)
            sensor = self._cells[key[0]].id
            if last - since >= LEAST and sensor not in self._on \
                    and self._last_on.get(sensor, -math.inf) < since - HOLD:
                self._left.append(Missed(since, last, sensor, resident.name))
        for key in inside:
            self._over[key] = (self._over[key][0] if key in self._over else now, now)
        due = [m for m in self._left if m.end + HOLD < now]
        for missed in due:
            self._left.remove(missed)
            if self._last_on.get(missed.sensor, -math.inf) < missed.start - HOLD:
                self.recording.missed.append(missed)

    def _note_power(self) -> None:
        """Records the power of a switched device."""
        if self.household.count == self._acted:
            return
        self._acted = self.household.count
        for kind, name in self._loads:
            when, _ = self.household.acts.get((kind, name), (0.0, ''))
            self._load(f'{kind}/{name}', max(when, self._looked),
                       float(self.site.simulator.state(kind, name).get('power', 0.0)))

    def _load(self, device: str, time: float, watts: float) -> None:
        """Records the power of a device from a time on, and reports that of all."""
        line = self.recording.power.setdefault(device, [])
        if line and line[-1][1] == round(watts, 3):
            return
        line.append((round(time, 3), round(watts, 3)))
        total = sum(line[-1][1] for line in self.recording.power.values())
        if self._mains and not abs(total - self._reported) < WATTS:
            self._reported = total
            self._add(time, self._mains, f'{total:.0f}', MAINS)

    def _cool(self, fridge: str) -> Iterator[float]:
        """The compressor of a fridge runs and rests."""
        household = self.household
        draw = chance(household.seed, household.name, 'fridge', fridge)
        runs = draw.random() < RUNS[0] / (RUNS[0] + RESTS[0])
        share = draw.random()  # part left at the start
        while True:
            self._load(f'fridge/{fridge}', household.now, FRIDGE if runs else 0.0)
            yield household.now + 60.0 * share * spread(draw, *(RUNS if runs else RESTS))
            runs, share = not runs, 1.0

    def _air_process(self) -> Iterator[float]:
        """Reports a temperature when it has changed by a step."""
        sensors = [s for s in self.site.sensors if s.kind == 'temperature']
        while sensors:
            for sensor in sensors:
                celsius = float(self.site.simulator.state('temperature', sensor.name)
                                .get('temperature', math.nan))
                last = self._air.get(sensor.id)
                if math.isfinite(celsius) and (last is None or abs(celsius - last) >= DEGREES):
                    step = round(celsius / DEGREES) * DEGREES
                    self._air[sensor.id] = step
                    self._add(self.household.now, sensor, f'{step:.1f}', ('', '', 'air'))
            yield self.household.now + AIR
