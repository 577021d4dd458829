"""A resident, who follows the agenda and uses the home by habit."""
from __future__ import annotations

import math
from dataclasses import replace
from random import Random
from typing import Generator

from angen_apps.residents.activities import FRIDGE, Activity, Step, Visits, activities
from angen_apps.residents.agenda import CONTINUES, RESORT, Item, Planner
from angen_apps.residents.chance import chance, choose, spread
from angen_apps.residents.company import MOVES, PATIENCE, QUEUE, Company, Process
from angen_apps.residents.floors import CLEAR, SWING
from angen_apps.residents.household import Household
from angen_apps.residents.mover import ASIDE
from angen_apps.residents.places import OUTSIDE, Spot
from angen_apps.residents.profiles import DAY, Profile
from angen_apps.robot.planner import Point
from angen_tools.common.failure import Failure

COOK, ANSWER = 'cook', 'answer_door'
LATE = 20.0  # s: an activity that would be shorter is left out
SHORT = 10.0  # s: so is a later step, as a stove that is on for a moment
CAT = (100.0, 600.0)
SLOWLY = 3.0  # times that the straight way to a thing may last
ROAMS = (15.0, 45.0)  # s at a place
OPEN_FOR, OPEN_AT_LEAST = 20.0, 5.0  # s that a fridge or the entrance is open
REACHES = (4.0, 15.0)  # s between two bouts of movements before it, ours
MAKES_WAY = 30.0  # s in which another one passes
ANYWHERE = 4  # places for things that a home lacks
PAUSE = 60.0  # s until a way that was given up is tried again, then twice as long
TAKEN, AGAIN = 600.0, 120.0  # s until it does without a place that is taken, and between tries
OUT_BETWEEN = 900.0  # s: a visitor with less to wait stays


