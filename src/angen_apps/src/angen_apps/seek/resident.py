"""The person who walks about: a random itinerary, and what he does on the way with doors, lamps and
the elevator. He knows what he sees: where he is, and where the robot is when it is near him."""
from __future__ import annotations

import math
import random
from dataclasses import dataclass, replace

import numpy as np
from lxml import etree

from angen_apps.maps.gridmap import OCCUPIED, GridMap
from angen_apps.robot.planner import Door, Planner, Point
from angen_apps.robot.route import Action, Drive, Ride, Router, Turn
from angen_apps.robot.route_file import Route, Waypoint
from angen_apps.seek.home import BODY, Home
from angen_apps.seek.simulation import Simulation
from angen_tools.common.failure import Failure

SPEED = 0.8  # m/s
STAYS = (10.0, 90.0)  # s at a place
PAUSE = 1.0  # s that his path pauses where he may have to wait
STRIDE = 4  # points of a way, a square of the map apart, between two of his path
THERE = 0.15  # m
CLOSES = 0.6  # probability that he closes a door behind him
LIGHTS = 0.8  # that he switches the lamp on where he stays
OTHER_FLOOR = 0.2  # that the next place is on the other floor
ROBOT = 0.25  # m around the robot's middle
ROBOT_IN_WAY, BESIDE = 0.9, 0.45  # m ahead and aside, from middle to middle
DOOR_ROOM = 0.45  # m from his middle to where a leaf swings
LIFT_ROOM = 1.6  # m around the middle of the cabin, and its landing, where the robot uses it


@dataclass(frozen=True)
class Gate:
    """A place on his path where he stops, until what he does there is done."""

    at: Point
    floor: int
    action: Turn | Ride | None  # None: he stays
    stays: float = 0.0
    room: str = ''


@dataclass(frozen=True)
class Itinerary:
    """A path with times, and the gates on it, in order."""

    waypoints: list[tuple[float, float, float]]  # t (s), x, y
    gates: list[Gate]

    @property
    def start(self) -> tuple[float, float, int]:
        return self.waypoints[0][1], self.waypoints[0][2], self.gates[0].floor


def plan_walk(home: Home, route: Route, seed: int, seconds: float) -> Itinerary:
    """An itinerary of at least that many seconds of walking and staying."""
    chance = random.Random(f'resident {seed}')
    planners = {floor: Planner(_without_robot(home, grid), BODY)
                for floor, grid in home.walkable.items()}
    places = [i for i in range(len(home.at)) if _can_stay(home, i, route)
              and (route.elevator or home.floor[i] == home.start.floor)]
    if not places:
        raise Failure('the building has no free place for a person')
    here = _choose(home, places, chance, None, route)
    (x, y), floor = home.point(here), int(home.floor[here])
    waypoints, gates = [(0.0, x, y)], [_stay(home, here, chance)]
    time, spent, tries = PAUSE, gates[0].stays, 0
    waypoints.append((time, x, y))
    while spent + time < seconds and tries < 200:
        tries += 1
        there = _choose(home, places, chance, here, route)
        goal = Waypoint('', int(home.floor[there]), home.point(there), 0)
        try:
            actions = Router(replace(route, waypoints=[goal], clearance=BODY, door_room=DOOR_ROOM),
                             planners, home.doors).actions((x, y), floor)
        except Failure:
            continue  # no way for a person, or it begins or ends at a leaf
        for action in actions:
            time, floor = _add(action, waypoints, gates, time, floor)
        gates.append(_stay(home, there, chance))
        spent += gates[-1].stays
        here = there
        x, y = goal.at
        time += PAUSE
        waypoints.append((time, x, y))
    return Itinerary(waypoints, gates)


def _without_robot(home: Home, grid: GridMap) -> GridMap:
    """The map without the robot's place at the start: he walks around it."""
    if grid.floor != home.start.floor:
        return grid
    cells = grid.cells.copy()
    y, x = np.indices(cells.shape) * grid.resolution
    away = np.hypot(x + grid.origin[0] - home.start.pose.x, y + grid.origin[1] - home.start.pose.y)
    cells[away < ROBOT] = OCCUPIED
    return replace(grid, cells=cells)


def _can_stay(home: Home, cell: int, route: Route) -> bool:
    point = home.point(cell)
    if any(door.room_for(point) < DOOR_ROOM for door in home.doors[int(home.floor[cell])]):
        return False
    return not (route.elevator and math.dist(point, route.elevator.cabin) < LIFT_ROOM)


def _choose(home: Home, places: list[int], chance: random.Random, here: int | None, route: Route
            ) -> int:
    """A place in another room, on the same floor mostly."""
    if here is None:  # not where the robot starts
        start = home.start.pose
        here = home.cell_at(start.x, start.y, home.start.floor)
        places = [i for i in places if home.room[i] != home.room[here]] or places
    else:
        other = route.elevator is not None and chance.random() < OTHER_FLOOR
        chosen = [i for i in places if (home.floor[i] != home.floor[here]) == other
                  and home.room[i] != home.room[here]]
        places = chosen or places
    room = chance.choice(sorted({int(home.room[i]) for i in places}))
    return chance.choice([i for i in places if home.room[i] == room])


def _stay(home: Home, cell: int, chance: random.Random) -> Gate:
    return Gate(home.point(cell), int(home.floor[cell]), None,
                chance.uniform(*STAYS), home.rooms[home.room[cell]])


