"""Maps of floors: closed forms on small worlds, and the building's rooms."""
from pathlib import Path

import angen
import numpy as np
import pytest
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED, UNKNOWN, load_world, make_map, reached

ROOT = Path(__file__).resolve().parents[3]
BUILDING = str(ROOT / 'worlds/angen.world')
PLUGINS = '''<plugin name="doors" filename="libdoor_world_plugin.so"/>
<plugin name="robots" filename="librobot_controller.so"/>'''
LANDING = (-1.4, 5.0)
ROOMS = {'entrance': (2.0, 5.0), 'kitchen': (3.0, 2.5), 'livingroom': (5.5, 2.0),
         'bedroom': (3.2, 7.0), 'workroom': (8.0, 6.0), 'bathroom': (5.5, 7.0)}


def solid(name: str, pose: str, size: str) -> str:
    return f'''<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link">
  <collision name="c"><geometry><box><size>{size}</size></box></geometry></collision>
  </link></model>'''


def sdf(*models: str) -> str:
    """A slab of 4 x 4 m at z = 0, with models on it."""
    return (f'<sdf version="1.6"><world name="w">{PLUGINS}'
            f'{solid("slab", "0 0 -0.1 0 0 0", "4 4 0.2")}{"".join(models)}</world></sdf>')


def small_world(*models: str) -> angen.World:
    return angen.World.from_text(sdf(*models))


def occupied(grid: Grid) -> set[tuple[float, float]]:
    """The middles of the occupied cells, m."""
    return {tuple(np.round(grid.point(*cell), 3)) for cell in np.argwhere(grid.cells == OCCUPIED)}


def value(grid: Grid, point: tuple[float, float]) -> int:
    return int(grid.cells[grid.cell(*point)])


def test_a_box_is_the_cells_that_hold_its_faces() -> None:
    grid = make_map(small_world(solid('box', '1 -0.5 0.5 0 0 0', '0.3 0.2 1')), 0)
    x, y = np.arange(0.85, 1.151, 0.05), np.arange(-0.6, -0.399, 0.05)
    faces = {(a, b) for a in x for b in y
             if a in (x[0], x[-1]) or b in (y[0], y[-1])}
    assert occupied(grid) == {tuple(np.round(face, 3)) for face in faces}
    assert value(grid, (1.0, -0.5)) == UNKNOWN  # inside
    assert (grid.resolution, grid.height) == (0.05, 0.0)


@pytest.mark.parametrize('pose, size, cells', [
    ('0.325 0.325 0.5 0 0 0', '0.02 0.02 1', 4),     # a table's leg on a corner of four cells
    ('0.4 0.4 0.33 0 0 0', '0.02 0.02 0.02', 1),     # a shelf's end between two heights
    ('0.4 0.4 0.6 0 0 0', '0.2 0.2 0.2', 0),         # higher than a robot
    ('0.4 0.4 0.0 0 0 0', '0.2 0.2 0.03', 0)])       # a sill that it drives over
def test_what_a_robot_can_meet_is_occupied(pose: str, size: str, cells: int) -> None:
    walls = [solid(f'wall{x}', f'{x} 0 0.5 0 0 0', '0.02 2 1') for x in (-1, 1)]
    grid = make_map(small_world(*walls, solid('thing', pose, size)), 0)
    assert len([place for place in occupied(grid) if abs(place[0]) < 0.9]) == cells


def test_robots_are_in_no_map() -> None:
    robot = '<include><uri>model://turtlebot</uri><pose>0 0 0.01 0 0 0</pose></include>'
    wall = solid('wall', '1 0 0.5 0 0 0', '0.1 2 1')
    assert (make_map(small_world(wall, robot), 0).cells
            == make_map(small_world(wall), 0).cells).all()


def test_where_the_floor_ends_nothing_is_known() -> None:
    grid = make_map(small_world(solid('far', '4 0 0.5 0 0 0', '0.1 4 1')), 0)
    assert value(grid, (3.9, 1.0)) == OCCUPIED or value(grid, (3.95, 1.0)) == OCCUPIED
    assert value(grid, (3.5, 1.0)) == UNKNOWN


@pytest.mark.parametrize('floor, doors, free', [(0, 'away', True), (1, 'open', True),
                                                (0, 'shut', False)])
def test_rooms_hang_together_through_their_doors(floor: int, doors: str, free: bool) -> None:
    grid = make_map(load_world(BUILDING), floor, doors)
    landing = np.zeros(grid.cells.shape, bool)
    landing[grid.cell(*LANDING)] = True
    together = reached(landing, grid.cells == FREE)
    for room, place in ROOMS.items():
        assert value(grid, place) == FREE, room
        assert together[grid.cell(*place)] == free, room
    assert together[grid.cell(-3.65, 5.0)]  # the elevator's cabin
    assert value(grid, (-1.0, 1.0)) == UNKNOWN  # outside


def test_what_is_reached_is_connected_by_edges() -> None:
    within = np.array([[1, 1, 0, 1], [0, 1, 0, 1], [0, 0, 1, 0]], bool)
    seeds = np.zeros_like(within)
    seeds[0, 0] = seeds[2, 0] = True  # the second is outside
    assert (reached(seeds, within) == [[1, 1, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]]).all()
