"""A resident's day: scheduled items, a semi-Markov chain between, and interruptions.

A day begins when the resident gets up and ends when the resident gets up again. It depends on the
seed, the resident, the date and the household's meals only, so that it can be planned alone.
"""
from __future__ import annotations

import datetime
import math
from dataclasses import dataclass, replace
from random import Random
from typing import Callable, Sequence

from angen_apps.residents.activities import activities
from angen_apps.residents.chance import around, chance, choose, spread
from angen_apps.residents.profiles import DAY, Profile, Scheduled, Span

SHORTEST = 90.0  # s: a gap that is shorter is not filled
RESORT = 'relax'  # activity with nothing else to do
AGAIN = 0.3  # how likely an activity follows itself, compared with others
PAUSE = 5.0  # s after an interruption
CLEAR = 60.0  # s between the begin of an activity and its interruption


@dataclass(frozen=True)
class Item:
    """An activity from `start` to `end`, s since midnight of the day. `cause`: scheduled, free or
    interrupts; of an activity that was interrupted also continues."""

    start: float
    end: float
    activity: str
    cause: str


@dataclass(frozen=True)
class Day:
    """A day of the calendar, counted from the start of a run."""

    number: int
    date: datetime.date

    @property
    def kind(self) -> str:
        return 'weekend' if self.date.weekday() >= 5 else 'weekday'

    def following(self) -> Day:
        return Day(self.number + 1, self.date + datetime.timedelta(days=1))


Draw = Callable[..., Random]  # random numbers of more keys


class Planner:
    """Plans the days of one resident. `home`: the home's name; meals together have its keys.
    `leaves_out`: activities that the home has no place for."""

    def __init__(self, seed: int, home: str, resident: str, profile: Profile,
                 leaves_out: frozenset[str] = frozenset()) -> None:
        self.seed, self.home, self.resident, self.profile = seed, home, resident, profile
        self.leaves_out = leaves_out

    def wakes(self, day: Day) -> float:
        """When the resident gets up on a day, s after its midnight."""
        return self._time(day, 'wakes', self.profile.wakes[day.kind])

    def sleeps(self, day: Day) -> float:
        """The time of going to bed after that, s after the same midnight."""
        when = self._time(day, 'sleeps', self.profile.sleeps[day.kind])
        wakes = self.wakes(day)
        while when < wakes + 6 * 3600.0:
            when += DAY
        return when

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
            if part.days not in ('all', day.kind):
                continue
            draw = chance(self.seed, self.home, 'meals', day.number, part.at.low) \
                if part.together else self._draw(day, 'scheduled', i)
            begins = around(draw, part.at.low, part.at.high)
            if self._draw(day, 'happens', i).random() >= part.chance:
                continue
            while begins < wakes - 3600.0:
                begins += DAY
            if wakes - 3600.0 <= begins < sleeps - 600.0:
                found.append((max(begins, wakes), self._lengths(day, f'scheduled {i}', part.do,
                                                                part)))
        laid: list[tuple[float, float, str]] = []
        time = wakes
        for begins, parts in sorted(found, key=lambda entry: entry[0]):
            time = max(time, begins)
            for name, length in parts:
                if time < sleeps or name == 'leave':
                    laid.append((time, time + length, name))
                    time += length
        return laid

    def _morning(self, day: Day) -> tuple[str, ...]:
        draw = self._draw(day, 'morning')
        parts = ['toilet', 'shower' if draw.random() < 0.6 else 'wash', 'dress']
        return tuple(parts)

    def _lengths(self, day: Day, key: str, names: Sequence[str], part: Scheduled | None = None
                 ) -> list[tuple[str, float]]:
        found = []
        for i, name in enumerate(names):
            low, high = (part.lasts if part and part.lasts and i == 0
                         else activities()[name].lasts)
            if part and part.together:  # who eats together gets up together
                draw = chance(self.seed, self.home, 'meals', day.number, part.at.low, i)
            else:
                draw = self._draw(day, key, i)
            found.append((name, spread(draw, low, high)))
        return [(name, length) for name, length in found if name not in self.leaves_out]

    def _fill(self, day: Day, items: list[Item], until: float, done: dict[str, int]) -> None:
        """The chain: the next activity depends on the hour and on the last one."""
        while until - items[-1].end > SHORTEST:
            start = items[-1].end
            draw = self._draw(day, 'free', round(start))
            hour = start / 3600.0 % 24
            weighted = [(name, free.weight(hour) * (AGAIN if name == items[-1].activity else 1.0))
                        for name, free in self.profile.free.items()
                        if done.get(name, 0) < free.per_day and name not in self.leaves_out]
            name = choose(draw, weighted) or self._resort()
            low, high = (self.profile.free[name].lasts if name in self.profile.free
                         else activities()[name].lasts)
            end = min(start + spread(draw, low, high), until)
            if until - end < SHORTEST:
                end = until
            done[name] = done.get(name, 0) + 1
            items.append(Item(start, end, name, 'free'))

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
        found = []
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


def _count(draw: Random, mean: float) -> int:
    """A Poisson number."""
    left, count = math.exp(-mean), 0
    product = draw.random()
    while product > left:
        product *= draw.random()
        count += 1
    return count
