"""Open leaves on the map of a storey."""
from __future__ import annotations

import math

import numpy as np
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED, RESOLUTION
from angen_apps.plan.apartment import apartment
from angen_apps.plan.writer import write_world
from angen_apps.residents import ground
from angen_apps.residents.ground import BODY
from angen_apps.residents.leaves import Leaves, Reach
from angen_apps.residents.survey import middles
from angen_apps.robot.planner import Planner
from angen_tools.common.catalog import angen_module
from angen_tools.common.home import Door, Home
from tests.angen_apps.residents.test_mover import home_of, narrow


def floor(rows: int, columns: int) -> Grid:
    return Grid(np.full((rows, columns), FREE, np.int8), (-1.0, -2.0), RESOLUTION, 0)


def row_of_doors() -> tuple[Grid, Grid, list[Door]]:
    """A corridor along the edges of a map, without and with the leaves of doors of many widths."""
    grid, opened, doors = floor(40, 200), floor(40, 200), []
    for number, at in enumerate(range(10, 200, 23)):
        x, y = grid.point(5, at)
        doors.append(Door(f'door{number}', 'door', ('a', 'b'), 0.5 + number % 3 * 0.2, 2.0,
                          (x, y, 0.0, 0.0)))
        opened.cells[5:5 + 9 + number % 3 * 4, at + number % 4 - 2] = OCCUPIED
    return grid, opened, doors


def test_one_passes_several_leaves_where_a_body_fits_between_them():
    grid, opened, doors = row_of_doors()
    leaves = Leaves(grid, opened, doors, BODY)
    for some in ([], doors[:1], doors[3:5], doors):
        planner = Planner(leaves.occupied(some), BODY)
        assert np.array_equal(leaves.passes(some), planner.passable)
    assert 100 < (leaves.passes([]) & ~leaves.passes(doors)).sum() < 5000


def test_a_leaf_belongs_to_the_nearest_door():
    grid, opened, doors = row_of_doors()
    leaves = Leaves(grid, opened, doors, BODY)
    owners = np.sum([leaves.cells(door) for door in doors], axis=0)
    assert owners.max() == 1 and owners.sum() == (opened.cells != FREE).sum()
    for door in doors:
        rows, columns = np.nonzero(leaves.cells(door))
        x, y = grid.point(int(rows[0]), int(columns[0]))
        assert math.dist((x, y), door.pose[:2]) == min(math.dist((x, y), other.pose[:2])
                                                       for other in doors)


def test_the_ways_of_a_storey_are_computed_once_for_all_of_its_doors(tmp_path, monkeypatch):
    write_world(apartment(3, 1, 7), tmp_path / 'home.world')
    world = angen_module().World(str(tmp_path / 'home.world'))
    home = Home.of_world(world)
    made: list[Grid] = []

    class Counted(Planner):
        def __init__(self, grid: Grid, radius: float) -> None:
            made.append(grid)
            super().__init__(grid, radius)

    monkeypatch.setattr(ground, 'Planner', Counted)
    found = ground.Ground(world, home)
    assert len(made) == len(found.planners) == 1 < len(home.doors)


def test_a_leaf_before_the_entrance_closes_off_the_outside(tmp_path):
    site, _, _ = home_of(narrow(tmp_path))
    grid = site.ground.planners[0].grid
    x, y = middles(grid, *np.indices(grid.cells.shape))
    reach = Reach(site.home.rooms, site.ground.entrance(), x, y)
    rooms = {'hall0', 'kitchen0', 'living0'}
    assert reach.rooms(Planner(grid, BODY).passable) == rooms | {''}
    leaf = (abs(x - 0.3) < 0.1) & (abs(y + 3.0) < 0.4)
    cells = np.where(leaf, OCCUPIED, grid.cells).astype(np.int8)
    assert reach.rooms(Planner(grid.with_cells(cells), BODY).passable) == rooms
