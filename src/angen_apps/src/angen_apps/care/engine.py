"""The rule engine: events and time in, warnings out. It knows neither ROS nor a world."""
import math
from dataclasses import dataclass, replace
from heapq import heappop, heappush
from typing import Collection, Iterable, Mapping

from angen_tools.common.clock import DAY, show_duration, show_time
from angen_apps.care.rules import Condition, Rule, Rules
from angen_apps.care.signals import LiveSignal
from angen_apps.care.sources import place_of
from angen_tools.session import Event

STEP = 1.0      # s of simulated time between two looks at the clock
ROUNDING = 1e-6  # s, more than that of a time
RELEASE = 0.5   # a warning ends when its degree falls below this share of the threshold
RESOLUTION = 0.005  # resolution of the recorded degrees

RAISED, ACKNOWLEDGED, ENDED = 'raised', 'acknowledged', 'ended'


@dataclass(frozen=True)
class CareWarning:
    """One time at which a rule warns; times in s of simulated time."""

    rule: Rule
    raised: float
    degree: float    # when it was raised
    detail: str      # the conditions, as they were then
    acknowledged: float | None = None
    ended: float | None = None


@dataclass(frozen=True)
class Change:
    """A change of a warning's state."""

    time: float
    event: str  # RAISED, ACKNOWLEDGED or ENDED
    warning: CareWarning
    degree: float


class Curve:
    """The degree of a rule over time, as the corners of straight lines."""

    def __init__(self) -> None:
        self.points: list[tuple[float, float]] = []
        self._last = (0.0, -1.0)

    def add(self, time: float, degree: float) -> None:
        """The degree at a time, later than all before."""
        if not self.points or abs(degree - self.points[-1][1]) > RESOLUTION:
            if self.points and self._last[0] > self.points[-1][0]:
                self.points.append(self._last)
            self.points.append((time, degree))
        self._last = (time, degree)

    def line(self) -> list[tuple[float, float]]:
        """The corners, up to now."""
        ahead = bool(self.points) and self._last[0] > self.points[-1][0]
        return [*self.points, self._last] if ahead else list(self.points)


class Engine:
    """Follows the signals and gives warnings. Time never decreases."""

    def __init__(self, rules: Rules, existing: Collection[str], summaries: Mapping[str, str],
                 now: float = 0.0) -> None:
        """`existing`: each KIND/NAME; `summaries`: their states at the time `now` (s)."""
        self.rules = rules
        self.starts = rules.starts or 0.0  # time of day at simulated time 0, s
        self.began = self.now = now
        self.signals = {name: LiveSignal(signal, existing, summaries, now)
                        for name, signal in rules.signals.items()}
        self.active: dict[str, CareWarning] = {}
        self.past: list[CareWarning] = []
        self.curves = {rule.name: Curve() for rule in rules.rules}
        self.places = {rule.name: place_of(rule, rules, existing) for rule in rules.rules}
        self._steps = 0
        self._corners: list[float] = []  # a heap of times
        self._expect(self.signals)

    def observe(self, event: Event) -> list[Change]:
        """Takes an event; events come in order, a late one counts as of now."""
        changes = self.advance(event.time)
        self.now = max(self.now, event.time)
        flipped = {name for name, signal in self.signals.items() if signal.observe(event)}
        if flipped:
            self._expect(flipped)
            changes += self._judge(self.now)
        return changes

    def advance(self, time: float) -> list[Change]:
        """All that happens up to a time in which there is no event."""
        changes: list[Change] = []
        while True:
            step = self.began + (self._steps + 1) * STEP
            due = min([step, *self._corners[:1]])
            if due > time:
                return changes
            if due == step:
                self._steps += 1
            else:
                heappop(self._corners)
            self.now = max(self.now, due)
            changes += self._judge(self.now)

    def _expect(self, flipped: Collection[str]) -> None:
        """Notes when memberships of the durations of signals that have just changed have corners:
        a warning is then on time, between two steps."""
        for rule in self.rules.rules:
            for condition in rule.when:
                if condition.signal in flipped and condition.lasting is not None:
                    since = self.signals[condition.signal].since + ROUNDING
                    for corner in {condition.lasting.a, condition.lasting.b}:
                        heappush(self._corners, since + corner)

    def acknowledge(self, name: str) -> list[Change]:
        """A user has seen the warning of a rule, or of 'all'; none if it is not active."""
        changes = []
        for rule, warning in self.active.items():
            if name in ('all', rule) and warning.acknowledged is None:
                self.active[rule] = replace(warning, acknowledged=self.now)
                changes.append(Change(self.now, ACKNOWLEDGED, self.active[rule],
                                      self.degree(warning.rule, self.now)))
        return changes

    def _judge(self, time: float) -> list[Change]:
        changes = []
        for rule in self.rules.rules:
            degree = self.degree(rule, time)
            self.curves[rule.name].add(time, degree)
            warning = self.active.get(rule.name)
            if warning is None and degree >= rule.threshold:
                self.active[rule.name] = CareWarning(rule, time, degree, self._describe(rule, time))
                changes.append(Change(time, RAISED, self.active[rule.name], degree))
            elif warning is not None and degree < RELEASE * rule.threshold:
                ended = replace(self.active.pop(rule.name), ended=time)
                self.past.append(ended)
                changes.append(Change(time, ENDED, ended, degree))
        return changes

    def degree(self, rule: Rule, time: float) -> float:
        """To what degree all conditions of a rule hold at a time."""
        return _and(rule.product, (self._degree_of(condition, rule.product, time)
                                   for condition in rule.when))

    def _degree_of(self, condition: Condition, product: bool, time: float) -> float:
        if condition.time is not None:
            return condition.time.degree(self._time_of_day(time))
        signal = self.signals[condition.signal]
        if signal.on == condition.negated:
            return 0.0
        degrees = []
        if condition.lasting is not None:
            degrees.append(condition.lasting.degree(time - signal.since))
        if condition.began is not None:
            degrees.append(condition.began.degree(self._time_of_day(signal.since)))
        return _and(product, degrees)

    def _time_of_day(self, time: float) -> float:
        return (self.starts + time) % DAY

    def _describe(self, rule: Rule, time: float) -> str:
        parts = []
        for condition in rule.when:
            degree = self._degree_of(condition, rule.product, time)
            if condition.time is not None:
                text = f'at {show_time(self._time_of_day(time))}'
            else:
                since = self.signals[condition.signal].since
                begun = show_time(self._time_of_day(since))
                text = (f'{"not " * condition.negated}{condition.signal} since {begun}, '
                        f'{show_duration(time - since)}')
            parts.append(f'{text} ({degree:.2f})' if degree < 1.0 else text)
        return '; '.join(parts)


def _and(product: bool, degrees: Iterable[float]) -> float:
    return math.prod(degrees) if product else min(degrees, default=1.0)
