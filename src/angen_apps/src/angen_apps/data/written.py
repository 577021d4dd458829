"""The data of a home as its files have it."""
from __future__ import annotations

from collections import Counter
from bisect import bisect_right
from dataclasses import dataclass, field
from datetime import datetime
from functools import cached_property
from pathlib import Path

from angen_apps.data.faults import Happened
from angen_apps.data.recorder import Event, Missed
from angen_apps.data.run import Data
from angen_apps.data.site import Sensor
from angen_apps.data.tables import (FAULTS, MISSED, MOVES, POWER, TALKS, TRACK, Tables,
                                    layout_of)
from angen_apps.data.whereabouts import Floors, Whereabouts, time_of, whereabouts
from angen_apps.residents.profiles import DAY, Profile
from angen_apps.residents.truth import Interval
from angen_tools.common.home import Home

LIST = 'home.json'  # settings, counts and hashes of a home


@dataclass
class Findings:
    """Errors by check, the number of checked items, and shares of all."""

    wrong: dict[str, list[str]] = field(default_factory=dict)
    checked: Counter[str] = field(default_factory=Counter)
    shares: dict[str, float] = field(default_factory=dict)

    def say(self, check: str, fine: bool, what: str) -> None:
        self.checked[check] += 1
        self.wrong.setdefault(check, [])
        if not fine:
            self.wrong[check].append(what)

    def add(self, other: Findings, name: str) -> None:
        """Those of a home, with its name."""
        self.checked += other.checked
        for check, wrong in other.wrong.items():
            self.wrong.setdefault(check, []).extend(f'{name}: {line}' for line in wrong)

    @property
    def count(self) -> int:
        return sum(len(found) for found in self.wrong.values())


class Written:
    """A home's folder, read."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.layout = layout_of(folder)
        self.start = datetime.fromisoformat(self.layout['start'])
        self.end = self.layout['days'] * DAY
        residents = {resident['name']: resident for resident in self.layout['residents']}
        self.hosts = {guest['name']: guest['host'] for guest in self.layout.get('guests', [])}
        self.names = [*residents, *self.hosts]
        self.people = {name for name in self.names
                       if residents.get(name, {}).get('body', 'person') == 'person'}
        self.speeds = {name: residents[self.hosts.get(name, name)]['speed'] for name in self.names
                       if self.hosts.get(name, name) in residents}
        tables = Tables(folder, self.layout)
        self.truth, self.events = list(tables.truth()), list(tables.events())
        self.track = list(tables.rows('track.csv.gz', TRACK))
        self.moves = list(tables.rows('moves.csv.gz', MOVES))
        talks = 'talks.csv.gz'  # if somebody talks
        self.talks = list(tables.rows(talks, TALKS)) if (folder / talks).exists() else []
        self.missed = list(tables.rows('missed.csv', MISSED))
        self.faults = list(tables.rows('faults.csv', FAULTS))
        self.faulty = {row['sensor'] for row in self.faults}
        self.times = [time_of(row, self.start) for row in self.events]
        self.loads: dict[str, tuple[list[float], list[float]]] = {}  # times and W, by device
        for row in tables.rows('loads.csv.gz', POWER):
            times, watts = self.loads.setdefault(f'{row["kind"]}/{row["device"]}', ([], []))
            times.append(float(row['time']))
            watts.append(float(row['watts']))
        self.sensors = {sensor['id']: sensor for sensor in self.layout['sensors']}
        self.things = {thing['name']: thing for thing in self.layout['things']}
        self.rooms = {room['name']: room for room in self.layout['rooms']}

    @cached_property
    def who(self) -> dict[str, Whereabouts]:
        """Where each resident was."""
        return whereabouts(self.names, self.truth, self.track, self.moves,
                           {name: room['storey'] for name, room in self.rooms.items()})

    @cached_property
    def floors(self) -> Floors:
        return Floors(self.layout)

    def use(self, room: str) -> str:
        return str(self.rooms[room]['use']) if room in self.rooms else 'outdoor'

    def watts(self, device: str, time: float) -> float:
        """The power of a device at a time."""
        times, watts = self.loads.get(device, ([], []))
        i = bisect_right(times, time) - 1
        return watts[i] if i >= 0 else 0.0

    def states(self, sensor: str) -> list[tuple[float, str]]:
        """Times and values of a sensor's events."""
        return self._states.get(sensor, [])

    @cached_property
    def _states(self) -> dict[str, list[tuple[float, str]]]:
        found: dict[str, list[tuple[float, str]]] = {}
        for time, row in zip(self.times, self.events):
            found.setdefault(row['sensor'], []).append((time, row['value']))
        return found

    def data(self, seed: int) -> Data:
        """As it was before it was written, for the writers of formats."""
        people = [(r['name'], Profile(r.get('profile', ''), r['speed'], {}, {}, (), {}, {}))
                  for r in self.layout['residents']]
        sensors = [Sensor(s['id'], s['kind'], '', s['name'], s['room'], s['x'], s['y'], s['z'])
                   for s in self.layout['sensors']]
        return Data(
            self.start, self.layout['days'], seed, people, Home(), sensors,
            [Event(time, *(row[key] for key in Event._fields[1:]))
             for time, row in zip(self.times, self.events)],
            [Interval(float(row['start']), float(row['end']), row['resident'], row['activity'],
                      row['cause'], row['phase'], row['room'], row['thing'], row['posture'],
                      float(row['x']), float(row['y']), row['note']) for row in self.truth],
            [Missed(float(row['start']), float(row['end']), row['sensor'], row['resident'])
             for row in self.missed],
            {device: list(zip(*lines)) for device, lines in self.loads.items()}, [],
            [Happened(float(row['time']), row['sensor'], row['fault'], row['detail'])
             for row in self.faults], [])
