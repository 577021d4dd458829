"""A world in this process: `import angen`, as fast as possible."""
import math
from contextlib import suppress
from typing import Any, Iterator, Self, Sequence

from angen_tools.common.catalog import simulator
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home, Pose
from angen_tools.session.world import Entity, Event, State, Summary, World


class InProcess(World):
    """See World. `world` is the angen.World, for all that only tools in its process can do."""

    def __init__(self, world: Any, long_steps: bool = False) -> None:
        """`long_steps`: ticks of up to 20 ms while only people walk, free of contact."""
        self.world, self._long_steps = world, long_steps
        self._stamps: dict[tuple[str, str], float] = {}  # stamps of states handed out

    @classmethod
    def load(cls, path: str, seed: int = 1) -> Self:
        """The world of a file; Failure if it does not load."""
        with simulator() as angen:
            return cls(angen.World(path, seed))

    @property
    def now(self) -> float:
        return float(self.world.time)

    @property
    def home(self) -> Home:
        return Home.of_world(self.world)

    def entities(self, kind: str = '') -> list[Entity]:
        found = [] if kind == 'model' else self.world.entities(kind)
        if kind in ('', 'model'):
            found += [('model', name, name, self.world.motion(name)[0])
                      for name in self.world.models]
        return sorted((self._entity(*each) for each in found), key=lambda e: (e.name, e.kind))

    def _entity(self, kind: str, name: str, model: str, pose: Sequence[float]) -> Entity:
        at = _seven(pose)
        return Entity(kind, name, model, at, self.world.room_at(*at[:3]))

    def pose(self, name: str) -> Pose:
        with simulator():
            return _seven(self.world.motion(name)[0])

    def state(self, kind: str, name: str, since: float = -math.inf) -> State:
        with simulator():
            return _state(self._reading(kind, name))

    def _reading(self, kind: str, name: str) -> dict[str, Any]:
        found = (self.world.sensor if self.world.sensors(kind) else self.world.device)(kind, name)
        return {**found, 'name': name}

    def states(self, *kinds: str) -> list[State]:
        new = []
        for key in (key for kind in kinds for key in self._keys(kind)):
            with suppress(Failure):  # it has measured nothing yet
                state = self.state(*key)
                if self._stamps.get(key) != state.time:
                    self._stamps[key] = state.time
                    new.append(state)
        return sorted(new, key=lambda state: state.time)

    def _keys(self, kind: str = '') -> Iterator[tuple[str, str]]:
        for its, name, _, _ in self.world.entities(kind):
            yield its, name

    def request(self, kind: str, name: str, wanted: bool = True) -> None:
        with simulator():
            self.world.request(kind, name, wanted)

    def summaries(self) -> dict[tuple[str, str], Summary]:
        return {each[:2]: Summary(*each) for each in self.world.summaries()}

    def events(self) -> list[Event]:
        return [Event(*event) for event in self.world.events()]

    def command(self, kind: str, name: str, text: str) -> str:
        with simulator():
            self.world.command(kind, name, text)
        return '' if name == 'all' else str(self.world.summary(kind, name))

    def spawn(self, name: str, what: str, pose: Sequence[float] = (0.0,) * 6, on: str = '') -> None:
        with simulator():
            self.world.spawn(what, name, pose, on)

    def delete(self, name: str) -> None:
        with simulator():
            self.world.delete(name)

    def place(self, model: str, pose: Sequence[float]) -> None:
        with simulator():
            self.world.set_state(model, pose, [0.0] * 3, [0.0] * 3)

    def save(self) -> str:
        return str(self.world.save())

    def run(self, seconds: float) -> None:
        with simulator():
            self.world.run(seconds, self._long_steps)


def _state(reading: dict[str, Any]) -> State:
    return State(reading.pop('kind'), reading.pop('name'), reading.pop('stamp'), reading)


def _seven(pose: Sequence[float]) -> Pose:
    x, y, z, a, b, c, d = (float(value) for value in pose)
    return x, y, z, a, b, c, d
