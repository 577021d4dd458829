"""Reads the scenario of a bench from its YAML file; Failure has file, line and what is right."""
import datetime
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable

from angen_apps.automation.claims import (ANYONE, NOBODY, Claim, contradiction, day_spans,
                                          parsed)
from angen_apps.residents.profiles import is_file
from angen_tools.common.clock import DAY, duration, time_of_day
from angen_tools.common.yaml_file import Entries, YamlFile, is_text, line_of

KEYS = ('home', 'start', 'lasts', 'seed', 'residents', 'lamps', 'people', 'add', 'delete',
        'script', 'weather', 'faults', 'automation', 'program', 'expect')
GENERATED = 'generated'
LONGEST = 366 * DAY
KINDS = ('expect', 'never', 'always', 'at_most', 'at_least')
COUNTED = ('changes_of', 'times', 'energy_of', 'time_of', 'notes')
PLACES = {'at': 'appears at', 'sits_on': 'sits on', 'lies_on': 'lies on'}
ANSWERS = ('barrier', 'quiet')
# What weather sets, in all devices of a kind.
WEATHER = {'outside': 'climate/all Outside', 'daylight': 'daylight/all Set'}  # °C, lx


@dataclass(frozen=True)
class Order:
    """A line of the script: a person does something, or a device is commanded."""

    time: float
    text: str
    line: int


@dataclass(frozen=True)
class Added:
    """A model that is spawned: at a pose, or in a corner of a room, facing its middle."""

    model: str
    name: str
    room: str
    pose: tuple[float, ...]
    line: int


@dataclass(frozen=True)
class Person:
    """One of the script. `does`: where it is at the start, in words of the script."""

    name: str
    does: str
    line: int


@dataclass(frozen=True)
class Program:
    """What is tested, if it is not an automation: a command line with {port} in it."""

    command: str
    line: int
    answers: str = ANSWERS[0]
    quiet: float = 0.05    # s
    rate: float = math.inf  # simulated s in one of wall time, at most


@dataclass(frozen=True)
class Expectation:
    """One of `kind`; claims by the keys that have them."""

    kind: str
    name: str
    claims: dict[str, Claim]
    within: float = 0.0
    held: float = 0.0     # `for` in the file
    counted: str = ''     # the key of what is counted
    things: tuple[str, ...] = ()
    limit: float = 0.0
    unit: str = ''
    per: float = 0.0      # s, 0: the whole run
    line: int = 0


@dataclass(frozen=True)
class Scenario:
    path: Path
    home: str
    start: datetime.datetime | None
    lasts: float
    seed: int
    residents: tuple[str, ...]
    leaves_lamps: bool
    people: tuple[Person, ...]
    added: tuple[Added, ...]
    deleted: tuple[tuple[str, int], ...]
    script: tuple[Order, ...]
    faults: Path | None
    automations: tuple[Path, ...]
    program: Program | None
    expectations: tuple[Expectation, ...]

    def fail(self, line: int, what: str) -> str:
        return f'{self.path}:{line}: {what}'


def read_scenario(path: Path) -> Scenario:
    """The scenario of a file."""
    return _Reader(path).scenario()


