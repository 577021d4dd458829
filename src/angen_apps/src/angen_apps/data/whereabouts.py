"""Where the residents of a home were, by its written truth and track, and what sees a place."""
from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass, field
from datetime import datetime
from functools import cached_property
from typing import Any, Iterator

import numpy as np
from angen import Grid

from angen_apps.plan.polygons import rectangle
from angen_tools.common.geometry import bounds, turned

SIDE = 0.05  # m, of a cell of the floor
EDGE = 0.5  # m around the rooms
WALL, PASSAGE = -1, 0  # instead of a room's number from 1
DEEP = 0.35  # m to both sides of a door's middle that belong to its opening
WIDE = 0.3  # m: half the width of a person
WALKS = 1.0  # s between two places of a walk, at most


@dataclass(frozen=True)
class Interval:
    """A line of the truth, as numbers."""

    start: float
    end: float
    row: dict[str, str]


@dataclass
class Whereabouts:
    """One resident: places (t, x, y, storey; x is NaN where it is away) and motions by time."""

    times: list[float] = field(default_factory=list)
    places: list[tuple[float, float, int]] = field(default_factory=list)
    moves: list[float] = field(default_factory=list)
    does: list[Interval] = field(default_factory=list)

    def at(self, time: float) -> tuple[float, float, int]:
        """Its place at a time."""
        i = bisect_right(self.times, time) - 1
        if i < 0:
            return math.nan, math.nan, 0
        x, y, storey = self.places[i]
        if i + 1 < len(self.times) and self.times[i + 1] - self.times[i] < WALKS:
            share = (time - self.times[i]) / max(self.times[i + 1] - self.times[i], 1e-9)
            to_x, to_y, _ = self.places[i + 1]
            if not math.isnan(to_x):
                return x + share * (to_x - x), y + share * (to_y - y), storey
        return x, y, storey

    def between(self, start: float, end: float) -> list[tuple[float, float, int]]:
        """Its places in a time."""
        i, j = bisect_right(self.times, start), bisect_right(self.times, end)
        return [self.at(start), *self.places[i:j], self.at(end)]

    def moving(self, start: float, end: float) -> list[tuple[float, float, int]]:
        """Its places in a time, at the moments at which it moves."""
        i, j = bisect_right(self.moves, start), bisect_right(self.moves, end)
        return [self.at(time) for time in self.moves[i:j]]

    def intervals(self, start: float, end: float) -> Iterator[dict[str, str]]:
        """The lines of its truth that a time meets."""
        i = bisect_right(self._starts, start) - 1
        for interval in self.does[max(i, 0):]:
            if interval.start > end:
                return
            yield interval.row

    @cached_property
    def _starts(self) -> list[float]:
        return [interval.start for interval in self.does]


def whereabouts(names: list[str], truth: list[dict[str, str]], track: list[dict[str, str]],
                moves: list[dict[str, str]], storeys: dict[str, int]) -> dict[str, Whereabouts]:
    """Of each resident; `storeys` by room."""
    found = {name: Whereabouts() for name in names}
    rows: dict[str, list[tuple[float, int, float, float, int]]] = {name: [] for name in names}
    for row in truth:
        if row['resident'] in found:
            start, end = float(row['start']), float(row['end'])
            found[row['resident']].does.append(Interval(start, end, row))
            away = row['phase'] == 'away'
            x, y = (math.nan, math.nan) if away else (float(row['x']), float(row['y']))
            rows[row['resident']].append((start, 1, x, y, storeys.get(row['room'], 0)))
            if row['phase'] != 'waits':
                found[row['resident']].moves.append(start)
    for row in track:
        if row['resident'] in found:
            rows[row['resident']].append((float(row['time']), 0, float(row['x']), float(row['y']),
                                          int(row['storey'])))
            found[row['resident']].moves.append(float(row['time']))
    for row in moves:
        if row['resident'] in found:
            found[row['resident']].moves.append(float(row['time']))
    for name, one in found.items():
        one.moves.sort()
        for time, _, x, y, storey in sorted(rows[name]):
            one.times.append(time)
            one.places.append((x, y, storey))
    return found


def time_of(row: dict[str, str], start: datetime) -> float:
    """Of an event, s since the first midnight."""
    return (datetime.fromisoformat(row['time']) - start).total_seconds()


class Floors:
    """The storeys of a layout in cells: rooms, the openings between them, and walls."""

    def __init__(self, layout: Any) -> None:
        self.rooms = [room['name'] for room in layout['rooms']]
        self._grids: dict[int, Grid] = {}
        for storey in {room['storey'] for room in layout['rooms']}:
            rooms = [(i, room) for i, room in enumerate(layout['rooms'], 1)
                     if room['storey'] == storey]
            x0, y0, x1, y1 = bounds(point for _, room in rooms for point in room['polygon'])
            shape = [math.ceil((size + 2 * EDGE) / SIDE) for size in (y1 - y0, x1 - x0)]
            grid = Grid(np.full(shape, WALL), (x0 - EDGE, y0 - EDGE), SIDE)
            for i, room in reversed(rooms):
                grid.fill(room['polygon'], i)
                for hole in room.get('holes', ()):
                    grid.fill(hole, WALL)
            for door in layout['doors']:
                if door['kind'] != 'window' and door.get('storey', storey) == storey:
                    x, y, _, yaw = door['pose']
                    half = door['width'] / 2 + SIDE
                    grid.fill(rectangle(x, y, yaw, (-half, -DEEP), (half, DEEP)), PASSAGE)
            self._grids[storey] = grid

    def _cells(self, storey: int, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        grid = self._grids.get(storey)
        if grid is None:
            return np.full(x.shape, WALL)
        cells = grid.cells
        rows, columns = cells.shape
        i = ((y - grid.origin[1]) / SIDE).astype(int)
        j = ((x - grid.origin[0]) / SIDE).astype(int)
        return np.asarray(cells[np.maximum(np.minimum(i, rows - 1), 0),
                                np.maximum(np.minimum(j, columns - 1), 0)])

    def room(self, x: float, y: float, storey: int) -> str:
        """The room at a place, '' in a wall or an opening."""
        number = int(self._cells(storey, np.array([x]), np.array([y]))[0])
        return self.rooms[number - 1] if number > 0 else ''

    def sees(self, start: tuple[float, float], place: tuple[float, float, int]) -> bool:
        """Whether a person at a place is in sight of a point, through open doors."""
        x, y, storey = place
        if math.isnan(x):
            return False
        yaw = math.atan2(y - start[1], x - start[0])
        return any(self._clear(start, turned((x, y), yaw, 0.0, side), storey)
                   for side in (0.0, -WIDE, WIDE))

    def _clear(self, a: tuple[float, float], b: tuple[float, float], storey: int) -> bool:
        share = np.linspace(0.0, 1.0, 2 + int(math.dist(a, b) / SIDE))
        line = self._cells(storey, a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
        inner = line[2:-2]  # the sensor may be in a wall, a person may reach into one
        if (inner == WALL).any():
            return False
        steps = inner[1:] != inner[:-1]
        return not (steps & (inner[1:] != PASSAGE) & (inner[:-1] != PASSAGE)).any()
