"""The search: the next viewpoint, observations on the way, and when the person is found."""
import math
from dataclasses import dataclass, replace
from typing import Callable

import numpy as np

from angen_apps.robot.driver import Driver
from angen_apps.robot.interface import CYCLE, Event
from angen_apps.robot.localizer import Field, returns_of, to_world, unexplained
from angen_apps.robot.pilot import wrapped
from angen_apps.robot.planner import Door, Planner, Point
from angen_apps.robot.route import Action, Drive, Router, Turn
from angen_apps.robot.route_file import Route, Waypoint
from angen_apps.seek.ambient import Ambient, RobotNow
from angen_apps.seek.belief import ARC, STEP, Belief
from angen_apps.seek.detector import Arc, Figure, find_arcs, find_figure
from angen_apps.seek.home import SEES, Home
from angen_apps.seek.simulation import Simulation
from angen_apps.seek.ways import Ways
from angen_tools.common.failure import Failure

LEAD = 60.0  # s before the search begins
LOOK_TIME = 3.0  # s
BETTER = 2.0  # times the score of the goal: a goal of a higher score is taken instead
REPLAN = 3.0  # s between two comparisons
SAME = 0.6  # m between two scans' arcs of the same thing
LOST = 1.0  # s without an arc
MOVES, SIGHTINGS = 0.4, 5  # m, arcs: something that has moved by this is a person
EXAMINES = 4.0  # s, at most, that it examines something
KNOWN, ELSEWHERE = 0.5, 0.8  # m around a rejected thing; it is examined again from this distance
FORGETS = 60.0  # s
IN_WAY, AHEAD = 0.30, 14  # m beside the line; points of the line, 0.05 m apart
HELD = 5.0  # s that it waits for something in its way
AVOIDS = 20.0  # s before it tries an unreachable viewpoint again
TURN = 1.2  # rad/s
CAMERA_NEEDS = 0.75  # m to a figure
BEHIND, BACK_SPEED = 0.1, 0.1  # m, m/s


@dataclass(frozen=True)
class Found:
    """The robot's report."""

    time: float  # s since the search began
    x: float  # m
    y: float
    floor: int
    room: str
    by: str


@dataclass
class Sighting:
    """Arcs of the same thing in scan after scan."""

    first: Arc
    latest: Arc
    count: int
    since: float  # s
    seen: float

    @property
    def moved(self) -> float:
        return math.dist(self.first.at, self.latest.at)


