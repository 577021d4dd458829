"""Runs a scenario: simulated time goes from event to event, and what is tested acts between."""
import math
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Iterator, Protocol, Sequence

from angen_apps.automation.automation_file import read_automations
from angen_apps.automation.automations import Automation, Service
from angen_apps.automation.claims import ANYONE, NOBODY, Line, Lines
from angen_apps.automation.engine import Engine, Sky
from angen_apps.automation.entities import Entities, Entity
from angen_apps.automation.home import House
from angen_apps.automation.scenario import Expectation, Scenario
from angen_apps.automation.services import NOTES, order_of
from angen_apps.residents.light import latitude_of
from angen_tools.common.catalog import kinds
from angen_tools.common.failure import Failure, WrongWords
from angen_tools.common.nearest import did_you_mean
from angen_tools.session import Event

FIRST = 0.01  # s, in which sensors report the state in which they start
POLL = 10.0   # s between two looks at numbers, which no event announces
LOOK = 1.0    # s between two looks at where people are, if an expectation asks for it
SLICE = 900.0  # s between two reports of progress
ROUNDS = 1000  # answers to one moment
Change = tuple[Entity, str, str]


@dataclass(frozen=True)
class Done:
    """A service that was called, or a note; `error`: why it was rejected."""

    time: float
    by: str
    what: str
    entity: str = ''
    error: str = ''


@dataclass
class Record:
    """The results of a run."""

    scenario: Scenario
    house: House
    lines: Lines
    watts: dict[str, Line]
    entities: Entities
    done: list[Done] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    cut: str = ''  # why the run ended early
    tested: str = ''


class Subject(Protocol):
    """What is tested."""

    needs: set[str]  # ids of entities

    @property
    def due(self) -> float: ...

    def begin(self, bench: 'Bench') -> None: ...

    def observe(self, changes: Sequence[Change], now: float) -> None: ...

    def advance(self, now: float) -> bool:
        """Does one thing that is due; whether there was one."""

    def end(self) -> None: ...


class HomeAssistant:
    """Automations of Home Assistant, run by our engine."""

    def __init__(self, paths: Sequence[Path]) -> None:
        self._paths = paths
        self.needs: set[str] = set()

    def read(self, entities: Entities) -> None:
        self.automations: list[Automation] = []
        for path in self._paths:
            self.automations += read_automations(path, entities)
        self.needs = set(_names(self.automations))

    def begin(self, bench: 'Bench') -> None:
        sky = Sky(bench.house.start, latitude_of(bench.house.site.home))
        self.engine = Engine(self.automations, bench.entities, sky, bench.order, bench.now)

    @property
    def due(self) -> float:
        return self.engine.due

    def observe(self, changes: Sequence[Change], now: float) -> None:
        self.engine.now = now
        for change in changes:
            self.engine.observe(*change)

    def advance(self, now: float) -> bool:
        return self.engine.advance(now)

    def end(self) -> None:
        pass


def _names(part: Any) -> Iterator[str]:
    """All ids of entities in automations."""
    if isinstance(part, (list, tuple)):
        for each in part:
            yield from _names(each)
    elif hasattr(part, '__dataclass_fields__'):
        for name in part.__dataclass_fields__:
            if name == 'entities':
                yield from getattr(part, name)
            else:
                yield from _names(getattr(part, name))


