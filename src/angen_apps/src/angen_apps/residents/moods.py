"""How people, and the days of one, differ: one draw for a person, and one for each day. Both scale
what a profile says. Numbers without a source are our own choice.
"""
from __future__ import annotations

import datetime
import math
from dataclasses import dataclass
from functools import lru_cache

from angen_apps.residents.chance import chance, spread
from angen_apps.residents.profiles import Profile

WEEK, MONTH, YEAR = 7, 28, 365.25  # days
# Standard deviations of logarithms: how often somebody does a thing, from person to person;
# durations, from person to person and from day to day.
LIKES = 0.4
PACES = 0.15, 0.2
DRIFT = 0.6  # correlation of a day's deviation with a mean that changes from week to week
SPIRITS = 0.5  # logarithm of the odds by which spirits of 1 favor a thing of effort 1
ILL = -3.0  # spirits of an ill person
SPELL = 2, 7  # days of an illness; a cold lasts about a week (CDC)
STAYS = 0.1  # how often an ill person leaves home, compared with others
WET, DULL = 0.35, 1.0  # share of days with bad weather, and what it takes from the spirits
WINTER = 900.0  # s that one gets up later at its middle, and earlier in that of summer
LATEST = 2.5 * 3600.0  # s that one is later or earlier than usual


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


@dataclass(frozen=True)
class Mood:
    """A day of somebody: spirits (a normal number, unless ill), the s by which one gets up and goes
    to bed later than usual, and times of durations."""

    spirits: float
    ill: bool
    wet: bool
    late: tuple[float, float]
    pace: float

    def does(self, effort: float) -> float:
        """How often something of this effort is done, compared with an ordinary day."""
        return math.exp(SPIRITS * effort * self.spirits)

    def skips(self, usual: float) -> float:
        """The probability that something is left out that usually is with that one."""
        odds = usual * math.exp(-2 * SPIRITS * self.spirits)
        return odds / (odds + 1.0 - usual) if usual < 1.0 else 1.0

    def leaves(self, usual: float) -> float:
        """The probability of leaving home, of one that usually does with that one."""
        spirits = self.spirits - DULL * self.wet
        odds = usual * math.exp(SPIRITS * spirits)
        return usual * STAYS if self.ill else odds / (odds + 1.0 - usual)


class Person:
    """What is somebody's own: its ranges are those of the profile."""

    def __init__(self, seed: int, home: str, resident: str, profile: Profile) -> None:
        self._keys = seed, home, resident
        draw = chance(*self._keys, 'person')
        self._varies = {kind: spread(draw, *profile.varies[kind])
                        for kind in sorted(profile.varies)}
        self._later = draw.gauss(0.0, 0.5)  # times that
        self._ills = draw.uniform(*profile.ills)  # a year
        self._moody = draw.uniform(*profile.moody)
        self.guests = draw.uniform(*profile.guests)  # a week
        self._pace = math.exp(PACES[0] * draw.gauss(0.0, 1.0))
        self.skips = {name: draw.uniform(*profile.skips[name]) for name in sorted(profile.skips)}
        self.queues, self.joins, self.talks, self.dishes = (
            draw.uniform(*span) for span in (profile.queues, profile.joins, profile.talks,
                                             profile.dishes))
        self.mood = lru_cache(4)(self._mood)

    def likes(self, activity: str) -> float:
        """How often it does something, compared with others."""
        return math.exp(chance(*self._keys, 'likes', activity).gauss(0.0, LIKES))

    def _mood(self, day: Day) -> Mood:
        draw = chance(*self._keys, day.number, 'mood')
        ill = self._is_ill(day.number)
        spirits = ILL if ill else self._moody * self._deviates(draw.gauss(0.0, 1.0), day, 'spirits')
        season = math.cos(2 * math.pi * (day.date.timetuple().tm_yday - 5) / YEAR)
        late = [(self._later + self._deviates(draw.gauss(0.0, 1.0), day, what))
                * self._varies[day.kind] + WINTER * season for what in ('wakes', 'sleeps')]
        return Mood(spirits, ill,
                    chance(*self._keys[:2], day.number, 'weather').random() < WET,
                    (_within(late[0]), _within(late[1])),
                    self._pace * math.exp(PACES[1] * draw.gauss(0.0, 1.0)))

    def _deviates(self, today: float, day: Day, what: str) -> float:
        """A normal number of a day around one that changes from week to week."""
        week, share = day.number // WEEK, day.number % WEEK / WEEK
        before, after = (chance(*self._keys, 'week', number, what).gauss(0.0, 1.0)
                         for number in (week, week + 1))
        mean = (1 - share) * before + share * after
        return DRIFT * mean + math.sqrt(1 - DRIFT ** 2) * today

    def _is_ill(self, number: int) -> bool:
        for month in (number // MONTH - 1, number // MONTH):
            draw = chance(*self._keys, 'ill', month)
            first = MONTH * month + draw.randrange(MONTH)
            if draw.random() < self._ills * MONTH / YEAR \
                    and first <= number < first + draw.randint(*SPELL):
                return True
        return False


def _within(seconds: float) -> float:
    return min(max(seconds, -LATEST), LATEST)
