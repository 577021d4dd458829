"""A drive to a goal: where it is blocked, the robot finds its pose and plans again."""
import math
from dataclasses import replace
from typing import Callable, Mapping

import numpy as np
from angen import Grid

from angen_apps.go.guard import Guard
from angen_apps.maps.cells import cell_of
from angen_apps.maps.gridmap import OCCUPIED
from angen_apps.robot.building import Start, Survey
from angen_apps.robot.driver import Driver, Stuck
from angen_apps.robot.interface import CYCLE, Robot
from angen_apps.robot.planner import Door, Planner, Point
from angen_apps.robot.route import Action, Drive, Router
from angen_apps.robot.route_file import Lift, Route, Waypoint
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import length

TRIES = 10
WAIT = 5.0  # s before a further try
AROUND = 3.0  # m around the robot: things that it sees there are in the way
YIELDS, ROOM = 1.5, 0.5  # m that it drives out of the way at most; farther from things it sees
ASIDE = 0.6  # m from the robot to the next place that is free
BESIDE_THINGS = 0.4  # m: about the width of a person
MISSED = 0.15  # m from the goal

Goal = Callable[[Mapping[int, Planner]], Waypoint]


class Held(Failure):
    """The robot is blocked, or finds no way."""


class Trip:
    """`goal` names it by the free place; `lift` is the elevator that it enters on a floor; `note`
    takes a line for the user; `watch` the share of the actions that is done, and the present one.
    """

    def __init__(self, robot: Robot, route: Route, survey: Survey, start: Start, goal: Goal,
                 lift: Callable[[int, Planner], Lift | None], note: Callable[[str], None],
                 watch: Callable[[float, str], None]) -> None:
        self._robot, self._route, self._survey = robot, route, survey
        self._goal, self._lift, self._note = goal, lift, note
        self._planners = {number: Planner(grid, route.clearance)
                          for number, grid in survey.maps.items()}
        self._guard = Guard(route.clearance)
        self._share = 0.0
        self._driver = Driver(robot, route, survey.landmarks, start.mount,
                              lambda: watch(self._share, self._driver.text),
                              self._guard.may_go, self._guard.give_up)
        self._guard.driver = self._driver
        self._start = start
        self.done: list[Action] = []
        self.tries = 0

    def run(self) -> Waypoint:
        """Drives to the goal, which it returns; Failure after the last try."""
        start = self._start
        goal, actions = self.plan((start.pose.x, start.pose.y), start.floor)
        self._driver.begin(start.pose, start.floor)
        problem = Failure()
        for self.tries in range(1, TRIES + 1):
            try:
                if self.tries > 1:
                    goal, actions = self._recover()
                self._do(actions)
                self._check(goal)
                return goal
            except (Held, Stuck) as held:
                problem = held
                self._note(f'{problem}' + ('; stops, waits, and plans its way again'
                                           if self.tries < TRIES else ''))
        raise Failure(f'{problem}; gave up after {TRIES} tries')

    def plan(self, at: Point, floor: int, foreign: np.ndarray | None = None
             ) -> tuple[Waypoint, list[Action]]:
        """The goal and the actions from a place, around obstacles that are `foreign` to the map."""
        planners, doors = dict(self._planners), dict(self._survey.doors)
        if foreign is not None and len(foreign):
            grid = with_points(self._survey.maps[floor], foreign)
            planners[floor] = Planner(grid, self._route.clearance)
        free = planners[floor].nearest(at, ASIDE)
        if free is None:
            raise Failure(f'the robot finds no free floor around {at[0]:.2f}, {at[1]:.2f}')
        doors[floor] = [door for door in doors[floor] if not self._holds_open(door, free)]
        goal = self._goal_beside(planners, floor) if planners[floor] is not self._planners[floor] \
            else self._goal(planners)
        route = replace(self._route, elevator=self._lift(floor, planners[floor]),
                        waypoints=[goal])
        actions = Router(route, planners, doors).actions(free, floor)
        self._driver.route = route
        return goal, actions

    def _goal_beside(self, planners: dict[int, Planner], floor: int) -> Waypoint:
        """The goal with room to things that the robot sees: it saw one side of a person only."""
        wide = Planner(planners[floor].grid, self._route.clearance + BESIDE_THINGS)
        try:
            return self._goal({**planners, floor: wide})
        except Failure:  # there is no such place
            return self._goal(planners)

    def _holds_open(self, door: Door, at: Point) -> bool:
        """Whether the robot is in the swing of a door that is open: it drives on through it."""
        return (self.tries > 0 and door.room_for(at) < self._route.door_room
                and self._robot.door(door.name).has_done('Open'))

    def _do(self, actions: list[Action]) -> None:
        for number, action in enumerate(actions):
            self._share = number / len(actions)
            self._guard.begin()
            if not self._driver.do(action):
                raise Held(f'{self._guard.reason} on floor {self._driver.floor}')
            self.done.append(action)

    def _check(self, goal: Waypoint) -> None:
        """Raises Held if it is not at the goal."""
        if not self._driver.localize():
            raise Held('the robot does not know where it is')
        pose = self._driver.pose
        away = math.dist((pose.x, pose.y), goal.at)
        if away > MISSED:
            raise Held(f'the robot is {away:.2f} m from its goal')

    def _recover(self) -> tuple[Waypoint, list[Action]]:
        """The goal and a new plan from the robot's place; Held if there is none yet."""
        driver = self._driver
        driver.text = 'waits'
        for _ in range(int(WAIT / CYCLE)):
            driver.cycle()
        if not driver.localize():
            raise Held('the robot does not know where it is')
        at = driver.pose.x, driver.pose.y
        foreign = driver.foreign
        foreign = foreign[np.hypot(*(foreign - at).T) < AROUND]
        try:
            return self.plan(at, driver.floor, foreign)
        except Failure as problem:
            self._yield_to(foreign)
            raise Held(str(problem)) from None

    def _yield_to(self, foreign: np.ndarray) -> None:
        """Drives away from things that it sees: a person may wait for the robot to leave."""
        floor, at = self._driver.floor, (self._driver.pose.x, self._driver.pose.y)
        grid = self._survey.maps[floor]
        planner = Planner(with_points(grid, foreign), self._route.clearance)
        start = planner.nearest(at, ASIDE)
        if start is None or not len(foreign):
            return
        places = np.argwhere(planner.costs(start) < YIELDS)
        points = np.array([grid.point(int(row), int(column)) for row, column in places])
        gaps = np.hypot(*(points[:, None] - foreign).transpose(2, 0, 1)).min(axis=1)
        best = int(gaps.argmax())
        here = float(np.hypot(*(foreign - start).T).min())
        way = planner.way(start, (float(points[best, 0]), float(points[best, 1])))
        if way is None or gaps[best] < here + ROOM or crosses(way, self._survey.doors[floor]):
            return
        self._guard.begin()
        self._driver.do(Drive(way, floor))

    @property
    def distance(self) -> float:
        """Meters that the wheels have driven."""
        return length(self._driver.track.odometry)


def crosses(way: list[Point], doors: list[Door]) -> bool:
    """Whether a way leads through a door."""
    return any(door.crosses(a, b) for a, b in zip(way, way[1:]) for door in doors)


def with_points(grid: Grid, points: np.ndarray) -> Grid:
    """A map on which the cells at points (n, 2) are occupied."""
    cells = grid.cells.copy()
    for x, y in points:
        cell = cell_of(grid, (x, y))
        if cell is not None:
            cells[cell] = OCCUPIED
    return grid.with_cells(cells)
