"""The home of a scenario: its world, its sensors, and the people in it."""
import datetime
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any, Callable, Collection

from lxml import etree

from angen_apps.automation.engine import seconds_of
from angen_apps.automation.scenario import GENERATED, Added, Order, Scenario
from angen_apps.data import faults
from angen_apps.data.run import first_day, residents_of
from angen_apps.data.site import HIGH, Site, apartment, facing
from angen_apps.residents.company import TURNED
from angen_apps.residents.figures import walker
from angen_apps.residents.household import Household
from angen_apps.residents.members import make
from angen_apps.residents.mover import ABOVE
from angen_apps.residents.simulator import Simulator
from angen_models.sdf import ANGEN
from angen_tools.common.catalog import kinds, simulator
from angen_tools.common.failure import Failure, WrongWords
from angen_tools.common.files import write_text
from angen_tools.common.home import Home, Place
from angen_tools.common.nearest import did_you_mean
from angen_tools.offline import day
from angen_tools.session.in_process import InProcess
from angen_tools.session.world import World
from angen_tools.world import sdf

SPEED = 1.0  # m/s of people of a script
CORNER = 1  # the number of the one where added sensors are
FEEDS = ('plug',)  # sensors that devices need


class Clocked(Simulator):
    """The simulator of a household, whose time passes as the bench lets it."""

    def __init__(self, world: World, home: Home, run: Callable[[float], None]) -> None:
        super().__init__(world, home)
        self._run = run

    def run(self, seconds: float) -> None:
        self._run(seconds)


class Actor:
    """A person of the script."""

    def __init__(self, home: 'House', name: str) -> None:
        self._home, self.name, self.posture, self.away = home, name, 'stand', True

    @property
    def line(self) -> str:
        """As claims.Part reads it."""
        if self.away:
            return '||'
        body = self._home.simulator.body(self.name)
        room = self._home.site.home.room_at(body.x, body.y, body.z + 0.5)
        return f'{room.name if room else ""}||{self.posture}'

    def appear(self, x: float, y: float, z: float = 0.0, yaw: float = 0.0, posture: str = 'stand'
               ) -> None:
        body = walker(self.name, SPEED, 'person', posture)
        if not self.away:
            self._home.simulator.vanish(self.name)
        self._home.simulator.appear(self.name, body, x, y, z + ABOVE, yaw)
        self.posture, self.away = posture, False

    def act(self, text: str) -> None:
        """Executes a line of the script; ValueError with what would be right."""
        words = text.split()
        if words == ['leaves']:
            if not self.away:
                self._home.simulator.vanish(self.name)
            self.posture, self.away = 'stand', True
        elif words[:2] == ['goes', 'to'] and len(words) in (3, 4):
            at = self._home.place(words[2:])
            if self.away:
                raise ValueError(f'{self.name} is away; write appears at')
            self._home.simulator.command('person', self.name, f'GoTo {at[0]:.3f} {at[1]:.3f}')
            self.posture = 'stand'
        elif words[:2] == ['appears', 'at'] and len(words) in (3, 4):
            self.appear(*self._home.place(words[2:]))
        elif words[:2] in (['sits', 'on'], ['lies', 'on']) and len(words) == 3:
            place = self._home.seat(words[2], words[0][:-1])
            self.appear(*place.pose, place.posture)
        elif words == ['fidgets'] and self.posture != 'stand' and not self.away:
            body = self._home.simulator.body(self.name)
            self._home.simulator.fidget(self.name, body._replace(yaw=body.yaw + TURNED))
        else:
            raise ValueError(f"'{text}' is not what a person does; write goes to ROOM or X Y, "
                             'appears at, sits on THING, lies on, fidgets or leaves')


