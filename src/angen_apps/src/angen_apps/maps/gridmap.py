"""Occupancy maps of a world's floors, measured by rays against its geometry."""
from pathlib import Path
from typing import Any, Callable, Collection, Sequence

import numpy as np
from angen import Grid
from scipy.ndimage import binary_propagation, distance_transform_edt

from angen_tools.common.catalog import angen_module, simulator
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home

RESOLUTION = 0.05  # m; cells are centered on its multiples, where the faces of buildings lie
LOW, HIGH = 0.02, 0.45  # m above the floor: a robot of that height can touch things between
LEVEL = 0.02  # m from one height of rays to the next, …
ABOVE = 0.25  # m … and above HIGH
FINE = 0.01  # m between rays: a thing that is thinner both ways may be missed
STEP_DOWN = 0.05  # m: deeper ground is not a floor
REACH = 60.0  # m: the largest distance of a building from the origin
MARGIN = 0.1  # m around everything
SETTLE = 60.0  # s of simulated time for doors and elevators to get where they are sent
ROOM, HEADROOM = 0.4, 1.0  # m: free floor without a circle of that radius and height is not a room

FREE, OCCUPIED, UNKNOWN = 0, 100, -1  # values of nav_msgs/OccupancyGrid


def _is_log(path: str) -> bool:
    try:
        with Path(path).open('rb') as file:
            return file.read(12) == b'{"angen_log"'
    except OSError:
        return False


def load_world(path: str, seed: int = 0, allow_paths: bool = False) -> Any:
    """The angen.World of a file, or of the beginning of a log; Failure if it does not load."""
    with simulator() as angen:
        return (angen.Replay(path).world() if _is_log(path)
                else angen.World(path, seed, allow_paths=allow_paths))


def make_map(world: Any, floor: int, doors: str = 'away', high: float = HIGH,
             but: Collection[str] = (), margin: float = MARGIN) -> Grid:
    """The map of a floor: everything between LOW and `high` (m) above it, and `margin` (m) around
    that. Changes the world.

    Robots and people are left out; elevators are at that floor with open doors, where they
    serve it. Doors are left out (`doors='away'`), `'open'` or `'shut'`, but those named in `but`
    are shut. FREE is floor
    that is connected to a place where a robot fits; the insides of walls and furniture, and
    ground that is not a floor, are UNKNOWN. Failure if the world has no such floor; it
    names those it has.
    """
    all_floors = floors(world)
    height = Home.of_world(world).elevation(floor)
    _prepare(world, floor, doors, but)
    surveyor = _Surveyor(world, high)
    bounds = surveyor.bounds(height, margin)
    if bounds is None or floor not in all_floors:
        known = ', '.join(str(known) for known in all_floors)
        raise Failure(f'there is no floor {floor}; ' +
                      (f'known are {known}' if known else 'it has no floor'))
    west, south, columns, rows = bounds
    x = (west + np.arange(columns)) * RESOLUTION
    y = (south + np.arange(rows)) * RESOLUTION
    occupied = surveyor.surfaces(x, y, height)
    ground, room = surveyor.ground(x, y, height)
    ground &= ~occupied
    cells = np.full((rows, columns), UNKNOWN)
    cells[reached(_shrunk(ground & room, ROOM), ground)] = FREE
    cells[occupied] = OCCUPIED
    return Grid(cells, (x[0] - RESOLUTION / 2, y[0] - RESOLUTION / 2), RESOLUTION, floor, height)


def floors(world: Any) -> list[int]:
    """The storeys of the world without those on which nothing is, such as a roof; 0 in a world
    without walls, unless nothing is there."""
    home = Home.of_world(world)
    surveyor = _Surveyor(world)
    return [number for number in [storey.number for storey in home.storeys] or [0]
            if surveyor.bounds(home.elevation(number)) is not None]


def models_with(world: Any, joint: str) -> list[str]:
    """The models that have a joint of this name; `hinge` makes a door, a wheel a robot."""
    ends = '::' + joint
    return [name.removesuffix(ends) for name in world.joints if name.endswith(ends)]


def _prepare(world: Any, floor: int, doors: str, but: Collection[str]) -> None:
    """Removes everything that no map shows, and moves doors and elevators to their mapped state."""
    leave_out = world.devices('person') + models_with(world, 'left_wheel_joint')
    if doors == 'away':
        leave_out += models_with(world, 'hinge')
    for name in leave_out:
        world.delete(name)
    # Leaves of a model that is more than a door are not in the way either.
    opened = [name for name in world.devices('door') if doors != 'shut' and name not in but]
    others = [name for name in world.devices('door') if name not in opened]
    _send(world, 'door', opened, 'Open', lambda s: s['mode'] == 'OPEN')
    _send(world, 'door', others, 'Close', lambda s: s['mode'] == 'CLOSED')
    _send(world, 'elevator', world.devices('elevator'), f'Floor{floor}',
          lambda s: s['floor'] == floor and s['mode'] == 'IDLE' and s['door_mode'] == 'OPEN')