class Search:
    """One run. `ambient`: whether it uses the building's sensors."""

    def __init__(self, home: Home, route: Route, simulation: Simulation, ambient: bool,
                 note: Callable[[float, str], None]) -> None:
        self._note = note
        self._home, self._route, self._simulation = home, route, simulation
        self.belief = Belief(home)
        self._ambient = Ambient(home, self.belief) if ambient else None
        self._planners = {floor: Planner(grid, route.clearance)
                          for floor, grid in home.maps.items()}
        self._fields = {floor: Field(grid) for floor, grid in home.landmarks.items()}
        self._driver = Driver(simulation, route, home.landmarks, home.start.mount, self._watch,
                              self._may_go, self._give_up)
        self._ways = Ways(home, route, self._planners)
        self._sighting: Sighting | None = None
        # s, floor, place of a thing that was not a person, and from where that was seen
        self._known: list[tuple[float, int, Point, Point]] = []
        self._views = home.views.astype(float)  # for products with probabilities
        self._avoid: dict[int, float] = {}
        self._robot = RobotNow(home.start.pose.x, home.start.pose.y, home.start.floor, 0.0)
        self._seen_events = self._seen_sent = 0
        self._step_due = self._replan_due = 0.0
        self._held = 0.0
        self._goal: int | None = None
        self._foreign = np.zeros((0, 2))
        self.goals: list[tuple[float, int]] = []  # s, cell
        self.found: Found | None = None
        self.began, self.limit = 0.0, math.inf

    @property
    def driver(self) -> Driver:
        return self._driver

    # --- the parts of each cycle

    def _watch(self) -> None:
        now, pose = self._simulation.now, self._driver.pose
        track = self._driver.track.believed
        if len(track) > 1 and math.dist(track[-1], track[-2]) > 0.002:
            self._robot.last_moved = now
        self._robot.x, self._robot.y, self._robot.floor = pose.x, pose.y, self._driver.floor
        for when, kind, name in self._simulation.sent[self._seen_sent:]:
            self._robot.commanded[kind, name] = when
        self._seen_sent = len(self._simulation.sent)
        self._see()
        if now >= self._step_due - 1e-6:
            self._step(True)

    def _see(self) -> None:
        """Arcs in the latest scan."""
        now, pose, floor = self._simulation.now, self._driver.pose, self._driver.floor
        scan, field = self._simulation.scan(), self._fields[floor]
        points = to_world(returns_of(scan, self._home.start.mount)[0], pose)
        self._foreign = points[unexplained(points, field)]
        arcs = [arc for arc in find_arcs(scan, self._home.start.mount, pose, field)
                if not self._is_known(arc, floor, now)]
        old = self._sighting
        if old is not None:
            before = old.latest.at
            near = [arc for arc in arcs if math.dist(arc.at, before) < SAME]
            if near:
                old.latest = min(near, key=lambda arc: math.dist(arc.at, before))
                old.count += 1
                old.seen = now
            elif now - old.seen > LOST:
                self._sighting = None
        if self._sighting is None and arcs:
            arc = min(arcs, key=lambda arc: arc.far)
            self._sighting = Sighting(arc, arc, 1, now, now)

    def _is_known(self, arc: Arc, floor: int, now: float) -> bool:
        here = self._driver.pose.x, self._driver.pose.y
        return any(where == floor and math.dist(arc.at, at) < KNOWN and now - when < FORGETS
                   and math.dist(here, eye) < ELSEWHERE for when, where, at, eye in self._known)

    def _step(self, awake: bool) -> None:
        """A step of the filter; `awake`: the robot's own sensors work."""
        now = self._simulation.now
        self._step_due = now + STEP
        events: list[Event] = self._simulation.events[self._seen_events:]
        self._seen_events = len(self._simulation.events)
        opened = None
        if self._ambient:
            opened = frozenset(door.name for _, door in self._home.all_doors()
                               if not self._simulation.door(door.name).has_done('Close'))
        self.belief.step(opened)
        if self._ambient:
            self._ambient.step(events, self._robot, now)
        if not awake:
            return
        if self._sighting is not None:
            x, y = self._sighting.latest.at
            self.belief.near(self._home.around(x, y, self._driver.floor, 0.6), ARC)
        else:
            self.belief.looked(self._in_view())

    def _in_view(self) -> np.ndarray:
        """The cells that the latest scan passes over."""
        home, pose = self._home, self._driver.pose
        scan = self._simulation.scan()
        away = home.at - (pose.x, pose.y)
        far = np.hypot(*away.T)
        bearing = np.arctan2(away[:, 1], away[:, 0]) - pose.yaw - home.start.mount.yaw
        bearing = np.remainder(bearing - scan.angle_min, 2 * math.pi)
        numbers = np.clip(np.rint(bearing / scan.angle_increment).astype(int), 0,
                          len(scan.ranges) - 1)
        ranges = np.asarray(scan.ranges)[numbers]
        return np.asarray((home.floor == self._driver.floor) & (far < SEES) & (ranges > far - 0.1))

    # --- while it drives

    def _may_go(self) -> bool:
        """Whether its way is free of things that the map does not show."""
        ahead = np.array(self._driver.left[:AHEAD]).reshape(-1, 2)
        foreign = self._foreign
        if not len(ahead) or not len(foreign):
            self._held = 0.0
            return True
        pose = np.array([self._driver.pose.x, self._driver.pose.y])
        foreign = foreign[np.hypot(*(foreign - pose).T) < 1.2]
        gaps = np.hypot(*(foreign[:, None] - ahead).transpose(2, 0, 1))
        free = not len(foreign) or bool(gaps.min() > IN_WAY)
        self._held = 0.0 if free else self._held + CYCLE
        return free

    def _give_up(self) -> bool:
        """Whether to stop on the way: it sees something, is blocked, or has a better goal."""
        now = self._simulation.now
        if self._sighting is not None and self._sighting.count >= 2 or now > self.limit:
            return True
        if self._held > HELD or self._shut_ahead():
            if self._goal is not None and self._held > HELD:
                self._avoid[self._goal] = now
            return True
        if self._goal is None or now < self._replan_due:
            return False
        self._replan_due = now + REPLAN
        scores = self._scores()
        return bool(scores.max() > BETTER * scores[self._goal])

    def _shut_ahead(self) -> bool:
        line = self._driver.left[:60]
        for door in self._home.doors[self._driver.floor]:
            if self._simulation.door(door.name).has_done('Open'):
                continue
            if any(door.crosses(a, b) for a, b in zip(line, line[1:])):
                return True
        return False

    # --- goals

    def _scores(self) -> np.ndarray:
        """For each viewpoint the probability to see the person there, by the time until then."""
        pose = self._driver.pose
        shut = {door.name for _, door in self._home.all_doors()
                if not self._simulation.door(door.name).has_done('Open')}
        times = self._ways.times((pose.x, pose.y), self._driver.floor, shut)
        gain = self._views @ self.belief.cells
        for cell, when in self._avoid.items():
            if self._simulation.now - when < AVOIDS:
                gain[cell] = 0.0
        return np.asarray(gain / (times + LOOK_TIME))

    # --- the whole

    def run(self, limit: float) -> Found | None:
        """Waits for LEAD s, in which ambient sensors already work, then searches until it has found
        him or for `limit` s; None if it has not."""
        while self._simulation.now < LEAD - 1e-6:
            self._simulation.wait()
            if self._simulation.now >= self._step_due - 1e-6:
                self._step(False)
        self._simulation.start(self._home.start)
        self.began = self._simulation.now
        self.limit = self.began + limit
        self._driver.begin(self._home.start.pose, self._home.start.floor)
        while self.found is None and self._simulation.now < self.limit:
            if self._sighting is not None:
                self._examine()
            else:
                self._go()
        return self.found

    def _go(self) -> None:
        """Drives to the best viewpoint, unless something intervenes."""
        scores = self._scores()
        best = int(scores.argmax())
        if scores[best] <= 0.0:
            self._goal = None
            self._driver.cycle()
            return
        self._goal = best
        self._replan_due = self._simulation.now + REPLAN
        self._held = 0.0
        self._note_goal(int(self._home.viewpoints[best]))
        try:
            for action in self._actions(int(self._home.viewpoints[best])):
                if not self._do(action):
                    return
        except Failure as failure:
            self._note(self._simulation.now - self.began, str(failure))
            self._avoid[best] = self._simulation.now
            self._driver.cycle()
        else:
            for _ in range(2):
                self._driver.cycle()
            self._views[best] *= self._in_view()  # cells hidden from there remain hidden
            self._avoid[best] = self._simulation.now

    def _note_goal(self, cell: int) -> None:
        now, rooms = self._simulation.now, self.belief.rooms()
        said = self._said()
        likely = max(rooms, key=lambda room: rooms[room])
        goal = self._home.rooms[self._home.room[cell]]
        self._note(now - self.began, f'to {goal}; most probable is {likely} with '
                   f'{100 * rooms[likely]:.0f} %' + (f'; last: {said}' if said else ''))
        self.goals.append((now, cell))

    def _said(self) -> str:
        """The last ambient sensor that detected the person, and when."""
        if not self._ambient or not self._ambient.last:
            return ''
        name, time = self._ambient.last
        return f'{name} at {time - self.began:.0f} s'

    def _do(self, action: Action) -> bool:
        """Does an action of a way; whether to continue with the next."""
        if isinstance(action, Drive) or self._sighting is None or self._in_lift():
            return self._driver.do(action) and self._simulation.now < self.limit
        return False

    def _in_lift(self) -> bool:
        lift = self._route.elevator
        pose = self._driver.pose
        return lift is not None and math.dist((pose.x, pose.y), lift.cabin) < 1.0

    def _actions(self, cell: int) -> list[Action]:
        """All steps that lead to a cell; open doors remain open."""
        home, floor, pose = self._home, self._driver.floor, self._driver.pose
        here = self._planners[floor].nearest((pose.x, pose.y), 0.5)
        if here is None:
            raise Failure('the robot is at a place where it does not fit')
        goal = Waypoint(home.rooms[home.room[cell]], int(home.floor[cell]), home.point(cell), 0)
        shut: dict[int, list[Door]] = {
            number: [door for door in doors
                     if not self._simulation.door(door.name).has_done('Open')]
            for number, doors in home.doors.items()}
        router = Router(replace(self._route, waypoints=[goal]), self._planners, shut)
        return [action for action in router.actions(here, floor)
                if not (isinstance(action, Turn) and not action.open)]

    # --- something that may be him

    def _examine(self) -> None:
        """Faces a thing until it has moved, the camera sees a person, or it is neither."""
        end = self._simulation.now + EXAMINES
        self._note(self._simulation.now - self.began, 'sees something that the map has not')
        self._simulation.request_depth(True)
        try:
            while self._sighting is not None and self._simulation.now < min(end, self.limit):
                sighting = self._sighting
                self._driver.cycle(self._back_from(sighting.latest),
                                   self._turn_to(sighting.latest))
                if self._sighting is sighting and self._is_person(sighting):
                    return
            if self._sighting is not None:
                pose = self._driver.pose
                self._known.append((self._simulation.now, self._driver.floor,
                                    self._sighting.latest.at, (pose.x, pose.y)))
                self._sighting = None
        finally:
            self._simulation.request_depth(False)
            self._driver.cycle()

    def _back_from(self, arc: Arc) -> float:
        """Its speed: backwards where the thing is too near for the camera, as far as it has room.
        """
        pose = self._driver.pose
        behind = (pose.x - BEHIND * math.cos(pose.yaw), pose.y - BEHIND * math.sin(pose.yaw))
        near = np.hypot(*(self._foreign - behind).T) if len(self._foreign) else np.array([np.inf])
        free = self._planners[self._driver.floor].is_free(behind) and near.min() > IN_WAY
        return -BACK_SPEED if arc.far < CAMERA_NEEDS and free else 0.0

    def _turn_to(self, arc: Arc) -> float:
        pose = self._driver.pose
        error = wrapped(math.atan2(arc.y - pose.y, arc.x - pose.x) - pose.yaw)
        return max(-TURN, min(TURN, 2.0 * error)) if abs(error) > 0.05 else 0.0

    def _is_person(self, sighting: Sighting) -> bool:
        arc = sighting.latest
        if sighting.seen < self._simulation.now - CYCLE / 2:
            return False
        how = ''
        if sighting.count >= SIGHTINGS and sighting.moved > MOVES:
            how = f'it moved by {sighting.moved:.1f} m'
        depth = self._simulation.depth()
        if not how and depth is not None and sighting.count >= 3:
            figure: Figure | None = find_figure(depth, self._camera(), self._driver.pose, arc)
            how = f'the camera sees {figure.top:.1f} m of a figure' if figure else ''
        if not how:
            return False
        said = self._said()
        floor = self._driver.floor
        room = self._home.room_at(arc.x, arc.y, floor)
        self.found = Found(self._simulation.now - self.began, arc.x, arc.y, floor, room,
                           f'an arc of {arc.radius:.2f} m at {arc.far:.1f} m in the scan, and '
                           + how + (f'; led by {said}' if said else ''))
        return True

    def _camera(self) -> tuple[float, float, float]:
        """The place of the depth camera on the robot: m ahead, left, and above the floor."""
        start = self._home.start
        camera = next(e for e in self._home.entities
                      if (e.kind, e.model) == ('depth', start.robot.model))
        there = start.robot.flat.inverse().then(camera.flat)
        return there.x, there.y, camera.pose[2] - self._home.maps[start.floor].height
