"""Habits of a kind of resident, in profiles/*.yaml or a user's own file."""
from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from angen_apps.residents.activities import Activity, activities
from angen_tools.common.clock import DAY
from angen_tools.common.failure import Failure
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.yaml_file import Entries, YamlFile, is_text

FOLDER = Path(__file__).with_name('profiles')
MOST = 100  # residents of a home
HOURS = re.compile(r'(\d{1,2}):(\d\d)-(\d{1,2}):(\d\d)')
DAYS = ('all', 'weekday', 'weekend')
BODIES = ('person', 'cat')
KEYS = ('about', 'body', 'speed', 'lives', 'closes_doors', 'lamps_on', 'lamps_off', 'wakes',
        'sleeps', 'scheduled', 'free', 'needs', 'varies', 'skips', 'ills', 'moody', 'guests',
        'queues', 'joins', 'talks', 'dishes')
RANGE = re.compile(r'(\d+(?:\.\d+)?)(?:-(\d+(?:\.\d+)?))?')
# s by which somebody gets up earlier or later from day to day (standard deviation)
VARIES = 0.25 * 3600.0, 0.75 * 3600.0


@dataclass(frozen=True)
class Span:
    """A range of times of day in s, the second after midnight where it is the lesser."""

    low: float
    high: float


@dataclass(frozen=True)
class Scheduled:
    """Activities one after the other that begin at a usual time of day."""

    do: tuple[str, ...]
    at: Span
    days: str = 'all'
    chance: float = 1.0
    together: bool = False
    lasts: tuple[float, float] | None = None  # duration of the first


@dataclass(frozen=True)
class Free:
    """An activity that fills the time between: its weight holds from an hour to the next given."""

    weights: tuple[tuple[float, float], ...]
    lasts: tuple[float, float]
    per_day: float

    def weight(self, hour: float) -> float:
        return next((weight for start, weight in reversed(self.weights) if hour >= start),
                    self.weights[-1][1])


@dataclass(frozen=True)
class Need:
    """An interruption: every `every` s while awake, or in some of the nights."""

    every: tuple[float, float] | None
    per_day: float
    at_night: float


@dataclass(frozen=True)
class Profile:
    """The habits of a kind of resident. `lives`: False for one who only comes to visit. Ranges, in
    which each resident has one number: `varies`, s by which its hours differ from day to day;
    `skips`, how probably a scheduled activity is left out; `ills`, illnesses a year (adults have
    two or three colds, CDC); `moody`, how much its spirits change; `guests`, visits a week, if
    some are scheduled (61 % of people from 70 on meet others weekly: Freedman, J Gerontol B 77,
    2022); `dishes`, days for which dirty dishes stand on average (1.5, OnePoll for LG, 2023); and
    probabilities: `queues`, that it waits before the door of a bathroom in use; `joins`,
    that it watches TV with another one; `talks`, that it begins a talk as it moves beside another.
    """

    name: str
    speed: float  # m/s
    wakes: dict[str, Span]
    sleeps: dict[str, Span]
    scheduled: tuple[Scheduled, ...]
    free: dict[str, Free]
    needs: dict[str, Need]
    body: str = 'person'
    lives: bool = True
    closes_doors: float = 0.3
    lamps_on: float = 0.95
    lamps_off: float = 0.85
    varies: dict[str, tuple[float, float]] = field(
        default_factory=lambda: dict.fromkeys(DAYS[1:], VARIES))
    skips: dict[str, tuple[float, float]] = field(default_factory=dict)
    ills: tuple[float, float] = (1.0, 4.0)
    moody: tuple[float, float] = (0.6, 1.4)
    guests: tuple[float, float] = (0.3, 2.5)
    queues: tuple[float, float] = (0.2, 0.8)
    joins: tuple[float, float] = (0.2, 0.7)
    talks: tuple[float, float] = (0.1, 0.6)
    dishes: tuple[float, float] = (0.5, 2.5)
    does: frozenset[str] = field(default_factory=frozenset)


def names() -> list[str]:
    """The profiles that Angen has."""
    return sorted(file.stem for file in FOLDER.glob('*.yaml'))


def is_file(name: str) -> bool:
    """Whether a profile is that of a user's file, and not a shipped one."""
    return Path(name).suffix in ('.yaml', '.yml')


def read(name: str) -> Profile:
    """A shipped profile, or that of a file; Failure has file and line of an error."""
    path = Path(name)
    if not is_file(name):
        path = FOLDER / f'{name}.yaml'
        if not path.is_file():
            raise Failure(f"there is no profile '{name}'; {did_you_mean(name, names())}")
    return _Reader(YamlFile(path)).profile(path.stem)