def _send(world: Any, kind: str, names: Sequence[str], text: str,
          done: Callable[[dict[str, Any]], bool]) -> None:
    sent = []
    for name in names:
        try:
            world.command(kind, name, text)
            sent.append(name)
        except angen_module().Error:
            continue  # an elevator that does not serve this floor stays where it is
    for _ in range(int(SETTLE / 0.5)):
        world.run(0.5)
        if all(done(world.device(kind, name)) for name in sent):
            break


def reached(seeds: np.ndarray, within: np.ndarray) -> np.ndarray:
    """Which of the mask `within` is connected to `seeds` by cells' edges (rows, columns)."""
    return binary_propagation(seeds & within, mask=within)


def _shrunk(mask: np.ndarray, radius: float) -> np.ndarray:
    """The cells whose circle of that radius (m) is wholly in the mask; outside is false."""
    steps = int(radius / RESOLUTION)
    return distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1] > steps


class _Surveyor:
    """Rays over whole floors of a world."""

    def __init__(self, world: Any, high: float = HIGH) -> None:
        self._world = world
        self._high = high
        self._levels = np.append(np.arange(LOW, min(high, HIGH), LEVEL),
                                 np.arange(HIGH, high, ABOVE))

    def bounds(self, floor: float, around: float = MARGIN) -> tuple[int, int, int, int] | None:
        """West and south in cells, columns and rows of everything on a floor at that
        height, and `around` (m) that.

        None if rays from afar hit nothing.
        """
        across = np.arange(-REACH, REACH, RESOLUTION) + FINE
        hits = []
        for axis in (0, 1):
            for sign in (1, -1):
                origins = np.zeros((len(across), len(self._levels), 3))
                origins[..., axis] = -sign * REACH
                origins[..., 1 - axis] = across[:, None]
                origins[..., 2] = floor + self._levels
                origins = origins.reshape(-1, 3)
                ranges = self._cast(origins, axis, sign, 2 * REACH)
                origins[:, axis] += sign * ranges
                hits.append(origins[ranges < 2 * REACH, :2])
        points = np.rint(np.concatenate(hits) / RESOLUTION).astype(int)
        if not len(points):
            return None
        (west, south), (east, north) = points.min(axis=0), points.max(axis=0)
        margin = round(around / RESOLUTION)
        return (west - margin, south - margin, east - west + 1 + 2 * margin,
                north - south + 1 + 2 * margin)

    def surfaces(self, x: np.ndarray, y: np.ndarray, floor: float) -> np.ndarray:
        """Which cells (rows, columns) around y, x (m) hold a surface at the heights of the map."""
        found = np.zeros((len(y), len(x)), bool)
        aside = np.arange(-2, 3) * FINE
        heights = floor + self._levels
        for axis, along, across in ((0, x, y), (1, y, x)):
            lines = np.array([(a, z) for a in (across[:, None] + aside).ravel() for z in heights])
            starts = np.zeros((len(lines), 3))
            starts[:, axis] = along[0] - RESOLUTION / 2
            starts[:, 1 - axis], starts[:, 2] = lines.T
            for points in self._march(starts, axis, along[-1] + RESOLUTION / 2):
                rows = np.rint((points[:, 1] - y[0]) / RESOLUTION).astype(int)
                columns = np.rint((points[:, 0] - x[0]) / RESOLUTION).astype(int)
                found[rows, columns] = True
        from_above = self._vertical(x, y, floor + self._high, -1, self._high - LOW)
        return found | (from_above < self._high - LOW)

    def ground(self, x: np.ndarray, y: np.ndarray, floor: float
               ) -> tuple[np.ndarray, np.ndarray]:
        """Which cells have floor beneath, small gaps apart, and which also HEADROOM above."""
        reach, aside = LOW + STEP_DOWN, 0.4 * RESOLUTION
        start = floor + LOW
        ground = np.zeros((len(y), len(x)), bool)
        for dx, dy in ((0, 0), (1, 1), (-1, 1), (1, -1), (-1, -1)):
            ground |= self._vertical(x + dx * aside, y + dy * aside, start, -1, reach) < reach
        return ground, ground & (self._vertical(x, y, start, 1, HEADROOM) >= HEADROOM)

    def _march(self, starts: np.ndarray, axis: int, end: float) -> Any:
        """Every point (n, 3) that rays along +axis hit up to `end`, a surface after the other."""
        past = 1e-4  # m: beyond a surface, to hit the next
        while len(starts):
            reach = end - starts[:, axis]
            ranges = self._cast(starts, axis, 1, reach)
            starts = starts[ranges < reach]
            starts[:, axis] += ranges[ranges < reach]
            yield starts
            starts = starts + past * np.eye(3)[axis]
            starts = starts[starts[:, axis] < end]

    def _vertical(self, x: np.ndarray, y: np.ndarray, start: float, sign: int, reach: float
                  ) -> np.ndarray:
        """Ranges (rows, columns) up (1) or down (-1) from z = `start`, m."""
        origins = np.stack([*np.meshgrid(x, y), np.full((len(y), len(x)), start)], axis=2)
        return self._cast(origins.reshape(-1, 3), 2, sign, reach).reshape(len(y), len(x))

    def _cast(self, origins: np.ndarray, axis: int, sign: int, reach: Any) -> np.ndarray:
        ways = np.broadcast_to(sign * np.eye(3)[axis], origins.shape)
        return np.asarray(self._world.cast(origins, ways, reach))
