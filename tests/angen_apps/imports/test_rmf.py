"""Buildings of Open-RMF: a small one of our own, whose sizes are known."""
from math import pi
from pathlib import Path

import angen
import pytest

from angen_apps.imports.rmf import read_rmf
from angen_apps.maps.gridmap import load_world
from angen_apps.plan.polygons import area
from angen_apps.plan.writer import world_of, write_world
from angen_apps.robot.building import Survey
from angen_apps.robot.planner import passages
from angen_bench import homes
from angen_tools.common.failure import Failure

# 0.05 m a pixel: two rooms of 5 x 4 m on L1, with y down; L2 is 3 m higher, drawn 20 pixels lower
LEVEL = '''
    elevation: {z}
    measurements: [[0, 1, {{distance: [3, 10.0]}}]]
    fiducials: [[0, {shift}, f], [200, {shift}, g]]
    vertices: [[0, {a}, 0, ""], [200, {a}, 0, ""], [200, {b}, 0, ""], [0, {b}, 0, ""],
               [100, {a}, 0, ""], [100, {b}, 0, ""], [40, {c}, 0, store], [100, {d}, 0, ""],
               [100, {e}, 0, ""], [20, {b}, 0, ""], [60, {b}, 0, ""]]
    walls: [[0, 4, {{}}], [4, 1, {{}}], [1, 2, {{}}], [2, 5, {{}}], [5, 10, {{}}], [9, 3, {{}}],
            [3, 0, {{}}], [4, 7, {{}}], [8, 5, {{}}]]
    doors: [[7, 8, {{type: [1, sliding], name: [1, {name}_slider]}}],
            [9, 10, {{type: [1, double_hinged], name: [1, {name}_main], motion_degrees: [3, 90],
                      motion_direction: [2, 1], right_left_ratio: [3, 1]}}]]
    lanes: [[0, 1, {{}}]]
'''


def building(tmp_path: Path) -> Path:
    levels = ''.join(f'  {name}:' + LEVEL.format(z=z, shift=s, a=s, b=s + 80, c=s + 20, d=s + 30,
                                                 e=s + 50, name=name)
                     for name, z, s in (('L1', 0.0, 0), ('L2', 3.0, 20)))
    lift = '''lifts:
  Lift1: {x: 230, y: 40, yaw: 0, width: 1.6, depth: 1.4, reference_floor_name: L1,
          level_doors: {L1: [d], L2: [d]}, doors: {d: {door_type: 2, width: 1.0, x: -0.9, y: 0}}}
'''
    path = tmp_path / 'small.building.yaml'
    path.write_text(f'name: small\nlevels:\n{levels}{lift}')
    return path


def test_levels_walls_doors_and_lifts(tmp_path: Path) -> None:
    plan = read_rmf(building(tmp_path))
    assert [(s.number, s.name, s.elevation) for s in plan.storeys] == [(0, 'L1', 0.0),
                                                                       (1, 'L2', 3.0)]
    assert [len(s.walls) for s in plan.storeys] == [9, 9]
    assert sorted(o.name for o in plan.all_openings()) == ['L1_main', 'L1_slider', 'L2_main',
                                                           'L2_slider']
    lift, = plan.lifts
    assert (lift.name, lift.stops) == ('Lift1', (0, 1))
    # its door is at -x, so that the cabin's depth is along x
    assert (abs(lift.yaw), lift.width, lift.depth) == (pytest.approx(pi), 1.4, 1.6)


def test_scale_and_fiducials_put_levels_over_each_other(tmp_path: Path) -> None:
    plan = read_rmf(building(tmp_path))
    for storey in plan.storeys:
        x = [p[0] for wall in storey.walls for p in (wall.start, wall.end)]
        y = [p[1] for wall in storey.walls for p in (wall.start, wall.end)]
        assert (min(x), max(x)) == (pytest.approx(0.0), pytest.approx(10.0))
        assert (min(y), max(y)) == (pytest.approx(-4.0), pytest.approx(0.0))