class _Reader(YamlFile):

    def scenario(self) -> Scenario:
        top = self.entries(self.root, 'a scenario', KEYS, ('lasts', 'expect'))
        if ('automation' in top) == ('program' in top):
            raise self.fail(self.root, 'a scenario has an automation or a program')
        lasts = self._duration(top['lasts'], 'lasts')
        if not 1.0 <= lasts <= LONGEST:
            raise self.fail(top['lasts'], 'lasts must be 1 s to 366 d')
        start = top.of('start', self._start)
        home = top.of('home', self.text, GENERATED)
        self._since = 0.0 if start is None else (
            start - datetime.datetime.combine(start.date(), datetime.time())).total_seconds()
        self._lasts, self._has_start = lasts, start is not None
        return Scenario(
            self.path, home if home == GENERATED else str(self._beside(home)), start, lasts,
            int(top.of('seed', self.number, 1, 0, 2**53)),
            tuple(str(self._beside(one)) if is_file(one) else one
                  for one in top.of('residents', self.texts, ())),
            top.of('lamps', self.choice, '', ('residents', 'automation')) == 'automation',
            self._all(top, 'people', self._person), self._all(top, 'add', self._added),
            tuple((self.text(node, 'delete'), line_of(node))
                  for node in top.of('delete', self.list, ())),
            tuple(sorted((*self._all(top, 'script', self._order),
                          *sum(self._all(top, 'weather', self._weather), ())),
                         key=lambda each: each.time)),
            self._beside(self.text(top['faults'], 'faults')) if 'faults' in top else None,
            tuple(self._beside(one) for one in top.of('automation', self.texts, ())),
            top.of('program', self._program),
            self._all(top, 'expect', self._expectation))

    def _beside(self, name: str) -> Path:
        return self.path.parent / name

    def _duration(self, node: Any, what: str) -> float:
        return float(self.said(node, what, duration))

    def _all(self, top: Entries, key: str, read: Callable[[Any], Any]) -> tuple[Any, ...]:
        return tuple(read(node) for node in top.of(key, self.list, ()))

    def _start(self, node: Any, what: str) -> datetime.datetime:
        try:
            return datetime.datetime.fromisoformat(self.text(node, what)).replace(tzinfo=None)
        except ValueError:
            raise self.fail(node, f"start is '{node.value}', must be as 2026-03-23 18:00") from None

    def _person(self, node: Any) -> Person:
        parts = self.entries(node, 'a person', ('name', *PLACES), ('name',))
        places = [key for key in PLACES if key in parts]
        if len(places) != 1:
            raise self.fail(node, f'a person has one of {", ".join(PLACES)}')
        name = self.text(parts['name'], 'name')
        if not re.fullmatch('[a-z][a-z0-9]*', name) or name in (ANYONE, NOBODY):
            raise self.fail(parts['name'], f"'{name}' must be a word of small letters")
        place, node = places[0], parts[places[0]]
        where = self.text(node, place) if is_text(node) else ' '.join(
            f'{self.number(each, place, -1e4, 1e4):g}' for each in self._count(node, place, 2))
        return Person(name, f'{PLACES[place]} {where}', line_of(node))

    def _count(self, node: Any, what: str, count: int) -> list[Any]:
        nodes = self.list(node, what)
        if len(nodes) != count:
            raise self.fail(node, f'{what} must have {count} numbers')
        return nodes

    def _added(self, node: Any) -> Added:
        parts = self.entries(node, 'an added model', ('model', 'name', 'room', 'pose'),
                             ('model', 'name'))
        if ('room' in parts) == ('pose' in parts):
            raise self.fail(node, 'an added model has a room or a pose')
        pose = tuple(self.number(each, 'pose', -1e4, 1e4)
                     for each in parts.of('pose', self._count, (), 6))
        return Added(self.text(parts['model'], 'model'), self.text(parts['name'], 'name'),
                     parts.of('room', self.text, ''), pose, line_of(node))

    def _order(self, node: Any) -> Order:
        parts = self.entries(node, 'a line of the script', ('at', 'do'), ('at', 'do'))
        return Order(self._time(parts['at']), self.text(parts['do'], 'do'), line_of(node))

    def _weather(self, node: Any) -> tuple[Order, ...]:
        parts = self.entries(node, 'a line of the weather', ('at', *WEATHER), ('at',))
        if len(parts) == 1:
            raise self.fail(node, f'a line of the weather has {" or ".join(WEATHER)}')
        time = self._time(parts['at'])
        return tuple(Order(time, f'{command} {self.number(parts[key], key, -1e6, 1e6):g}',
                           line_of(node)) for key, command in WEATHER.items() if key in parts)

    def _time(self, node: Any) -> float:
        """s from the start, of a line at a time."""
        text = self.text(node, 'at')
        if ':' in text:
            if not self._has_start:
                raise self.fail(node, "a time of day needs the scenario's start; or write "
                                'it from there on, as 10 min')
            days, _, clock = text.rpartition('d ')
            time = self.said(node, 'at', lambda _: time_of_day(clock.strip()))
            time += DAY * int(days if days.isdigit() else 0) - self._since
        else:
            time = self._duration(node, 'at')
        if not 0.0 <= time < self._lasts:
            raise self.fail(node, f'{text} is not within the scenario, which lasts '
                            f'{self._lasts:g} s')
        return time

    def _program(self, node: Any, what: str) -> Program:
        parts = self.entries(node, f'a {what}', ('run', 'answers', 'quiet', 'rate'), ('run',))
        return Program(
            self.text(parts['run'], 'run'), line_of(node),
            parts.of('answers', self.choice, Program.answers, ANSWERS),
            parts.of('quiet', self._duration, Program.quiet),
            parts.of('rate', self.number, Program.rate, 0.01, 1e6))

    # --- expectations

    def _claim(self, node: Any, what: str) -> Claim:
        """One that can hold within the scenario."""
        found: Claim = self.said(node, what, parsed)
        if contradiction(found):
            raise self.fail(node, f'{what}: {contradiction(found)}: it can never be judged')
        if self._has_start and any(part.window and not day_spans(*part.window, self._since,
                                                                 self._lasts)
                                   for part in found.parts):
            raise self.fail(node, f"{what}: '{found.text}' is never within the scenario: it can "
                            'never be judged')
        return found

    def _expectation(self, node: Any) -> Expectation:
        given = self.entries(node, 'an expectation')
        kind = next((one for one in KINDS if one in given), '')
        if not kind:
            raise self.fail(node, f'an expectation has one of {", ".join(KINDS)}')
        read = {'expect': self._expect, 'never': self._lasting, 'always': self._lasting,
                'at_most': self._limit, 'at_least': self._limit}[kind]
        return read(node, kind)

    def _expect(self, node: Any, kind: str) -> Expectation:
        parts = self.entries(node, 'an expectation', ('expect', 'within', 'of', 'while', 'name'),
                             ('within', 'of'))
        claims = {key: self._claim(parts[key], key) for key in ('expect', 'of', 'while')
                  if key in parts}
        within = self._duration(parts['within'], 'within')
        if within >= self._lasts:
            raise self.fail(parts['within'], 'within is longer than the scenario: it can never be '
                            'judged')
        text = (f'{claims["expect"].text} within {parts["within"].value} of {claims["of"].text}'
                + (f' while {claims["while"].text}' if 'while' in claims else ''))
        return Expectation(kind, self._name(parts, text), claims, within, line=line_of(node))

    def _lasting(self, node: Any, kind: str) -> Expectation:
        parts = self.entries(node, 'an expectation', (kind, 'for', 'while', 'name'), (kind,))
        claims = {key: self._claim(parts[key], key) for key in (kind, 'while') if key in parts}
        held = parts.of('for', self._duration, 0.0)
        if held >= self._lasts:
            raise self.fail(parts['for'], 'for is longer than the scenario: it can never be judged')
        text = (f'{kind} {claims[kind].text}'
                + (f' while {claims["while"].text}' if 'while' in claims else '')
                + (f' {"for more than" if kind == "never" else "but for"} {parts["for"].value}'
                   if held else ''))
        return Expectation(kind, self._name(parts, text), claims, held=held, line=line_of(node))

    def _limit(self, node: Any, kind: str) -> Expectation:
        parts = self.entries(node, 'an expectation', (kind, *COUNTED, 'per', 'name'))
        counted = [key for key in COUNTED if key in parts]
        if len(counted) != 1:
            raise self.fail(node, f'{kind} needs one of {", ".join(COUNTED)}')
        key = counted[0]
        limit, unit = self._quantity(parts[kind], kind, key)
        claims, things = dict[str, Claim](), tuple[str, ...]()
        if key in ('times', 'time_of'):
            claims[key] = self._claim(parts[key], key)
        elif key in ('changes_of', 'energy_of'):
            things = self.texts(parts[key], key)
        else:
            things = (self.text(parts[key], key),)
        per = parts.of('per', self._duration, 0.0)
        if per > self._lasts:
            raise self.fail(parts['per'], 'per is longer than the scenario: it can never be judged')
        what = ' '.join((claims[key].text,) if claims else things)
        text = (f'{kind.replace("_", " ")} {parts[kind].value} {key.replace("_", " ")} {what}'
                + (f' per {parts["per"].value}' if per else ''))
        return Expectation(kind, self._name(parts, text), claims, counted=key, things=things,
                           limit=limit, unit=unit, per=per, line=line_of(node))

    def _quantity(self, node: Any, what: str, key: str) -> tuple[float, str]:
        text = self.text(node, what)
        if key == 'energy_of':
            number, _, unit = text.partition(' ')
            if unit not in ('kWh', 'Wh') or not re.fullmatch(r'\d+(\.\d+)?', number):
                raise self.fail(node, f"{what} is '{text}', must be an energy as 0.5 kWh")
            return float(number) * (1.0 if unit == 'kWh' else 0.001), 'kWh'
        if key == 'time_of':
            return self._duration(node, what), 's'
        return self.number(node, what, 0, 1e9), ''

    def _name(self, parts: Entries, text: str) -> str:
        return self.text(parts['name'], 'name') if 'name' in parts and is_text(parts['name']) \
            else text
