"""The parts of care rules, as their file has them."""
from dataclasses import dataclass
from pathlib import Path

from angen_apps.care.membership import Trapezoid


@dataclass(frozen=True)
class Signal:
    """True while any of some sensors or devices is in a state.

    With `elsewhere` it lasts from that state in one of `of` until one of `elsewhere` that is not
    in `of` comes into the state: where a person was detected last.
    """

    name: str
    of: tuple[str, ...]  # KIND/NAME, NAME may have * and ?
    state: str
    tag: str             # only this RFID tag, '' any
    elsewhere: tuple[str, ...]
    line: int
    rooms: tuple[str, ...] = ()  # names or uses of rooms that `of` is in; none: any room


@dataclass(frozen=True)
class Condition:
    """A signal that is true, or with `negated` false; without a signal a time of day."""

    signal: str
    negated: bool
    lasting: Trapezoid | None  # for how long, s
    began: Trapezoid | None    # the time of day at which that began, s
    time: Trapezoid | None     # the time of day now, s


@dataclass(frozen=True)
class Rule:
    """Warns when the degree of all conditions together reaches the threshold."""

    name: str
    when: tuple[Condition, ...]
    product: bool  # degrees multiply; otherwise the least counts
    threshold: float
    reason: str
    at: str        # a model, sensor, device or type of thing that is warned at; '' first source
    line: int


@dataclass(frozen=True)
class Rules:
    """The contents of a rules file."""

    path: Path
    starts: float | None  # time of day at simulated time 0, s; None: as the home says
    signals: dict[str, Signal]
    rules: tuple[Rule, ...]
    left_out: tuple[str, ...] = ()  # why the home has nothing for some rules
