"""The route's file."""
from pathlib import Path

import pytest

from angen_apps.robot.route_file import read_route
from angen_tools.common.failure import Failure

ROOT = Path(__file__).resolve().parents[3]
POINTS = ('waypoints:\n- {name: a, floor: 0, at: [0.5, 0.5]}\n'
          '- {name: b, floor: 0, at: [3.5, 0.5]}\n')


def route_of(folder: Path, text: str):
    file = folder / 'my.yaml'
    file.write_text(text)
    return read_route(file)


def test_the_stock_route_visits_every_room() -> None:
    route = read_route(ROOT / 'src/angen_apps/config/patrol.yaml')
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
def test_a_wrong_file_is_reported_by_line(tmp_path: Path, text: str, line: int, part: str) -> None:
    with pytest.raises(Failure) as caught:
        route_of(tmp_path, text)
    assert str(caught.value).startswith(f'{tmp_path}/my.yaml:{line}: ')
    assert part in str(caught.value)
