"""A search's knowledge of the building: rooms, cells, visibility between them, the sensors."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from angen import Grid
from scipy.ndimage import label

from angen_apps.maps.cells import largest
from angen_apps.maps.gridmap import FREE, load_world, make_map
from angen_apps.maps.rays import sees
from angen_apps.plan.polygons import inside, to_segments
from angen_apps.robot.building import Start, Survey, find_start
from angen_apps.robot.entities import Entity
from angen_apps.robot.planner import Door, Planner, Point, distances
from angen_apps.robot.route_file import Route
from angen_apps.robot.views import sensor_element, view_of
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import edges as edges_of
from angen_tools.common.home import Home as DescribedHome
from angen_tools.common.home import Room
from angen_tools.world import sdf

CELL = 0.5  # m
BODY = 0.3  # m: a person's distance from everything
TALL = 1.8  # m: obstacles of a person are below
PERSON_HEIGHTS = (0.4, 1.0, 1.5)  # m: a person is in view where one of these is
LASER = 0.44  # m
SEES = 4.0  # m: how far a look from a viewpoint counts
APART = 1.0  # m between viewpoints
DOORWAY = 1.3  # m around the middle of a shut leaf


@dataclass(frozen=True)
class Pir:
    """Which cells a PIR sees with doors shut, and which only through open doors."""

    name: str
    sees: np.ndarray  # (n,) bool
    through_doors: np.ndarray
    memory: float  # s: age of the scan with which a nodding PIR compares


@dataclass(frozen=True)
class Home:
    """A building in cells of CELL; all arrays (n, ...) are by cell."""

    described: DescribedHome
    entities: list[Entity]
    start: Start
    maps: dict[int, Grid]
    landmarks: dict[int, Grid]
    doors: dict[int, list[Door]]
    walkable: dict[int, Grid]  # for a person
    floor: np.ndarray
    at: np.ndarray  # (n, 2) m
    room: np.ndarray  # index in `rooms`
    rooms: list[str]
    edges: np.ndarray  # (m, 2) cells beside each other, each pair once
    edge_door: list[str]  # the door between them, or nothing
    pirs: list[Pir]
    viewpoints: np.ndarray  # (k,) cells
    views: np.ndarray  # (k, n) bool: cells in view of a viewpoint
    by_lift: np.ndarray  # (n,) bool

    def cell_at(self, x: float, y: float, floor: int) -> int:
        """The nearest cell."""
        away = np.hypot(self.at[:, 0] - x, self.at[:, 1] - y) + 1e6 * (self.floor != floor)
        return int(away.argmin())

    def point(self, cell: int) -> tuple[float, float]:
        """x, y of a cell, m."""
        return float(self.at[cell][0]), float(self.at[cell][1])

    def room_at(self, x: float, y: float, floor: int) -> str:
        return self.rooms[self.room[self.cell_at(x, y, floor)]]

    def room_sums(self, cells: np.ndarray) -> dict[str, float]:
        """The sum of a value by cell, by room."""
        sums = np.bincount(self.room, cells, minlength=len(self.rooms))
        return {name: float(value) for name, value in zip(self.rooms, sums)}

    def around(self, x: float, y: float, floor: int, radius: float) -> np.ndarray:
        """Which cells lie within `radius` (m) of a place."""
        away = np.hypot(self.at[:, 0] - x, self.at[:, 1] - y)
        return (self.floor == floor) & (away <= radius)

    def all_doors(self) -> list[tuple[int, Door]]:
        """Floor and door, of each."""
        return [(floor, door) for floor, doors in self.doors.items() for door in doors]


def make_home(route: Route, path: Path, entities: list[Entity],
              offset: tuple[float, float, float], survey: Survey | None = None) -> Home:
    """The building of a world's file, in which the robot is alone; surveys it if need be."""
    start = find_start(route, entities, offset)
    if survey is None:
        survey = Survey(load_world(str(path)), load_world(str(path)))
    walkable = {floor: make_map(survey.world, floor, 'open', TALL) for floor in survey.maps}
    named = {floor: Rooms(survey.home, floor) for floor in walkable}
    planners = {floor: Planner(grid, route.clearance) for floor, grid in survey.maps.items()}
    starts = {floor: route.elevator.landing for floor in planners} if route.elevator else {}
    starts[start.floor] = (start.pose.x, start.pose.y)
    cells = _Cells(walkable, named, survey.doors, planners, starts)
    if not len(cells.at):
        raise Failure('there is no floor on which a person could walk')
    free = _Sight(survey.world, survey.shut_world)
    targets = np.array([[[x, y, walkable[floor].height + h] for h in PERSON_HEIGHTS]
                        for (x, y), floor in zip(cells.at, cells.floor)])
    described = sdf.read(path)
    pirs = [free.pir(entity, described, targets) for entity in entities if entity.kind == 'pir']
    viewpoints = find_viewpoints(cells.at, cells.floor, planners, survey.doors, route)
    views = np.array([free.around(cells.at, cells.floor, k, walkable) for k in viewpoints])
    by_lift = np.zeros(len(cells.at), bool)
    if route.elevator:
        for place in (route.elevator.cabin, route.elevator.landing):
            by_lift |= np.hypot(*(cells.at - place).T) < 1.3
    return Home(survey.home, entities, start, survey.maps, survey.landmarks,
                survey.doors, walkable, cells.floor, cells.at, cells.room, cells.names,
                cells.edges, cells.edge_door, pirs, viewpoints, views, by_lift)