class Resident(Company):
    """A member of a household; live() is its process."""

    def __init__(self, household: Household, name: str, number: int, profile: Profile) -> None:
        super().__init__(household, name, number, profile)
        self._known = dict(activities())
        self.leaves_out: dict[str, str] = {}  # by activity: what the home lacks
        self._tasks = {task: self._resolve(self._known[task])
                       for task in sorted(profile.does | {'sleep', 'leave'}
                                          | ({'relax', 'toilet', 'wash', 'shower', 'dress'}
                                             if profile.body == 'person' else {'nap'}))}
        self.planner = Planner(household.seed, household.name, name, profile,
                               frozenset(self.leaves_out))

    def _resolve(self, activity: Activity) -> list[list[Spot]]:
        """The spots of each step; one that the home has no place for is left out, and so is the
        activity if it needs that, but for sleep: without a bed one sleeps on the floor; Failure if
        no one can lie."""
        places = self.household.places
        person = self.profile.body == 'person'
        found: list[list[Spot]] = []
        steps: list[Step] = []
        for step in activity.steps:
            spots = places.spots(step)
            if not spots and OUTSIDE not in step.at:
                missing = f'no {" and no ".join(step.at or (step.room,))}'
                if activity.name == 'sleep' and person and self.profile.lives:
                    spots = self._on_floor(missing)
                elif activity.name in ('sleep', RESORT) or not person:
                    spots = [places.anywhere(Random(number)) for number in range(ANYWHERE)]
                elif not step.optional:
                    self.leaves_out[activity.name] = f'{missing} in reach'
                if spots:
                    self._stands_in[activity.name, len(found)] = f'{missing} in reach'
            if spots or OUTSIDE in step.at:
                found.append(spots)
                steps.append(step)
        if not steps:
            rooms = ' and no '.join(sorted({step.room for step in activity.steps}))
            self.leaves_out.setdefault(activity.name, f'no {rooms} in reach')
        self._known[activity.name] = replace(activity, steps=tuple(steps))
        return found

    def _on_floor(self, missing: str) -> list[Spot]:
        spots = self.household.places.on_floor
        if not spots:
            raise Failure(f'the home has {missing} where {self.name} ({self.profile.name}), who '
                          'sleeps, could lie, and no floor as long as that')
        return spots

    def remarks(self) -> list[str]:
        """What it does not do in this home, or does at another place."""
        who = f'{self.name} ({self.profile.name})'
        if self.profile.body != 'person':
            return []
        found = [f'{who} leaves out {name}: the home has {missing}'
                 for name, missing in sorted(self.leaves_out.items())]
        for (name, index), missing in sorted(self._stands_in.items()):
            if not self.profile.lives and name == 'sleep':
                continue
            spot = self._tasks[name][index][0]
            where = f'on the floor of {spot.room}' if spot.place else f'in {spot.room}'
            found.append(f'{who} does {name} {where}: the home has {missing}')
        return found

    def live(self) -> Process:
        """Lives day after day."""
        number = 0
        household = self.household
        midnight = -household.since
        items = [Item(item.start - DAY, item.end - DAY, item.activity, item.cause)
                 for item in self._items(-1) if item.end > DAY]
        self._begin([*items, *self._items(0)])
        while True:
            for item in items:
                due = Item(midnight + item.start, midnight + item.end, item.activity, item.cause)
                self._habits = chance(household.seed, household.name, self.name, 'habits',
                                      number, round(item.start, 3))
                if due.end > self.now + LATE:
                    yield from self._do(due)
            midnight = number * DAY - household.since
            items = self._items(number)
            number += 1

    def _items(self, number: int) -> list[Item]:
        """What it does on a day."""
        return self.planner.plan(self.household.day(number))

    def _begin(self, items: list[Item]) -> None:
        """Starts at the place of the first item, or out of the home."""
        self._note('away', '')
        now = self.now + self.household.since
        first = next((item for item in items if item.end > now), None)
        if not self.profile.lives or first is None or first.activity == 'leave':
            return
        spots = self._tasks.get(first.activity, self._tasks['sleep'])
        spot = self._choose(spots[0]) or (first.activity == 'sleep' and self._choose(
            self.household.places.on_floor)) or self.household.places.anywhere()
        self.storey = spot.storey
        self.enter(spot, first.activity == 'sleep')
        self._note('does', first.activity)

    def _do(self, item: Item) -> Process:
        if item.start > self.now + OUT_BETWEEN and not self.profile.lives and not self.away:
            yield from self._leave(item.start)
        if item.start > self.now:
            yield from self._stay(item.start)
        item = self._joins(item)
        activity = self._known[item.activity]
        before, self.item = self.item, item
        if activity.name == ANSWER and item.cause != CONTINUES:
            self.household.ring()
        if activity.name == 'leave' or (not self.profile.lives and activity.name == 'sleep'):
            yield from self._leave(item.end)
            return
        yield from self._come()
        if self.away:
            return
        if activity.alone and not (yield from self._queue(activity, self._rooms(activity), before)):
            return
        try:
            steps = [(i, step) for i, step in enumerate(activity.steps) if not (
                item.cause == CONTINUES and step.opens and step.minutes)]  # it was opened before
            times = replace(activity, steps=tuple(step for _, step in steps)).times(
                max(item.end - self.now, LATE))
            end = self.now
            for number, ((i, step), seconds) in enumerate(zip(steps, times)):
                end += seconds
                if number == 0 or end > self.now + SHORT:
                    yield from self._step(activity, step, i, end)
        finally:
            if activity.alone:
                self._leave_rooms(activity)

    def _step(self, activity: Activity, step: Step, index: int, end: float) -> Process:
        """A part of an activity at one place."""
        self._release()
        spots = self._of_own(activity, self._tasks[activity.name][index])
        spot = self._choose(self._in_company(spots, activity.name))
        if step.posture == 'roam':
            yield from self._roam(activity, step, index, end)
            return
        remark = ''
        if spot is None:
            remark = f'no place for {activity.name}'
            spot = (activity.name == 'sleep' and self._choose(self.household.places.on_floor)) \
                or self.household.places.beside(self._tasks[activity.name][index], self._habits)
        spot = yield from self._takes_place(spot, activity, index, end, remark)
        if spot is None:
            return
        self._lamps(activity.dark)
        used = self._use(step, spot)
        if used and step.opens:
            yield from self._opened(used, end)
            used = None
        yield from self._busy(activity, index, spot, end)
        self._unuse(used)

    def _gets_to(self, spot: Spot, activity: Activity, end: float) -> Generator[float, None, bool]:
        """Walks to a spot, and tries again; returns whether it is there before the end."""
        pause = PAUSE
        yield from self._reach(spot, activity.name)
        while not self.arrived:
            self.diary.note(f'gave up the way: {self.why}')
            yield from self._stay(min(end, self.now + pause))
            if self.now > end - LATE:
                return False
            pause *= 2
            yield from self._reach(spot, activity.name)
        return True

    def _takes_place(self, spot: Spot, activity: Activity, index: int, end: float, remark: str = ''
                     ) -> Generator[float, None, Spot | None]:
        """Gets to a spot, and sits or lies down where it is for that. While another one is in the
        way, it tries the others that serve, waits, and tries again; then it sleeps on the floor, or
        does the activity on its feet. Returns where it is; None if the end comes before."""
        patience = min(self.now + TAKEN, (self.now + end) / 2)
        tried: list[Spot] = []
        while (yield from self._gets_to(spot, activity, end)):
            why = self._sits(spot)
            if activity.name == 'sleep' and spot.place is None and self.profile.body == 'person':
                why = 'no place for sleep'
            late = self.now >= patience
            if not why or late and activity.name != 'sleep':
                self._note('does', activity.name, index)
                self.diary.note(why or remark)
                return spot
            self._note('waits', activity.name)
            self.diary.note(why)
            tried.append(spot)
            other = self._another(activity, index, tried, late)
            if other is None:
                tried.clear()
                yield from self._until_free(spot, min(end, self.now + AGAIN))
            else:
                spot, serves = other, other in self._tasks[activity.name][index]
                remark = '' if serves else f'no place for {activity.name}'
            if self.now > end - LATE:
                break
        return None

    def _another(self, activity: Activity, index: int, tried: list[Spot], floor: bool
                 ) -> Spot | None:
        """Another spot of a step that nobody has or is at, of those on the floor if it may."""
        spots = self._of_own(activity, self._tasks[activity.name][index])
        if floor and activity.name == 'sleep':
            spots = [*spots, *self.household.places.on_floor]
        other = self._choose([spot for spot in spots
                              if spot not in tried and not self._is_settled_at(spot)])
        if other is not None:
            self._release(other)
        return other

    def _sits(self, spot: Spot) -> str:
        """Sits or lies down where a spot is for that; returns what was in the way."""
        if spot.place is not None and self.profile.body == 'person':
            try:
                self.settle(spot)
            except Failure as error:
                return str(error)
        return ''

    def _opened(self, used: list[tuple[str, str, str]], end: float) -> Process:
        """Has a front or the entrance open for a while, also if the way there took all the time."""
        until = max(min(end, self.now + OPEN_FOR), self.now + OPEN_AT_LEAST)
        yield from self._stay(until, REACHES)
        self._unuse(used)

    def _busy(self, activity: Activity, index: int, spot: Spot, end: float) -> Process:
        """Is at a spot until the end, moves in bouts, and goes to other things for a moment."""
        moves = activity.moves or MOVES[self.posture]
        visits = activity.visits if self.profile.body == 'person' else None
        while visits is not None:
            leaves = self.now + spread(self._habits, *visits.every)
            lasts = spread(self._habits, *visits.lasts)
            if leaves + lasts > end:
                break
            yield from self._stay(leaves, moves)
            other = self._other(visits, spot)
            if other is None or self.now + lasts + 2 * SLOWLY * math.dist(
                    spot.stand, other.stand) / self.profile.speed > end \
                    or not self.household.take(('spot', other.key), self.name):
                continue
            yield from self._visit(activity, index, other, lasts)
            back = yield from self._takes_place(spot, activity, index, end)
            if back is None:
                return
            spot = back
        yield from self._stay(end, CAT if self.profile.body != 'person' else moves)

    def _other(self, visits: Visits, spot: Spot) -> Spot | None:
        """The nearest thing of a kind drawn by weight, on this storey, if one is free."""
        places = self.household.places
        near = choose(self._habits, [
            (spots, weight) for what, weight in visits.to
            if (spots := [s for s in places.spots(Step((what,)))
                          if s.storey == spot.storey and s.thing != spot.thing])]) or []
        free = [other for other in near if not self._somebody_at(other)]
        return min(free, key=lambda s: math.dist(s.stand, spot.stand)) if free else None

    def _visit(self, activity: Activity, index: int, other: Spot, lasts: float) -> Process:
        """Goes to a thing and stays there for some seconds; opens it if that is a fridge."""
        self._note('goes', activity.name)
        yield from self.go(other.stand, other.storey)
        self.spot = other if self.arrived else None
        if self.arrived:
            self._note('does', activity.name, index)
            self._lamps()
            thing = self._thing(other)
            until = self.now + lasts
            if thing is not None and thing.type == FRIDGE:
                used = self._use(Step((FRIDGE,), opens=FRIDGE), other)
                if used:
                    yield from self._opened(used, until)
            yield from self._stay(until, MOVES[self.posture])
        self.household.leave(('spot', other.key), self.name)

    def _reach(self, spot: Spot, name: str) -> Process:
        """Walks to a spot, unless the resident is there."""
        if self.spot == spot and not self.away:
            self.arrived = True
            return
        self._note('goes', name)
        left, until = self.room, self.now + PATIENCE
        yield from self.go(spot.stand, spot.storey)
        while not self.arrived and (other := self.blocker(spot)) and self.now < until:
            if other.waits_for is self:  # who comes second makes way
                yield from self.go(*self._elsewhere())
            else:
                yield from self._leave_swings()
                self.waits_for = other
            self._note('waits', name)
            at, pause = other.at, self.now
            while math.dist(other.at, at) < ASIDE and self.now < until and (
                    self.waits_for is other or self.now < pause + MAKES_WAY):
                yield self.now + QUEUE
            self.waits_for = None
            self._note('goes', name)
            yield from self.go(spot.stand, spot.storey)
        if left and left != self.room:
            self._lamp_off(left)
        self.spot = spot if self.arrived else None

    def _leave_swings(self) -> Process:
        """Steps out of the swing of a door, which others may need."""
        for door in self.household.home.doors:
            x, y, z, _ = door.pose
            if door.kind == 'door' and math.dist((x, y), self.at) < CLEAR \
                    and self.household.home.storey_at(z) == self.storey:
                nearest = min(self.floors.around((x, y), self.storey, SWING), default=self.at,
                              key=lambda point: math.dist(point, self.at))
                if self._send(nearest, self.storey):
                    yield from self._walk(nearest)

    def _elsewhere(self) -> tuple[Point, int]:
        """A place in the open, out of the way of others."""
        points = self.floors.spots(self.room, 1, self._habits) if self.room else []
        anywhere = self.household.places.anywhere(self._habits)
        return (points[0], self.storey) if points else (anywhere.stand, anywhere.storey)

    def _roam(self, activity: Activity, step: Step, index: int, end: float) -> Process:
        """Walks around in a room."""
        tries = 0
        while self.now < end - 5.0 and tries < 40:
            tries += 1
            spots = self.household.places.free(step.room, self._habits, 1)
            spot = spots[0] if spots else self.household.places.anywhere(self._habits)
            yield from self._reach(spot, activity.name)
            if not self.arrived:
                self.diary.note(f'gave up the way: {self.why}')
                yield self.now + 5.0
                continue
            self._note('does', activity.name, index)
            self._lamps(activity.dark)
            yield from self._stay(min(self.now + self._habits.uniform(*ROAMS), end))

    def _leave(self, until: float) -> Process:
        """Out of the home, until then."""
        porch = self._tasks['leave'][0]
        self._release()
        if not self.away and porch:
            yield from self._reach(porch[0], 'leave')
            if self.arrived:
                yield self.now + 0.5
                self.vanish()
                self._note('away', 'leave')
                entrance = self.floors.entrance()
                if entrance is not None:  # it closes by itself
                    self.household.do(self.name, 'door', entrance.name, 'CloseByHand')
            else:
                self.diary.note(f'gave up the way out: {self.why}')
        if until > self.now:
            yield until

    def _come(self) -> Process:
        """Back into the home."""
        porch = self._tasks['leave'][0]
        if not self.away:
            return
        if not porch:
            raise Failure(f'the home has no entrance by which {self.name} could come in')
        waits = 0
        while not self.household.take(porch[0].key, self.name) and waits < 60:
            waits += 1
            yield self.now + 2.0
        self.enter(porch[0])
        self._note('goes', self.item.activity)
        self.household.leave(porch[0].key, self.name)

    def _choose(self, spots: list[Spot]) -> Spot | None:
        """The first free place; beds by the resident's number, so that each keeps its own."""
        order = list(spots)
        lying = [spot for spot in order if spot.place and spot.place.posture == 'lie']
        if len(lying) > 1 and self.number:
            order = order[self.number % len(lying):] + order[:self.number % len(lying)]
        for spot in order:
            if (spot.thing or spot.place or not self._somebody_at(spot)) \
                    and self.household.take(('spot', spot.key), self.name):
                return spot
        return None
