"""Care rules over a world: its events and time in, changes of warnings out."""
from angen_apps.care.engine import Change, Engine
from angen_apps.care.rules import Rules
from angen_apps.care.sources import at_home, check_sources
from angen_tools.session import Event, World


class Follower:
    """An engine that follows a world; a reset of its time starts it again."""

    def __init__(self, rules: Rules, world: World) -> None:
        self.world, self._written = world, rules
        self.check()

    def check(self) -> None:
        """Gives the rules their sources in this home; Failure if one is missing."""
        self._new = self.world.events()  # events from now on are not missed
        self.entities = self.world.entities()
        existing = {f'{kind}/{name}' for kind, name in self.world.summaries()}
        rooms = {f'{entity.kind}/{entity.name}': entity.room for entity in self.entities}
        self.rules = at_home(self._written, self.world.home, rooms, existing)
        check_sources(self.rules, existing, {entity.name for entity in self.entities})

    def begin(self, start: float) -> None:
        """Begins with the present states, as of the time `start` (s)."""
        summaries = {f'{kind}/{name}': summary.text
                     for (kind, name), summary in self.world.summaries().items()}
        self.engine = Engine(self.rules, summaries, summaries, start)
        self._start, self._time = start, 0.0

    def follow(self) -> tuple[list[Event], list[Change]]:
        """What has happened since the last call, and the changes of warnings by it."""
        events, changes = [*self._new, *self.world.events()], []
        self._new = []
        for event in events:
            if event.time >= self._start:
                changes += self.engine.observe(event)
        self._time = self.world.complete_until
        return events, changes + self.engine.advance(self._time)
