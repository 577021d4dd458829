"""A resident's day: scheduled items, a semi-Markov chain between, and interruptions.

A day begins when the resident gets up and ends when the resident gets up again. It depends on the
seed, the resident, the date and the household's meals only, so that it can be planned alone.
"""
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from random import Random
from typing import Sequence

from angen_apps.residents.activities import activities
from angen_apps.residents.chance import around, chance, choose, spread
from angen_apps.residents.moods import Day, Mood, Person
from angen_apps.residents.profiles import DAY, Profile, Scheduled, Span

SHORTEST = 90.0  # s: a gap that is shorter is not filled
RESORT = 'relax'  # activity with nothing else to do
AGAIN = 0.3  # how likely an activity follows itself, compared with others
PAUSE = 5.0  # s after an interruption
CLEAR = 60.0  # s between the begin of an activity and its interruption
NIGHT = 3 * 3600.0  # s of sleep, at least
MUST = 0.8  # probability from which one leaves in any mood and weather
SECOND = 0.08, (1200.0, 5400.0), 0.4  # how often one eats twice, how much later, how much
BRIEF = 60.0, 360.0  # s of what comes between
APART = 5400.0  # s: meals that are nearer to each other are one


@dataclass(frozen=True)
class Item:
    """An activity from `start` to `end`, s since midnight of the day. `cause`: scheduled, free or
    interrupts; of an activity that was interrupted also continues."""

    start: float
    end: float
    activity: str
    cause: str


