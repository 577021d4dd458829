"""Runs automations of Home Assistant in simulated time: changes of states and time in, services
out. Its clock is told by the bench."""
import datetime
import heapq
import itertools
import math
from functools import partial
from typing import Callable, Iterator, Protocol, Sequence

from angen_apps.automation.automations import (
    Action, Automation, Choice, Condition, Delay, Logic, NumericCondition, NumericTrigger, Service,
    StateCondition, StateTrigger, Stop, SunCondition, SunTrigger, Test, TimeCondition, TimeTrigger,
    Trigger, TriggerCondition, Wait)
from angen_apps.automation.entities import UNKNOWN, Entities, Entity
from angen_tools.common.clock import DAY
from angen_tools.common.sun import sun

FEW = 1e-6  # s, more than the rounding of a time
ROUNDS = 1000  # automations that start one another at one moment
HALVINGS = 20  # so often a part of a day is halved, to milliseconds
STEPS = 288  # looks at the sun a day
RISEN = -0.267  # degrees: the apparent elevation of the sun's middle when its edge rises


class Sky:
    """When the sun rises and sets; times in s since the start."""

    def __init__(self, start: datetime.datetime, latitude: float) -> None:
        self.start, self._latitude = start, latitude
        self._days: dict[datetime.date, dict[str, float | None]] = {}

    def at(self, now: float) -> datetime.datetime:
        """The clock on the wall."""
        return self.start + datetime.timedelta(seconds=now)

    def of_day(self, now: float, event: str) -> float | None:
        """When the sun rises or sets on the day of a time; None if it does not."""
        midnight = self.at(now).replace(hour=0, minute=0, second=0, microsecond=0)
        day = midnight.date()
        if day not in self._days:
            self._days[day] = {'sunrise': self._crossing(midnight, 1.0),
                               'sunset': self._crossing(midnight, -1.0)}
        return self._days[day][event]

    def _up(self, moment: datetime.datetime, sign: float) -> bool:
        apparent = sun(moment, self._latitude)[0]
        return sign * (math.degrees(apparent) - RISEN) > 0.0

    def _crossing(self, midnight: datetime.datetime, sign: float) -> float | None:
        def moment(seconds: float) -> datetime.datetime:
            return midnight + datetime.timedelta(seconds=seconds)
        for i in range(STEPS):
            low, high = i * DAY / STEPS, (i + 1) * DAY / STEPS
            if not self._up(moment(low), sign) and self._up(moment(high), sign):
                for _ in range(HALVINGS):
                    middle = (low + high) / 2
                    low, high = (low, middle) if self._up(moment(middle), sign) else (middle, high)
                return (moment(high) - self.start).total_seconds()
        return None


class Orders(Protocol):
    """What carries out services."""

    def __call__(self, service: Service, by: str) -> None: ...


class Timers:
    """Calls at times, in order."""

    def __init__(self) -> None:
        self._heap: list[tuple[float, int, Callable[[], None]]] = []
        self._count = itertools.count()
        self._off: set[int] = set()

    @property
    def due(self) -> float:
        while self._heap and self._heap[0][1] in self._off:
            self._off.discard(heapq.heappop(self._heap)[1])
        return self._heap[0][0] if self._heap else math.inf

    def add(self, time: float, call: Callable[[], None]) -> int:
        number = next(self._count)
        heapq.heappush(self._heap, (time, number, call))
        return number

    def cancel(self, number: int) -> None:
        self._off.add(number)

    def run(self, now: float) -> bool:
        """Calls one that is due; whether there was one."""
        if self.due > now + FEW:
            return False
        heapq.heappop(self._heap)[2]()
        return True


