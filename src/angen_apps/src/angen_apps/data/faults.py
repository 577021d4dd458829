"""Faults of sensors and of the transport of their events; each effect is logged."""
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

from angen_apps.data.recorder import VALUES, Event
from angen_apps.data.run import Data
from angen_apps.residents.activities import span
from angen_apps.residents.chance import chance, spread
from angen_apps.residents.profiles import DAY
from angen_tools.common.yaml_file import YamlFile

KINDS = {'dropout': ('share',), 'stuck': ('from', 'lasts'), 'false_alarm': ('per_day',),
         'delay': ('by',), 'duplicate': ('share',), 'clock': ('seconds_per_day',),
         'battery': ('from', 'lasts')}
PULSE = (1.25, 6.0)  # s that a false alarm lasts
ECHO = 0.05  # s between an event and its duplicate


@dataclass(frozen=True)
class Fault:
    """One of some sensors. `start` and `lasts` in s, `by` in s, other numbers as they are given."""

    kind: str
    sensors: str
    number: float = 0.0
    start: float = 0.0
    lasts: float = math.inf
    by: tuple[float, float] = (0.0, 0.0)


class Happened(NamedTuple):
    """The effect of a fault on one event."""

    time: float
    sensor: str
    fault: str
    detail: str


def read(path: Path) -> list[Fault]:
    """The faults of a YAML file; Failure has file and line of an error."""
    file = YamlFile(path)
    root = file.entries(file.root, 'the file', ('faults',), ('faults',))
    return [_fault(file, node) for node in file.list(root['faults'], 'faults')]


def _fault(file: YamlFile, node: Any) -> Fault:
    known = ('fault', 'sensors', *sorted({key for keys in KINDS.values() for key in keys}))
    entry = file.entries(node, 'a fault', known, ('fault',))
    kind = file.choice(entry['fault'], 'fault', KINDS)
    file.entries(node, kind, ('fault', 'sensors', *KINDS[kind]), KINDS[kind])
    made = Fault(kind, file.text(entry['sensors'], 'sensors') if 'sensors' in entry else '*')
    for key in KINDS[kind]:
        if key == 'share':
            made = replace(made, number=file.number(entry[key], key, 0.0, 1.0))
        elif key in ('per_day', 'seconds_per_day'):
            made = replace(made, number=file.number(entry[key], key, -1e4, 1e4))
        else:
            value = span(file, entry[key], key)
            made = replace(made, by=value) if key == 'by' else \
                replace(made, start=value[0]) if key == 'from' else replace(made, lasts=value[1])
    return made


def apply(data: Data, faults: list[Fault]) -> tuple[Data, list[Happened]]:
    """The data with the faults applied, and the effect on each changed event."""
    events, happened = list(data.events), []
    for number, fault in enumerate(faults):
        kept: list[Event] = []
        for sensor in data.sensors:
            if fnmatchcase(sensor.id, fault.sensors):
                own = [event for event in events if event.sensor == sensor.id]
                numbers = chance(data.seed, 'fault', number, sensor.id)
                after = _Sensor(fault, sensor.id, sensor.kind, data.days * DAY, numbers)
                kept += after.through(own)
                happened += after.happened
            else:
                kept += [event for event in events if event.sensor == sensor.id]
        events = sorted(kept, key=lambda e: (e.time, e.sensor))
    return replace(data, events=events), sorted(happened)


class _Sensor:
    """One fault at one sensor."""

    def __init__(self, fault: Fault, sensor: str, kind: str, ends: float, numbers: Random) -> None:
        self.fault, self.sensor, self.kind, self.ends = fault, sensor, kind, ends
        self.numbers = numbers
        self.happened: list[Happened] = []

    def through(self, events: list[Event]) -> list[Event]:
        """The events that arrive."""
        found: list[Event] = []
        for event in events:
            found += self._one(event)
        return found + (self._alarms() if self.fault.kind == 'false_alarm' else [])

    def _one(self, event: Event) -> list[Event]:
        fault = self.fault
        inside = fault.start <= event.time < fault.start + fault.lasts
        if fault.kind == 'dropout' and self.numbers.random() < fault.number:
            return self._lost(event)
        if fault.kind == 'stuck' and inside:
            return self._lost(event)
        if fault.kind == 'battery' and event.time >= fault.start \
                and self.numbers.random() < min((event.time - fault.start) / fault.lasts, 1.0):
            return self._lost(event)
        if fault.kind == 'delay':
            return [self._moved(event, spread(self.numbers, *fault.by))]
        if fault.kind == 'clock':
            return [self._moved(event, fault.number * event.time / DAY)]
        if fault.kind == 'duplicate' and self.numbers.random() < fault.number:
            self._note(event.time, f'{event.value} twice')
            return [event, event._replace(time=event.time + ECHO)]
        return [event]

    def _lost(self, event: Event) -> list[Event]:
        self._note(event.time, f'{event.value} lost')
        return []

    def _moved(self, event: Event, by: float) -> Event:
        self._note(event.time, f'{event.value} by {by:.3f} s')
        return event._replace(time=min(max(event.time + by, 0.0), self.ends))

    def _alarms(self) -> list[Event]:
        """Of sensors with two values."""
        found: list[Event] = []
        on, off = VALUES.get(self.kind, ('', ''))
        time = self.numbers.expovariate(self.fault.number / DAY) if self.fault.number > 0 else DAY
        while on and self.fault.number > 0 and time < self.ends:
            found.append(Event(time, self.sensor, on, '', '', 'noise'))
            found.append(Event(min(time + self.numbers.uniform(*PULSE), self.ends), self.sensor,
                               off, '', '', 'noise'))
            self._note(time, f'{on} for {found[-1].time - time:.2f} s')
            time += self.numbers.expovariate(self.fault.number / DAY)
        return found

    def _note(self, time: float, detail: str) -> None:
        self.happened.append(Happened(round(time, 6), self.sensor, self.fault.kind, detail))
