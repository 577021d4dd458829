"""The walkable floor of a home, and ways over it through doors."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
from angen import Grid
from scipy.ndimage import label

from angen_apps.maps.gridmap import OCCUPIED, RESOLUTION
from angen_apps.plan.polygons import inside
from angen_apps.residents.leaves import Leaves, Reach, largest
from angen_apps.residents.survey import (DEEP, delete, elevation, middles, open_all, opening,
                                         storey_at, survey)
from angen_apps.robot.planner import Planner, Point
from angen_tools.common.home import Door, Home, Place, Room

BODY = 0.3  # m: half the width of a person, with a margin
CLEAR = 1.05  # m from a door's middle: its leaf does not hit a person there
SWING = 1.25  # m from a door's middle: its leaf does not reach farther
CACHED = 1 << 25  # bytes of ways to goals that are kept
REACH = 1.1  # m from a person to the thing that the person uses


@dataclass(frozen=True)
class Leg:
    """A part of a way: places to pass, and the door that has to be open before it begins, or the
    one to shut behind. `exact`: one has to get to its end, and not only near to it."""

    points: tuple[Point, ...]
    door: Door | None = None
    behind: Door | None = None
    exact: bool = False


@dataclass(frozen=True)
class Ride:
    """An elevator: its cabin, and where one waits before and gets out after a ride."""

    name: str
    cabin: Point
    waits: Point
    leaves: Point


class Ground:
    """The floors of a home. `world` is one of its own, from which people and leaves are removed."""

    def __init__(self, world: Any, home: Home) -> None:
        self.home = home
        delete(world, 'person', 'drive')
        self._world = world
        entrance = self.entrance()
        lives = self.storey_at(entrance.pose[2]) if entrance else min(r.storey for r in home.rooms)
        open_all(world, home)
        self.in_way: set[str] = set()  # doors whose leaves close off a room, if they stand open
        self.reached: set[str] = set()  # rooms that people get to
        self._stops: dict[str, Point] = {}  # where one opens and shuts these
        leaves = {storey: survey(self._world, home, storey) for storey in self._storeys(lives)}
        delete(world, 'door')
        self.planners = {storey: self._planner(survey(self._world, home, storey), opened)
                         for storey, opened in leaves.items()}
        self.free = {storey: largest(planner.passable)
                     for storey, planner in self.planners.items()}
        self._toward: dict[tuple[int, tuple[int, int]], np.ndarray] = {}  # the last used at the end
        self._floors: dict[str, np.ndarray] = {}  # floors of rooms
        self._places: dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]] = {}  # _by_doors()
        self._names: dict[tuple[int, int, int], str] = {}  # by floor, row and column

    def _storeys(self, lives: int) -> list[int]:
        """That of the main entrance, and those that elevators reach from there."""
        found = {lives}
        for lift in self.home.elevators:
            landings = {landing.storey for landing in lift.landings}
            if lives in landings:
                found |= landings
        return sorted(storey for storey in found
                      if any(room.storey == storey for room in self.home.rooms))

    def lift(self, storey: int, other: int) -> Ride | None:
        """The first elevator between two storeys."""
        for lift in self.home.elevators:
            landings = {landing.storey: landing for landing in lift.landings}
            if storey in landings and other in landings:
                points = [self.near(*landings[s].pose[:2], self.elevation(s))
                          for s in (storey, other)]
                if points[0] and points[1]:
                    return Ride(lift.name, lift.pose[:2], points[0], points[1])
        return None

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

    def storey_at(self, z: float) -> int:
        """The storey whose floor is nearest below a height."""
        return storey_at(self.home, z)

    def elevation(self, storey: int) -> float:
        return elevation(self.home, storey)

    def room_name(self, x: float, y: float, storey: int) -> str:
        """The room at a place on the floor, to a cell of the map; '' outside."""
        grid = self.planners[storey].grid
        key = (storey, math.floor((y - grid.origin[1]) / grid.resolution),
               math.floor((x - grid.origin[0]) / grid.resolution))
        name = self._names.get(key)
        if name is None:
            x, y = grid.point(*key[1:])
            room = self.home.room_at(x, y, self.elevation(storey) + 0.5)
            name = self._names[key] = room.name if room else ''
        return name

    def near(self, x: float, y: float, z: float, reach: float = REACH) -> Point | None:
        """The free place nearest to a point, on the floor of its room."""
        room = self.home.room_at(x, y, z + 0.1)
        planner = self.planners.get(self.storey_at(z))
        if planner is None or room is None:
            return None
        free = self.floor_of(room)
        if planner.is_free((x, y)) and free[planner.grid.cell(x, y)]:
            return x, y
        rows, columns = np.nonzero(free)
        px, py = middles(planner.grid, rows, columns)
        away = np.hypot(px - x, py - y)
        best = int(away.argmin()) if len(away) else -1
        if best < 0 or away[best] > reach:
            return None
        return float(px[best]), float(py[best])

    def floor_of(self, room: Room) -> np.ndarray:
        """The largest connected part (rows, columns) of a room's free cells: not one that a bed
        separates from it, before another door."""
        if room.name not in self._floors:
            free = self.free[room.storey]
            rows, columns = np.indices(free.shape)
            x, y = middles(self.planners[room.storey].grid, rows, columns)
            here = free & inside(room.polygon, x, y)
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
        x, y = middles(self.planners[room.storey].grid, rows, columns)
        away = np.full(len(x), np.inf)
        for door in self.home.doors:
            if room.contains(*door.pose[:2]) or room.distance(*door.pose[:2]) < SWING:
                away = np.minimum(away, np.hypot(x - door.pose[0], y - door.pose[1]))
        return x, y, away

    def porch(self) -> tuple[Point, int] | None:
        """The free place outside the main entrance, and its storey; None if there is none."""
        door = self.entrance()
        if door is None:
            return None
        storey = self.storey_at(door.pose[2])
        x, y, _, yaw = door.pose
        for sign in (1, -1):
            at = (x - sign * SWING * math.sin(yaw), y + sign * SWING * math.cos(yaw))
            room = self.home.room_at(*at, door.pose[2] + 0.1)
            if room is None or room.use in ('landing', 'outdoor'):
                point = self.planners[storey].nearest(at, 0.7)
                if point:
                    return point, storey
        return None

    def entrance(self) -> Door | None:
        """The main entrance's door."""
        named = [d for d in self.home.doors if d.name == self.home.entrance
                 and d.kind in ('door', 'opening')]
        return named[0] if named else None

    def way(self, start: Point, goal: Point, storey: int) -> list[Leg] | None:
        """Legs from a place to another on a storey; None if there is no way."""
        planner = self.planners[storey]
        begin = start if planner.is_free(start) else (
            self.near(*start, self.elevation(storey), 0.8) or planner.nearest(start, 0.8))
        points = begin and planner.along(self._following(planner, goal, storey), begin, goal)
        if not points:
            return None
        doors = [d for d in self.home.doors if d.kind == 'door'
                 and self.storey_at(d.pose[2]) == storey]
        points, stops = self._by_stops(points, doors, storey)
        cuts: list[tuple[int, Door, bool]] = []  # where a door is opened, or is shut behind
        for i, crossed in _crossings(points, doors):
            first, stop = (cuts[-1][0] if cuts else 0), stops.get(crossed.name)
            before = next((j for j in range(i, first - 1, -1)
                           if math.dist(points[j], crossed.pose[:2]) >= SWING), first)
            cuts.append((before if stop is None or stop > i else stop, crossed, True))
            if stop is not None and stop > i:
                cuts.append((stop, crossed, False))
        legs: list[Leg] = []
        parts = [(0, None, True), *sorted(cuts, key=lambda cut: cut[0])]
        ends = [*(index for index, _, _ in parts[1:]), len(points) - 1]
        for (index, door, opens), end in zip(parts, ends):
            legs.append(Leg(self._corners(planner, points[index:end + 1]),
                            door if opens else None, None if opens else door,
                            end == len(points) - 1 or end in stops.values()))
        return legs

    def _by_stops(self, points: list[Point], doors: Sequence[Door], storey: int
                  ) -> tuple[list[Point], dict[str, int]]:
        """A way past the stop of each of its doors that has one, and where in it they are."""
        planner, goal = self.planners[storey], points[-1]
        crossed = [door.name for _, door in _crossings(points, doors) if door.name in self._stops]
        line, found = points[:1], {}
        for name, point in [*((name, self._stops[name]) for name in crossed), ('', goal)]:
            part = planner.along(self._following(planner, point, storey), line[-1], point)
            if part is None:
                return points, {}
            line += part[1:]
            found[name] = len(line) - 1
        del found['']
        return (line, found) if crossed else (points, {})

    def _following(self, planner: Planner, goal: Point, storey: int) -> np.ndarray:
        """Planner.toward() with a cache of the last goals."""
        key = (storey, planner.grid.cell(*goal))
        found = self._toward.pop(key, None)
        if found is None:
            found = planner.toward(goal)
            while self._toward and (len(self._toward) + 1) * found.nbytes > CACHED:
                del self._toward[next(iter(self._toward))]
        self._toward[key] = found
        return found

    def _corners(self, planner: Planner, points: Sequence[Point]) -> tuple[Point, ...]:
        """Reduces a way to the corners of straight segments."""
        kept = [points[0]]
        i = 0
        while i < len(points) - 1:
            step = min(i + 40, len(points) - 1)
            while step > i + 1 and not self._straight(planner, points[i], points[step]):
                step -= 2 if step - 2 > i else 1
            i = step
            kept.append(points[i])
        return tuple(kept[1:] or kept)

    @staticmethod
    def _straight(planner: Planner, a: Point, b: Point) -> bool:
        count = max(int(math.dist(a, b) / RESOLUTION), 1)
        share = np.arange(1, count) / count
        grid = planner.grid
        row = ((a[1] - grid.origin[1] + (b[1] - a[1]) * share) / grid.resolution).astype(int)
        column = ((a[0] - grid.origin[0] + (b[0] - a[0]) * share) / grid.resolution).astype(int)
        return bool(planner.passable[row, column].all())

    def _planner(self, grid: Grid, opened: Grid, walls: Sequence[Door] = ()) -> Planner:
        """The ground of a storey with open doors: their leaves are obstacles, except those without
        which a room could not be reached. `grid` is without leaves. A door that opens too little
        for people is a wall, as `walls` are."""
        doors = [door for door in self.home.doors
                 if door.kind == 'door' and self.storey_at(door.pose[2]) == grid.floor
                 and door not in walls]
        leaves = Leaves(grid, opened, doors, BODY)
        reach = self._reach(grid.floor, leaves)
        rooms = reach.rooms(leaves.passable)
        kept: list[Door] = []
        in_way: list[Door] = []

        def reaches_all(of: Sequence[Door]) -> bool:
            return reach.rooms(leaves.passes(of)) == rooms

        for door in doors:
            if reaches_all([*kept, door]):
                kept.append(door)
                continue
            in_way += [door, *(other for other in kept
                               if math.dist(other.pose[:2], door.pose[:2]) < 2 * SWING
                               and reaches_all([*(d for d in kept if d != other), door]))]
        open_alone = {door.name: leaves.passes([door]) for door in in_way}
        closed = [door for door in in_way
                  if not _passes(door, open_alone[door.name], leaves.x, leaves.y)]
        if closed:
            cells = grid.cells.copy()
            for door in closed:
                cells[opening(leaves.x, leaves.y, door, DEEP)] = OCCUPIED
            return self._planner(grid.with_cells(cells), opened, [*walls, *closed])
        for door in in_way:
            self._add_stop(door, open_alone[door.name], leaves.cells(door), leaves.x, leaves.y)
        self.in_way |= {door.name for door in in_way}
        self.reached |= rooms
        return Planner(leaves.occupied(kept), BODY)

    def _add_stop(self, door: Door, passable: np.ndarray, leaf: np.ndarray, x: np.ndarray,
                  y: np.ndarray) -> None:
        """Notes a place that is clear of a leaf, on its side, and reached with it open."""
        parts, _ = label(passable, np.ones((3, 3), int))
        away = np.hypot(x - door.pose[0], y - door.pose[1])
        across = _across(door, x, y)
        side = across * np.median(across[leaf])
        here = parts[np.unravel_index(np.where(passable, away, np.inf).argmin(), away.shape)]
        far = np.where((parts == here) & (side > 0) & (away > CLEAR), away, np.inf)
        row, column = np.unravel_index(far.argmin(), far.shape)
        if far[row, column] < CLEAR + REACH:
            self._stops[door.name] = float(x[row, column]), float(y[row, column])

    def _reach(self, storey: int, leaves: Leaves) -> Reach:
        door = self.entrance()
        here = door is not None and self.storey_at(door.pose[2]) == storey
        return Reach([room for room in self.home.rooms if room.storey == storey],
                     door if here else None, leaves.x, leaves.y)