class House:
    """A scenario's home. `run` lets time pass; `sensors`: those that are needed, by kind and name,
    None all."""

    def __init__(self, scenario: Scenario, folder: Path, run: Callable[[float], None]) -> None:
        self.scenario = scenario
        self.path = self._world_file(folder)
        self.site = Site(self.path, scenario.seed, scenario.home == GENERATED)
        self.site.world.step()  # all devices have a state
        self.world = InProcess(self.site.world, long_steps=True)
        self.simulator = Clocked(self.world, self.site.home, run)
        self.start = self._start()
        for added in scenario.added:
            self._add(added)
        for name, line in scenario.deleted:
            with simulator(scenario.fail(line, '')):
                self.site.world.delete(name)
        self.site.sensors = self.site.listed()
        if scenario.faults:
            faults.give(self.site, faults.read(scenario.faults))

    def _world_file(self, folder: Path) -> Path:
        """The world with the scenario's start."""
        path = folder / 'home.world'
        if self.scenario.home == GENERATED:
            apartment(path)
        elif self.scenario.start is None:
            return Path(self.scenario.home)
        root = sdf.read(path if path.exists() else Path(self.scenario.home))
        if self.scenario.start is not None:
            home = root.find(f'.//{{{ANGEN}}}home')
            if home is None:
                home = etree.SubElement(root.find('world'), f'{{{ANGEN}}}home')
            for old in home.findall(f'{{{ANGEN}}}start'):
                home.remove(old)
            etree.SubElement(home, f'{{{ANGEN}}}start').text = self.scenario.start.isoformat()
        write_text(path, sdf.text(root))
        return path

    def _start(self) -> datetime.datetime:
        home = self.site.home
        return self.scenario.start or datetime.datetime.combine(
            first_day(home), datetime.time()) + datetime.timedelta(seconds=home.time_of_day)

    @property
    def since(self) -> float:
        """The start's time of day, s."""
        return seconds_of(self.start)

    def _add(self, added: Added) -> None:
        pose = list(added.pose)
        if added.room:
            room = self.site.home.room(added.room)
            if room is None:
                raise WrongWords(self.scenario.fail(added.line, f"the home has no room "
                                                    f"'{added.room}'; " + self._rooms(added.room)))
            x, y, yaw = facing(room, CORNER)
            pose = [x, y, room.floor + HIGH, 0.0, 0.0, yaw]
        what = added.model if added.model.startswith(('<', 'model://')) \
            else f'model://{added.model}'
        with simulator(self.scenario.fail(added.line, '')):
            self.site.world.spawn(what, added.name, pose)

    def _rooms(self, word: str) -> str:
        return did_you_mean(word, [room.name for room in self.site.home.rooms])

    def keep(self, needed: Collection[tuple[str, str]]) -> None:
        """Deletes the sensors that nobody reads: they take time, and change nothing."""
        for kind, name, _, _ in self.site.world.entities():
            if kind in kinds('sensor') and kind not in FEEDS and (kind, name) not in needed:
                with simulator():
                    self.site.world.delete(name)

    def settle(self) -> None:
        """Residents move in, people of the script appear."""
        scenario = self.scenario
        self.household = Household(self.simulator, self.site.floors, scenario.seed, 'home',
                                   self.start.date(), self.since)
        who = residents_of(list(scenario.residents)) if scenario.residents else []
        if scenario.leaves_lamps:
            who = [(name, replace(profile, lamps_on=0.0, lamps_off=0.0)) for name, profile in who]
        make(self.household, who)
        self.actors: dict[str, Actor] = {}
        for person in scenario.people:
            actor = self.actors[person.name] = Actor(self, person.name)
            self._execute(Order(0.0, f'{person.name} {person.does}', person.line), actor)
        self._orders = [self._checked(order) for order in scenario.script]

    def _checked(self, order: Order) -> tuple[Order, Any]:
        """A line of the script, and what executes it: an actor or a command to a device."""
        name, _, rest = order.text.partition(' ')
        if name in self.actors:
            return order, self.actors[name]
        kind, slash, device = name.partition('/')
        if not slash:
            raise WrongWords(self.scenario.fail(order.line, f"'{name}' is no person of the "
                                                'scenario and no KIND/NAME, as stove/kitchen0'))
        where = self.scenario.fail(order.line, '').rstrip(': ')
        try:
            return order, day.checked_orders(self.site.world, [day.Order(
                order.time, kind, device, rest, where)])[0]
        except Failure as error:
            raise WrongWords(str(error)) from None

    def live(self, until: float) -> None:
        """Residents live and the script is played up to a time."""
        while self._orders and self._orders[0][0].time < until:
            order, actor = self._orders[0]
            self.household.run(order.time)
            self._orders.pop(0)
            self._execute(order, actor)
        self.household.run(until)

    def _execute(self, order: Order, actor: Any) -> None:
        try:
            if isinstance(actor, day.Order):
                actor.execute(self.site.world)
            else:
                actor.act(order.text.partition(' ')[2])
        except (ValueError, Failure) as error:
            raise WrongWords(self.scenario.fail(order.line, str(error))) from None

    def place(self, words: list[str]) -> tuple[float, float]:
        """X Y, or a free place of a room; ValueError."""
        if len(words) == 2:
            try:
                return float(words[0]), float(words[1])
            except ValueError:
                raise ValueError(f"'{' '.join(words)}' is not a place; write ROOM or X Y"
                                 ) from None
        if self.site.home.room(words[0]) is None:
            raise ValueError(f"there is no room '{words[0]}'; {self._rooms(words[0])}")
        return self.site.floors.spots(words[0], 1, Random(0))[0]

    def seat(self, thing: str, posture: str) -> Place:
        things = {each.name: each for each in self.site.home.things}
        if thing not in things:
            raise ValueError(f"there is no thing '{thing}'; {did_you_mean(thing, things)}")
        found = [place for place in things[thing].places if place.posture == posture]
        if not found:
            raise ValueError(f'nobody can {posture} on {thing}')
        return found[0]

    @property
    def people(self) -> list[str]:
        return [*(resident.name for resident in self.household.residents), *self.actors]

    def lines(self) -> dict[str, str]:
        """Where each person is, as claims.Part reads it."""
        found = {name: actor.line for name, actor in self.actors.items()}
        for resident in self.household.residents:
            diary = resident.diary.now
            found[resident.name] = '||' if resident.away or diary is None else \
                f'{resident.room}|{diary.activity if diary.phase == "does" else ""}|' \
                f'{resident.posture}'
        return found

    def close(self) -> None:
        with suppress(AttributeError):
            self.household.close()
