"""Waypoints become actions."""
from pathlib import Path

import pytest

from angen_apps.robot.planner import Planner
from angen_apps.robot.route import Drive, Ride, Router, Turn
from angen_tools.common.failure import Failure
from tests.angen_apps.robot.rooms import DOOR, two_rooms
from tests.angen_apps.robot.test_route_file import POINTS, route_of


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
    ('{name: far, floor: 0, at: [9, 9]}', 'cannot be at 9, 9'),
    ('{name: far, floor: 0, at: [2.0, 0.1]}', 'cannot be at'),
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
