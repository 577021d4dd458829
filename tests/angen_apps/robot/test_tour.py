"""The order of visits to places on a floor."""
import math
from itertools import permutations

import numpy as np
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED
from angen_apps.robot.planner import Planner, Point
from angen_apps.robot.tour import in_order


def planner(*walls: slice) -> Planner:
    """A floor of 20 m x 4 m; walls at y = 2 m over some columns."""
    cells = np.full((80, 400), FREE, np.int8)
    for wall in walls:
        cells[40, wall] = OCCUPIED
    return Planner(Grid(cells, (0.0, 0.0), 0.05, 0), 0.22)


def test_a_corridor_is_driven_to_one_end_and_then_to_the_other() -> None:
    places = [(10.0 + 1.5 * i * (-1) ** i, 1.0) for i in range(1, 6)]
    order = in_order(planner(), (10.0, 1.0), places)
    assert [places[i][0] for i in order] == [13.0, 16.0, 8.5, 5.5, 2.5]


def test_places_behind_a_wall_come_after_those_on_this_side() -> None:
    below: list[Point] = [(x, 1.2) for x in (4.0, 8.0, 12.0)]
    above: list[Point] = [(x, 2.8) for x in (12.0, 8.0, 4.0)]
    order = in_order(planner(slice(0, 380)), (1.0, 1.2), [*above, *below])
    assert order == [3, 4, 5, 0, 1, 2]


def test_the_way_is_nearly_the_shortest() -> None:
    dice = np.random.default_rng(27)
    for _ in range(5):
        drawn = dice.uniform((1, 0.5), (19, 3.5), (7, 2))
        places: list[Point] = [(float(x), float(y)) for x, y in drawn]

        def length(order: tuple[int, ...]) -> float:
            way = [(10.0, 2.0), *(places[i] for i in order)]
            return sum(math.dist(a, b) for a, b in zip(way, way[1:]))

        best = min(map(length, permutations(range(7))))
        order = in_order(planner(), (10.0, 2.0), places)
        assert sorted(order) == list(range(7)) and length(tuple(order)) < 1.15 * best
