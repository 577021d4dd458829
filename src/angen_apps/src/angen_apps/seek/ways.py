"""How long the robot takes to the viewpoints: ways, doors, and the elevator."""
from __future__ import annotations

from typing import Mapping

import numpy as np

from angen_apps.robot.planner import Planner, Point
from angen_apps.robot.route_file import Route
from angen_apps.seek.home import Home, doors_between

DOOR_TIME, LIFT_TIME = 5.0, 25.0  # s


class Ways:
    """The ways of a home for one robot."""

    def __init__(self, home: Home, route: Route, planners: Mapping[int, Planner]) -> None:
        self._home, self._route, self._planners = home, route, planners
        self._lift_costs: dict[int, np.ndarray] = {}

    def times(self, at: Point, floor: int, shut: set[str]) -> np.ndarray:
        """Seconds to each viewpoint, infinite where there is no way; `shut`: names of doors."""
        home = self._home
        found = np.full(len(home.viewpoints), np.inf)
        here = self._planners[floor].nearest(at, 0.5)
        if here is None:
            return found
        costs = self._planners[floor].costs(here)
        room = int(home.room[home.cell_at(*at, floor)])
        self._add(found, costs, 0.0, floor, doors_between(home, room, shut))
        lift = self._route.elevator
        if lift is not None:
            doors = doors_between(home, room, shut)[
                home.room[home.cell_at(*lift.landing, floor)]]
            ready = (self._cost_at(costs, floor, lift.landing) / self._route.speed + LIFT_TIME
                     + DOOR_TIME * float(doors))
            for other in self._planners:
                if other != floor:
                    landing = int(home.room[home.cell_at(*lift.landing, other)])
                    self._add(found, self._costs_from_lift(other, lift.landing), ready, other,
                              doors_between(home, landing, shut))
        return found

    def _costs_from_lift(self, floor: int, landing: Point) -> np.ndarray:
        if floor not in self._lift_costs:
            self._lift_costs[floor] = self._planners[floor].costs(landing)
        return self._lift_costs[floor]

    def _add(self, times: np.ndarray, costs: np.ndarray, ready: float, floor: int,
             doors: np.ndarray) -> None:
        home = self._home
        for k, cell in enumerate(home.viewpoints):
            if home.floor[cell] == floor:
                way = self._cost_at(costs, floor, home.point(cell))
                times[k] = ready + way / self._route.speed + DOOR_TIME * doors[home.room[cell]]

    def _cost_at(self, costs: np.ndarray, floor: int, point: Point) -> float:
        row, column = self._planners[floor].grid.cell(*point)
        return float(costs[row, column])