class Planner:
    """Plans the days of one resident. `home`: the home's name; meals together have its keys.
    `leaves_out`: activities that the home has no place for; `table`: all who eat together."""

    def __init__(self, seed: int, home: str, resident: str, profile: Profile,
                 leaves_out: frozenset[str] = frozenset()) -> None:
        self.seed, self.home, self.resident, self.profile = seed, home, resident, profile
        self.leaves_out = leaves_out
        self.person = Person(seed, home, resident, profile)
        self.table: list[Planner] = [self]

    def wakes(self, day: Day) -> float:
        """When the resident gets up on a day, s after its midnight."""
        return self._time(day, 'wakes', self.profile.wakes[day.kind]) + self._mood(day).late[0]

    def sleeps(self, day: Day) -> float:
        """The time of going to bed after that, s after the same midnight."""
        when = self._time(day, 'sleeps', self.profile.sleeps[day.kind]) + self._mood(day).late[1]
        wakes = self.wakes(day)
        while when < wakes + 6 * 3600.0:
            when += DAY
        return min(when, DAY + self.wakes(day.following()) - NIGHT)

    def plan(self, day: Day) -> list[Item]:
        """The day's items, in order and without gaps of more than SHORTEST."""
        wakes, sleeps = self.wakes(day), self.sleeps(day)
        ends = DAY + self.wakes(day.following())
        fixed = self._scheduled(day, wakes, sleeps)
        items: list[Item] = [Item(wakes, wakes, 'sleep', 'scheduled')]
        done: dict[str, int] = {}
        for start, end, name in fixed + [(sleeps, ends, 'sleep')]:
            if self.profile.lives:
                self._fill(day, items, start, done)
            start = max(start, items[-1].end)
            items.append(Item(start, max(end, start + 60.0), name, 'scheduled'))
        items = [item for item in items[1:] if item.end > item.start]
        return self._interrupted(day, items)

    def _mood(self, day: Day) -> Mood:
        return self.person.mood(day)

    def _draw(self, day: Day, *keys: object) -> Random:
        return chance(self.seed, self.home, self.resident, day.number, *keys)

    def _time(self, day: Day, what: str, span: Span) -> float:
        return around(self._draw(day, what), span.low, span.high)

    def _scheduled(self, day: Day, wakes: float, sleeps: float) -> list[tuple[float, float, str]]:
        """Begin, end and name of scheduled items between getting up and going to bed."""
        found: list[tuple[float, list[tuple[str, float]]]] = []
        if self.profile.lives and self.profile.body == 'person':
            found.append((wakes, self._lengths(day, 'morning', self._morning(day))))
        for i, part in enumerate(self.profile.scheduled):
            if part.days not in ('all', day.kind) or not self._happens(day, i, part):
                continue
            begins, parts = self._chain(day, i, part)
            while begins < self.profile.wakes[day.kind].low - 3600.0:
                begins += DAY
            if begins < sleeps - 600.0:
                found.append((max(begins, wakes), parts))
                found += self._second(day, i, max(begins, wakes), parts)
        laid: list[tuple[float, float, str]] = []
        time = wakes
        for begins, parts in sorted(found, key=lambda entry: entry[0]):
            time = max(time, begins)
            for name, length in parts:
                if time < sleeps or name == 'leave':
                    laid.append((time, time + length, name))
                    time += length
        return laid

    def _happens(self, day: Day, number: int, part: Scheduled) -> bool:
        """Whether a scheduled item is done, by habit, mood and weather."""
        usual = part.chance
        if part.do[0] == 'leave' and (usual < MUST or self._mood(day).ill):
            usual = self._mood(day).leaves(usual)
        return self._draw(day, 'happens', number).random() < usual

    def _chain(self, day: Day, number: int, part: Scheduled
               ) -> tuple[float, list[tuple[str, float]]]:
        """When a scheduled item begins, and its activities without those that are left out."""
        with_whom = self._meal(day, part)
        span = min((other.at for _, other in with_whom), key=lambda s: (s.high - s.low, s.low))
        keys: tuple[object, ...] = self.seed, self.home, self.resident, day.number, number
        if len(with_whom) == 1:
            begins = around(self._draw(day, 'scheduled', number), span.low, span.high)
            parts = self._lengths(day, f'scheduled {number}', part.do, part)
        else:  # who eats together begins and gets up together, and one of them cooks
            keys = self.seed, self.home, 'meals', day.number, span.low
            begins = around(chance(*keys), span.low, span.high)
            parts = [(name, spread(chance(*keys, name), *activities()[name].lasts))
                     for name in part.do]
            for name in ('cook', 'wash_dishes'):
                able = [who for who, other in with_whom if name in other.do] or [self]
                if chance(*keys, 'does', name).choice(able) is not self:
                    begins += sum(length for other, length in parts if other == name == 'cook')
                    parts = [entry for entry in parts if entry[0] != name]
        kept = [(name, length) for name, length in parts if name not in self.leaves_out
                and chance(*keys, 'skips', name).random()
                >= self._mood(day).skips(self.person.skips.get(name, 0.0))]
        return begins, kept

    def _meal(self, day: Day, part: Scheduled) -> list[tuple[Planner, Scheduled]]:
        """Who has a meal together at that time, with what each has then."""
        if not part.together:
            return [(self, part)]
        return [(who, other) for who in self.table for i, other in enumerate(who.profile.scheduled)
                if other.together and other.days in ('all', day.kind)
                and abs(other.at.low + other.at.high - part.at.low - part.at.high) < 2 * APART
                and (other is part or who._happens(day, i, other))]

    def _second(self, day: Day, number: int, begins: float, parts: list[tuple[str, float]]
                ) -> list[tuple[float, list[tuple[str, float]]]]:
        """A part of a meal that is had again some time after it."""
        often, later, share = SECOND
        draw = self._draw(day, 'second', number)
        again = [(name, share * length) for name, length in parts if name in ('cook', 'eat')]
        if not again or draw.random() >= often:
            return []
        return [(begins + sum(length for _, length in parts) + draw.uniform(*later), again)]

    def _morning(self, day: Day) -> tuple[str, ...]:
        draw = self._draw(day, 'morning')
        parts = ['toilet', 'shower' if draw.random() < 0.6 else 'wash', 'dress']
        return tuple(parts)

    def _lengths(self, day: Day, key: str, names: Sequence[str], part: Scheduled | None = None
                 ) -> list[tuple[str, float]]:
        found = []
        for i, name in enumerate(names):
            given = part.lasts if part and i == 0 else None
            low, high = given or activities()[name].lasts
            pace = 1.0 if given else self._mood(day).pace
            found.append((name, pace * spread(self._draw(day, key, i), low, high)))
        return [(name, length) for name, length in found if name not in self.leaves_out]

    def _fill(self, day: Day, items: list[Item], until: float, done: dict[str, int]) -> None:
        """The chain: the next activity depends on the hour and on the last one."""
        while until - items[-1].end > SHORTEST:
            start = items[-1].end
            draw = self._draw(day, 'free', round(start))
            name = choose(draw, [
                (name, weight * (AGAIN if name == items[-1].activity else 1.0))
                for name, weight in self._weights(day, start)
                if done.get(name, 0) < self.profile.free[name].per_day]) or self._resort()
            low, high = (self.profile.free[name].lasts if name in self.profile.free
                         else activities()[name].lasts)
            end = min(start + self._mood(day).pace * spread(draw, low, high), until)
            if until - end < SHORTEST:
                end = until
            done[name] = done.get(name, 0) + 1
            items.append(Item(start, end, name, 'free'))

    def _weights(self, day: Day, time: float) -> list[tuple[str, float]]:
        """How likely each free activity is, by hour, person and mood."""
        hour, mood = time / 3600.0 % 24, self._mood(day)
        return [(name, free.weight(hour) * self.person.likes(name)
                 * mood.does(activities()[name].effort))
                for name, free in self.profile.free.items() if name not in self.leaves_out]

    def _resort(self) -> str:
        return RESORT if self.profile.body == 'person' else 'nap'

    def _interrupted(self, day: Day, items: list[Item]) -> list[Item]:
        """The items with their interruptions between their parts."""
        moments = sorted(self._moments(day, items))
        result: list[Item] = []
        waiting = list(items)
        while waiting:
            item = waiting.pop(0)
            inside = next((m for m in moments if m[0] < item.end - CLEAR), None)
            if inside is None or item.activity == 'leave' or not result:
                moments = [m for m in moments if item.activity != 'leave' or m[0] > item.end]
                result.append(item)
                continue
            moments.remove(inside)
            when, name, length = max(inside[0], item.start + CLEAR), inside[1], inside[2]
            if name == item.activity or when + length > item.end - CLEAR:
                waiting.insert(0, item)
                continue
            result.append(replace(item, end=when))
            result.append(Item(when, when + length, name, 'interrupts'))
            waiting.insert(0, Item(when + length + PAUSE, item.end, item.activity, 'continues'))
        return result

    def _moments(self, day: Day, items: list[Item]) -> list[tuple[float, str, float]]:
        """When something interrupts, what, and for how long."""
        found = self._breaks(day, items)
        wakes, sleeps, ends = items[0].start, items[-1].start, items[-1].end
        for name, need in self.profile.needs.items():
            if name in self.leaves_out:
                continue
            draw = self._draw(day, 'needs', name)
            times: list[float] = []
            if need.every:
                time = wakes + spread(draw, *need.every)
                while time < sleeps:
                    times.append(time)
                    time += spread(draw, *need.every)
            times += [draw.uniform(max(wakes, 8 * 3600.0), min(sleeps, 21 * 3600.0))
                      for _ in range(_count(draw, need.per_day))]
            times += [draw.uniform(sleeps + 2400.0, max(ends - 1800.0, sleeps + 2401.0))
                      for _ in range(_count(draw, need.at_night))]
            found += [(time, name, spread(draw, *activities()[name].lasts)) for time in times]
        return found

    def _breaks(self, day: Day, items: list[Item]) -> list[tuple[float, str, float]]:
        """Something short that comes between, as while the water boils."""
        found = []
        for item in items:
            draw = self._draw(day, 'breaks', round(item.start))
            often = activities()[item.activity].breaks / self._mood(day).pace
            for _ in range(_count(draw, often * (item.end - item.start) / 3600.0)):
                time = draw.uniform(item.start, item.end)
                name = choose(draw, [(name, weight) for name, weight in self._weights(day, time)
                                     if name != item.activity and name != 'nap'])
                if name:
                    found.append((time, name, spread(draw, *BRIEF)))
        return found


def _count(draw: Random, mean: float) -> int:
    """A Poisson number."""
    left, count = math.exp(-mean), 0
    product = draw.random()
    while product > left:
        product *= draw.random()
        count += 1
    return count
