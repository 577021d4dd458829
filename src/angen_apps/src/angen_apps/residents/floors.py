"""Where people can stand in a home, by maps of its floors. Ways there are found by the people
themselves."""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from angen import Grid
from scipy.ndimage import label

from angen_apps.maps.gridmap import FREE, make_map
from angen_apps.plan.polygons import from_segment, inside
from angen_apps.residents.fronts import Fronts
from angen_apps.robot.doors import door_of
from angen_apps.robot.planner import Door as Leaf, Point, distances
from angen_tools.common.catalog import angen_module
from angen_tools.common.home import Door, Home, Place, Room

BODY = 0.3  # m: half the width of a person, with a margin
TALL = 1.9  # m: people pass below higher things
PORCH = 1.4  # m outside the entrance where people come and go
CLEAR = 1.05  # m from a door's middle: its leaf does not hit a person there
SWING = 1.25  # m from a door's middle: its leaf does not reach farther
DEEP = 0.35  # m to both sides of a door's middle that belong to its opening
JOINT = 0.03  # m beside a leaf, to the other one of a double door
REACH = 1.1  # m from a person to the thing that the person uses
OPENS_IN = 20.0  # s, at most
NARROWER = (0.28, 0.26, 0.24, 0.22, 0.2, 0.18, 0.16, 0.14, 0.12, 0.1, 0.08)  # m, instead of it
PASSES = 0.35  # m from a leaf to the middle of who gets past it


