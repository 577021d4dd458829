"""A route through the rooms of any home, and the home with a robot and a person in it."""
import os
import sys
from dataclasses import replace
from math import hypot
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree

from angen_apps.maps.gridmap import load_world
from angen_apps.plan.polygons import inside
from angen_apps.robot.building import Survey
from angen_apps.robot.entities import Entity, entities_of
from angen_apps.robot.planner import Planner, Point, distances
from angen_apps.robot.route_file import Lift, Route, Waypoint, default_route, read_route
from angen_apps.robot.tour import in_order
from angen_tools.common.failure import Failure
from angen_tools.common.files import make_folder, write_text
from angen_tools.common.geometry import turned
from angen_tools.common.home import Home, Room
from angen_tools.session.in_process import InProcess
from angen_tools.world import sdf
from angen_tools.world.models import building

INSIDE = 1.0  # m from the main entrance to where the robot starts
REACH = 2.0  # m around that
CENTRAL = 0.6  # m from everything that is far enough
OUTSIDE = ('outdoor',)


def prepare(route_file: Path | None, world: Path | None, out: Path, visits: bool = True
            ) -> tuple[Route, Path, Survey | None]:
    """The route and the world of a task, or the default ones. Makes the folder `out`, and lets the
    world include the models beside it. In another world the default route visits its rooms, and
    the robot and the person that are missing are added; without `visits` only that. The survey is
    that of the world where this took one."""
    route = read_route(route_file or default_route())
    other = route_file is None and world is not None and world.resolve() != building().resolve()
    world = (world or building()).absolute()
    make_folder(out)
    paths = [str(world.parent / 'models'), os.environ.get('ANGEN_MODEL_PATH', '')]
    os.environ['ANGEN_MODEL_PATH'] = ':'.join(path for path in paths if path)
    if other and (visits or not has_all(world, route)):
        return by_rooms(route, world, out / 'home.world')
    return route, world, None


def has_all(world: Path, route: Route) -> bool:
    """Whether a world has the route's robot and a person."""
    robots = [e for e in load_world(str(world)).entities() if e[:2] == ('drive', route.robot)]
    return bool(robots) and sdf.read(world).find('.//actor') is not None


def by_rooms(route: Route, world: Path, to: Path) -> tuple[Route, Path, Survey]:
    """The route with a waypoint in each room that the robot reaches, and the world; with a robot
    at the main entrance and a person in the last room in `to`, where the world has none."""
    shut = load_world(str(world))
    entities = entities_of(InProcess(shut))
    survey = Survey(load_world(str(world)), shut, but=_kept_shut(shut, entities, route))
    planners = {floor: Planner(grid, route.clearance) for floor, grid in survey.maps.items()}
    start, floor, heading = _start(route, survey, planners, entities, world)
    lift = lift_of(survey.home, planners[floor], floor)
    waypoints = _visits(route, survey, planners, start, floor, lift)
    if not waypoints:
        raise Failure(f'{world}: the robot reaches no room from {start[0]:.2f}, {start[1]:.2f}')
    made = replace(route, waypoints=waypoints, elevator=lift if any(
        waypoint.floor != floor for waypoint in waypoints) else None)
    return made, _peopled(made, survey, entities, (start, floor, heading), world, to), survey


def _kept_shut(world: Any, entities: list[Entity], route: Route) -> set[str]:
    """The leaves of the main entrance, for a robot that is inside: open they may fill a hall."""
    home = Home.of_world(world)
    at = next((e for e in entities if (e.kind, e.name) == ('drive', route.robot)), None)
    if at is not None:
        room = home.room_at(at.pose[0], at.pose[1], at.pose[2] + 0.1)
        if room is None or room.use in OUTSIDE:
            return set()
    return {name for door in home.doors if door.name == home.entrance
            for name in (door.name, door.partner) if name}


def _start(route: Route, survey: Survey, planners: dict[int, Planner], entities: list[Entity],
           world: Path) -> tuple[Point, int, float]:
    """The place of the robot, or one where it fits behind the main entrance: x, y, floor, yaw."""
    for entity in entities:
        if (entity.kind, entity.name) == ('drive', route.robot):
            return (entity.pose[0], entity.pose[1]), entity.floor, entity.flat.yaw
    home = survey.home
    door = next((door for door in home.doors if door.name == home.entrance), None)
    if door is None:
        raise Failure(f'{world}: has no robot {route.robot} and no main entrance, behind which '
                      'one could start; include model://turtlebot in it')
    room = next((room for room in map(home.room, door.rooms)
                 if room and room.use not in OUTSIDE), None)
    if room is None:
        raise Failure(f'{world}: the main entrance {home.entrance} leads into no room')
    x, y, _, yaw = door.pose
    behind = room
    sides = [turned((x, y), yaw, 0.0, side * INSIDE) for side in (-1, 1)]
    wish = min(sides, key=lambda point: (not behind.contains(*point), point))
    planner = planners[room.storey]
    place = _clear_of_doors(wish, survey, planner, room.storey, route)
    if place is None:
        raise Failure(f'{world}: the robot has no room within {REACH:g} m of the main entrance '
                      f'{home.entrance}')
    return place, room.storey, np.arctan2(wish[1] - y, wish[0] - x)


