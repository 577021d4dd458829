"""Routes: their files, ways over maps, doors on them, and what cannot be reached."""
from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from angen_tools.failure import Failure
from angen_tools.gridmap import FREE, OCCUPIED, GridMap
from angen_tools.planner import Door, Planner, passages
from angen_tools.route import Drive, Ride, Router, Turn
from angen_tools.route_file import read_route

ROOT = Path(__file__).resolve().parents[2]
POINTS = ('waypoints:\n- {name: a, floor: 0, at: [0.5, 0.5]}\n'
          '- {name: b, floor: 0, at: [3.5, 0.5]}\n')


def two_rooms(floor: int = 0) -> GridMap:
    """4 m x 2 m, with walls all round and one at x = 2 that has a doorway from y = 0.5 to 1.5."""
    cells = np.full((40, 80), FREE, np.int8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    cells[:10, 40] = cells[30:, 40] = OCCUPIED
    return GridMap(cells, (0.0, 0.0), 0.05, floor)


# shut across the doorway; opens into the right room
DOOR = Door('d', (2.0, 0.5), math.pi / 2, 0.0, 1.0)


def route_of(folder: Path, text: str):
    file = folder / 'my.yaml'
    file.write_text(text)
    return read_route(file)


def test_the_stock_route_goes_through_every_room() -> None:
    route = read_route(ROOT / 'src/angen_tools/config/patrol.yaml')
    rooms = {point.name for point in route.waypoints}
    kinds = ('entrance', 'kitchen', 'livingroom', 'bedroom', 'workroom', 'bathroom')
    assert {f'{kind}{floor}' for kind in kinds for floor in (0, 1)} <= rooms
    assert route.elevator.name == 'elevator'


@pytest.mark.parametrize('text, line, part', [
    ('waypoints: [', 1, 'not YAML'),
    ('', 1, 'a route must have'),
    ('speed: 0.4\n', 1, 'no waypoints'),
    ('waypoints: []\n', 1, 'must be a list'),
    ('spede: 0.4\n' + POINTS, 1, "'spede' is not known"),
    (POINTS + 'speed: fast\n', 4, "speed is 'fast', must be a number"),
    (POINTS + 'speed: -1\n', 4, 'speed is -1, must be 0.02 to 2'),
    (POINTS + 'speed: .nan\n', 4, "must be a number"),
    (POINTS + 'robot: a\nrobot: b\n', 5, 'twice'),
    ('waypoints:\n- {name: a, floor: 0, at: [1, 1]}\n- {name: b, floor: 0}\n', 3, 'has no at'),
    ('waypoints:\n- {name: a, floor: 0.5, at: [1, 1]}\n', 2, 'floor is 0.5'),
    ('waypoints:\n- {name: a, floor: 0, at: [1]}\n', 2, 'at must be [x, y]'),
    (POINTS + 'elevator: {name: e}\n', 4, 'has no cabin'),
])
def test_a_wrong_file_is_told_by_line(tmp_path: Path, text: str, line: int, part: str) -> None:
    with pytest.raises(Failure) as caught:
        route_of(tmp_path, text)
    assert str(caught.value).startswith(f'{tmp_path}/my.yaml:{line}: ')
    assert part in str(caught.value)


def test_a_way_keeps_its_distance() -> None:
    grid = two_rooms()
    way = Planner(grid, 0.25).way((0.5, 0.5), (3.5, 0.5))
    rows, columns = np.nonzero(grid.cells == OCCUPIED)
    walls = np.stack([(columns + 0.5), (rows + 0.5)], axis=1) * 0.05
    nearest = min(float(np.linalg.norm(walls - point, axis=1).min()) for point in way)
    assert way[0] == (0.5, 0.5) and way[-1] == (3.5, 0.5)
    assert nearest > 0.2
    assert max(math.dist(a, b) for a, b in zip(way, way[1:])) < 0.15


def test_where_it_is_too_narrow_there_is_no_way() -> None:
    assert Planner(two_rooms(), 0.55).way((0.9, 1.0), (3.1, 1.0)) is None


def test_the_robot_stops_clear_of_a_leaf_on_either_side() -> None:
    way = [(0.5 + 0.1 * i, 1.0) for i in range(31)]
    passage, = passages(way, [DOOR], 0.3)
    assert math.isclose(way[passage.before][0], 1.7, abs_tol=0.11)  # the leaf swings away from it
    assert way[passage.after][0] >= 2.0 + math.sqrt(1.3 ** 2 - 0.5 ** 2) - 1e-9


def test_a_route_through_a_door_opens_and_shuts_it(tmp_path: Path) -> None:
    route = route_of(tmp_path, POINTS + 'clearance: 0.2\n')
    router = Router(route, {0: Planner(two_rooms(), 0.2)}, {0: [DOOR]})
    actions = router.actions((0.5, 1.0), 0)
    assert [type(action) for action in actions] == [Drive, Drive, Turn, Drive, Turn, Drive]
    assert [a.open for a in actions if isinstance(a, Turn)] == [True, False]
    assert [a.name for a in actions if isinstance(a, Drive)] == ['a', '', '', 'b']
    ends = [a.points for a in actions if isinstance(a, Drive)]
    assert all(first[-1] == then[0] for first, then in zip(ends, ends[1:]))


def test_another_floor_is_reached_by_the_elevator(tmp_path: Path) -> None:
    route = route_of(tmp_path, 'waypoints:\n- {name: up, floor: 1, at: [1.0, 1.5]}\n'
                     'elevator: {name: e, cabin: [0.5, 0.5], landing: [1.0, 1.0]}\n')
    router = Router(route, {floor: Planner(two_rooms(floor), 0.2) for floor in (0, 1)}, {})
    actions = router.actions((1.0, 1.5), 0)
    assert [type(action) for action in actions] == [Drive, Ride, Drive, Ride, Drive]
    assert [a for a in actions if isinstance(a, Ride)] == [Ride(0, False), Ride(1, True)]


@pytest.mark.parametrize('point, part', [
    ('{name: far, floor: 0, at: [9, 9]}', 'cannot stand at 9, 9'),
    ('{name: far, floor: 0, at: [2.0, 0.1]}', 'cannot stand'),
    ('{name: far, floor: 3, at: [1, 1]}', 'no floor 3; known are 0'),
    ('{name: far, floor: 0, at: [1.8, 1.0]}', 'within the swing of door d'),
])
def test_what_cannot_be_reached_is_named(tmp_path: Path, point: str, part: str) -> None:
    route = route_of(tmp_path, POINTS + f'- {point}\nclearance: 0.2\n')
    router = Router(route, {0: Planner(two_rooms(), 0.2)}, {0: [DOOR]})
    with pytest.raises(Failure) as caught:
        router.actions((0.5, 1.0), 0)
    assert str(caught.value).startswith(f'{tmp_path}/my.yaml:4: waypoint far: ')
    assert part in str(caught.value)


def test_a_floor_without_an_elevator_cannot_be_reached(tmp_path: Path) -> None:
    route = route_of(tmp_path, 'waypoints:\n- {name: up, floor: 1, at: [1.0, 1.5]}\n')
    router = Router(route, {floor: Planner(two_rooms(floor), 0.2) for floor in (0, 1)}, {})
    with pytest.raises(Failure, match='waypoint up: is on floor 1, and the route names no elev'):
        router.actions((1.0, 1.5), 0)