class Floors:
    """The floors of a home. `world` is one of its own, which loses people, robots and doors."""

    def __init__(self, world: Any, home: Home) -> None:
        self.home, self._world = home, world
        self.fronts = Fronts(world)
        entrance = self.entrance()
        lives = home.storey_at(entrance.pose[2]) if entrance else min(r.storey for r in home.rooms)
        self.leaves = _opened(world, home)
        self.barred: dict[str, float] = {}  # doors that nobody passes, and m that they leave
        self.free: dict[int, np.ndarray] = {}  # cells (rows, columns) where a person can stay
        self.grids = {storey: make_map(world, storey, 'away', TALL, margin=PORCH)
                      for storey in self._storeys(lives)}
        self.reached: set[str] = set()  # rooms that people get to
        for storey in self.grids:
            self._measure(storey)
        self._floors: dict[str, np.ndarray] = {}  # floors of rooms
        self._places: dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]] = {}  # _by_doors()

    def _storeys(self, lives: int) -> list[int]:
        """That of the main entrance, and those that elevators reach from there."""
        found = {lives}
        for lift in self.home.elevators:
            landings = {landing.storey for landing in lift.landings}
            if lives in landings:
                found |= landings
        return sorted(storey for storey in found
                      if any(room.storey == storey for room in self.home.rooms))

    def _measure(self, storey: int) -> None:
        """Finds where people can stay on a floor, and its rooms that they get to: past each open
        leaf, as they shut one that is in their way."""
        grid = self.grids[storey]
        x, y = np.meshgrid(grid.x, grid.y)
        rooms = [room for room in self.home.rooms if room.storey == storey]
        doors = [door for door in self.home.doors
                 if door.kind != 'window' and self.home.storey_at(door.pose[2]) == storey]
        within = np.zeros(x.shape, bool)
        for room in rooms:
            within |= inside(room.polygon, x, y)
        for door in doors:
            within |= _opening(x, y, door, PORCH if door.name == self.home.entrance else DEEP)
        within &= grid.cells == FREE
        clear = distances(grid, BODY)
        passable = within & (clear >= BODY)
        beside = np.ones(passable.shape, bool)
        for door in (door for door in doors if door.kind == 'door'):
            leaf = self.leaves.get(door.name)
            away = np.full(x.shape, BODY) if leaf is None else from_segment(
                x, y, leaf.hinge, leaf.tip(leaf.open))
            past = beside if leaf is None else away >= BODY
            if not _passes(door, passable & past, x, y):
                wide = np.minimum(clear, away)
                self.barred[door.name] = 2 * next(
                    (half for half in NARROWER if _passes(door, within & (wide >= half), x, y)),
                    0.0)
                passable &= ~_opening(x, y, door, DEEP)
            elif leaf is not None and not self._closes_off(leaf, passable, grid):
                beside = beside & past
        whole = largest(passable)
        self.free[storey] = largest(passable & beside)
        self.reached |= {room.name for room in rooms if (whole & inside(room.polygon, x, y)).any()}

    @staticmethod
    def _closes_off(leaf: Leaf, passable: np.ndarray, grid: Grid) -> bool:
        """Whether nobody gets past an open leaf to a place behind it: people always shut it."""
        (x0, y0), (x1, y1) = leaf.hinge, leaf.tip(leaf.open)
        share = 1 + PASSES / leaf.width
        beyond = x0 + share * (x1 - x0), y0 + share * (y1 - y0)
        behind = ((x0 + x1) / 2 - PASSES * math.cos(leaf.shut),
                  (y0 + y1) / 2 - PASSES * math.sin(leaf.shut))
        return bool(not passable[grid.cell(*beyond)] and passable[grid.cell(*behind)])

    def is_free(self, point: Point, storey: int) -> bool:
        """Whether a person can stay there."""
        row, column = self.grids[storey].cell(*point)
        rows, columns = self.free[storey].shape
        return (0 <= row < rows and 0 <= column < columns
                and bool(self.free[storey][row, column]))

    def around(self, point: Point, storey: int, *away: float) -> list[Point]:
        """Places that far (m) from one where people can stay."""
        places = [(point[0] + far * math.cos(k * math.pi / 8),
                   point[1] + far * math.sin(k * math.pi / 8)) for far in away for k in range(16)]
        return [place for place in places if self.is_free(place, storey)]

    def support(self, place: Place) -> float:
        """z of the surface under a sitting or lying person, m."""
        x, y, z, yaw = place.pose
        c, s = math.cos(yaw), math.sin(yaw)
        along = np.linspace(-0.7, 0.4, 12) if place.posture == 'lie' else np.linspace(-0.1, 0.1, 3)
        across = np.linspace(-0.15, 0.15, 4)
        offsets = np.array([(a, b) for a in along for b in across])
        origins = np.column_stack([x + c * offsets[:, 0] - s * offsets[:, 1],
                                   y + s * offsets[:, 0] + c * offsets[:, 1],
                                   np.full(len(offsets), z + 0.45)])
        down = np.broadcast_to([0.0, 0.0, -1.0], origins.shape)
        return float(z + 0.45 - self._world.cast(origins, down, 0.9).min())

    def room_name(self, x: float, y: float, storey: int) -> str:
        """The room at a place on the floor; '' outside."""
        room = self.home.room_at(x, y, self.home.elevation(storey) + 0.5)
        return room.name if room else ''

    def near(self, x: float, y: float, z: float, reach: float = REACH, leaf: Leaf | None = None
             ) -> Point | None:
        """The free place nearest to a point, on the floor of its room; out of the swing of a leaf
        if there is one."""
        room = self.home.room_at(x, y, z + 0.1)
        if room is None or room.storey not in self.grids:
            return None
        free, grid = self.floor_of(room), self.grids[room.storey]
        found = None
        if leaf is not None:
            away = np.hypot(grid.x - leaf.hinge[0], grid.y[:, None] - leaf.hinge[1])
            found = self._nearest(free & (away >= leaf.width + BODY), room.storey, (x, y), reach)
        return found or self._nearest(free, room.storey, (x, y), reach)

    def _nearest(self, free: np.ndarray, storey: int, point: Point, reach: float) -> Point | None:
        """The point, if its cell is among these, or the middle of the nearest of them."""
        grid = self.grids[storey]
        rows, columns = np.nonzero(free)
        away = np.hypot(grid.x[columns] - point[0], grid.y[rows] - point[1])
        best = int(away.argmin()) if len(away) else -1
        if best < 0 or away[best] > reach:
            return None
        cell = int(rows[best]), int(columns[best])
        return point if grid.cell(*point) == cell else grid.point(*cell)

    def floor_of(self, room: Room) -> np.ndarray:
        """The largest connected part (rows, columns) of a room's free cells: not one that a bed
        separates from it, before another door."""
        if room.name not in self._floors:
            x, y = np.meshgrid(self.grids[room.storey].x, self.grids[room.storey].y)
            here = self.free[room.storey] & inside(room.polygon, x, y)
            for other in self.home.rooms[:self.home.rooms.index(room)]:  # like Home.room_at()
                if other.storey == room.storey:
                    here &= ~inside(other.polygon, x, y)
            self._floors[room.name] = largest(here)
        return self._floors[room.name]

    def spots(self, room: str, count: int, numbers: Any) -> list[Point]:
        """Places in a room, in the open first."""
        if room not in self._places:
            self._places[room] = self._by_doors(next(r for r in self.home.rooms if r.name == room))
        x, y, away = self._places[room]
        for least in (SWING - 0.2, 0.6, 0.0):
            cells = np.nonzero(away >= least)[0]
            if len(cells):
                chosen = [cells[numbers.randrange(len(cells))] for _ in range(count)]
                return [(float(x[i]), float(y[i])) for i in chosen]
        return []

    def _by_doors(self, room: Room) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """x and y of the places of a room, and m to the middle of a door, where that is near."""
        rows, columns = np.nonzero(self.floor_of(room))
        x, y = self.grids[room.storey].x[columns], self.grids[room.storey].y[rows]
        away = np.full(len(x), np.inf)
        for door in self.home.doors:
            if room.contains(*door.pose[:2]) or room.distance(*door.pose[:2]) < SWING:
                away = np.minimum(away, np.hypot(x - door.pose[0], y - door.pose[1]))
        return x, y, away

    def porch(self) -> tuple[Point, int] | None:
        """The free place outside the main entrance, before a landing, and its storey; None if
        there is none."""
        door = self.entrance()
        if door is None:
            return None
        storey = self.home.storey_at(door.pose[2])
        x, y, _, yaw = door.pose
        sides = [(x - sign * SWING * math.sin(yaw), y + sign * SWING * math.cos(yaw))
                 for sign in (1, -1)]
        rooms = [self.home.room_at(*at, door.pose[2] + 0.1) for at in sides]
        for at, room in sorted(zip(sides, rooms), key=lambda side: side[1] is not None):
            if room is None or room.use in ('landing', 'outdoor'):
                point = self._nearest(self.free[storey], storey, at, 0.7)
                if point:
                    return point, storey
        return None

    def entrance(self) -> Door | None:
        """The main entrance's door."""
        return next((door for door in self.home.doors if door.name == self.home.entrance
                     and door.kind in ('door', 'opening')), None)


