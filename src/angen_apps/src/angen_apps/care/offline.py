"""Care rules over a simulated time without ROS: as fast as possible, by the same engine."""
from __future__ import annotations

from pathlib import Path
from typing import Any, Iterator, Sequence

from angen_tools.offline.day import Order, checked_orders
from angen_apps.care.engine import Change, Engine
from angen_apps.care.rules import Rules
from angen_apps.care.signals import Event
from angen_apps.care.sources import at_home, check_sources
from angen_apps.data.run import first_day, residents_of
from angen_apps.data.site import Site
from angen_apps.residents.household import Household
from angen_apps.residents.resident import make
from angen_apps.robot.entities import entities_of
from angen_tools.common.catalog import kinds, simulator
from angen_tools.common.home import Home
from angen_tools.common.progress import Progress

SLICE = 60.0  # simulated s between two progress reports
FIRST = 1.1   # s after which each sensor has published


class Watched:
    """A world in this process, the engine that follows it, and all that happened."""

    def __init__(self, rules: Rules, world: Path, seed: int, residents: Sequence[str] = ()
                 ) -> None:
        """`residents`: profiles of the people who live there, or how many they are."""
        site = Site(world, seed, placed=False) if residents else None
        if site is None:
            with simulator() as angen:
                self._world = angen.World(str(world), seed=seed)
        else:
            self._world = site.world
        existing = set(_existing(self._world))
        rooms = {f'{e.kind}/{e.name}': e.room for e in entities_of(self._world)}
        rules = at_home(rules, Home.of_world(self._world), rooms, existing)
        names = {key.split('/', 1)[1] for key in existing}
        check_sources(rules, existing, names | set(self._world.models))
        self.rules = rules
        self._live = self._world.run
        if site is not None:
            household = Household(site.simulator, site.ground, seed, world.stem,
                                  first_day(site.home), rules.starts or 0.0)
            make(household, residents_of(list(residents)))
            self._live = lambda seconds: household.run(self.time + seconds)
        self.events: list[Event] = []
        self.changes: list[Change] = []
        self._run(FIRST)
        summaries = {key: self._world.summary(*key.split('/', 1)) for key in existing}
        self.engine = Engine(rules, existing, summaries)
        self._follow()

    @property
    def time(self) -> float:
        return float(self._world.time)

    def run(self, seconds: float, orders: Sequence[Order]) -> None:
        """Simulates up to a time, with commands at theirs."""
        waiting = [order for order in checked_orders(self._world, orders) if order.time < seconds]
        with Progress('care') as progress:
            while self.time < seconds - 1e-6:
                while waiting and waiting[0].time <= self.time:
                    waiting.pop(0).execute(self._world)
                end = min([seconds, self.time + SLICE, *(order.time for order in waiting[:1])])
                self._run(end - self.time)
                self._follow()
                progress.update(self.time / seconds)

    def _run(self, seconds: float) -> None:
        """Simulates `seconds`; at least a tick."""
        before = self._world.tick
        self._live(seconds)
        if self._world.tick == before:
            self._world.step()

    def _follow(self) -> None:
        """Gives the engine all new events."""
        for time, source, kind, event, detail in self._world.events():
            self.events.append(Event(time, source, kind, event, detail))
            self.changes += self.engine.observe(self.events[-1])
        self.changes += self.engine.advance(self.time)


def _existing(world: Any) -> Iterator[str]:
    """KIND/NAME of each sensor and device."""
    for role, named in (('sensor', world.sensors), ('device', world.devices)):
        for kind in kinds(role):
            yield from (f'{kind}/{name}' for name in named(kind))