def test_rooms_are_found_and_named_by_a_vertex(tmp_path: Path) -> None:
    plan = read_rmf(building(tmp_path))
    ground = plan.storeys[0].rooms
    assert 'store0' in {room.name for room in ground} and len(ground) == 2
    for room in ground:
        assert area(room.polygon) == pytest.approx(4.9 * 3.9, abs=0.3)


def test_what_is_not_read_is_listed(tmp_path: Path) -> None:
    assert any('not read: 2 lanes' in remark for remark in read_rmf(building(tmp_path)).remarks)


def test_a_door_between_the_ends_of_walls_needs_no_remark(tmp_path: Path) -> None:
    assert not [r for r in read_rmf(building(tmp_path)).remarks if 'in no wall' in r]
    path = building(tmp_path)
    path.write_text(path.read_text().replace('[8, 5, {}]', '[9, 3, {}]'))
    assert [r for r in read_rmf(path).remarks if 'in no wall' in r] == [
        f'the door "{name}_slider" at 5.00 -2.00 is in no wall' for name in ('L1', 'L2')]


def test_leaves_slide_and_turn_in_the_world(tmp_path: Path) -> None:
    root, counts = world_of(read_rmf(building(tmp_path)), 'none')
    joints = {joint.get('name'): joint.get('type') for joint in root.iter('joint')}
    assert joints['slide'] == 'prismatic' and joints['hinge'] == 'revolute'
    assert (counts['doors'], counts['lifts']) == (4, 1)
    names = {name.text for name in root.iter('device_name')}
    assert {'L1_slider', 'L1_main_left', 'L1_main_right'} <= names


def test_a_telescope_slides_and_a_door_may_have_no_name(tmp_path: Path) -> None:
    path = building(tmp_path)
    path.write_text(path.read_text().replace('[1, sliding], name: [1, L1_slider]',
                                             '[1, telescope], name: [1, ""]'))
    ground = read_rmf(path).storeys[0]
    door, = (o for o in ground.openings if o.name != 'L1_main')
    assert door.name == 'room0' or door.name == 'store0'
    assert [abs(leaf.slide) for leaf in door.leaves] == [pytest.approx(1.0)]


def test_measurements_that_are_missing_are_an_error(tmp_path: Path) -> None:
    path = building(tmp_path)
    path.write_text(path.read_text().replace('measurements', 'guesses'))
    with pytest.raises(Failure, match=r'yaml:4: the level L1 has no measurements'):
        read_rmf(path)


def test_a_lift_serves_levels_of_unequal_height_through_their_ceilings(tmp_path: Path) -> None:
    """The shaft is in a room: its ceilings at 2.5 m and the floors above must leave it free."""
    levels = ''.join(f'''  L{i}:
    elevation: {z}
    measurements: [[0, 1, {{distance: [3, 10.0]}}]]
    vertices: [[0, 0, 0, ""], [200, 0, 0, ""], [200, 160, 0, ""], [0, 160, 0, ""]]
    walls: [[0, 1, {{}}], [1, 2, {{}}], [2, 3, {{}}], [3, 0, {{}}]]
''' for i, z in enumerate((0.0, 4.0, 7.5)))
    path = tmp_path / 'three.building.yaml'
    path.write_text(f'''levels:
{levels}lifts:
  Lift1: {{x: 100, y: 80, yaw: 0.3, width: 2.0, depth: 1.8, reference_floor_name: L0,
          level_doors: {{L0: [d], L1: [d], L2: [d]}},
          doors: {{d: {{door_type: 2, width: 0.9, x: 0, y: 1.0}}}}}}
''')
    write_world(read_rmf(path), tmp_path / 'three.world', 'none')
    world = angen.World(str(tmp_path / 'three.world'))
    for floor, height in ((2, 7.5), (1, 4.0)):
        world.command('elevator', 'Lift1', f'Floor{floor}')
        world.run(20.0)
        state = world.device('elevator', 'Lift1')
        assert (state['mode'], state['door_mode']) == ('IDLE', 'OPEN')
        assert state['position'] == pytest.approx(height, abs=0.005)


