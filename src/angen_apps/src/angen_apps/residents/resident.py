"""A resident, who follows the agenda and uses the home by habit."""
from __future__ import annotations

import math
import sys
from dataclasses import replace
from random import Random
from typing import Any, Generator, Iterator

from angen_apps.residents.activities import FRIDGE, Activity, Step, Visits, activities
from angen_apps.residents.agenda import RESORT, Item, Planner
from angen_apps.residents.chance import chance, choose, spread
from angen_apps.residents.floors import BODY
from angen_apps.residents.household import Household
from angen_apps.residents.interface import Rejected
from angen_apps.residents.mover import ASIDE
from angen_apps.residents.places import OUTSIDE, Spot
from angen_apps.residents.profiles import DAY, Profile
from angen_apps.residents.truth import Diary, Interval
from angen_apps.residents.user import User
from angen_apps.robot.planner import Point
from angen_tools.common.failure import Failure

LATE = 20.0  # s: an activity that would be shorter is left out
SHORT = 10.0  # s: so is a later step, as a stove that is on for a moment
# s between two bouts of movements; who sleeps turns 2.1 to 2.7 times an hour (De Koninck, Lorrain
# and Gagnon, Sleep 15, 1992); the others are ours
MOVES = {'sit': (40.0, 300.0), 'lie': (500.0, 3000.0), 'stand': (15.0, 90.0)}
CAT = (100.0, 600.0)
TURNS = (-0.12, 0.0, 0.12)  # rad from the way a seat faces: who turned on would hit what is beside
MORE, APART = 0.6, (3.0, 9.0)  # probability of a further movement in a bout, and s until then
SLOWLY = 3.0  # times that the straight way to a thing may last
ROAMS = (15.0, 45.0)  # s at a place
OPEN_FOR = 20.0  # s that a fridge is open, at most
REACHES = (4.0, 15.0)  # s between two bouts of movements before it, ours
QUEUE, PATIENCE = 10.0, 900.0  # s between two looks at a room or way, and until it is given up
MAKES_WAY = 30.0  # s in which another one passes
ANYWHERE = 4  # places for things that a home lacks
PAUSE = 60.0  # s until a way that was given up is tried again, then twice as long
OUT_BETWEEN = 900.0  # s: a visitor with less to wait stays

Process = Iterator[float]


