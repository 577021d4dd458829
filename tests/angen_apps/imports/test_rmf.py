"""Buildings of Open-RMF: a small one of our own, whose sizes are known."""
from __future__ import annotations

from math import pi
from pathlib import Path

import pytest

from angen_apps.imports.rmf import read_rmf
from angen_apps.plan.polygons import area
from angen_apps.plan.writer import world_of
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


def test_leaves_slide_and_turn_in_the_world(tmp_path: Path) -> None:
    root, counts = world_of(read_rmf(building(tmp_path)), 'none')
    joints = {joint.get('name'): joint.get('type') for joint in root.iter('joint')}
    assert joints['slide'] == 'prismatic' and joints['hinge'] == 'revolute'
    assert (counts['doors'], counts['lifts']) == (4, 1)
    names = {name.text for name in root.iter('device_name')}
    assert {'L1_slider', 'L1_main_left', 'L1_main_right'} <= names


def test_measurements_that_are_missing_are_an_error(tmp_path: Path) -> None:
    path = building(tmp_path)
    path.write_text(path.read_text().replace('measurements', 'guesses'))
    with pytest.raises(Failure, match=r'yaml:4: the level L1 has no measurements'):
        read_rmf(path)
