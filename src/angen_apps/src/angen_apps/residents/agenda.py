"""A resident's day: scheduled items, a semi-Markov chain between, and interruptions.

A day begins when the resident gets up and ends when the resident gets up again. It depends on the
seed, the resident, the date and the household's meals only, so that it can be planned alone.
"""
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from random import Random
from statistics import mean
from typing import Sequence

from angen_apps.residents.activities import activities
from angen_apps.residents.chance import around, chance, choose, spread
from angen_apps.residents.moods import Day, Mood, Person
from angen_apps.residents.profiles import DAY, Profile, Scheduled, Span

SHORTEST = 90.0  # s: a gap that is shorter is not filled
CONTINUES = 'continues'  # cause of the rest of an interrupted activity
VISIT = 'visit'  # by a guest
RESORT = 'relax'  # activity with nothing else to do
AGAIN = 0.3  # how likely an activity follows itself, compared with others
PAUSE = 5.0  # s after an interruption
CLEAR = 60.0  # s between the begin of an activity and its interruption
NIGHT = 3 * 3600.0  # s of sleep, at least
MUST = 0.8  # probability from which one leaves in any mood and weather
SECOND = 0.08, (1200.0, 5400.0), 0.4  # how often one eats twice, how much later, how much
BRIEF = 60.0, 360.0  # s of what comes between
WASH, PILE, MORE = 'wash_dishes', 6, 0.3  # meals whose dishes stand, at most; what each takes more
WEEK = {'all': 7, 'weekday': 5, 'weekend': 2}  # days of a week
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
        if part.do[0] == VISIT:
            usual = self._mood(day).leaves(min(self._visits(part), 1.0))
        return self._draw(day, 'happens', number).random() < usual

    def _visits(self, part: Scheduled) -> float:
        """How many visits a day there are by a scheduled item."""
        planned = sum(WEEK[other.days] * other.chance for other in self.profile.scheduled
                      if other.do[0] == VISIT)
        return self.person.guests * part.chance / planned if planned else 0.0

    def _chain(self, day: Day, number: int, part: Scheduled
               ) -> tuple[float, list[tuple[str, float]]]:
        """When a scheduled item begins, and its activities without those that are left out."""
        begins, with_whom = self._meal(day, part)
        keys: tuple[object, ...] = self.seed, self.home, self.resident, day.number, number
        if len(with_whom) == 1:
            begins = around(self._draw(day, 'scheduled', number), part.at.low, part.at.high)
            parts = self._lengths(day, f'scheduled {number}', part.do, part)
        else:  # who eats together begins and gets up together, and one of them cooks
            keys = self.seed, self.home, 'meals', day.number, min(o.at.low for _, o in with_whom)
            parts = [(name, spread(chance(*keys, name), *activities()[name].lasts))
                     for name in part.do]
        skipped = {name for _, other in with_whom for name in other.do
                   if chance(*keys, 'skips', name).random() < mean(
                       who._mood(day).skips(who._usually_skips(name))
                       for who, other in with_whom if name in other.do)} | self.leaves_out
        for name in ('cook', WASH) if len(with_whom) > 1 else ():
            able = [who for who, other in with_whom if name in other.do]
            if able and name not in skipped \
                    and chance(*keys, 'does', name).choice(able) is not self:
                skipped.add(name)
                if name == 'cook':
                    begins += spread(chance(*keys, name), *activities()[name].lasts)
        return begins, [(name, self._washing(keys, length) if name == WASH else length)
                        for name, length in parts if name not in skipped]

    def _usually_skips(self, name: str) -> float:
        """How probably an activity is left out on a usual day."""
        left = 0.0 if name != WASH else 1.0 - 1.0 / self._stand()
        return self.person.skips.get(name, left)

    def _stand(self) -> float:
        """The number of meals after which dishes are washed, on average."""
        meals = sum(WEEK[part.days] * part.chance for part in self.profile.scheduled
                    if WASH in part.do) / WEEK['all']
        return max(meals * self.person.dishes, 1.0)

    def _washing(self, keys: tuple[object, ...], length: float) -> float:
        """How long it takes with the dishes that stand from the meals before."""
        draw, count = chance(*keys, WASH, 'stands'), 0
        while count < PILE and draw.random() < 1.0 - 1.0 / self._stand():
            count += 1
        return length * (1.0 + MORE * count)

    def _meal(self, day: Day, part: Scheduled) -> tuple[float, list[tuple[Planner, Scheduled]]]:
        """When a meal together begins, and who has it, with what each has then: who is up in time,
        for whom the others wait."""
        alone = [(self, part)]
        if not part.together:
            return 0.0, alone
        whom = [(who, other) for who in self.table for i, other in enumerate(who.profile.scheduled)
                if other.together and other.days in ('all', day.kind)
                and abs(other.at.low + other.at.high - part.at.low - part.at.high) < 2 * APART
                and (other is part or who._happens(day, i, other))]
        span = min((other.at for _, other in whom), key=lambda s: (s.high - s.low, s.low))
        begins = around(chance(self.seed, self.home, 'meals', day.number, span.low),
                        span.low, span.high)
        whom = [(who, other) for who, other in whom if who._ready(day) < begins + APART]
        if self not in [who for who, _ in whom]:
            return begins, alone
        return max(begins, *(who._ready(day) for who, _ in whom)), whom

    def _ready(self, day: Day) -> float:
        """When the resident is up and dressed."""
        return self.wakes(day) + sum(
            length for _, length in self._lengths(day, 'morning', self._morning(day)))

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
            waiting.insert(0, Item(when + length + PAUSE, item.end, item.activity, CONTINUES))
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
