"""Sends a resident from place to place. How to get there is up to the person: its way, doors, the
elevator, and whom to let pass (docs/devices/person.md)."""
from __future__ import annotations

import math
from random import Random
from typing import Generator, Iterator

from angen_apps.residents.floors import SWING
from angen_apps.residents.household import CLEAR, Household
from angen_apps.residents.places import UNUSED, Spot
from angen_apps.residents.profiles import Profile
from angen_apps.robot.planner import Point

POLL = (0.1, 0.4)  # s between two looks at where it is, at least and at most
STARTS = 0.8  # s until its state shows that it goes, in ROS
NEARBY = 0.35  # m from a goal: something may hold one there who has arrived
TRIES = 3
PAUSE = 6.0  # s between them, in which doors shut
LEAVES_AROUND = 2.5  # m to the middle of their doorways
STUCK = 150.0  # s at one place, as before a door that it cannot open, and it gives up
PUSHES = 5.0  # s against something that does not move
BESIDE = 2.5  # m to others, against whom nobody pushes
SEAT_WAIT = 20.0  # s for a place to get up to
LIFT_WAIT = 90.0  # s for somebody else in the elevator
LIFT_ROOM = 1.6  # m around cabin and landings, where a robot uses the elevator
IN_WAY = 2.5  # m: somebody there was in the way of one who gave up
ASIDE = 0.55  # m between the middles of two people
LEGS = 0.4  # m before a seat

Process = Iterator[float]


