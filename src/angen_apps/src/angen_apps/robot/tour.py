"""The order of a robot's visits: a short way through all places of a floor."""
from typing import Sequence

import numpy as np
from scipy.sparse.csgraph import dijkstra

from angen_apps.robot.planner import Planner, Point, step_costs

BLOCK = 4  # cells of the map in a cell here: places on two sides of a wall are farther apart
PART = 3  # visits that are moved together
GAIN = 1e-6  # cells: a change that saves less is none


def in_order(planner: Planner, start: Point, places: Sequence[Point]) -> list[int]:
    """The numbers of places that the robot reaches from `start`, in the order of their visits."""
    away = _away(planner, [start, *places])
    return [number - 1 for number in _improved(_nearest(away), away)[1:]]


def _away(planner: Planner, places: Sequence[Point]) -> np.ndarray:
    """The way from each place to each, in cells of a coarse map."""
    rows, columns = (-(-size // BLOCK) for size in planner.passable.shape)
    fine = np.zeros((rows * BLOCK, columns * BLOCK), bool)
    fine[:planner.passable.shape[0], :planner.passable.shape[1]] = planner.passable
    coarse = fine.reshape(rows, BLOCK, columns, BLOCK).any(axis=(1, 3))
    cells = [planner.grid.cell(*place) for place in places]
    numbers = [row // BLOCK * columns + column // BLOCK for row, column in cells]
    graph = step_costs(coarse, np.ones(coarse.shape))
    return np.asarray(dijkstra(graph, indices=numbers)[:, numbers])


def _nearest(away: np.ndarray) -> list[int]:
    """The order from number 0 to the nearest that is left, and so on."""
    order, left = [0], set(range(1, len(away)))
    while left:
        order.append(min(left, key=lambda number: (away[order[-1], number], number)))
        left.remove(order[-1])
    return order


def _improved(order: list[int], away: np.ndarray) -> list[int]:
    """The order, changed as long as that makes the way shorter."""
    found = np.array(order)
    shorter = True
    while shorter:
        shorter = _reverse_parts(found, away)
        shorter = _move_parts(found, away) or shorter
    return [int(number) for number in found]


def _reverse_parts(found: np.ndarray, away: np.ndarray) -> bool:
    """Reverses parts of the order; whether that made the way shorter."""
    shorter = False
    for i in range(1, len(found) - 1):
        ends, after = found[i:], found[i + 1:]
        change = away[found[i - 1], ends] - away[found[i - 1], found[i]]
        change[:-1] += away[found[i], after] - away[ends[:-1], after]
        j = int(change.argmin())
        if change[j] < -GAIN:
            found[i:i + j + 1] = found[i:i + j + 1][::-1].copy()
            shorter = True
    return shorter


def _move_parts(found: np.ndarray, away: np.ndarray) -> bool:
    """Moves up to PART visits in a row to elsewhere; whether that made the way shorter."""
    shorter = False
    for length in range(1, PART + 1):
        for i in range(1, len(found) - length + 1):
            part, rest = found[i:i + length].copy(), np.delete(found, range(i, i + length))
            cost = away[rest, part[0]]
            cost[:-1] += away[part[-1], rest[1:]] - away[rest[:-1], rest[1:]]
            k = int(cost.argmin())
            if cost[k] < cost[i - 1] - GAIN:
                found[:] = np.insert(rest, k + 1, part)
                shorter = True
    return shorter