class Resident(User):
    """A member of a household; live() is its process."""

    def __init__(self, household: Household, name: str, number: int, profile: Profile) -> None:
        super().__init__(household, name, number, profile)
        self.diary = Diary()
        self._turned = 0.0  # rad, of a sitting or lying body
        self._known = dict(activities())
        self.leaves_out: dict[str, str] = {}  # by activity: what the home lacks
        self._stands_in: dict[tuple[str, int], str] = {}  # by step: the missing thing
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
                 for item in self.planner.plan(household.day(-1)) if item.end > DAY]
        self._begin([*items, *self.planner.plan(household.day(0))])
        while True:
            for item in items:
                due = Item(midnight + item.start, midnight + item.end, item.activity, item.cause)
                self._habits = chance(household.seed, household.name, self.name, 'habits',
                                      number, round(item.start, 3))
                if due.end > self.now + LATE:
                    yield from self._do(due)
            midnight = number * DAY - household.since
            items = self.planner.plan(household.day(number))
            number += 1

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
        self.enter(spot)
        if first.activity == 'sleep':
            self._sits(spot)
        self._note('does', first.activity)

    def _do(self, item: Item) -> Process:
        activity = self._known[item.activity]
        if item.start > self.now + OUT_BETWEEN and not self.profile.lives and not self.away:
            yield from self._leave(item.start)
        if item.start > self.now:
            yield from self._stay(item.start)
        self.item = item
        if activity.name == 'leave' or (not self.profile.lives and activity.name == 'sleep'):
            yield from self._leave(item.end)
            return
        yield from self._come()
        if self.away:
            return
        if activity.alone and not (yield from self._queue(activity, item)):
            return
        try:
            times = activity.times(max(item.end - self.now, LATE))
            end = self.now
            for i, (step, seconds) in enumerate(zip(activity.steps, times)):
                end += seconds
                if i == 0 or end > self.now + SHORT:
                    yield from self._step(activity, step, i, end)
        finally:
            if activity.alone:
                self._leave_rooms(activity)

    def _step(self, activity: Activity, step: Step, index: int, end: float) -> Process:
        """A part of an activity at one place."""
        self._release()
        spot = self._choose(self._tasks[activity.name][index])
        if step.posture == 'roam':
            yield from self._roam(activity, step, index, end)
            return
        remark = ''
        if spot is None:
            remark = f'no place for {activity.name}'
            spot = (activity.name == 'sleep' and self._choose(self.household.places.on_floor)) \
                or self.household.places.beside(self._tasks[activity.name][index], self._habits)
        if not (yield from self._gets_to(spot, activity, end)):
            return
        remark = self._sits(spot) or remark
        self._note('does', activity.name, index)
        self.diary.note(remark)
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

    def _sits(self, spot: Spot) -> str:
        """Sits or lies down where a spot is for that; returns what was in the way."""
        if spot.place is not None and self.profile.body == 'person':
            try:
                self.settle(spot)
                self._turned = 0.0
            except Rejected as error:
                return str(error)
        return ''

    def _opened(self, used: list[tuple[str, str, str]], end: float) -> Process:
        """Has a front open for a while."""
        yield from self._stay(min(end, self.now + OPEN_FOR), REACHES)
        self._unuse(used)

    def _busy(self, activity: Activity, index: int, spot: Spot, end: float) -> Process:
        """Is at a spot until the end, moves in bouts, and goes to other things for a moment."""
        moves = activity.moves or MOVES[self.posture]
        visits = activity.visits if self.profile.body == 'person' else None
        while visits is not None:
            leaves = self.now + spread(self._habits, *visits.every)
            lasts = spread(self._habits, *visits.lasts)
            other = self._other(visits, spot)
            if other is None or leaves + lasts > end:
                break
            yield from self._stay(leaves, moves)
            back = SLOWLY * math.dist(spot.stand, other.stand) / self.profile.speed
            if self.now + lasts + 2 * back > end \
                    or not self.household.take(('spot', other.key), self.name):
                continue
            yield from self._visit(activity, index, other, lasts)
            if not (yield from self._gets_to(spot, activity, end)):
                return
            remark = self._sits(spot)
            self._note('does', activity.name, index)
            self.diary.note(remark)
        yield from self._stay(end, CAT if self.profile.body != 'person' else moves)

    def _other(self, visits: Visits, spot: Spot) -> Spot | None:
        """The nearest thing of a kind drawn by weight, on this storey and free."""
        places = self.household.places
        near = [(min(spots, key=lambda s: math.dist(s.stand, spot.stand)), weight)
                for what, weight in visits.to
                if (spots := [s for s in places.spots(Step((what,))) if s.storey == spot.storey
                              and s.thing != spot.thing and not self._somebody_at(s)])]
        return choose(self._habits, near)

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

    def _elsewhere(self) -> tuple[Point, int]:
        """A place in the open, out of the way of others."""
        points = self.floors.spots(self.room, 1, self._habits) if self.room else []
        anywhere = self.household.places.anywhere(self._habits)
        return (points[0], self.storey) if points else (anywhere.stand, anywhere.storey)

    def _stay(self, until: float, moves: tuple[float, float] | None = None) -> Process:
        """Stays, and moves a little in bouts, which follow each other after such a time."""
        moves = moves or (None if self.posture == 'stand' else MOVES[self.posture])
        while moves and self.now < until and not self.away:
            pause = spread(self._habits, *moves)
            while self.now + pause < until:
                yield self.now + pause
                self.moved = self.now
                if self.posture != 'stand':
                    turn = self._habits.choice([turn for turn in TURNS if turn != self._turned])
                    self.simulator.fidget(self.name, turn - self._turned)
                    self._turned = turn
                elif self.spot is not None:
                    yield from self._shuffle(self.spot)
                if self.posture == 'lie' or self._habits.random() > MORE:
                    break
                pause = self._habits.uniform(*APART)
            else:
                break
        if until > self.now:
            yield until

    def _shuffle(self, spot: Spot) -> Process:
        """Steps aside, along the front of the thing in use, out of the swing of its leaf."""
        thing = self._thing(spot)
        leaf = self.floors.fronts.leaf(thing) if thing else None
        for _ in range(4):
            point = (spot.stand[0] + self._habits.uniform(-0.3, 0.3),
                     spot.stand[1] + self._habits.uniform(-0.3, 0.3))
            if (leaf is None or leaf.room_for(point) >= BODY) and self._step_to(point):
                break
        yield self.now + 1.2
        if self.simulator.state('person', self.name).get('going'):  # round who stands in its way
            yield from self._walk(point, self.storey)
        self.look()

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

    def _queue(self, activity: Activity, item: Item) -> Generator[float, None, bool]:
        """Waits for rooms that one resident uses at a time; returns whether they are free."""
        rooms = [room.name for room in self.household.places.rooms_of(activity.alone)]
        since = self.now
        while rooms:
            if any(self.household.take(('room', room), self.name) for room in rooms):
                return True
            if self.now == since:
                self._note('waits', activity.name)
            if self.now - since > PATIENCE or self.now > item.end:
                self.diary.note('gave up waiting')
                return False
            yield self.now + QUEUE
        return True

    def _leave_rooms(self, activity: Activity) -> None:
        for room in self.household.places.rooms_of(activity.alone):
            self.household.leave(('room', room.name), self.name)

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

    def _somebody_at(self, spot: Spot) -> bool:
        return any(r is not self and r.is_at(spot) for r in self.household.residents)

    def _release(self) -> None:
        held = self.household.held
        for key in [key for key, who in held.items() if who == self.name and key[0] == 'spot']:
            del held[key]

    def _note(self, phase: str, activity: str, step: int = 0) -> None:
        """A phase begins, for the truth."""
        thing = self.spot.thing if self.spot and phase == 'does' else ''
        posture = '' if self.away else 'stand' if phase == 'goes' else self.posture
        cause = self.item.cause
        x, y = self.at if not self.away else (float('nan'), float('nan'))
        self.diary.turn(Interval(self.now, self.now, self.name, activity or 'leave', cause, phase,
                                 self.room, thing, posture, x, y))
        if phase == 'does':
            self.diary.note(self._stands_in.get((activity, step), ''))


def make(household: Household, who: list[tuple[str, Profile]], strict: bool = False) -> list[Any]:
    """The residents of a household, whose days begin. Says what they cannot do in their home;
    Failure for that if `strict`."""
    for number, (name, profile) in enumerate(who):
        household.residents.append(Resident(household, name, number, profile))
    remarks = [remark for resident in household.residents for remark in resident.remarks()]
    for remark in remarks:
        print(f'angen: {remark}', file=sys.stderr, flush=True)
    if strict and remarks:
        raise Failure(f'residents cannot live in {household.name} as they do elsewhere: '
                      f'{len(remarks)} remarks')
    planners = [resident.planner for resident in household.residents if resident.profile.lives]
    for resident in household.residents:
        resident.planner.table = planners
        household.add(resident.live())
    return household.residents