class Mover:
    """A resident's body."""

    def __init__(self, household: Household, name: str, number: int, profile: Profile) -> None:
        self.household, self.name, self.number, self.profile = household, name, number, profile
        self.simulator, self.floors = household.simulator, household.floors
        self.spot: Spot | None = None  # where it is, or was last
        self.posture = 'stand'
        self.away = True
        self.walks = False
        self.arrived, self.why = False, ''  # on its last way, and why not
        self.waits_for: Mover | None = None  # who stays on its way
        self.room = ''
        self.at: tuple[float, float] = (math.inf, math.inf)
        self.storey = 0
        self.looked = -math.inf  # s: when it was at `at`
        self.moved = -math.inf  # s: when it last moved
        self._habits = Random(0)

    @property
    def now(self) -> float:
        return self.simulator.now

    def look(self) -> None:
        """Notes where the body is."""
        if self.away:
            return
        body = self.simulator.body(self.name)
        if math.dist(self.at, (body.x, body.y)) > 0.02:
            self.moved = self.now
        self.at, self.looked = (body.x, body.y), self.now
        self.storey = self.household.home.storey_at(body.z)
        self.room = self.floors.room_name(body.x, body.y, self.storey)

    def enter(self, spot: Spot) -> None:
        """Appears standing at a place: outside the entrance, or at the start of a run."""
        self.storey, self.spot = spot.storey, spot
        yaw = self._habits.uniform(-math.pi, math.pi)
        self._stand_at(self._free(spot.stand) or spot.stand, spot.z, yaw)
        self.away = False
        self.look()

    def _stand_at(self, point: Point, z: float, yaw: float) -> None:
        self.simulator.appear(self.name, *point, z, yaw, self.profile.speed, self.profile.body)
        self.posture = 'stand'

    def settle(self, spot: Spot) -> None:
        """Sits down or lies down."""
        if spot.place is None or self.profile.body != 'person':
            return
        self.simulator.settle(self.name, spot.place)
        self.posture, self.spot = spot.place.posture, spot
        self.moved = self.now
        self.look()

    def rise(self) -> Process:
        """Gets up, once the place before the seat is free."""
        if self.posture == 'stand' or self.spot is None:
            return
        point = self._free(self.spot.stand)
        until = self.now + SEAT_WAIT
        while point is None and self.now < until:
            yield self.now + 1.0
            point = self._free(self.spot.stand)
        yaw = self.simulator.body(self.name).yaw
        self._stand_at(point or self.spot.stand, self.spot.z, yaw)
        self.moved = self.now
        self.look()
        yield self.now + 0.3

    def vanish(self) -> None:
        """Leaves the simulation."""
        self.simulator.vanish(self.name)
        self.away, self.room, self.at = True, '', (math.inf, math.inf)

    def _free(self, point: Point) -> Point | None:
        """The point, or one beside it, that no other resident is at."""
        others = [r.at for r in self.household.residents if r is not self and not r.away
                  and r.storey == self.storey]
        around = [(0.0, 0.0)] + [(d * math.cos(k * math.pi / 4), d * math.sin(k * math.pi / 4))
                                 for d in (0.4, 0.7, 1.0) for k in range(8)]
        for dx, dy in around:
            at = (point[0] + dx, point[1] + dy)
            if (dx or dy) and not self.floors.is_free(at, self.storey):
                continue
            if all(math.dist(at, other) > ASIDE for other in others):
                return at
        return None

    def go(self, goal: Point, storey: int) -> Process:
        """Walks there; `self.arrived` says whether it succeeded."""
        self.arrived = False
        yield from self.rise()
        rides = storey != self.storey
        if rides and not (yield from self._waits_for_lift()):
            return
        try:
            comes_in = self.household.places.use(self.room) in UNUSED
            shuts = comes_in or self._habits.random() < self.profile.closes_doors
            self._order('CloseDoors' if shuts else 'LeaveDoors')
            for attempt in range(TRIES):
                if attempt:
                    yield from self._shut_around()
                    yield self.now + PAUSE
                if attempt == TRIES - 1 and not self._beside_somebody():
                    yield from self._push_out()
                if not self._send(goal, storey):
                    break
                yield from self._walk(goal, storey)
                if self.arrived:
                    break
        finally:
            if rides:
                self.household.leave('elevator', self.name)

    def _shut_around(self) -> Process:
        """Shuts open doors nearby that nobody is at: their leaves may close off a corridor."""
        for door in self.household.home.doors:
            x, y, z, _ = door.pose
            if (door.kind == 'door' and self.profile.body == 'person'
                    and math.dist(self.at, (x, y)) < LEAVES_AROUND
                    and self.household.home.storey_at(z) == self.storey
                    and self.household.doorway_free(x, y, self.storey, self.name)
                    and self.simulator.state('door', door.name).get('mode') == 'OPEN'):
                yield from self._out_of_swing(x, y)
                self.household.do(self.name, 'door', door.name, 'CloseByHand')

    def _beside_somebody(self) -> bool:
        """Whether another resident is so near that a push could be against that one."""
        return any(other is not self and not other.away and other.storey == self.storey
                   and math.dist(self.at, other.at) < BESIDE
                   for other in self.household.residents)

    def _push_out(self) -> Process:
        """Goes to the open floor of its room straight, against a chair that shuts it in."""
        for x, y in self.floors.spots(self.room, 1, self._habits) if self.room else ():
            if self._order(f'PushTo {x:.3f} {y:.3f}'):
                yield from self._walk((x, y), self.storey, PUSHES)
                self.arrived = False

    def _out_of_swing(self, x: float, y: float) -> Process:
        """Steps to where the leaf of a door there does not hit it."""
        around = [(x + SWING * math.cos(k * math.pi / 8), y + SWING * math.sin(k * math.pi / 8))
                  for k in range(16)]
        free = [point for point in around if self.floors.is_free(point, self.storey)]
        nearest = min(free, key=lambda point: math.dist(point, self.at), default=self.at)
        if math.dist(self.at, (x, y)) < CLEAR and self._send(nearest, self.storey):
            yield from self._walk(nearest, self.storey)
            self.arrived = False

    def _leave_swings(self) -> Process:
        """Steps out of the swings of the doors around, which others may need."""
        for door in self.household.home.doors:
            x, y, z, _ = door.pose
            if door.kind == 'door' and self.household.home.storey_at(z) == self.storey:
                yield from self._out_of_swing(x, y)

    def _waits_for_lift(self) -> Generator[float, None, bool]:
        """Takes the elevator, which one uses at a time; returns whether it may."""
        until = self.now + LIFT_WAIT
        places = [pose[:2] for lift in self.household.home.elevators
                  for pose in (lift.pose, *(landing.pose for landing in lift.landings))]
        while not self.household.take('elevator', self.name) or any(
                self.household.robot_near(x, y, LIFT_ROOM) for x, y in places):
            if self.now > until:
                self.household.leave('elevator', self.name)
                return False
            yield self.now + 1.0
        return True

    def _send(self, goal: Point, storey: int) -> bool:
        return self._order(f'GoTo {goal[0]:.3f} {goal[1]:.3f} {storey}')

    def _order(self, text: str) -> bool:
        return self.household.do(self.name, 'person', self.name, text)

    def _walk(self, goal: Point, storey: int, patience: float = STUCK) -> Process:
        """Waits until it has arrived or given up; in ROS its state may be a little old."""
        self.walks, since = True, self.now
        try:
            while True:
                self.look()
                away = math.dist(self.at, goal) if self.storey == storey else math.inf
                state = self.simulator.state('person', self.name)
                ended = self.now - since > STARTS and not state.get('going', True)
                self.arrived = ended and away < NEARBY  # and stands: it is at `at` from now on
                self.why = state.get('why', '')
                if self.arrived or (ended and state.get('unreachable', False)):
                    return
                least, most = POLL
                yield self.now + min(max(away / self.profile.speed, least), most)
                if self.now - max(self.moved, since) > patience:
                    self._order('Stop')
                    return
        finally:
            self.walks = False

    def blocker(self, spot: Spot) -> Mover | None:
        """The resident who stays in the way of one who gave up the way to a spot: the nearest, or
        who is at it."""
        near: list[Mover] = [r for r in self.household.residents if r is not self and not r.away
                             and not r.walks and r.storey == self.storey
                             and (math.dist(r.at, self.at) < IN_WAY or r.is_at(spot))]
        return min(near, key=lambda r: math.dist(r.at, self.at)) if near else None

    def is_at(self, spot: Spot) -> bool:
        """Whether it stands, sits or lies at a place on the floor."""
        return (not self.away and self.storey == spot.storey
                and math.dist(self.at, spot.stand) < ASIDE + LEGS * (self.posture != 'stand'))

    def _step_to(self, point: Point) -> bool:
        """Steps to a place nearby, if one can stay there."""
        return self.floors.is_free(point, self.storey) and self._send(point, self.storey)