def _add(action: Action, waypoints: list[tuple[float, float, float]], gates: list[Gate],
         time: float, floor: int) -> tuple[float, int]:
    """Adds an action of a way to a path; the time and floor after it."""
    _, x, y = waypoints[-1]
    if isinstance(action, Drive):
        for point in action.points[STRIDE:-1:STRIDE] + action.points[-1:]:
            far = math.dist((x, y), point)
            if far > 0.02:
                time += far / SPEED
                x, y = point
                waypoints.append((time, x, y))
        return time, floor
    gates.append(Gate((x, y), floor, action))
    time += PAUSE
    waypoints.append((time, x, y))
    return time, action.floor if isinstance(action, Ride) and action.aboard else floor


def add_actor(root: etree._Element, name: str, itinerary: Itinerary, home: Home) -> None:
    """Adds the person to a world's SDF."""
    x, y, floor = itinerary.start
    actor = etree.SubElement(root.find('world'), 'actor', name=name)
    etree.SubElement(actor, 'pose').text = f'0 0 {home.maps[floor].height:g} 0 0 0'
    script = etree.SubElement(actor, 'script')
    etree.SubElement(script, 'loop').text = 'false'
    trajectory = etree.SubElement(script, 'trajectory', id='0', type='walk')
    for t, x, y in itinerary.waypoints:
        waypoint = etree.SubElement(trajectory, 'waypoint')
        etree.SubElement(waypoint, 'time').text = f'{t:.3f}'
        etree.SubElement(waypoint, 'pose').text = f'{x:.4f} {y:.4f} 0 0 0 0'


class Resident:
    """Follows the itinerary, gate by gate."""

    def __init__(self, simulation: Simulation, home: Home, route: Route, name: str,
                 itinerary: Itinerary, seed: int) -> None:
        self._simulation, self._home, self._route, self._name = simulation, home, route, name
        self._gates = itinerary.gates
        self._chance = random.Random(f'habits {seed}')
        self._doors: dict[str, Door] = {door.name: door for _, door in home.all_doors()}
        self._lamps = set(simulation.world.devices('lamp'))
        self._next = 0
        self._since: float | None = None  # s: when he came to the next gate
        self._stopped = False
        self._lit = ''

    def act(self) -> None:
        """His actions before each cycle."""
        x, y, z, yaw = self._simulation.place(f'{self._name}::body')
        robot = self._simulation.truth()
        if self._next < len(self._gates) and self._at(self._gates[self._next], x, y, z):
            self._wait_at(self._gates[self._next], robot)
        else:
            self._stop(self._robot_in_way((x, y, z, yaw), robot))

    def _at(self, gate: Gate, x: float, y: float, z: float) -> bool:
        if self._since is not None:
            return True
        return math.dist((x, y), gate.at) < THERE and self._floor(z) == gate.floor

    def _floor(self, z: float) -> int:
        return self._home.described.storey_at(z)

    def _stop(self, stop: bool) -> None:
        if stop != self._stopped:
            self._simulation.order('person', self._name, 'Stop' if stop else 'Go')
            self._stopped = stop

    def _wait_at(self, gate: Gate, robot: tuple[float, ...]) -> None:
        now = self._simulation.now
        if self._since is None:
            self._since = now
            self._stop(True)
            self._light(gate)
        if self._done(gate, now - self._since, robot):
            self._next += 1
            self._since = None
            self._stop(False)

    def _light(self, gate: Gate) -> None:
        """He switches on the lamp of the room where he stays, and off that where he was."""
        if gate.action is not None or gate.room == self._lit:
            return
        if self._lit:
            self._simulation.order('lamp', self._lit, 'Off')
        self._lit = ''
        if gate.room in self._lamps and self._chance.random() < LIGHTS:
            self._simulation.order('lamp', gate.room, 'On')
            self._lit = gate.room

    def _done(self, gate: Gate, waited: float, robot: tuple[float, ...]) -> bool:
        if gate.action is None:
            return waited >= gate.stays
        if isinstance(gate.action, Turn):
            return self._turned(gate.action, robot, waited)
        return self._ridden(gate.action, robot)

    def _turned(self, turn: Turn, robot: tuple[float, ...], waited: float) -> bool:
        mode = self._simulation.door(turn.door).mode
        if turn.open and mode == 'OPEN':
            return True
        door = self._doors[turn.door]
        here = self._simulation.place(f'{self._name}::body')[2]
        clear = (self._floor(robot[2]) != self._floor(here)
                 or door.room_for((robot[0], robot[1])) > 2 * BODY)
        if not turn.open:  # he walks on while it closes
            if clear and mode == 'OPEN' and self._chance.random() < CLOSES:
                self._simulation.order('door', turn.door, 'Close')
            return True
        if clear and mode in ('CLOSED', 'AJAR', 'CLOSING'):
            self._simulation.order('door', turn.door, 'Open')
        return False

    def _ridden(self, ride: Ride, robot: tuple[float, ...]) -> bool:
        lift = self._route.elevator
        assert lift is not None
        state = self._simulation.lift(lift.name)
        busy = min(math.dist(robot[:2], lift.cabin), math.dist(robot[:2], lift.landing)) < LIFT_ROOM
        if busy:
            return False
        if state.stands_open(ride.floor, self._home.maps[ride.floor].height):
            return True
        if state.mode == 'IDLE' and state.door_mode == 'OPEN':
            self._simulation.order('elevator', lift.name, f'Floor{ride.floor}')
        return False

    def _robot_in_way(self, me: tuple[float, ...], robot: tuple[float, ...]) -> bool:
        """Whether he stops for the robot: it is near, and ahead of him."""
        x, y, z, yaw = me
        dx, dy = robot[0] - x, robot[1] - y
        ahead = math.cos(yaw) * dx + math.sin(yaw) * dy
        aside = math.cos(yaw) * dy - math.sin(yaw) * dx
        return (self._floor(z) == self._floor(robot[2]) and 0 < ahead < ROBOT_IN_WAY
                and abs(aside) < BESIDE)
