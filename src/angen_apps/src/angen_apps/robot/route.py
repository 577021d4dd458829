"""Turns a route's waypoints into actions of the robot: drive, have doors turned, ride."""
from dataclasses import dataclass

from angen_apps.robot.planner import Door, NoRoom, Planner, Point, passages
from angen_apps.robot.route_file import Lift, Route, Waypoint


@dataclass(frozen=True)
class Drive:
    """Along these points, stopping at the last; `name` is set where that is a waypoint."""

    points: list[Point]
    floor: int
    name: str = ''


@dataclass(frozen=True)
class Turn:
    """Have a door opened or shut, and wait until it is."""

    door: str
    open: bool


@dataclass(frozen=True)
class Ride:
    """Have the elevator come, or carry the robot, and wait until it is open at the floor."""

    floor: int
    aboard: bool


Action = Drive | Turn | Ride


class Router:
    """Makes a route's actions over the floors' maps (with doors open) and their doors."""

    def __init__(self, route: Route, planners: dict[int, Planner], doors: dict[int, list[Door]]
                 ) -> None:
        self._route, self._planners, self._doors = route, planners, doors

    def actions(self, start: Point, floor: int) -> list[Action]:
        """All from start; Failure names the first waypoint that cannot be reached, and its line."""
        found: list[Action] = []
        here = start
        for goal in self._route.waypoints:
            if goal.floor not in self._planners:
                known = ', '.join(str(known) for known in self._planners)
                raise self._route.wrong(goal, f'there is no floor {goal.floor}; known are {known}')
            if not self._planners[goal.floor].is_free(goal.at):
                raise self._route.wrong(
                    goal, f'the robot cannot be at {goal.at[0]:g}, {goal.at[1]:g} on floor '
                    f'{goal.floor}: no floor there, or something nearer than '
                    f'{self._route.clearance:g} m')
            if goal.floor != floor:
                lift = self._lift(goal)
                found += self._leg(goal, here, lift.landing, floor)
                found.append(Ride(floor, False))
                found += self._leg(goal, lift.landing, lift.cabin, floor)
                found.append(Ride(goal.floor, True))
                floor, here = goal.floor, lift.cabin
            found += self._leg(goal, here, goal.at, floor, goal.name)
            here = goal.at
        return found

    def _lift(self, goal: Waypoint) -> Lift:
        if self._route.elevator is None:
            raise self._route.wrong(goal, f'is on floor {goal.floor}, and the route names no '
                                    'elevator')
        return self._route.elevator

    def _leg(self, goal: Waypoint, start: Point, end: Point, floor: int, name: str = ''
             ) -> list[Action]:
        way = self._planners[floor].way(start, end)
        if way is None:
            raise self._route.wrong(
                goal, f'no way leads from {start[0]:g}, {start[1]:g} to {end[0]:g}, {end[1]:g} on '
                f'floor {floor} that keeps {self._route.clearance:g} m from everything')
        try:
            found = passages(way, self._doors.get(floor, []), self._route.door_room)
        except NoRoom as error:
            raise self._route.wrong(goal, f'the way begins or ends {error}') from None
        actions: list[Action] = []
        done = 0
        stops = sorted([(p.before, 1, p.door.name) for p in found] +
                       [(p.after, 0, p.door.name) for p in found])
        for index, opens, door in stops:
            if index > done:
                actions.append(Drive(way[done:index + 1], floor))
                done = index
            actions.append(Turn(door, bool(opens)))
        actions.append(Drive(way[done:], floor, name))
        return actions