class Watched:
    """A trigger that waits to fire; `for` is counted for each entity."""

    def __init__(self, engine: 'Engine', trigger: Trigger, fire: Callable[[str], None]) -> None:
        self._engine, self._trigger, self._fire = engine, trigger, fire
        self._timers: dict[str, int] = {}  # by entity
        self._left: dict[str, str] = {}  # the state that each with a timer has left
        self.over = False
        if isinstance(trigger, NumericTrigger):
            self._inside = {name: self._is_inside(engine.entities.find(name))
                            for name in trigger.entities}
        if isinstance(trigger, (TimeTrigger, SunTrigger)):
            self._plan(self._engine.now)

    def end(self) -> None:
        self.over = True
        for number in self._timers.values():
            self._engine.timers.cancel(number)

    def _plan(self, now: float) -> None:
        """The next time of a time or sun trigger."""
        at = self._engine.next_time(self._trigger, now)
        if at is not None:
            self._timers[''] = self._engine.timers.add(at, partial(self._on_time, at))

    def _on_time(self, at: float) -> None:
        if not self.over:
            self._plan(at + FEW)
            self._fire(self._trigger.id)

    def see(self, entity: Entity, before: str, now: str) -> None:
        """An entity's state, or for an equal one an attribute, has changed."""
        trigger = self._trigger
        if isinstance(trigger, StateTrigger) and entity.id in trigger.entities and before != now:
            self._see_state(trigger, entity, before, now)
        elif isinstance(trigger, NumericTrigger) and entity.id in trigger.entities:
            inside = self._is_inside(entity)
            was, self._inside[entity.id] = self._inside[entity.id], inside
            if inside and not was:
                self._begin(entity, trigger.held)
            elif not inside:
                self._cancel(entity)

    def _see_state(self, trigger: StateTrigger, entity: Entity, before: str, now: str) -> None:
        # What has `from` alone counts until its entity is back in the state that it left.
        goes_on = (trigger.origin and not trigger.to and entity.id in self._timers
                   and now != self._left[entity.id])
        if goes_on:
            return
        self._cancel(entity)
        if (not trigger.to or now in trigger.to) and (not trigger.origin
                                                      or before in trigger.origin):
            self._left[entity.id] = before
            self._begin(entity, trigger.held)

    def _is_inside(self, entity: Entity) -> bool:
        assert isinstance(self._trigger, NumericTrigger)
        return inside(entity, self._trigger.attribute, self._trigger.above, self._trigger.below)

    def _begin(self, entity: Entity, held: float) -> None:
        if held > 0.0:
            self._timers[entity.id] = self._engine.timers.add(
                self._engine.now + held, partial(self._on_held, entity.id))
        else:
            self._fire(self._trigger.id)

    def _on_held(self, name: str) -> None:
        self._timers.pop(name, None)
        if not self.over:
            self._fire(self._trigger.id)

    def _cancel(self, entity: Entity) -> None:
        number = self._timers.pop(entity.id, None)
        if number is not None:
            self._engine.timers.cancel(number)


class Run:
    """The actions of an automation, from a trigger on."""

    def __init__(self, engine: 'Engine', automation: Automation, trigger: str) -> None:
        self._engine, self._automation, self._trigger = engine, automation, trigger
        self._steps = self._all(automation.actions)
        self._waits: list[Watched] = []
        self._timer: int | None = None
        self.over = False

    def go(self) -> None:
        """Acts until it waits or ends."""
        if not self.over and next(self._steps, None) is None:
            self.end()

    def end(self) -> None:
        self.over = True
        self._rest()

    def _rest(self) -> None:
        for waits in self._waits:
            waits.end()
        self._engine.forget(self._waits)
        self._waits = []
        if self._timer is not None:
            self._engine.timers.cancel(self._timer)
            self._timer = None

    def _all(self, actions: Sequence[Action]) -> Iterator[bool]:
        """Yields True when it waits. A condition that fails ends this block; Stop, and a wait that
        must not go on, end the run by `over`."""
        for action in actions:
            if isinstance(action, Service):
                self._engine.orders(action, self._automation.name)
            elif isinstance(action, Delay):
                self._sleep(action.seconds)
                yield True
            elif isinstance(action, Wait):
                yield from self._wait(action)
            elif isinstance(action, Test):
                if not self._engine.holds(action.condition, self._trigger):
                    return
            elif isinstance(action, Choice):
                yield from self._all(self._chosen(action))
            elif isinstance(action, Stop):
                self.over = True
            if self.over:
                return

    def _chosen(self, choice: Choice) -> Sequence[Action]:
        return next((actions for conditions, actions in choice.options
                     if all(self._engine.holds(one, self._trigger) for one in conditions)),
                    choice.default)

    def _sleep(self, seconds: float) -> None:
        self._timer = self._engine.timers.add(self._engine.now + seconds, self._wake)

    def _wake(self) -> None:
        self._rest()
        self.go()

    def _wait(self, wait: Wait) -> Iterator[bool]:
        fired: list[str] = []

        def fire(name: str) -> None:
            if not fired and not self.over:
                fired.append(name)
                self._engine.later(self._wake)

        self._waits = [self._engine.watch(trigger, fire) for trigger in wait.triggers]
        if wait.timeout is not None:
            self._sleep(wait.timeout)
        yield True
        if not fired and not wait.goes_on:
            self.over = True


