"""Care rules over a simulated time without ROS: as fast as possible, by the same engine."""
from pathlib import Path
from typing import Sequence

from angen_tools.offline.day import Order, checked_orders
from angen_apps.care.engine import Change
from angen_apps.care.follower import Follower
from angen_apps.care.rules import Rules
from angen_apps.data.run import first_day, residents_of
from angen_apps.data.site import Site
from angen_apps.residents.household import Household
from angen_apps.residents.members import make
from angen_tools.common.progress import Progress
from angen_tools.session import Event
from angen_tools.session.in_process import InProcess

SLICE = 60.0  # simulated s between two progress reports
FIRST = 1.1   # s after which each sensor has published


class Watched(Follower):
    """A world in this process, the engine that follows it, and all that happened."""

    def __init__(self, rules: Rules, world: Path, seed: int, residents: Sequence[str] = ()
                 ) -> None:
        """`residents`: profiles of the people who live there, or how many they are."""
        site = Site(world, seed, placed=False) if residents else None
        own = InProcess.load(str(world), seed) if site is None else InProcess(site.world)
        super().__init__(rules, own)
        self._world, self._live = own.world, own.run
        if site is not None:
            household = Household(site.simulator, site.floors, seed, world.stem,
                                  first_day(site.home), self.rules.starts or 0.0)
            make(household, residents_of(list(residents)))
            self._live = lambda seconds: household.run(self.time + seconds)
        self.events: list[Event] = []
        self.changes: list[Change] = []
        self._run(FIRST)
        self.begin(0.0)
        self._follow()

    @property
    def time(self) -> float:
        return self.world.now

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
        events, changes = self.follow()
        self.events += events
        self.changes += changes
