"""Simulates residents in one home for some days: the data of a run."""
from __future__ import annotations

import datetime
import sys
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Callable, Sequence

from angen_apps.data import faults
from angen_apps.data.cabins import Slide
from angen_apps.data.recorder import Event, Missed, Moved, Recorder, Step
from angen_apps.data.site import Sensor, Site
from angen_apps.residents.company import Talk
from angen_apps.residents.household import Household
from angen_apps.residents.members import Guest, make
from angen_apps.residents.profiles import DAY, MOST, Profile, read
from angen_apps.residents.truth import Interval
from angen_apps.residents.ways import ways
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home

NAMES = ('anna', 'bert', 'clara', 'dora', 'emil', 'fritz', 'greta', 'hans')
USUAL = ('worker', 'retired', 'student', 'child')
SLICE = 900.0  # s between two reports of progress


@dataclass(frozen=True)
class Data:
    """The results of a run; times in s since `start`, a midnight."""

    start: datetime.datetime
    days: int
    seed: int
    residents: list[tuple[str, Profile]]
    home: Home
    sensors: list[Sensor]
    events: list[Event]
    truth: list[Interval]
    missed: list[Missed]
    power: dict[str, list[tuple[float, float]]]
    track: list[Step]
    faults: list[faults.Happened]
    slides: list[Slide]
    moves: list[Moved] = field(default_factory=list)
    guests: list[tuple[str, str]] = field(default_factory=list)  # and the host of each
    talks: list[Talk] = field(default_factory=list)

    def intervals(self, resident: str) -> list[Interval]:
        return [interval for interval in self.truth if interval.resident == resident]

    @cached_property
    def by_id(self) -> dict[str, Sensor]:
        """The sensors by id."""
        return {sensor.id: sensor for sensor in self.sensors}

    def at(self, time: float) -> datetime.datetime:
        """The wall clock at a time."""
        return self.start + datetime.timedelta(microseconds=round(time * 1e6))


def residents_of(words: list[str]) -> list[tuple[str, Profile]]:
    """Names and profiles: of a number the usual ones, or those that are listed."""
    if len(words) == 1 and words[0].isdecimal():
        if int(words[0]) > MOST:
            raise Failure(f'{words[0]} residents are too many; give at most {MOST}')
        words = [USUAL[i % len(USUAL)] for i in range(int(words[0]))]
    return [(NAMES[i % len(NAMES)] + ('' if i < len(NAMES) else str(i)), read(word))
            for i, word in enumerate(words)]


def first_day(home: Home) -> datetime.date:
    """The date at which a home's time begins, or else a Monday."""
    return datetime.date.fromisoformat((home.start or '2026-03-23')[:10])


def try_household(world: Path, who: list[str], strict: bool = False) -> None:
    """Says where residents find no way in the home of a world's file, and what they cannot do
    there; Failure for that if `strict`."""
    site = Site(world, 0, placed=False)
    for line in ways(site.floors, site.world):
        print(f'angen: {line}', file=sys.stderr)
    make(Household(site.simulator, site.floors, 0, world.stem, first_day(site.home)),
         residents_of(who), strict)


def live(world: Path, name: str, days: int, who: list[tuple[str, Profile]], seed: int,
         start: datetime.date | None = None, placed: bool = True, light: bool = False,
         faulty: Sequence[faults.Fault] = (),
         progress: Callable[[float], None] = lambda _: None, strict: bool = False) -> Data:
    """Has residents live in the home of a world's file; `strict`: Failure if they cannot do
    something there."""
    site = Site(world, seed, placed, light, rare_air=not faulty)  # faults change each reading
    faults.give(site, list(faulty))
    first = start or first_day(site.home)
    household = Household(site.simulator, site.floors, seed, name, first)
    guests = [one for one in make(household, who, strict) if isinstance(one, Guest)]
    recorder = Recorder(site, household)
    recorder.start()
    end = days * DAY
    while household.now < end - 1e-6:
        household.run(min(household.now + SLICE, end))
        progress(household.now / end)
    household.close()
    truth = sorted((replace(interval, start=round(interval.start, 3), end=round(interval.end, 3))
                    for resident in household.residents for interval in resident.diary.closed),
                   key=lambda i: (i.start, i.resident))
    events = sorted(recorder.recording.events, key=lambda e: (e.time, e.sensor))
    left = recorder.recording
    return Data(datetime.datetime.combine(first, datetime.time()), days, seed,
                who, site.home, site.sensors, events, truth, left.missed, left.power,
                sorted(left.track), sorted(left.faults), recorder.cabins.slides, left.moves,
                [(guest.name, guest.host.name) for guest in guests],
                sorted(talk for resident in household.residents for talk in resident.talks))