def _across(door: Door, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The signed distances of places from the plane of a shut door."""
    return np.asarray(math.cos(door.pose[3]) * (y - door.pose[1])
                      - math.sin(door.pose[3]) * (x - door.pose[0]))


def _passes(door: Door, passable: np.ndarray, x: np.ndarray, y: np.ndarray) -> bool:
    """Whether places before and behind a door are connected."""
    parts, _ = label(passable, np.ones((3, 3), int))
    near = passable & opening(x, y, door, CLEAR)
    across = _across(door, x, y)
    return bool(set(parts[near & (across > DEEP)]) & set(parts[near & (across < -DEEP)]))


def _crossings(points: Sequence[Point], doors: Sequence[Door]) -> list[tuple[int, Door]]:
    """Which doors a way passes, and the index of its last point before each."""
    found = []
    line = np.array(points)
    for door in doors:
        c, s = math.cos(door.pose[3]), math.sin(door.pose[3])
        dx, dy = line[:, 0] - door.pose[0], line[:, 1] - door.pose[1]
        across, along = c * dy - s * dx, c * dx + s * dy
        passes = (across[:-1] > 0) != (across[1:] > 0)
        near = np.abs(along[:-1]) <= door.width / 2 + 0.1
        found += [(int(i), door) for i in np.nonzero(passes & near)[0]]
    return sorted(found, key=lambda entry: entry[0])
