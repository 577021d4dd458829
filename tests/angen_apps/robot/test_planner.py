"""Ways over a map."""
import math

import numpy as np
import pytest
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED
from angen_apps.robot.planner import Door, Planner, distances, passages
from tests.angen_apps.robot.rooms import DOOR, two_rooms


def test_a_way_keeps_its_distance() -> None:
    grid = two_rooms()
    way = Planner(grid, 0.25).way((0.5, 0.5), (3.5, 0.5))
    rows, columns = np.nonzero(grid.cells == OCCUPIED)
    walls = np.stack([(columns + 0.5), (rows + 0.5)], axis=1) * 0.05
    nearest = min(float(np.linalg.norm(walls - point, axis=1).min()) for point in way)
    assert way[0] == (0.5, 0.5) and way[-1] == (3.5, 0.5)
    assert nearest > 0.2
    assert max(math.dist(a, b) for a, b in zip(way, way[1:])) < 0.15


def test_a_narrow_passage_is_no_way() -> None:
    assert Planner(two_rooms(), 0.55).way((0.9, 1.0), (3.1, 1.0)) is None


def test_the_robot_stops_clear_of_a_leaf_on_either_side() -> None:
    way = [(0.5 + 0.1 * i, 1.0) for i in range(31)]
    passage, = passages(way, [DOOR], 0.3)
    assert math.isclose(way[passage.before][0], 1.7, abs_tol=0.11)  # the leaf swings away from it
    assert way[passage.after][0] >= 2.0 + math.sqrt(1.3 ** 2 - 0.5 ** 2) - 1e-9


def test_distances_are_those_to_the_nearest_edge_that_is_not_free() -> None:
    random = np.random.default_rng(1)
    cells = np.where(random.random((13, 17)) < 0.1, OCCUPIED, FREE).astype(np.int8)
    blocked = [(y, x) for y in range(-1, 14) for x in range(-1, 18)
               if not (0 <= y < 13 and 0 <= x < 17) or cells[y, x] != FREE]
    for reach in (0.12, 10.0):
        found = distances(Grid(cells, (0.0, 0.0), 0.05, 0), reach)
        for row, column in np.ndindex(cells.shape):
            nearest = min(math.hypot(max(abs(row - y) - 0.5, 0), max(abs(column - x) - 0.5, 0))
                          for y, x in blocked)
            assert found[row, column] == pytest.approx(min(0.05 * nearest, reach), abs=1e-12)


def test_both_leaves_of_a_double_door_are_opened() -> None:
    left = Door('left', (0.0, 0.0), 0.0, math.pi / 2, 0.6, partner='right')
    right = Door('right', (1.22, 0.0), math.pi, math.pi / 2, 0.6, partner='left')
    single = Door('beside', (2.5, 0.0), 0.0, math.pi / 2, 0.9)
    way = [(0.5, 0.1 * i - 1.5) for i in range(31)]  # through the left one alone
    found = passages(way, [left, right, single], 0.3)
    assert [passage.door.name for passage in found] == ['left', 'right']
    assert len({(passage.before, passage.after) for passage in found}) == 1
    for passage in found:
        for leaf in (left, right):
            assert leaf.room_for(way[passage.before]) >= 0.3
            assert leaf.room_for(way[passage.after]) >= 0.3
