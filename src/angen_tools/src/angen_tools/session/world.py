"""The interface of a world to its tools, which is the same in this process and in ROS."""
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import Any, Callable, Mapping, Sequence

from angen_tools.common.home import Home, Pose

MOST = 20_000  # events or messages that are kept for a tool between two calls
STEP = 0.1      # s of simulated time between two checks of a condition


@dataclass(frozen=True)
class Event:
    """One change, as angen_msgs/Event has it; time in s."""

    time: float
    source: str
    kind: str
    event: str
    detail: str = ''

    @property
    def key(self) -> str:
        """KIND/NAME of its source."""
        return f'{self.kind}/{self.source}'


@dataclass(frozen=True)
class Entity:
    """A model, device or sensor: of a sensor its own pose, of a device that of its model.

    In this process it has no topic.
    """

    kind: str
    name: str
    model: str
    pose: Pose
    room: str = ''
    topic: str = ''
    type: str = ''


@dataclass(frozen=True)
class State:
    """The state of a device or the reading of a sensor: the fields of its kind, by name."""

    kind: str
    name: str
    time: float  # s, when it was made
    values: Mapping[str, Any]

    def __getitem__(self, name: str) -> Any:
        return self.values[name]


@dataclass(frozen=True)
class Summary:
    """The state of a device or the reading of a sensor in a few words, as /angen/summary has it."""

    kind: str
    name: str
    text: str      # '' before the first
    alarm: bool    # it detects its target
    time: float    # s, of that state or reading
    values: Sequence[float] = field(default=())  # values of the fields that are flags or numbers
    period: float = 0.0  # s, how often the node publishes a sensor; 0 of one on demand


class World(ABC):
    """A world, which belongs to one thread. Errors are Failures, and change nothing."""

    @property
    @abstractmethod
    def now(self) -> float:
        """Simulated time, s."""

    @property
    def complete_until(self) -> float:
        """The time up to which `events` has them all, s."""
        return self.now

    @property
    @abstractmethod
    def home(self) -> Home:
        """The present home."""

    @abstractmethod
    def entities(self, kind: str = '') -> list[Entity]:
        """What is in the world, or what is of one kind, by name."""

    @abstractmethod
    def pose(self, name: str) -> Pose:
        """The pose of a model, or of MODEL::LINK."""

    @abstractmethod
    def state(self, kind: str, name: str, since: float = -math.inf) -> State:
        """The latest state or reading; in ROS one that was made at `since` (s) or later."""

    @abstractmethod
    def states(self, *kinds: str) -> list[State]:
        """The states and readings of some kinds that are new since the last call: in this process
        the latest of each, in ROS all that were published."""

    @abstractmethod
    def request(self, kind: str, name: str, wanted: bool = True) -> None:
        """Has a sensor on demand sample, as lidars and cameras, or no longer."""

    @abstractmethod
    def summaries(self) -> dict[tuple[str, str], Summary]:
        """By kind and name: every device and sensor in a few words."""

    @abstractmethod
    def events(self) -> list[Event]:
        """The events since the last call, in order; the first call may begin with none."""

    @abstractmethod
    def command(self, kind: str, name: str, text: str) -> str:
        """Commands a device, or `all` of a kind; the state of one in a few words."""

    @abstractmethod
    def spawn(self, name: str, what: str, pose: Sequence[float] = (0.0,) * 6, on: str = '') -> None:
        """Adds a model or sensor at x y z roll pitch yaw: SDF, a path or model://NAME; a sensor on
        the link `on`, in whose frame its pose is."""

    @abstractmethod
    def delete(self, name: str) -> None:
        """Deletes a model or sensor."""

    @abstractmethod
    def place(self, model: str, pose: Sequence[float]) -> None:
        """Puts a model at x y z roll pitch yaw, at rest."""

    @abstractmethod
    def save(self) -> str:
        """The present world as SDF."""

    @abstractmethod
    def run(self, seconds: float) -> None:
        """Lets simulated time pass."""

    def wait(self, condition: Callable[[], bool], limit: float = math.inf, step: float = STEP
             ) -> bool:
        """Lets time pass until the condition holds; false if it does not within `limit` s of
        simulated time."""
        end = self.now + limit
        while not condition():
            if self.now > end - 1e-9:
                return False
            self.run(step)
        return True