class Bench:
    """A scenario that is run with what it tests."""

    def __init__(self, scenario: Scenario, subject: Subject,
                 read: Callable[[Entities], None] = lambda _: None,
                 progress: Callable[[float], None] = lambda _: None) -> None:
        """`read` is called when the entities are known."""
        self.scenario, self.subject, self._progress = scenario, subject, progress
        self._folder = tempfile.TemporaryDirectory(prefix='angen_')
        self.house = House(scenario, Path(self._folder.name), self._pass)
        self.entities = Entities(self.house.world)
        read(self.entities)
        self._named = self._sources() | {(name, '') for name in subject.needs}
        things = {self.entities.find(name).thing.key for name, _ in self._named}
        if subject.needs or not scenario.program:
            self.house.keep(things)
        else:
            things = set(self.entities.things)
        self._watched = sorted(things)
        self._polled = [key for key in self._watched
                        if any(part.is_number for part in self.entities.things[key].parts())]
        self.lines = Lines({}, [], 0.0, self.house.since)
        self.watts: dict[str, Line] = {}
        self.done: list[Done] = []
        self.events: list[Event] = []
        self._poll = self._look = 0.0
        self.is_running = False

    def _sources(self) -> set[tuple[str, str]]:
        """Entities and attributes of expectations; WrongWords if one is not there."""
        found = set()
        for each in self.scenario.expectations:
            for claim in each.claims.values():
                for part in claim.parts:
                    if part.window is not None:
                        continue
                    if not part.who:
                        self._check(each, part.source, part.attribute, part.value)
                        found.add(part.key)
                    else:
                        self._check_person(each, part.who, part.room)
            if each.counted in ('changes_of', 'energy_of'):
                found |= {(self._check(each, name), '') for name in each.things}
        return found

    def _check(self, each: Expectation, name: str, attribute: str = '', value: str = '') -> str:
        try:
            entity = self.entities.find(name)
            entity.attribute(attribute)
            options = entity.component.config.get('options')
            if entity.domain in ('light', 'switch', 'binary_sensor', 'fan') and not attribute:
                options = ['on', 'off']
            if value and options and value not in options:
                raise Failure(f"{name} is never '{value}'; {did_you_mean(value, options)}")
            return entity.id
        except Failure as error:
            raise WrongWords(self.scenario.fail(each.line, str(error))) from None

    def _check_person(self, each: Expectation, who: str, room: str) -> None:
        names = [one.name for one in self.scenario.people] + [ANYONE, NOBODY]
        if who not in names and not self.scenario.residents:
            raise WrongWords(self.scenario.fail(each.line, f"there is no person '{who}'; "
                                                + did_you_mean(who, names)))
        home = self.house.site.home
        if room and home.room(room) is None:
            raise WrongWords(self.scenario.fail(
                each.line, f"the home has no room '{room}'; "
                + did_you_mean(room, [one.name for one in home.rooms])))

    # --- the run

    @property
    def now(self) -> float:
        return float(self.house.site.world.time)

    def run(self) -> Record:
        """Runs to the end, or until Ctrl-C or what is tested cuts it."""
        cut = ''
        try:
            self._begin()
            while self.now < self.scenario.lasts - 1e-6:
                self.house.live(min(self.now + SLICE, self.scenario.lasts))
                self._progress(self.now / self.scenario.lasts)
        except KeyboardInterrupt:
            cut = f'{self.scenario.path}: it was interrupted'
        except Cut as why:
            cut = str(why)
        finally:
            self.house.close()
            self.subject.end()
        self.lines.end = self.now
        return Record(self.scenario, self.house, self.lines, self.watts, self.entities, self.done,
                      self.events, cut)

    def _begin(self) -> None:
        self.house.settle()
        people = self.lines.people = self.house.people
        self._check_names(people)
        self.house.site.world.run(FIRST)
        self.entities.read(self._watched, 0.0)
        for event in self.house.world.events():
            self.entities.on_event(event)
        for name, attribute in sorted(self._named | {(name, attribute) for name, _ in self._named
                                                     for attribute in self.entities.find(
                                                         name).attributes()}):
            self.lines.values[name, attribute] = [
                (0.0, self.entities.find(name).attribute(attribute))]
        for name, text in self.house.lines().items():
            self.lines.values[name, ''] = [(0.0, text)]
        self._note_power(0.0)
        self.subject.begin(self)
        self.is_running = True
        self._poll = self._look = self.now

    def _check_names(self, people: Sequence[str]) -> None:
        for each in self.scenario.expectations:
            for claim in each.claims.values():
                for part in claim.parts:
                    if part.who not in ('', ANYONE, NOBODY, *people):
                        raise WrongWords(self.scenario.fail(
                            each.line, f"there is no person '{part.who}'; "
                            + did_you_mean(part.who, people)))

    def _pass(self, seconds: float) -> None:
        """Lets simulated time pass, and what is tested answer each event."""
        world, end = self.house.site.world, self.now + seconds
        while self.now < end - 1e-9:
            self._settle()
            due = min(end, self.subject.due, self._poll, self._look)
            before = world.tick
            world.run(max(due - self.now, 0.0), long_steps=True, until_event=True)
            if world.tick == before:
                world.step()
        self._settle()

    def _settle(self) -> None:
        """All that is due at this moment."""
        if not self.is_running:
            return
        for _ in range(ROUNDS):
            changes = self._changes()
            if changes:
                self._note(changes)
                self.subject.observe(changes, self.now)
            elif not self.subject.advance(self.now):
                return
        raise Cut(f'{self.scenario.path}: at {self.now:g} s what is tested has acted {ROUNDS} '
                  'times, and goes on')

    def _changes(self) -> list[Change]:
        changes, now = [], self.now
        events = self.house.world.events()
        self.events += events
        for event in events:
            changes += self.entities.on_event(event)
        if events:
            self._note_power(now)
        if now >= self._poll - 1e-9:
            self._poll = now + POLL
            changes += self.entities.read(self._polled, now, flags=False)
        if now >= self._look - 1e-9:
            self._look = now + LOOK
            for name, text in self.house.lines().items():
                self._put((name, ''), text)
        return changes

    def _note(self, changes: Sequence[Change]) -> None:
        for entity, _, _ in changes:
            for key in ('', *entity.attributes()):
                if (entity.id, key) in self.lines.values:
                    self._put((entity.id, key), entity.attribute(key))

    def _put(self, key: tuple[str, str], text: str) -> None:
        line = self.lines.values.setdefault(key, [])
        if not line or line[-1][1] != text:
            line.append((self.now, text))

    def _note_power(self, now: float) -> None:
        """The power of loads."""
        for key, thing in self.entities.things.items():
            if 'power' in {each['name'] for each in kinds().get(key[0], {'fields': []})['fields']} \
                    and key[0] in kinds('device'):
                watts = self.house.simulator.state(*key).get('power', 0.0)
                line = self.watts.setdefault('/'.join(key), [])
                text = f'{float(watts) if math.isfinite(watts) else 0.0:.3f}'
                if not line or line[-1][1] != text:
                    line.append((now, text))

    def order(self, service: Service, by: str) -> None:
        """Carries out a service."""
        data = dict(service.data)
        if service.name.partition('.')[0] in NOTES:
            self.done.append(Done(self.now, by, data.get('message', service.name)))
            return
        for name in service.entities:
            entity, error = self.entities.find(name), ''
            try:
                part, payload = order_of(service.name, entity, data)
                self.entities.command(entity, part, payload)
            except Failure as why:
                error = str(why)
            words = ' '.join(f'{key}: {value}' for key, value in data.items())
            self.done.append(Done(self.now, by, f'{service.name} {words}'.strip(), name, error))


class Cut(Exception):
    """Why a run ends early."""
