"""Sends a resident from place to place. How to get there is up to the person: its way, doors, the
elevator, and whom to let pass (docs/devices/person.md)."""
from __future__ import annotations

import math
from random import Random
from typing import Generator, Iterator

from angen_apps.residents.figures import walker
from angen_apps.residents.household import Household
from angen_apps.residents.places import UNUSED, Spot
from angen_apps.residents.profiles import Profile
from angen_apps.robot.planner import Point

POLL = (0.1, 0.4)  # s between two looks at where it is, at least and at most
STARTS = 0.8  # s until its state shows that it goes, in ROS
TRIES = 3
PAUSE = 6.0  # s between them
STUCK = 150.0  # s at one place, as of a cat before a door, and it gives up
PUSHES = 5.0  # s against something that does not move
BESIDE = 2.5  # m to others, against whom nobody pushes, and who may be in the way
LIFT_WAIT = 90.0  # s for somebody else in the elevator
LIFT_ROOM = 1.6  # m around cabin and landings, where a robot uses the elevator
RISES = 1.6  # m to others who get up, for whom one waits
ASIDE = 0.55  # m between the middles of two people
LEGS = 0.4  # m before a seat
ABOVE = 0.002  # m between a floor or seat and who appears on it
POSTURES = {'SITTING': 'sit', 'LYING': 'lie'}  # by the mode of a person

Process = Iterator[float]
Success = Generator[float, None, bool]


class Mover:
    """A resident's body."""

    def __init__(self, household: Household, name: str, number: int, profile: Profile) -> None:
        self.household, self.name, self.number, self.profile = household, name, number, profile
        self.simulator, self.floors = household.simulator, household.floors
        self.spot: Spot | None = None  # where it is, or was last
        self.posture = 'stand'
        self.away = True
        self.goes, self.walks = False, False  # somewhere, and on its feet
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

    def others(self) -> list[Mover]:
        """The other residents on its floor."""
        return [other for other in self.household.residents
                if other is not self and not other.away and other.storey == self.storey]

    def enter(self, spot: Spot, settled: bool = False) -> None:
        """Appears at a place, or beside it if others are there: outside the entrance, or at the
        start of a run; sitting or lying if `settled`."""
        self.storey, self.spot, self.posture = spot.storey, spot, 'stand'
        taken = [other.at for other in self.others()]
        around = self.floors.around(spot.stand, spot.storey, 0.4, 0.7, 1.0)
        places = [at for at in (spot.stand, *around)
                  if all(math.dist(at, other) > ASIDE for other in taken)]
        stand = *(places or [spot.stand])[0], spot.z
        pose = *stand, self._habits.uniform(-math.pi, math.pi)
        if settled and spot.place is not None and self.profile.body == 'person':
            pose, self.posture = spot.place.pose, spot.place.posture
        body = walker(self.name, self.profile.speed, self.profile.body, self.posture, stand)
        self.simulator.appear(self.name, body, pose[0], pose[1], pose[2] + ABOVE, pose[3])
        self.away = False
        self.look()

    def settle(self, spot: Spot) -> None:
        """Sits down or lies down; Failure says why not."""
        if spot.place is None or self.profile.body != 'person':
            return
        x, y = spot.place.pose[:2]
        self.simulator.command('person', self.name,
                               f'{spot.place.posture.capitalize()} {x:.3f} {y:.3f}')
        self.posture, self.spot = spot.place.posture, spot
        self.at, self.moved, self.looked = (x, y), self.now, self.now

    def vanish(self) -> None:
        """Leaves the simulation."""
        self.simulator.vanish(self.name)
        self.away, self.room, self.at = True, '', (math.inf, math.inf)

    def go(self, goal: Point, storey: int) -> Process:
        """Walks there; `self.arrived` says whether it succeeded."""
        self.arrived, until = False, self.now + PAUSE
        while self.posture != 'stand' and self.now < until \
                and any(other.goes for other in self._near(RISES)):
            yield self.now + 1.0  # who gets up at once would stand close to each other
        rides = storey != self.storey
        if rides and not (yield from self._waits_for_lift()):
            return
        try:
            comes_in = self.household.places.use(self.room) in UNUSED
            self.goes = True
            shuts = comes_in or self._habits.random() < self.profile.closes_doors
            self._order('CloseDoors' if shuts else 'LeaveDoors')
            for attempt in range(TRIES):
                if attempt:
                    yield self.now + PAUSE
                if attempt == TRIES - 1 and not self._near(BESIDE):
                    yield from self._push_out()
                self.arrived = self._send(goal, storey) and (yield from self._walk(goal))
                if self.arrived:
                    break
        finally:
            self.goes = False
            if rides:
                self.household.leave('elevator', self.name)

    def _push_out(self) -> Process:
        """Goes to the open floor of its room straight, against a chair that shuts it in."""
        for x, y in self.floors.spots(self.room, 1, self._habits) if self.room else ():
            if self._order(f'PushTo {x:.3f} {y:.3f}'):
                yield from self._walk((x, y), PUSHES)

    def _waits_for_lift(self) -> Success:
        """Takes the elevator, which one uses at a time; returns whether it may."""
        until = self.now + LIFT_WAIT
        places = [pose[:2] for lift in self.household.home.elevators
                  for pose in (lift.pose, *(landing.pose for landing in lift.landings))]
        while not self.household.take('elevator', self.name) or any(
                self.household.robot_near(x, y, LIFT_ROOM) for x, y in places):
            if self.now > until:
                self.why = 'others use the elevator'
                self.household.leave('elevator', self.name)
                return False
            yield self.now + 1.0
        return True

    def _send(self, goal: Point, storey: int) -> bool:
        return self._order(f'GoTo {goal[0]:.3f} {goal[1]:.3f} {storey}')

    def _order(self, text: str) -> bool:
        return self.household.do(self.name, 'person', self.name, text)

    def _walk(self, goal: Point, patience: float = STUCK) -> Success:
        """Waits until it has arrived or given up; in ROS its state may be a little old. Returns
        whether it has arrived."""
        self.moved = since = self.now
        try:
            while self.now - self.moved <= patience:
                self.look()
                state = self.simulator.state('person', self.name)
                self.posture = POSTURES.get(state.get('mode', ''), 'stand')
                self.walks = self.posture == 'stand'  # it has got up
                if self.now - since > STARTS and not state.get('going', True):
                    self.why = state.get('why', '')
                    return not state.get('unreachable', False)
                least, most = POLL
                away = math.dist(self.at, goal)
                yield self.now + min(max(away / self.profile.speed, least), most)
            self.why = 'it does not come on'
            self._order('Stop')
            return False
        finally:
            self.walks = False

    def _near(self, reach: float) -> list[Mover]:
        return [other for other in self.others() if math.dist(self.at, other.at) < reach]

    def blocker(self, spot: Spot) -> Mover | None:
        """The resident who stays in the way of one who gave up the way to a spot: the nearest, or
        who is at it."""
        near = [other for other in self.others() if not other.walks
                and (math.dist(other.at, self.at) < BESIDE or other.is_at(spot))]
        return min(near, key=lambda r: math.dist(r.at, self.at)) if near else None

    def is_at(self, spot: Spot) -> bool:
        """Whether it stands, sits or lies at a place on the floor."""
        return (not self.away and self.storey == spot.storey
                and math.dist(self.at, spot.stand) < ASIDE + LEGS * (self.posture != 'stand'))
