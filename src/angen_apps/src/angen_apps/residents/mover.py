"""Moves a resident from place to place: on foot, through doors, out of the home and back."""
from __future__ import annotations

import math
from random import Random
from typing import Iterator, Sequence

from angen_apps.residents.ground import BODY, CLEAR, SWING, Leg
from angen_apps.residents.household import Household
from angen_apps.residents.places import Spot
from angen_apps.residents.profiles import Profile
from angen_apps.robot.planner import Point, to_segment
from angen_tools.common.home import Door

POLL = (0.1, 0.5)  # s between two looks at where one is, at least and at most
PASSED, THERE = 0.35, 0.12  # m from a corner of the way, and from its end
STALLED = 7.0  # s without coming nearer, after which another way is tried
TRIES = 3
DOOR_WAIT = 20.0  # s to wait for another person in a doorway
OPENS_IN, SHUTS_IN = 12.0, 6.0  # s
LIFT_WAIT = 90.0  # s for an elevator, or for someone else in it
LIFT_ROOM = 1.6  # m around cabin and landing, where a robot uses the elevator
LEAVES_AROUND = 2.5  # m to the middle of their doorways
ASIDE = 0.55  # m between the middles of two people
LEGS = 0.4  # m before a seat
NEARER = 0.05  # m
BACK = 0.25  # m: a step back
BEYOND = CLEAR - 0.15  # m from a door's middle: who is there lets its leaf shut
WAYS_OUT = 4  # places beyond a leaf that are tried
SLOWS = 0.4  # s, in which it walks the rest of its way

Process = Iterator[float]


