"""The catalog of activities in activities.yaml."""
from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from angen_tools.common.yaml_file import YamlFile

USES = ('kitchen', 'bedroom', 'bathroom', 'living', 'hall', 'work', 'landing', 'outdoor', 'other')
POSTURES = ('stand', 'sit', 'lie', 'roam')
FRIDGE = 'fridge'
OPENS = (FRIDGE, 'wardrobe', 'entrance')
RUNS = ('stove', 'tv', 'appliance')
CATALOG = Path(__file__).with_name('activities.yaml')
NOON, EVENING = 11, 16  # h, from which a second and a third label of meals hold


@dataclass(frozen=True)
class Step:
    """A part of an activity at one place. `at`: things, the best first, each 'thing' or
    'use thing'; `room`: the use of the room, where none is at hand."""

    at: tuple[str, ...] = ()
    room: str = ''
    posture: str = 'stand'
    share: float = 1.0
    minutes: float | None = None
    opens: str = ''
    runs: str = ''

    @property
    def optional(self) -> bool:
        """Whether the activity is possible without it."""
        return self.minutes is not None or bool(self.room)


@dataclass(frozen=True)
class Visits:
    """Where one goes for a moment in the middle of an activity: to things by weight, after `every`
    s at the place of a step, for `lasts` s."""

    to: tuple[tuple[str, float], ...]
    every: tuple[float, float]
    lasts: tuple[float, float]


@dataclass(frozen=True)
class Activity:
    """One that residents do. `alone`: the use of a room that is not shared meanwhile; `moves`: s
    between two small movements; `effort`: 1 of what one does on good days, -1 on bad ones;
    `breaks`: how often an hour something else comes between."""

    name: str
    steps: tuple[Step, ...]
    casas: str
    openshs: str
    aras: tuple[int, ...]
    kasteren: tuple[int, ...]
    lasts: tuple[float, float]  # s, 10 % and 90 % quantiles
    alone: str = ''
    dark: bool = False
    visits: Visits | None = None
    moves: tuple[float, float] | None = None
    effort: float = 0.0
    breaks: float = 0.0

    @property
    def opened(self) -> set[str]:
        """The things that are opened at each use."""
        fridges = {FRIDGE for what, _ in self.visits.to if what == FRIDGE} if self.visits else set()
        return fridges | {step.opens for step in self.steps if step.opens}

    def number(self, numbers: tuple[int, ...], hour: float) -> int:
        """The number of a label that may depend on the time of day."""
        part = 0 if hour < NOON else 1 if hour < EVENING else 2
        return numbers[min(part, len(numbers) - 1)]

    def times(self, seconds: float) -> list[float]:
        """The duration of each step, of the seconds in all."""
        fixed = sum(60 * step.minutes for step in self.steps if step.minutes is not None)
        shares = sum(step.share for step in self.steps if step.minutes is None)
        scale = min(1.0, seconds / fixed) if fixed and shares == 0 else 1.0
        if fixed > 0.8 * seconds:
            scale = 0.8 * seconds / fixed
        left = seconds - scale * fixed
        return [scale * 60 * step.minutes if step.minutes is not None
                else left * step.share / shares for step in self.steps]


@cache
def activities() -> dict[str, Activity]:
    """The activities by name."""
    file = YamlFile(CATALOG)
    return {name: _read(file, name, node)
            for name, node in file.entries(file.root, 'the catalog').items()}


def _read(file: YamlFile, name: str, node: Any) -> Activity:
    entry = file.entries(node, name, ('labels', 'lasts', 'steps', 'alone', 'dark', 'visits',
                                      'moves', 'effort', 'breaks'), ('labels', 'lasts', 'steps'))
    labels = file.entries(entry['labels'], 'labels', ('casas', 'aras', 'kasteren', 'openshs'),
                          ('casas', 'aras', 'kasteren', 'openshs'))
    numbers = {key: tuple(int(file.number(part, key)) for part in
                          file.nodes(labels[key], key))
               for key in ('aras', 'kasteren')}
    return Activity(
        name, tuple(_step(file, step) for step in file.list(entry['steps'], 'steps')),
        file.text(labels['casas'], 'casas'), file.text(labels['openshs'], 'openshs'),
        numbers['aras'], numbers['kasteren'], file.span(entry['lasts'], 'lasts'),
        entry.of('alone', file.choice, '', USES), entry.of('dark', file.flag, False),
        _visits(file, entry['visits']) if 'visits' in entry else None,
        entry.of('moves', file.span), entry.of('effort', file.number, 0.0, -1.0, 1.0),
        entry.of('breaks', file.number, 0.0, 0.0, 60.0))


def _visits(file: YamlFile, node: Any) -> Visits:
    keys = ('to', 'every', 'lasts')
    entry = file.entries(node, 'visits', keys, keys)
    return Visits(tuple((what, file.number(weight, what, 0.0))
                        for what, weight in file.entries(entry['to'], 'to').items()),
                  file.span(entry['every'], 'every'), file.span(entry['lasts'], 'lasts'))


def _step(file: YamlFile, node: Any) -> Step:
    entry = file.entries(node, 'a step', ('at', 'room', 'posture', 'share', 'minutes', 'opens',
                                          'runs'))
    at = entry.of('at', file.texts, ())
    if not at and 'room' not in entry:
        raise file.fail(node, 'a step needs at: a thing, or room: a use')
    return Step(
        at, entry.of('room', file.choice, '', USES),
        entry.of('posture', file.choice, 'stand', POSTURES),
        entry.of('share', file.number, 1.0, 0.0, 1.0),
        entry.of('minutes', file.number, None, 0.01, 1440),
        entry.of('opens', file.choice, '', OPENS), entry.of('runs', file.choice, '', RUNS))
