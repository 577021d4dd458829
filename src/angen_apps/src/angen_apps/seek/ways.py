"""The times of the robot to the viewpoints: ways, doors, and the elevator."""
from collections import deque
from typing import Mapping

import numpy as np

from angen_apps.robot.planner import Planner, Point
from angen_apps.robot.route_file import Route
from angen_apps.seek.home import Home

DOOR_TIME, LIFT_TIME = 5.0, 25.0  # s


class Ways:
    """The ways of a home for one robot."""

    def __init__(self, home: Home, route: Route, planners: Mapping[int, Planner]) -> None:
        self._home, self._route, self._planners = home, route, planners
        self._lift_costs: dict[int, np.ndarray] = {}
        self._beside: dict[int, set[tuple[int, str]]] = {}  # rooms and doors to them, by room
        for (a, b), door in zip(home.edges, home.edge_door):
            one, other = int(home.room[a]), int(home.room[b])
            if one != other:
                self._beside.setdefault(one, set()).add((other, door))
                self._beside.setdefault(other, set()).add((one, door))
        self._views: dict[int, tuple[np.ndarray, np.ndarray, np.ndarray]] = {}  # by floor: which
        for floor, planner in planners.items():  # viewpoints, and the rows and columns of these
            numbers = np.nonzero(home.floor[home.viewpoints] == floor)[0]
            cells = np.array([planner.grid.cell(*home.point(int(home.viewpoints[k])))
                              for k in numbers]).reshape(-1, 2)
            self._views[floor] = numbers, cells[:, 0], cells[:, 1]

    def times(self, at: Point, floor: int, shut: set[str]) -> np.ndarray:
        """Seconds to each viewpoint, infinite if there is no way; `shut`: names of doors."""
        home = self._home
        found = np.full(len(home.viewpoints), np.inf)
        here = self._planners[floor].nearest(at, 0.5)
        if here is None:
            return found
        costs = self._planners[floor].costs(here)
        between = self._doors_between(int(home.room[home.cell_at(*at, floor)]), shut)
        self._add(found, costs, 0.0, floor, between)
        lift = self._route.elevator
        if lift is not None:
            doors = between[home.room[home.cell_at(*lift.landing, floor)]]
            ready = (self._cost_at(costs, floor, lift.landing) / self._route.speed + LIFT_TIME
                     + DOOR_TIME * float(doors))
            for other in self._planners:
                if other != floor:
                    landing = int(home.room[home.cell_at(*lift.landing, other)])
                    self._add(found, self._costs_from_lift(other, lift.landing), ready, other,
                              self._doors_between(landing, shut))
        return found

    def _doors_between(self, room: int, shut: set[str]) -> np.ndarray:
        """The least number of shut doors between a room and each room of its floor."""
        count = np.full(len(self._home.rooms), 99)
        count[room] = 0
        waiting = deque([room])
        while waiting:
            here = waiting.popleft()
            for there, door in self._beside.get(here, ()):
                more = count[here] + (door in shut)
                if more < count[there]:
                    count[there] = more
                    waiting.append(there)
        return count

    def _costs_from_lift(self, floor: int, landing: Point) -> np.ndarray:
        if floor not in self._lift_costs:
            self._lift_costs[floor] = self._planners[floor].costs(landing)
        return self._lift_costs[floor]

    def _add(self, times: np.ndarray, costs: np.ndarray, ready: float, floor: int,
             doors: np.ndarray) -> None:
        numbers, rows, columns = self._views[floor]
        rooms = self._home.room[self._home.viewpoints[numbers]]
        times[numbers] = (ready + costs[rows, columns] / self._route.speed
                          + DOOR_TIME * doors[rooms])

    def _cost_at(self, costs: np.ndarray, floor: int, point: Point) -> float:
        row, column = self._planners[floor].grid.cell(*point)
        return float(costs[row, column])
