"""Maps of floors: closed forms on small worlds, the building's rooms, and map_server's files."""
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import yaml

import angen
from angen_tools import cli
from angen_tools.gridmap import FREE, OCCUPIED, UNKNOWN, GridMap, load_world, make_map, reached

ROOT = Path(__file__).resolve().parents[2]
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


def occupied(grid: GridMap) -> set[tuple[float, float]]:
    """The middles of the occupied cells, m."""
    return {tuple(np.round(grid.point(*cell), 3)) for cell in np.argwhere(grid.cells == OCCUPIED)}


def value(grid: GridMap, point: tuple[float, float]) -> int:
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


def hits(world: angen.World, lidar: str, robot: str) -> np.ndarray:
    """Where a scan meets something, (n, 2) m in the world; the lidar is above the robot."""
    world.want('lidar', lidar)
    world.run(0.2)
    scan = world.sensor('lidar', lidar)
    ranges = np.array(scan['ranges'])
    pose = world.link_poses[world.links.index(f'{robot}::base_footprint')]
    angles = (scan['angle_min'] + scan['angle_increment'] * np.arange(len(ranges))
              + 2 * np.arctan2(pose[5], pose[6]))
    far = np.isfinite(ranges)
    return (pose[:2] + ranges[far, None] *
            np.stack([np.cos(angles), np.sin(angles)], axis=1)[far])


@pytest.mark.parametrize('floor', [0, 1])
def test_the_lidar_meets_what_the_map_says(floor: int) -> None:
    world = load_world(BUILDING)
    for person in world.devices('person'):
        world.delete(person)
    world.spawn('model://turtlebot', 'guest', [5.5, 2.0, 4 * floor + 0.01, 0, 0, 1])
    for door in world.devices('door'):
        world.command('door', door, 'Open')
    world.run(4)
    met = hits(world, 'guest_lidar', 'guest')
    grid = make_map(load_world(BUILDING), floor, 'open')
    cells = np.array([grid.point(*cell) for cell in np.argwhere(grid.cells == OCCUPIED)])
    far = np.hypot(*(met[:, None] - cells[None]).transpose(2, 0, 1)).min(axis=1)
    assert len(met) > 700 and far.mean() < 0.05


def read_as_map_server(path: Path) -> GridMap:
    """What map_server publishes for a yaml file (its rules: wiki.ros.org/map_server)."""
    told = yaml.safe_load(path.read_text())
    assert told['negate'] == 0
    kind, size, depth, shades = (path.parent / told['image']).read_bytes().split(b'\n', 3)
    assert (kind, depth) == (b'P5', b'255')
    columns, rows = map(int, size.split())
    dark = (255 - np.frombuffer(shades, np.uint8).reshape(rows, columns)[::-1]) / 255
    cells = np.where(dark > told['occupied_thresh'], OCCUPIED,
                     np.where(dark < told['free_thresh'], FREE, UNKNOWN))
    assert told['origin'][2] == 0
    return GridMap(cells, tuple(told['origin'][:2]), told['resolution'], 0)


def test_the_files_say_what_the_map_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]
                                         ) -> None:
    world = tmp_path / 'w.world'
    world.write_text(sdf(solid('upper', '0 0 3.9 0 0 0', '4 4 0.2'),
                         solid('box', '1 -0.5 4.5 0 0 0', '0.5 2 1'),
                         solid('wall', '-2 0 4.5 0 0 0', '0.1 4 1')))
    stem = tmp_path / 'up.1'
    assert cli.run(['map', '--world', str(world), '--floor', '1', '-o', str(stem)]) == 0
    grid = make_map(load_world(str(world)), 1)
    assert capsys.readouterr().out == (
        f'wrote {stem}.pgm and {stem}.yaml: floor 1, '
        f'{grid.cells.shape[1]} x {grid.cells.shape[0]} cells of 0.05 m\n')
    read = read_as_map_server(tmp_path / 'up.1.yaml')
    assert (read.cells == grid.cells).all() and set(read.cells.flat) == {FREE, OCCUPIED, UNKNOWN}
    assert read.resolution == grid.resolution
    assert read.origin == pytest.approx(grid.origin, abs=1e-6)


@pytest.mark.parametrize('words, part', [
    (['--floor', '2'], 'worlds/angen.world: there is no floor 2; known are 0, 1'),
    (['--world', f'{ROOT}/worlds/empty.world'], 'empty.world: there is no floor 0; nothing stands'),
    (['--world', 'none.world'], 'none.world'),
    (['-o', 'no/such/folder/map'], 'no/such/folder/map: cannot be written')])
def test_what_is_wrong_is_one_line(words: list[str], part: str, tmp_path: Path,
                                   monkeypatch: pytest.MonkeyPatch,
                                   capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    assert cli.run(['map', *words]) == 1
    line, = capsys.readouterr().err.splitlines()
    assert line.startswith('angen: ') and part in line and not list(tmp_path.iterdir())