class _Reader:
    def __init__(self, file: YamlFile) -> None:
        self.file, self.known = file, activities()

    def profile(self, name: str) -> Profile:
        file = self.file
        entry = file.entries(file.root, 'a profile', KEYS, ('speed', 'wakes', 'sleeps'))
        scheduled = tuple(map(self.scheduled, entry.of('scheduled', file.list, ())))
        free = self.several(entry, 'free', self.free)
        needs = self.several(entry, 'needs', self.need)
        wakes, sleeps = (self.spans(entry[key], key) for key in ('wakes', 'sleeps'))
        made = Profile(
            name, file.number(entry['speed'], 'speed', 0.2, 2.0), wakes, sleeps, scheduled, free,
            needs, entry.of('body', file.choice, 'person', BODIES),
            entry.of('lives', file.flag, True), **self.own(entry),
            skips=self.several(entry, 'skips', self.skip),
            does=frozenset([*free, *needs, *(name for part in scheduled for name in part.do)]))
        self.check_time(made, entry)
        return made

    def several(self, entry: Entries, key: str, read: Any) -> dict[str, Any]:
        found = {}
        for name, node in entry.of(key, self.file.entries, Entries()).items():
            self.activity(name, node)
            found[name] = read(name, node)
        return found

    def activity(self, name: str, node: Any) -> Activity:
        if name not in self.known:
            raise self.file.fail(node, f"'{name}' is not an activity; "
                                 f'{did_you_mean(name, self.known)}')
        return self.known[name]

    def scheduled(self, node: Any) -> Scheduled:
        file = self.file
        entry = file.entries(node, 'scheduled', ('do', 'at', 'days', 'chance', 'together', 'lasts'),
                             ('do', 'at'))
        for part in file.nodes(entry['do'], 'do'):
            self.activity(file.text(part, 'do'), part)
        return Scheduled(
            file.texts(entry['do'], 'do'), self.hours(entry['at'], 'at'),
            entry.of('days', file.choice, 'all', DAYS),
            entry.of('chance', file.number, 1.0, 0.0, 1.0),
            entry.of('together', file.flag, False), entry.of('lasts', file.span))

    def free(self, name: str, node: Any) -> Free:
        file = self.file
        entry = file.entries(node, name, ('hours', 'lasts', 'per_day'), ('hours',))
        weights = sorted((float(hour), file.number(weight, 'a weight', 0.0))
                         for hour, weight in self.hourly(entry['hours']))
        return Free(tuple(weights), entry.of('lasts', file.span, self.known[name].lasts),
                    entry.of('per_day', file.number, 99.0, 0.0))

    def hourly(self, node: Any) -> list[tuple[float, Any]]:
        found = []
        for key, value in self.file.entries(node, 'hours').items():
            if not key.isdigit() or not 0 <= int(key) < 24:
                raise self.file.fail(value, f"'{key}' is not an hour of 0 to 23")
            found.append((float(key), value))
        return found

    def need(self, name: str, node: Any) -> Need:
        file = self.file
        entry = file.entries(node, name, ('every', 'per_day', 'at_night'))
        return Need(entry.of('every', file.span), entry.of('per_day', file.number, 0.0, 0, 50),
                    entry.of('at_night', file.number, 0.0, 0, 9))

    def skip(self, name: str, node: Any) -> tuple[float, float]:
        return self.range(node, name, 1.0)

    def own(self, entry: dict[str, Any]) -> dict[str, Any]:
        """What residents differ in, if it is given."""
        found: dict[str, Any] = {key: self.file.number(entry[key], key, 0.0, 1.0)
                                 for key in ('closes_doors', 'lamps_on', 'lamps_off')
                                 if key in entry}
        most = {'ills': 12.0, 'moody': 3.0, 'guests': 7.0, 'queues': 1.0, 'joins': 1.0,
                'talks': 1.0, 'dishes': 14.0}
        found.update({key: self.range(entry[key], key, most[key]) for key in most if key in entry})
        if 'varies' in entry:
            node = entry['varies']
            parts = dict.fromkeys(DAYS[1:], node) if is_text(node) \
                else self.file.entries(node, 'varies', DAYS[1:], DAYS[1:])
            found['varies'] = {day: self.file.span(part, 'varies') for day, part in parts.items()}
        return found

    def range(self, node: Any, what: str, most: float) -> tuple[float, float]:
        text = self.file.text(node, what)
        found = RANGE.fullmatch(text)
        if not found or not 0 <= float(found[1]) <= float(found[2] or found[1]) <= most:
            raise self.file.fail(node, f"{what} is '{text}', must be two numbers up to {most:g} as "
                                 '0.1-0.5')
        return float(found[1]), float(found[2] or found[1])

    def spans(self, node: Any, what: str) -> dict[str, Span]:
        if is_text(node):
            both = self.hours(node, what)
            return {'weekday': both, 'weekend': both}
        entry = self.file.entries(node, what, DAYS[1:], DAYS[1:])
        return {day: self.hours(part, what) for day, part in entry.items()}

    def hours(self, node: Any, what: str) -> Span:
        text = self.file.text(node, what)
        found = HOURS.fullmatch(text)
        if not found or int(found[1]) > 23 or int(found[3]) > 23 \
                or int(found[2]) > 59 or int(found[4]) > 59:
            raise self.file.fail(node, f"{what} is '{text}', must be two times of day as "
                                 "'7:00-7:30'")
        low, high = (3600.0 * int(found[i]) + 60.0 * int(found[i + 1]) for i in (1, 3))
        return Span(low, high if high >= low else high + DAY)

    def check_time(self, profile: Profile, entry: dict[str, Any]) -> None:
        """Checks that scheduled items fit into the time awake, at their usual durations."""
        for day in DAYS[1:]:
            sleeps, wakes = profile.sleeps[day], profile.wakes[day]
            awake = (sleeps.low + sleeps.high - wakes.low - wakes.high) / 2 % DAY
            taken = 0.0
            for part in profile.scheduled:
                if part.days in ('all', day):
                    times = [part.lasts if i == 0 and part.lasts else self.known[name].lasts
                             for i, name in enumerate(part.do)]
                    taken += part.chance * sum((low * high) ** 0.5 for low, high in times)
            if taken > awake:
                raise self.file.fail(entry['scheduled'], f'the scheduled items of a {day} take '
                                     f'{taken / 3600:.1f} h, but {profile.name} is awake for '
                                     f'{awake / 3600:.1f} h')