class Engine:
    """Automations over the entities of a home."""

    def __init__(self, automations: Sequence[Automation], entities: Entities, sky: Sky,
                 orders: Orders, now: float = 0.0) -> None:
        self.entities, self.sky, self.orders, self.now = entities, sky, orders, now
        self.timers = Timers()
        self._watched: list[Watched] = []
        self._runs: dict[str, list[Run]] = {}
        self.started: list[tuple[float, str]] = []  # when each automation ran
        for number, automation in enumerate(automations):
            for trigger in automation.triggers:
                self.watch(trigger, partial(self._start, automation, f'{number}'))

    @property
    def due(self) -> float:
        """When something is to be done, if nothing changes before."""
        return self.timers.due

    def watch(self, trigger: Trigger, fire: Callable[[str], None]) -> Watched:
        watched = Watched(self, trigger, fire)
        self._watched.append(watched)
        return watched

    def forget(self, over: Sequence[Watched]) -> None:
        self._watched = [each for each in self._watched if each not in over]

    def later(self, call: Callable[[], None]) -> None:
        """Calls at this moment, after what is under way."""
        self.timers.add(self.now, call)

    def observe(self, entity: Entity, before: str, now: str) -> None:
        """The state of an entity, or an attribute, has changed."""
        for watched in list(self._watched):
            if not watched.over:
                watched.see(entity, before, now)

    def advance(self, now: float) -> bool:
        """Time is `now`: one thing that is due; whether there was one."""
        self.now = now
        return self.timers.run(now)

    def _start(self, automation: Automation, key: str, trigger: str) -> None:
        if not all(self.holds(condition, trigger) for condition in automation.conditions):
            return
        runs = self._runs[key] = [run for run in self._runs.get(key, ()) if not run.over]
        if runs and automation.mode == 'single':
            return
        if automation.mode == 'restart':
            for run in runs:
                run.end()
        self.started.append((self.now, automation.name))
        run = Run(self, automation, trigger)
        self._runs[key].append(run)
        self.later(run.go)

    # --- time

    def next_time(self, trigger: Trigger, now: float) -> float | None:
        """The next time of a time or sun trigger, from `now` on."""
        for days in range(-1, 367):
            moment = now + days * DAY
            if isinstance(trigger, SunTrigger):
                at = self.sky.of_day(moment, trigger.event)
                at = None if at is None else at + trigger.offset
            else:
                assert isinstance(trigger, TimeTrigger)
                at = moment - seconds_of(self.sky.at(moment)) + trigger.at
            if at is not None and at >= now:
                return at
        return None

    # --- conditions

    def holds(self, condition: Condition, trigger: str = '') -> bool:
        """Whether a condition holds now; `trigger`: the id of the one that fired."""
        if isinstance(condition, Logic):
            parts = (self.holds(part, trigger) for part in condition.parts)
            return {'and': all, 'or': any, 'not': lambda each: not any(each)}[condition.word](parts)
        if isinstance(condition, StateCondition):
            return all(self._has_state(condition, self.entities.find(name))
                       for name in condition.entities)
        if isinstance(condition, NumericCondition):
            return all(inside(self.entities.find(name), condition.attribute, condition.above,
                              condition.below) for name in condition.entities)
        if isinstance(condition, TimeCondition):
            return self._is_time(condition)
        if isinstance(condition, TriggerCondition):
            return trigger in condition.ids
        return self._is_sun(condition)

    def _has_state(self, condition: StateCondition, entity: Entity) -> bool:
        return (entity.attribute(condition.attribute) in condition.states
                and self.now - entity.changed >= condition.held - FEW)

    def _is_time(self, condition: TimeCondition) -> bool:
        moment = self.sky.at(self.now)
        if condition.weekdays and moment.weekday() not in condition.weekdays:
            return False
        clock = seconds_of(moment)
        after, before = condition.after or 0.0, condition.before
        if before is None:
            return clock >= after
        if condition.after is None or after < before:
            return after <= clock < before
        return clock >= after or clock < before

    def _is_sun(self, condition: SunCondition) -> bool:
        """As of Home Assistant: of the present day; both together are a night if they cross it."""
        times = [None if not event else self.sky.of_day(self.now, event)
                 for event in (condition.after, condition.before)]
        after = None if times[0] is None else times[0] + condition.after_offset
        before = None if times[1] is None else times[1] + condition.before_offset
        is_after = after is None or self.now > after
        is_before = before is None or self.now < before
        if condition.after == 'sunset' and condition.before == 'sunrise':
            return is_after or is_before
        return is_after and is_before


def seconds_of(moment: datetime.datetime) -> float:
    """Since midnight."""
    return (moment - moment.replace(hour=0, minute=0, second=0, microsecond=0)).total_seconds()


def inside(entity: Entity, attribute: str, above: float, below: float) -> bool:
    """Whether a number is between limits, which are not in it."""
    text = entity.attribute(attribute)
    try:
        return text != UNKNOWN and above < float(text) < below
    except ValueError:
        return False
