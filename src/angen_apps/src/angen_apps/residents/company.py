"""A resident among others: how it stays at a place, waits for a room, and talks."""
from __future__ import annotations

import math
from dataclasses import replace
from typing import Generator, Iterator, NamedTuple

from angen_apps.residents.activities import Activity, activities
from angen_apps.residents.agenda import CONTINUES, VISIT, Item, Planner
from angen_apps.residents.chance import spread
from angen_apps.residents.floors import BODY, SWING
from angen_apps.residents.household import Household
from angen_apps.residents.mover import ASIDE
from angen_apps.residents.places import Spot
from angen_apps.residents.profiles import Profile
from angen_apps.residents.simulator import Body
from angen_apps.residents.truth import Diary, Interval
from angen_apps.residents.user import TV, User

EAT = 'eat'
BESIDE = (EAT, VISIT, TV)  # activities for which one takes a seat near to others there
LEFT_FOR_TV = ('relax', 'read', 'play')  # free time that one may spend before the TV with another
# s between two bouts of movements; who sleeps turns 2.1 to 2.7 times an hour (De Koninck, Lorrain
# and Gagnon, Sleep 15, 1992). Most rests of people are short and a few very long (Nakamura et al.,
# Physical Review Letters 99, 138103, 2007); the numbers for those who sit or stand are ours.
MOVES = {'sit': (30.0, 600.0), 'lie': (500.0, 3000.0), 'stand': (20.0, 240.0)}
TURNED = 0.12  # rad from the way a seat faces: who turned on would hit what is beside
TURNS = (-TURNED, 0.0, TURNED)
LEANS = (-0.02, 0.1), (-0.02, 0.02)  # m ahead and aside, of who sits and reaches; ours
MORE, APART = 0.8, (3.0, 9.0)  # probability of a further movement in a bout, and s until then; ours
QUEUE, PATIENCE = 10.0, 900.0  # s between two looks at a room or way, and until it is given up
CLOSE = 0.35  # m between two who sit or lie, at least
HEARS = 4.0  # m to one whom one talks to, ours
# s of a turn of a talk: 1200 of 2 to 3 h a day (Levinson and Torreira, Frontiers in Psychology 6,
# 2015)
SAYS = (3.0, 15.0)
SHORTEST = 1.0  # s of a turn, ours: with less time left nobody begins one
ANSWERS = 0.7  # probability of a further turn, of the other one; ours
SOCIAL = ('eat', 'leisure')  # labels of OpenSHS whose activities leave people time to talk

Process = Iterator[float]
Success = Generator[float, None, bool]


class Talk(NamedTuple):
    """A turn of a talk: a resident speaks to another one in its room."""

    start: float
    end: float
    resident: str
    to: str


