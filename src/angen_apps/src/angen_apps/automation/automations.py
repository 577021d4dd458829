"""The parts of an automation of Home Assistant, as its file has them; times in s."""
from dataclasses import dataclass
from pathlib import Path
from typing import Union

MODES = ('single', 'restart', 'parallel')


@dataclass(frozen=True)
class Where:
    """The place in a file, for errors."""

    path: Path
    line: int

    def __str__(self) -> str:
        return f'{self.path}:{self.line}'


@dataclass(frozen=True)
class StateTrigger:
    entities: tuple[str, ...]
    to: tuple[str, ...] = ()    # none: any
    origin: tuple[str, ...] = ()
    held: float = 0.0           # `for`
    id: str = ''


@dataclass(frozen=True)
class NumericTrigger:
    entities: tuple[str, ...]
    above: float
    below: float
    attribute: str = ''
    held: float = 0.0
    id: str = ''


@dataclass(frozen=True)
class TimeTrigger:
    at: float  # s since midnight
    id: str = ''


@dataclass(frozen=True)
class SunTrigger:
    event: str  # sunrise, sunset
    offset: float = 0.0
    id: str = ''


Trigger = Union[StateTrigger, NumericTrigger, TimeTrigger, SunTrigger]


@dataclass(frozen=True)
class StateCondition:
    entities: tuple[str, ...]
    states: tuple[str, ...]
    attribute: str = ''
    held: float = 0.0


@dataclass(frozen=True)
class NumericCondition:
    entities: tuple[str, ...]
    above: float
    below: float
    attribute: str = ''


@dataclass(frozen=True)
class TimeCondition:
    after: float | None
    before: float | None
    weekdays: tuple[int, ...] = ()


@dataclass(frozen=True)
class SunCondition:
    """`after` and `before` are sunrise or sunset, '' for neither."""

    after: str
    before: str
    after_offset: float = 0.0
    before_offset: float = 0.0


@dataclass(frozen=True)
class TriggerCondition:
    ids: tuple[str, ...]


@dataclass(frozen=True)
class Logic:
    word: str  # and, or, not
    parts: tuple['Condition', ...]


Condition = Union[StateCondition, NumericCondition, TimeCondition, SunCondition, TriggerCondition,
                  Logic]


@dataclass(frozen=True)
class Service:
    name: str
    entities: tuple[str, ...]
    data: tuple[tuple[str, str], ...]
    where: Where


@dataclass(frozen=True)
class Delay:
    seconds: float


@dataclass(frozen=True)
class Wait:
    """wait_for_trigger; `timeout` None is forever."""

    triggers: tuple[Trigger, ...]
    timeout: float | None
    goes_on: bool


@dataclass(frozen=True)
class Test:
    """A condition among actions: the rest is left out unless it holds."""

    condition: Condition


@dataclass(frozen=True)
class Choice:
    """if/then/else, and choose: the first whose conditions hold."""

    options: tuple[tuple[tuple[Condition, ...], tuple['Action', ...]], ...]
    default: tuple['Action', ...]


@dataclass(frozen=True)
class Stop:
    pass


Action = Union[Service, Delay, Wait, Test, Choice, Stop]


@dataclass(frozen=True)
class Automation:
    name: str
    triggers: tuple[Trigger, ...]
    conditions: tuple[Condition, ...]
    actions: tuple[Action, ...]
    mode: str
    where: Where