class Mover:
    """A resident's body."""

    def __init__(self, household: Household, name: str, number: int, profile: Profile) -> None:
        self.household, self.name, self.number, self.profile = household, name, number, profile
        self.simulator, self.ground = household.simulator, household.ground
        self.spot: Spot | None = None  # where it is, or was last
        self.posture = 'stand'
        self.away = True
        self.walks = False
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
        self.room = self.ground.room_name(body.x, body.y, self.storey)

    def enter(self, spot: Spot) -> None:
        """Appears standing at a place: outside the entrance, or at the start of a run."""
        self.storey, self.spot = spot.storey, spot
        point = self._free(spot.stand) or spot.stand
        yaw = self._habits.uniform(-math.pi, math.pi)
        self.simulator.appear(self.name, *point, spot.z, yaw, self.profile.speed,
                              self.profile.body)
        self.away, self.posture = False, 'stand'
        self.look()

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
        waited = 0.0
        while point is None and waited < DOOR_WAIT:
            yield self.now + 1.0
            waited += 1.0
            point = self._free(self.spot.stand)
        body = self.simulator.body(self.name)
        self.simulator.appear(self.name, *(point or self.spot.stand), self.spot.z, body.yaw,
                              self.profile.speed, self.profile.body)
        self.posture, self.moved = 'stand', self.now
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
        planner = self.ground.planners[self.storey]
        around = [(0.0, 0.0)] + [(d * math.cos(k * math.pi / 4), d * math.sin(k * math.pi / 4))
                                 for d in (0.4, 0.7, 1.0) for k in range(8)]
        for dx, dy in around:
            at = (point[0] + dx, point[1] + dy)
            if (dx or dy) and not planner.is_free(at):
                continue
            if all(math.dist(at, other) > ASIDE for other in others):
                return at
        return None

    def go(self, goal: Point, storey: int) -> Iterator[float]:
        """Walks there; `self.arrived` says whether it succeeded."""
        self.arrived = False
        yield from self.rise()
        if storey != self.storey:
            yield from self._ride(storey)
            if storey != self.storey:
                self.arrived = False  # it had come to the elevator
                return
        yield from self._reach_on_foot(goal, storey)

    def _reach_on_foot(self, goal: Point, storey: int) -> Process:
        self.arrived = False
        for attempt in range(TRIES):
            legs = self.ground.way(self.at, goal, storey)
            if legs is None:
                return
            yield from self._follow(legs)
            if self.arrived:
                return
            if attempt + 1 < TRIES:
                yield from self._shut_around()
                yield from self._aside(attempt)

    def _ride(self, storey: int) -> Process:
        """Takes the elevator to another storey, one person at a time."""
        ride = self.ground.lift(self.storey, storey)
        key, since = ('lift', ride.name if ride else ''), self.now
        if ride is None:
            return
        while not self.household.take(key, self.name) or any(
                self.household.robot_near(*at, LIFT_ROOM) for at in (ride.cabin, ride.waits)):
            if self.now - since > LIFT_WAIT:
                self.household.leave(key, self.name)
                return
            yield self.now + 1.0
        try:
            yield from self._reach_on_foot(ride.waits, self.storey)
            if not self.arrived:
                return
            self.walks = True
            yield from self._call(ride.name, self.storey)
            if self._opened:
                yield from self._walk(ride.cabin, PASSED, [])
                self.halt()
            if not self._opened or not self._came:
                return
            yield from self._call(ride.name, storey)
            if self._opened:
                self.storey = storey
                self.look()
                yield from self._walk(ride.leaves, PASSED, [])
        finally:
            self.walks = False
            self.halt()
            self.household.leave(key, self.name)

    def _call(self, lift: str, storey: int) -> Process:
        """Has an elevator at a storey with open doors; `self._opened` says whether it is."""
        self._opened = False
        since = self.now
        self.household.do(self.name, 'elevator', lift, f'Floor{storey}')
        while self.now - since < LIFT_WAIT:
            yield self.now + 0.5
            state = self.simulator.state('elevator', lift)
            if (state.get('mode'), state.get('door_mode')) != ('IDLE', 'OPEN'):
                continue
            if state.get('target_floor') == storey:
                self._opened = True
                return
            self.household.do(self.name, 'elevator', lift, f'Floor{storey}')  # another called it

    def _follow(self, legs: list[Leg]) -> Process:
        self.walks = True
        held: list[Door] = []  # two of a double door
        try:
            for leg in legs:
                if leg.door is not None:
                    if not any(door.partner == leg.door.name for door in held):
                        self._let_go(held)
                    yield from self._open(leg.door)
                    if not self._opened:
                        return
                    held.append(leg.door)
                elif leg.behind is not None:
                    self._let_go(held)
                    yield from self._wait_for('CLOSED', leg.behind, SHUTS_IN)
                for j, point in enumerate(leg.points):
                    ends = j == len(leg.points) - 1
                    near = THERE if ends and leg.exact else PASSED
                    yield from self._walk(point, near, held)
                    if not self._came and ends:  # a leaf or a chair may be at another point
                        return
                    if all(math.dist(self.at, door.pose[:2]) > SWING for door in held):
                        self._let_go(held)
            self.arrived = True
            yield self.now + SLOWS
        finally:
            self.walks = False
            self.halt()
            self._let_go(held)

    def halt(self) -> None:
        """Stops here: otherwise it would keep trying to reach the exact point."""
        if not self.away and self.posture == 'stand':
            self.household.do(self.name, 'person', self.name, 'Stop')

    def _walk(self, point: Point, near: float, held: list[Door]) -> Process:
        """Walks straight to a point; `self._came` says whether it came near enough."""
        self._came = False
        if not self.household.do(self.name, 'person', self.name,
                                 f'GoTo {point[0]:.3f} {point[1]:.3f}'):
            return
        best, since = math.inf, self.now
        while True:
            self.look()
            away = math.dist(self.at, point)
            if away < near:
                self._came = True
                return
            if away < best - NEARER:
                best, since = away, self.now
            elif self.now - since > STALLED:
                return
            if all(math.dist(self.at, door.pose[:2]) > SWING and self._behind(door, point)
                   for door in held):
                self._let_go(held)
            least, most = POLL
            yield self.now + min(max((away - near) / self.profile.speed, least), most)

    def _behind(self, door: Door, point: Point) -> bool:
        """Whether a door is behind, on the way to a point."""
        return math.dist(self.at, point) < math.dist(door.pose[:2], point)

    def _open(self, door: Door) -> Process:
        """Opens and reserves a door; `self._opened` says whether it is open."""
        self._opened = False
        key, since = ('door', door.name), self.now
        while not self.household.take(key, self.name) or self._meets_robot(door):
            if self.now - since > DOOR_WAIT:
                self.household.leave(key, self.name)
                return
            yield self.now + 0.5
        state = self.simulator.state('door', door.name)
        if state.get('mode') != 'OPEN' and self.profile.body == 'person':
            self.household.do(self.name, 'door', door.name, 'OpenByHand')
        if self.profile.body == 'person':
            yield from self._wait_for('OPEN', door, OPENS_IN + DOOR_WAIT + since - self.now)
            state = self.simulator.state('door', door.name)
        self._opened = not state or state.get('mode') == 'OPEN'
        if not self._opened:
            self.household.leave(key, self.name)

    def _meets_robot(self, door: Door) -> bool:
        """Whether the leaf of a door that is not open would hit a robot."""
        x, y = door.pose[:2]
        return (self.household.robot_near(x, y, CLEAR, self.storey)
                and self.simulator.state('door', door.name).get('mode') != 'OPEN')

    def _wait_for(self, mode: str, door: Door, seconds: float) -> Process:
        """Waits until a door is open or shut, for at most this time."""
        until = self.now + seconds
        while self.now < until \
                and self.simulator.state('door', door.name).get('mode', mode) != mode:
            yield self.now + 0.25

    def _let_go(self, held: list[Door]) -> None:
        """Releases doors, and shuts them by habit; always the entrance, and who is in the way."""
        for door in held:
            key = ('door', door.name)
            if self.household.held.get(key) != self.name:
                continue
            self.household.leave(key, self.name)
            shuts = (self.ground.home.entrance in (door.name, door.partner)
                     or door.name in self.ground.in_way
                     or self._habits.random() < self.profile.closes_doors)
            beyond = math.dist(self.at, door.pose[:2]) > BEYOND
            if shuts and beyond and self.profile.body == 'person' \
                    and self.household.doorway_free(*door.pose[:2], self.storey, self.name):
                self.household.do(self.name, 'door', door.name, 'CloseByHand')
        held.clear()

    def _shut_around(self) -> Process:
        """Shuts open leaves nearby that are not in use: two of them can close off a corridor."""
        for door in self.ground.home.doors:
            x, y, z, _ = door.pose
            if (door.kind == 'door' and self.profile.body == 'person'
                    and PASSED < math.dist(self.at, (x, y)) < LEAVES_AROUND
                    and self.ground.storey_at(z) == self.storey
                    and ('door', door.name) not in self.household.held
                    and self.household.doorway_free(x, y, self.storey, self.name)
                    and self.simulator.state('door', door.name).get('mode') == 'OPEN'):
                yield from self._out_of_swing(door)
                self.household.do(self.name, 'door', door.name, 'CloseByHand')

    def _out_of_swing(self, door: Door) -> Process:
        """Steps to where a leaf that shuts does not hit it."""
        x, y = door.pose[:2]
        free = self.ground.planners[self.storey].is_free
        around = [(x + CLEAR * math.cos(turn), y + CLEAR * math.sin(turn))
                  for turn in (k * math.pi / 8 for k in range(16))]
        for point in sorted(filter(free, around), key=lambda p: math.dist(p, self.at))[:WAYS_OUT]:
            if math.dist(self.at, (x, y)) > BEYOND:
                break
            yield from self._walk(point, THERE, [])
        self.halt()

    def blocker(self, spot: Spot) -> Mover | None:
        """The resident nearest to here of those who stay on the way to a spot."""
        legs = self.ground.way(self.at, spot.stand, self.storey) \
            if spot.storey == self.storey else None
        line = [self.at, *(point for leg in legs or () for point in leg.points)]
        near: list[Mover] = [r for r in self.household.residents if r is not self and not r.away
                             and not r.walks and r.storey == self.storey
                             and away_from(line, r.at) < ASIDE + LEGS * (r.posture != 'stand')]
        return min(near, key=lambda r: math.dist(r.at, self.at)) if near else None

    def somebody_at(self, spot: Spot) -> bool:
        """Whether another resident stands, sits or lies at a place on the floor."""
        return any(r is not self and not r.away and r.storey == spot.storey
                   and math.dist(r.at, spot.stand) < ASIDE + LEGS * (r.posture != 'stand')
                   for r in self.household.residents)

    def _aside(self, attempt: int) -> Process:
        """Steps aside before another try."""
        planner = self.ground.planners[self.storey]
        for _ in range(12):
            turn = self._habits.uniform(-math.pi, math.pi)
            point = (self.at[0] + 3 * BODY * math.cos(turn), self.at[1] + 3 * BODY * math.sin(turn))
            if planner.is_free(point):
                self.household.do(self.name, 'person', self.name,
                                  f'GoTo {point[0]:.3f} {point[1]:.3f}')
                break
        yield self.now + 2.0 + attempt
        self.halt()
        self.look()

    def _step_back(self, x: float, y: float, side: float) -> None:
        """Steps away from a point, or where there is no room to one side: 1 left, -1 right."""
        yaw = math.atan2(self.at[1] - y, self.at[0] - x)
        for turn in (0.0, 0.8 * side, 1.6 * side, -0.8 * side, -1.6 * side):
            point = (self.at[0] + BACK * math.cos(yaw + turn),
                     self.at[1] + BACK * math.sin(yaw + turn))
            if self.ground.planners[self.storey].is_free(point):
                self.household.do(self.name, 'person', self.name,
                                  f'GoTo {point[0]:.3f} {point[1]:.3f}')
                return


def away_from(line: Sequence[Point], point: Point) -> float:
    """The distance of a point from a line through points, m."""
    return min((to_segment(point, a, b) for a, b in zip(line, line[1:]) if a != b),
               default=math.dist(line[0], point))