class Company(User):
    """A resident at a place, with a diary."""

    planner: Planner
    _tasks: dict[str, list[list[Spot]]]  # by activity: the spots of each step

    def __init__(self, household: Household, name: str, number: int, profile: Profile) -> None:
        super().__init__(household, name, number, profile)
        self.diary = Diary()
        self.talks: list[Talk] = []
        self._seated: Body | None = None  # a sitting or lying body, as it settled
        self._turned = 0.0  # rad from there
        self._stands_in: dict[tuple[str, int], str] = {}  # by step: the missing thing
        self._joined = ''  # the activity that it has left for the TV
        self._until = 0.0  # when it ends to stay where it is, s

    def _stay(self, until: float, moves: tuple[float, float] | None = None) -> Process:
        """Stays, and moves a little after each such time, or by its posture, in bouts."""
        self._until = until
        moves = moves or (None if self.posture == 'stand' else MOVES[self.posture])
        more = MORE if moves in (MOVES['sit'], MOVES['stand']) else 0.0
        while moves and self.now < until and not self.away:
            pause = spread(self._habits, *moves)
            while self.now + pause < until:
                yield self.now + pause
                if not (yield from self._talk(until)):  # a talk is a movement, too
                    yield from self._move()
                if self._habits.random() >= more:
                    break
                pause = self._habits.uniform(*APART)
            else:
                break
        if until > self.now:
            yield until

    def _move(self) -> Process:
        """Moves a little at its place."""
        self.moved = self.now
        if self.posture != 'stand':
            turn = self._habits.choice([turn for turn in TURNS if turn != self._turned])
            leans = [self._habits.uniform(*span) for span in LEANS] \
                if self.posture == 'sit' else [0.0, 0.0]
            self._turn(turn, *leans)
        elif self.spot is not None:
            yield from self._shuffle(self.spot)

    def _turn(self, turn: float, ahead: float = 0.0, aside: float = 0.0) -> None:
        """Turns (rad), and moves (m), so far from how it settled."""
        if self._seated is None:
            self._seated = self.simulator.body(self.name)
        x, y, z, yaw = self._seated
        c, s = math.cos(yaw), math.sin(yaw)
        self.moved, self._turned = self.now, turn
        self.simulator.fidget(self.name, Body(x + c * ahead - s * aside, y + s * ahead + c * aside,
                                              z, yaw + turn))

    def settle(self, spot: Spot) -> None:
        self._seated, self._turned = None, 0.0
        super().settle(spot)

    def _shuffle(self, spot: Spot) -> Process:
        """Steps aside, along the front of the thing in use, out of the swing of its leaf."""
        thing = self._thing(spot)
        leaf = self.floors.fronts.leaf(thing) if thing else None
        for _ in range(4):
            point = (spot.stand[0] + self._habits.uniform(-0.3, 0.3),
                     spot.stand[1] + self._habits.uniform(-0.3, 0.3))
            if (leaf is None or leaf.room_for(point) >= BODY) \
                    and self.floors.is_free(point, self.storey) and self._send(point, self.storey):
                break
        yield self.now + 1.2
        if self.simulator.state('person', self.name).get('going'):  # round who stands in its way
            yield from self._walk(point)
        self.look()

    def _talk(self, until: float) -> Success:
        """Says something to another one here, if it likes; each speaks in turn. Returns whether
        it did, or listens."""
        other = self._listener()
        room = self._place
        if other is not None and ('talk', room) in self.household.held:
            return True  # it listens
        if other is None or self._habits.random() >= self.planner.person.talks:
            return False
        self.household.take(('talk', room), self.name)
        speaks, hears = self, other
        try:
            while hears.listens_in(room) and speaks.listens_in(room):
                ends = min(until, hears._until, speaks._until)
                if ends < self.now + SHORTEST:
                    break
                yield from speaks._say(hears, min(spread(self._habits, *SAYS), ends - self.now))
                if self._habits.random() >= ANSWERS:
                    break
                speaks, hears = hears, speaks
        finally:
            self.household.leave(('talk', room), self.name)
        return True

    def _listener(self) -> Company | None:
        """The nearest one to whom it may talk."""
        if not self.listens_in(self._place):
            return None
        near = [(math.dist(other.at, self.at), other.number, other) for other in self.others()
                if isinstance(other, Company) and other.listens_in(self._place)]
        return min(near)[2] if near and min(near)[0] < HEARS else None

    def listens_in(self, room: str) -> bool:
        """Whether it is in a room, and has time to talk."""
        return (not self.away and not self.goes and self._place == room and room != ''
                and self.profile.body == 'person' and self.posture != 'lie'
                and self._doing == self.item.activity
                and activities()[self.item.activity].openshs in SOCIAL)

    @property
    def _place(self) -> str:
        """The room that the truth has."""
        return self.diary.now.room if self.diary.now is not None else ''

    @property
    def _doing(self) -> str:
        """The activity that it does, if it is not on its way."""
        now = self.diary.now
        return now.activity if now is not None and now.phase == 'does' else ''

    def _say(self, other: Company, seconds: float) -> Process:
        """Speaks, while those of both who sit are turned to each other."""
        self._face(other)
        other._face(self)
        start = self.now
        self._order('Speak')
        try:
            yield self.now + seconds
        finally:
            if self.now > start:
                self.talks.append(Talk(start, self.now, self.name, other.name))
        self._order('Quiet')

    def _face(self, other: Company) -> None:
        """Turns to another one as far as one does on a seat."""
        if self.posture != 'sit':
            return
        x, y = other.at[0] - self.at[0], other.at[1] - self.at[1]
        ahead = self.simulator.body(self.name).yaw - self._turned
        aside = math.remainder(math.atan2(y, x) - ahead, 2 * math.pi)
        turn = math.copysign(TURNED, aside) if abs(aside) > TURNED / 2 else 0.0
        if turn != self._turned:
            self._turn(turn)

    def _in_company(self, spots: list[Spot], name: str) -> list[Spot]:
        """The spots of an activity, if people do it together the nearest first to others there."""
        if name not in BESIDE:
            return spots
        held, others = self.household.held, {r.name for r in self.household.residents
                                             if r is not self and r.item.activity == name}
        taken = [spot for spot in spots if held.get(('spot', spot.key)) in others]
        return sorted(spots, key=lambda spot: min(
            ((spot.room != other.room, math.dist(spot.stand, other.stand)) for other in taken),
            default=(False, 0.0)))

    def _joins(self, item: Item) -> Item:
        """The item, or watching TV instead with another one who does, by habit."""
        if item.cause in ('interrupts', CONTINUES):
            again = item.cause == CONTINUES and self._joined == item.activity
            return replace(item, activity=TV) if again and self._may_join() else item
        self._joined = ''
        if item.cause == 'free' and item.activity in LEFT_FOR_TV and TV in self.profile.free \
                and TV not in self.planner.leaves_out and self._may_join() \
                and self._habits.random() < self.planner.person.joins:
            self._joined = item.activity
            return replace(item, activity=TV)
        return item

    def _may_join(self) -> bool:
        """Whether a seat for the TV is free in the room of one who watches."""
        rooms = {r.room for r in self.household.residents
                 if r is not self and r.item.activity == TV and not r.away}
        return any(spot.room in rooms and
                   self.household.held.get(('spot', spot.key), self.name) == self.name
                   for spot in self._tasks[TV][0])

    def _rooms(self, activity: Activity) -> list[str]:
        """The rooms of which an activity takes one, those of this storey first."""
        away = {room.name: room.storey != self.storey
                for room in self.household.places.rooms_of(activity.alone)}
        used = [spot.room for spot in self._tasks[activity.name][0] if spot.room in away]
        return sorted(dict.fromkeys(used), key=lambda room: away[room])

    def _of_own(self, activity: Activity, spots: list[Spot]) -> list[Spot]:
        """The spots of an activity outside of rooms that it takes, but for those that it has
        taken."""
        others = {room.name for room in self.household.places.rooms_of(activity.alone)
                  if self.household.held.get(('room', room.name)) != self.name}
        return [spot for spot in spots if spot.room not in others]

    def _leave_rooms(self, activity: Activity) -> None:
        for room in self.household.places.rooms_of(activity.alone):
            self.household.leave(('room', room.name), self.name)

    def _queue(self, activity: Activity, rooms: list[str], before: Item) -> Success:
        """Waits for one of some rooms that one resident uses at a time, by habit before its door or
        with what it did before; returns whether it has one, or needs none."""
        if not rooms or self._takes(rooms):
            return True
        item, until = self.item, min(self.now + PATIENCE, self.item.end)
        stays = self._goes_on_with(before, rooms) and \
            self._habits.random() >= self.planner.person.queues
        if stays:
            self.item = before
        else:
            yield from self._to_door(rooms, activity.name)
            self._note('waits', activity.name)
        moves = self.now + spread(self._habits, *MOVES[self.posture])
        while not (taken := self._takes(rooms)) and self.now < until:
            yield self.now + QUEUE
            if stays and self.now > moves:
                yield from self._move()
                moves = self.now + spread(self._habits, *MOVES[self.posture])
        self.item = before if stays and not taken else item
        if not taken:
            self.diary.note('gave up waiting')
        return taken

    def _goes_on_with(self, item: Item, rooms: list[str]) -> bool:
        """Whether it still does that, in none of some rooms and with no device."""
        return item.activity != '' and self._doing == item.activity and self.room not in rooms \
            and not any(step.runs for step in activities()[item.activity].steps)

    def _takes(self, rooms: list[str]) -> bool:
        return any(self.household.take(('room', room), self.name) for room in rooms)

    def _to_door(self, rooms: list[str], name: str) -> Process:
        """Goes to the first of some rooms, and stays before its door, out of the swing."""
        points = [point for door in self.household.home.doors
                  if door.kind != 'window' and rooms[0] in door.rooms
                  and self.household.home.storey_at(door.pose[2]) == self.storey
                  for point in self.floors.around(door.pose[:2], self.storey, SWING + 0.1)
                  if self.floors.room_name(*point, self.storey) not in ('', *rooms)
                  and all(math.dist(point, other.at) > ASIDE for other in self.others())]
        if points and (self.posture == 'stand' or self.room not in rooms):
            self._note('goes', name)
            self._release()
            self.spot = None
            nearest = min(points, key=lambda point: (math.dist(point, self.at), point))
            yield from self.go(nearest, self.storey)

    def _somebody_at(self, spot: Spot) -> bool:
        return any(r is not self and r.is_at(spot) for r in self.household.residents)

    def _is_settled_at(self, spot: Spot) -> bool:
        """Whether another one sits or lies at the place of a spot."""
        return spot.place is not None and any(
            other.posture != 'stand' and math.dist(other.at, spot.place.pose[:2]) < CLOSE
            for other in self.others() if other.storey == spot.storey)

    def _until_free(self, spot: Spot, until: float) -> Process:
        """Waits until another one has left the place of a spot."""
        taken = self._is_settled_at(spot)
        while self.now < until and taken == self._is_settled_at(spot):
            yield min(until, self.now + QUEUE)

    def _release(self, but: Spot | None = None) -> None:
        """Gives back its places, but for one."""
        held = self.household.held
        for key in [key for key, who in held.items() if who == self.name and key[0] == 'spot'
                    and (but is None or key[1] != but.key)]:
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
