"""Rays, rasters and floors in Python: closed forms."""
import pickle

import angen
import numpy as np
import pytest

WORLD = '''<sdf version="1.6"><world name="w">
  <model name="box"><static>true</static><pose>3 0 1 0 0 0</pose><link name="l"><collision name="c">
  <geometry><box><size>1 2 2</size></box></geometry></collision></link></model></world></sdf>'''


def test_rays_hit_shapes_as_they_are_now_and_no_time_passes() -> None:
    world = angen.World.from_text(WORLD)
    origins = np.array([[0.0, 0.0, 1.0], [0.0, 1.5, 1.0], [3.0, 0.0, 5.0]])
    ways = np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -2.0]])
    assert world.cast(origins, ways, 10.0) == pytest.approx([2.5, 10.0, 3.0])
    assert world.cast(origins, ways, np.array([1.0, 2.0, 4.0])) == pytest.approx([1.0, 2.0, 3.0])
    world.delete('box')
    assert (world.cast(origins, ways, 10.0) == 10.0).all() and world.time == 0.0
    with pytest.raises(angen.Error):
        world.cast(origins, ways[:2], 10.0)


def test_a_grid_has_cells_at_places() -> None:
    grid = angen.Grid(np.zeros((3, 4)), (1.0, -2.0), 0.5, floor=1, height=3.0)
    assert grid.cell(2.1, -1.4) == (1, 2) and grid.point(1, 2) == (2.25, -1.25)
    assert grid.cell(0.9, -2.1) == (-1, -1)
    assert grid.extent == (1.0, 3.0, -2.0, -0.5)
    assert (grid.x[2], grid.y[1]) == (2.25, -1.25)
    grid.cells[1, 2] = 7
    again = pickle.loads(pickle.dumps(grid))
    assert again.cells[1, 2] == 7 and again.cells.sum() == 7
    assert (again.origin, again.resolution, again.floor, again.height) == ((1.0, -2.0), 0.5, 1, 3.0)
    assert grid.with_cells(again.cells + 1).cells[1, 2] == 8 and grid.cells[1, 2] == 7
    for cells, resolution in ((np.zeros(3), 0.5), (np.zeros((3, 4)), 0.0)):
        with pytest.raises(angen.Error):
            angen.Grid(cells, (0.0, 0.0), resolution)


def test_polygons_become_cells_and_cells_polygons() -> None:
    grid = angen.Grid(np.full((20, 20), angen.Grid.WALL), (0.0, 0.0), 0.1)
    grid.fill([(0.2, 0.2), (1.2, 0.2), (1.2, 1.2), (0.2, 1.2)], angen.Grid.FREE)
    grid.fill([(0.5, 0.5), (0.8, 0.5), (0.8, 0.8), (0.5, 0.8)], angen.Grid.WALL)
    assert (grid.cells == angen.Grid.FREE).sum() == 100 - 9
    assert grid.number_parts() == [91]
    outline, (hole,) = grid.region(0, 0.05, 0.01)
    assert outline == [pytest.approx(corner) for corner in
                       ((0.2, 0.2), (1.2, 0.2), (1.2, 1.2), (0.2, 1.2))]
    assert hole[0] == pytest.approx((0.5, 0.5)) and len(hole) == 4
    assert grid.region(0, 0.05, 1.0)[1] == []
    assert grid.region(1, 0.05, 0.01) is None


def test_the_storey_at_a_height_is_the_highest_below() -> None:
    heights = np.array([-9.0, -0.4, 2.4, 2.6, 9.0])
    storeys = [(-1, 0.0), (4, 3.0)]
    assert angen.storey_at(storeys, heights).tolist() == [-1, -1, -1, 4, 4]
    assert angen.storey_at(storeys, 2.6) == 4 and angen.storey_at([], 2.6) == 0