def _clear_of_doors(wish: Point, survey: Survey, planner: Planner, floor: int, route: Route
                    ) -> Point | None:
    rows, columns = np.nonzero(planner.passable)
    points = [planner.grid.point(int(r), int(c)) for r, c in zip(rows, columns)]
    near = sorted((hypot(p[0] - wish[0], p[1] - wish[1]), p) for p in points
                  if hypot(p[0] - wish[0], p[1] - wish[1]) < REACH)
    return next((p for _, p in near if _keeps_off(p, survey, floor, route)), None)


def _keeps_off(point: Point, survey: Survey, floor: int, route: Route) -> bool:
    return all(door.room_for(point) >= route.door_room for door in survey.doors[floor])


def lift_of(home: Home, planner: Planner, floor: int) -> Lift | None:
    """The first elevator that the robot can enter on its floor, and where it waits for it."""
    for elevator in home.elevators:
        landing = next((each for each in elevator.landings if each.storey == floor), None)
        if landing is None:
            continue
        cabin = planner.nearest((elevator.pose[0], elevator.pose[1]), 0.5)
        away = hypot(landing.pose[0] - elevator.pose[0], landing.pose[1] - elevator.pose[1]) or 1.0
        more = 1 + 0.6 / away  # m farther from the cabin: its doors need no room there
        before = planner.nearest(
            (elevator.pose[0] + (landing.pose[0] - elevator.pose[0]) * more,
             elevator.pose[1] + (landing.pose[1] - elevator.pose[1]) * more), 0.6)
        if cabin and before:
            return Lift(elevator.name, cabin, before)
    return None


def _visits(route: Route, survey: Survey, planners: dict[int, Planner], start: Point, floor: int,
            lift: Lift | None) -> list[Waypoint]:
    """A place in each room, in the order of a short way, floor by floor."""
    found: list[Waypoint] = []
    numbers = sorted(planners, key=lambda number: (number != floor, number))
    for number in numbers:
        rooms = [room for room in survey.home.rooms
                 if room.storey == number and room.use not in OUTSIDE]
        if number == floor:
            origin: Point | None = start
        else:
            origin = lift.cabin if lift and planners[number].is_free(lift.cabin) else None
        reached: list[Waypoint] = []
        places = _Places(planners[number], origin)
        for room in rooms:
            place = places.of(room, survey, number, route)
            if place is None:
                print(f'angen: the robot does not reach {room.name}', file=sys.stderr)
            else:
                reached.append(Waypoint(room.name, number, place, 0))
        if origin and reached:
            order = in_order(planners[number], origin, [waypoint.at for waypoint in reached])
            found += [reached[i] for i in order]
    return found


class _Places:
    """The places of a floor that the robot reaches, the most central first."""

    def __init__(self, planner: Planner, origin: Point | None) -> None:
        costs = planner.costs(origin) if origin else np.full(planner.passable.shape, np.inf)
        rows, columns = np.nonzero(planner.passable & np.isfinite(costs))
        clear = distances(planner.grid, CENTRAL)
        order = np.lexsort((costs[rows, columns], -clear[rows, columns]))
        self._at = np.array([planner.grid.point(row, column) for row, column in
                             zip(rows[order].tolist(), columns[order].tolist())]).reshape(-1, 2)

    def of(self, room: Room, survey: Survey, floor: int, route: Route) -> Point | None:
        """The first one in a room."""
        x, y = self._at.T
        for i in np.nonzero(inside(room.polygon, x, y, room.holes))[0]:
            point = (float(self._at[i, 0]), float(self._at[i, 1]))
            if _keeps_off(point, survey, floor, route):
                return point
        return None


def _peopled(route: Route, survey: Survey, entities: list[Entity],
             start: tuple[Point, int, float], world: Path, to: Path) -> Path:
    """The world, or a copy with the robot and the person that it lacks."""
    root = sdf.read(world)
    inside = root.find('world')
    (x, y), floor, yaw = start
    has_robot = any((e.kind, e.name) == ('drive', route.robot) for e in entities)
    has_person = root.find('.//actor') is not None
    if has_robot and has_person:
        return world
    if not has_robot:
        block = etree.SubElement(inside, 'include')
        etree.SubElement(block, 'name').text = route.robot
        etree.SubElement(block, 'pose').text = \
            f'{x:.4f} {y:.4f} {survey.home.elevation(floor):.4f} 0 0 {yaw:.4f}'
        etree.SubElement(block, 'uri').text = 'model://turtlebot'
    if not has_person:
        last = [waypoint for waypoint in route.waypoints if waypoint.floor == floor][-1]
        actor = etree.SubElement(inside, 'actor', name='person')
        trajectory = etree.SubElement(etree.SubElement(actor, 'script'), 'trajectory', id='0',
                                      type='walking')
        waypoint = etree.SubElement(trajectory, 'waypoint')
        etree.SubElement(waypoint, 'time').text = '0'
        etree.SubElement(waypoint, 'pose').text = \
            f'{last.at[0]:.4f} {last.at[1]:.4f} {survey.home.elevation(floor):.4f} 0 0 0'
    write_text(to, sdf.text(root))
    return to