class Rooms:
    """The rooms of a floor, by name; those whose south-west corner comes first are first."""

    def __init__(self, home: DescribedHome, floor: int) -> None:
        self._rooms = sorted((room for room in home.rooms if room.storey == floor),
                             key=lambda room: (round(room.bounds[1], 2), room.bounds[0]))
        self.names = [room.name for room in self._rooms] or [f'floor {floor}']
        self._doors = [door for door in home.doors if door.kind != 'window' and '' not in door.rooms
                       and any(room.name in door.rooms for room in self._rooms)]

    def hold(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Which places (m) are in a room or in the doorway between two."""
        if not self._rooms:
            return np.ones(len(x), bool)
        found = np.zeros(len(x), bool)
        for door in self._doors:
            found |= np.hypot(x - door.pose[0], y - door.pose[1]) < door.width / 2 + BODY
        for room in self._rooms:
            found |= inside(room.polygon, x, y, room.holes)
        return found

    def at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """The numbers of the rooms that places (m) are in, or nearest to."""
        if not self._rooms:
            return np.zeros(len(x), int)
        found = np.full(len(x), -1)
        for number, room in reversed(list(enumerate(self._rooms))):
            found[inside(room.polygon, x, y, room.holes)] = number
        rest = found < 0
        away = np.array([_distance(room, x[rest], y[rest]) for room in self._rooms])
        found[rest] = away.argmin(axis=0)
        return found


def _distance(room: Room, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """As room.distance, of many places."""
    nearest = np.full(len(x), np.inf)
    for polygon in (room.polygon, *room.holes):
        for a, b in edges_of(polygon):
            nearest = np.minimum(nearest, to_segments(x, y, a, b))
    return nearest


def _reached(planner: Planner, at: Point | None, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Which places (m) the robot can be at, coming from `at`."""
    start = at and planner.nearest(at, CELL)
    if not start:
        return np.zeros(len(x), bool)
    parts = np.pad(label(planner.passable, np.ones((3, 3)))[0], 1)  # around the map it is nowhere
    rows, columns = (np.clip(np.floor((place - low) / planner.grid.resolution).astype(int) + 1, 0,
                             size - 1)
                     for place, low, size in zip((y, x), planner.grid.origin[::-1], parts.shape))
    row, column = planner.grid.cell(*start)
    return np.asarray(parts[rows, columns] == parts[row + 1, column + 1])


class _Cells:
    """Cuts the walkable floor into cells."""

    def __init__(self, walkable: dict[int, Grid], named: dict[int, Rooms],
                 doors: dict[int, list[Door]], planners: dict[int, Planner],
                 starts: dict[int, Point]) -> None:
        """`starts`: where the robot comes to a floor."""
        self.names = [name for rooms in named.values() for name in rooms.names]
        at: list[tuple[float, float]] = []
        floors: list[int] = []
        room: list[int] = []
        edges: list[list[int]] = []
        first_room = 0
        for floor, grid in walkable.items():
            rows, columns = np.nonzero((distances(grid, BODY) >= BODY) & (grid.cells == FREE))
            x, y = grid.x[columns], grid.y[rows]
            masks = np.zeros((2, *grid.cells.shape), bool)
            for mask, which in zip(masks, (named[floor].hold(x, y), _reached(
                    planners[floor], starts.get(floor), x, y))):
                mask[rows[which], columns[which]] = True
            rows, columns = np.nonzero(largest(*masks))
            x, y = grid.x[columns], grid.y[rows]
            key = np.stack([np.floor(x / CELL), np.floor(y / CELL), named[floor].at(x, y)],
                           axis=1).astype(int)
            kept, which = np.unique(key, axis=0, return_inverse=True)
            lattice = np.full(grid.cells.shape, -1)
            lattice[rows, columns] = which.ravel() + len(at)
            by_cell = np.argsort(which.ravel(), kind='stable')
            ends = np.cumsum(np.bincount(which.ravel(), minlength=len(kept)))
            for i, mine in enumerate(np.split(by_cell, ends[:-1])):
                middle = np.array([x[mine].mean(), y[mine].mean()])
                best = np.hypot(x[mine] - middle[0], y[mine] - middle[1]).argmin()
                at.append((x[mine][best], y[mine][best]))
                floors.append(floor)
                room.append(first_room + kept[i][2])
            for a, b in ((lattice[:, 1:], lattice[:, :-1]), (lattice[1:], lattice[:-1])):
                both = (a >= 0) & (b >= 0) & (a != b)
                edges += np.sort(np.stack([a[both], b[both]], axis=1), axis=1).tolist()
            first_room += len(named[floor].names)
        self.at, self.floor, self.room = np.array(at), np.array(floors), np.array(room)
        self.edges = np.unique(np.array(edges, int).reshape(-1, 2), axis=0)
        self.edge_door = [self._door(doors[int(self.floor[a])], a, b) for a, b in self.edges]

    def _door(self, doors: list[Door], a: int, b: int) -> str:
        """The door between two rooms at a pair of cells."""
        if self.room[a] == self.room[b]:
            return ''
        middle = (self.at[a] + self.at[b]) / 2
        near = [(float(np.hypot(*(middle - d.middle))), d.name) for d in doors]
        best = min(near, default=(np.inf, ''))
        return best[1] if best[0] < DOORWAY else ''


class _Sight:
    """Rays in the building with doors open, and with doors shut."""

    def __init__(self, world: Any, shut: Any) -> None:
        self._open, self._shut = world, shut

    def pir(self, entity: Entity, described: Any, targets: np.ndarray) -> Pir:
        """The cells that a PIR sees; `targets` (n, heights, 3) points of a person in each."""
        sensor = sensor_element(described, entity)
        view = view_of(entity, sensor)
        points = targets.reshape(-1, 3)
        held = np.nonzero(view.holds(points))[0]
        seen = [np.zeros(len(points), bool), np.zeros(len(points), bool)]
        for mask, world in zip(seen, (self._shut, self._open)):
            mask[held] = sees(world, view.position, points[held])
        shut, opened = (mask.reshape(targets.shape[:2]).any(axis=1) for mask in seen)
        period = float(sensor.findtext('plugin/nod_period') or 0) if sensor is not None else 0.0
        return Pir(entity.name, shut, opened & ~shut, period)

    def around(self, at: np.ndarray, floor: np.ndarray, cell: int, maps: dict[int, Grid]
               ) -> np.ndarray:
        """The cells in which a laser at a cell sees a person, with doors shut."""
        z = maps[int(floor[cell])].height + LASER
        found = (floor == floor[cell]) & (np.hypot(*(at - at[cell]).T) <= SEES)
        rows = np.nonzero(found)[0]
        points = np.column_stack([at[rows], np.full(len(rows), z)])
        found[rows] = sees(self._shut, np.array([*at[cell], z]), points, BODY)
        return found


def find_viewpoints(at: np.ndarray, floor: np.ndarray, planners: dict[int, Planner],
                    doors: dict[int, list[Door]], route: Route) -> np.ndarray:
    """Cells APART m from each other that are free for the robot and where no leaf swings."""
    found: list[int] = []
    near: dict[int, np.ndarray] = {number: np.zeros((0, 2)) for number in planners}
    for i, (place, number) in enumerate(zip(at, floor)):
        point = (float(place[0]), float(place[1]))
        if number not in planners or not planners[number].is_free(point):
            continue
        if (np.hypot(*(near[number] - place).T) < APART).any():
            continue
        if route.elevator and np.hypot(*np.subtract(place, route.elevator.cabin)) < 1.2:
            continue
        if all(door.room_for(point) >= route.door_room for door in doors[number]):
            found.append(i)
            near[number] = np.vstack([near[number], place])
    return np.array(found, int)