def largest(cells: np.ndarray) -> np.ndarray:
    """The largest connected part."""
    parts, count = label(cells, np.ones((3, 3), int))
    return parts == 1 + int(np.argmax(np.bincount(parts.ravel())[1:])) if count else cells


def _opened(world: Any, home: Home) -> dict[str, Leaf]:
    """The leaves that turn, as far open as they get: one that is locked stays shut."""
    doors = {door.name: door for door in home.doors
             if door.kind == 'door' and door.name in world.devices('door')}
    for model in [model for kind, _, model, _ in world.entities() if kind in ('person', 'drive')]:
        if model in world.models:
            world.delete(model)
    for name in doors:
        try:
            world.command('door', name, 'Open')
        except angen_module().Error:
            continue  # it is locked, or has no drive
    end = world.time + OPENS_IN
    moving = list(doors)
    while moving and world.time < end:
        world.run(0.5)
        moving = [name for name in moving if world.device('door', name)['mode'] != 'OPEN']
    leaves = {}
    for name, door in doors.items():
        state = world.device('door', name)
        if 'hinge' in state:
            turned = math.copysign(state['position'], state['opens'])
            leaves[name] = door_of(door, {**state, 'opens': turned})
    return leaves


def _offsets(x: np.ndarray, y: np.ndarray, door: Door) -> tuple[np.ndarray, np.ndarray]:
    """The signed distances of places from a door's middle, along its shut leaf and across it."""
    c, s = math.cos(door.pose[3]), math.sin(door.pose[3])
    dx, dy = x - door.pose[0], y - door.pose[1]
    return c * dx + s * dy, c * dy - s * dx


def _opening(x: np.ndarray, y: np.ndarray, door: Door, deep: float) -> np.ndarray:
    """Which places are in a door's opening, `deep` (m) to both sides of its middle."""
    along, across = _offsets(x, y, door)
    return np.asarray((np.abs(along) <= door.width / 2 + JOINT) & (np.abs(across) <= deep))


def _passes(door: Door, passable: np.ndarray, x: np.ndarray, y: np.ndarray) -> bool:
    """Whether places before and behind a door are connected."""
    parts, _ = label(passable, np.ones((3, 3), int))
    near = passable & _opening(x, y, door, CLEAR)
    across = _offsets(x, y, door)[1]
    return bool(set(parts[near & (across > DEEP)]) & set(parts[near & (across < -DEEP)]))