def test_a_cabin_fits_its_shaft(tmp_path: Path) -> None:
    path = tmp_path / 'tight.building.yaml'
    path.write_text('''levels:
  L1:
    elevation: 0
    measurements: [[0, 1, {distance: [3, 10.0]}]]
    vertices: [[0, 0, 0, ""], [200, 0, 0, ""], [200, 160, 0, ""], [0, 160, 0, ""],
               [80, 60, 0, ""], [120, 60, 0, ""], [120, 100, 0, ""], [80, 100, 0, ""],
               [90, 100, 0, ""], [110, 100, 0, ""]]
    walls: [[0, 1, {}], [1, 2, {}], [2, 3, {}], [3, 0, {}],
            [4, 5, {}], [5, 6, {}], [7, 4, {}], [7, 8, {}], [9, 6, {}]]
lifts:
  Lift1: {x: 100, y: 80, yaw: 0, width: 2.0, depth: 2.0, reference_floor_name: L1,
          level_doors: {L1: [d]}, doors: {d: {door_type: 2, width: 0.9, x: 0, y: -1.0}}}
''')
    plan = read_rmf(path)
    # the shaft's walls are 2 m apart and 0.1 m thick
    assert plan.lifts[0].width < 1.9 and plan.lifts[0].depth < 1.9
    assert any('the cabin of Lift1' in remark for remark in plan.remarks)


def test_leaves_slide_where_their_wall_is_askew_and_turn_beside_its_end(tmp_path: Path) -> None:
    path = tmp_path / 'askew.building.yaml'
    path.write_text('''levels:
  L1:
    elevation: 0
    measurements: [[0, 1, {distance: [3, 10.0]}]]
    vertices: [[0, 0, 0, ""], [200, 0, 0, ""], [200, 160, 0, ""], [0, 160, 0, ""],
               [0, 82, 0, ""], [80, 80, 0, ""], [120, 80, 0, ""], [200, 78, 0, ""],
               [100, 160, 0, ""], [100, 100, 0, ""], [100, 80, 0, ""], [160, 79, 0, ""]]
    walls: [[0, 1, {}], [1, 2, {}], [2, 8, {}], [8, 3, {}], [3, 0, {}], [4, 5, {}], [6, 7, {}],
            [8, 9, {}]]
    doors: [[5, 6, {type: [1, double_sliding], name: [1, slider]}],
            [9, 10, {type: [1, hinged], name: [1, turner]}]]
''')
    write_world(read_rmf(path), tmp_path / 'askew.world', 'none')
    states = homes.open_all(angen.World(str(tmp_path / 'askew.world')))
    assert {name for _, name in states} == {'slider_left', 'slider_right', 'turner'}
    assert {mode for mode, _, _ in states.values()} == {'OPEN'}


def test_a_robot_knows_the_doors_that_slide(tmp_path: Path) -> None:
    path = tmp_path / 'small.world'
    write_world(read_rmf(building(tmp_path)), path, 'none')
    shut = load_world(str(path))
    survey = Survey(load_world(str(path)), shut, {0})
    doors = {door.name: door for door in survey.doors[0]}
    slider = doors['L1_slider']
    assert slider.width == pytest.approx(1.0, abs=0.15)
    assert slider.crosses((4.5, -2.0), (5.5, -2.0))
    assert not slider.crosses((4.5, -1.2), (5.5, -1.2))
    assert slider.room_for((4.5, -2.0)) == pytest.approx(0.5, abs=0.1)
    found = passages([(3 + 0.1 * i, -2.0) for i in range(41)], list(doors.values()), 0.3)
    assert [passage.door.name for passage in found] == ['L1_slider']
