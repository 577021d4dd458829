"""Residents of one home, each a process that says when it continues, and their shared state."""
from __future__ import annotations

import datetime
import heapq
import itertools
import math
from typing import Any, Callable, Iterator

from angen_apps.residents.floors import Floors
from angen_apps.residents.light import daylight_in
from angen_apps.residents.moods import Day
from angen_apps.residents.places import Places
from angen_apps.residents.simulator import Simulator
from angen_tools.common.clock import DAY
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home

Process = Iterator[float]  # yields when it continues, s
LIT = 100.0  # lx of a lamp, in rooms without a sensor


class Household:
    """The home that residents share. `day`: of simulated time 0; `since`: its seconds then."""

    def __init__(self, simulator: Simulator, floors: Floors, seed: int, name: str,
                 day: datetime.date, since: float = 0.0) -> None:
        self.simulator, self.floors, self.seed, self.name = simulator, floors, seed, name
        self.home: Home = simulator.home
        self.places = Places(floors)
        self.first, self.since = day, since
        self.residents: list[Any] = []  # each a resident.Resident
        self.held: dict[Any, str] = {}  # who has a door, place or room
        self.acts: dict[tuple[str, str], tuple[float, str]] = {}  # time and resident
        self.count = 0  # count of commands to devices
        self.heard: Callable[[], None] = lambda: None  # after each part of time
        self._queue: list[tuple[float, int, Process]] = []
        self._orders = itertools.count()  # orders of processes that are due at one time
        self.devices = simulator.devices()
        self._lux: dict[str, str] = {}
        self.lamps: dict[str, list[str]] = {}
        for kind, device, _, pose in self.devices:
            room = self.home.room_at(pose[0], pose[1], pose[2] - 0.1)
            if room and kind == 'lamp':
                self.lamps.setdefault(room.name, []).append(device)
            elif room and kind == 'luminosity':
                self._lux.setdefault(room.name, device)

    @property
    def now(self) -> float:
        return self.simulator.now

    def date(self, time: float) -> tuple[datetime.date, float]:
        """The day of a simulated time, and its seconds since midnight."""
        days, seconds = divmod(time + self.since, DAY)
        return self.first + datetime.timedelta(days=int(days)), seconds

    def day(self, number: int) -> Day:
        return Day(number, self.first + datetime.timedelta(days=number))

    def add(self, process: Process) -> None:
        """Begins a process."""
        heapq.heappush(self._queue, (self.now, next(self._orders), process))

    def run(self, until: float) -> None:
        """Lets residents live until a simulated time."""
        while self._queue and self._queue[0][0] < until:
            due = self._queue[0][0]
            if due > self.now + 1e-9:
                self.simulator.run(due - self.now)
                self.heard()  # hearing may add a process
            _, order, process = heapq.heappop(self._queue)
            wakes = next(process, None)
            if wakes is not None:
                heapq.heappush(self._queue, (max(wakes, self.now + 1e-3), order, process))
        if until > self.now:
            self.simulator.run(until - self.now)
            self.heard()

    def close(self) -> None:
        """Ends the activities of residents."""
        for _, _, process in self._queue:
            getattr(process, 'close', lambda: None)()
        for resident in self.residents:
            resident.diary.end(self.now)

    def take(self, what: Any, who: str) -> bool:
        """Reserves a door, place or room; returns whether `who` has it now."""
        return self.held.setdefault(what, who) == who

    def leave(self, what: Any, who: str) -> None:
        if self.held.get(what) == who:
            del self.held[what]

    def do(self, who: str, kind: str, name: str, text: str) -> bool:
        """A resident commands a device; whether it obeyed."""
        try:
            self.simulator.command(kind, name, text)
        except Failure:
            return False
        if kind != 'person':
            self.acts[kind, name] = (self.now, who)
            self.count += 1
        return True

    def ring(self, who: str = '') -> None:
        """Somebody rings the doorbell next to the entrance, a guest or one without a body."""
        door = self.floors.entrance()
        bells = [(math.dist(pose[:2], door.pose[:2]) if door else 0.0, name)
                 for kind, name, _, pose in self.devices if kind == 'doorbell']
        if bells:
            self.do(who, 'doorbell', min(bells)[1], 'Ring')

    def of_model(self, model: str, *kinds: str) -> tuple[str, str] | None:
        """Kind and name of a device of a model."""
        return next(((kind, name) for kind, name, other, _ in self.devices
                     if other == model and kind in kinds), None)

    def others_in(self, room: str, who: str) -> bool:
        """Whether another person is awake in a room."""
        return any(r.room == room and r.name != who and not r.away for r in self.residents)

    def robot_near(self, x: float, y: float, reach: float) -> bool:
        """Whether a robot is within `reach` (m) of a place, on any storey."""
        return any((pose[0] - x) ** 2 + (pose[1] - y) ** 2 < reach ** 2
                   for *_, pose in self.simulator.devices('drive'))

    def lux(self, room: str) -> float:
        """The illuminance in a room: by its sensor, or else by its lamps and the sun."""
        if room in self._lux:
            reading = self.simulator.state('luminosity', self._lux[room])
            if 'illuminance' in reading:
                return float(reading['illuminance'])
        lit = any(self.simulator.state('lamp', lamp).get('on') for lamp in self.lamps.get(room, ()))
        return (LIT if lit else 0.0) + daylight_in(self.home, room, *self.date(self.now))
