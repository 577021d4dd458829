"""Which doors are opened on a path."""
import pytest
from angen_apps.navigation.door_opener import AHEAD, in_the_way

PATH = [(0.1 * i, 0.0) for i in range(101)]  # 10 m along x
ROBOT = (0.0, 0.0, 0.0)


@pytest.mark.parametrize('place, opened', [
    ((1.5, 0.45, 0.0), True), ((1.5, -0.45, 0.0), True),
    ((1.5, 1.2, 0.0), False),  # beside the path
    ((AHEAD + 2.0, 0.45, 0.0), False),  # later
    ((1.5, 0.45, 4.0), False)])  # upstairs
def test_what_is_ahead(place: tuple[float, float, float], opened: bool) -> None:
    assert in_the_way({'door': place}, ROBOT, PATH) == ['door'] * opened


def test_what_it_has_passed_stays_as_it_is() -> None:
    doors = {'door': (1.5, 0.45, 0.0)}
    assert in_the_way(doors, (4.0, 0.0, 0.0), PATH) == []
    assert in_the_way(doors, (0.5, 0.1, 0.0), PATH) == ['door']


def test_the_way_counts_along_the_path() -> None:
    around = [(0.1 * i, 0.0) for i in range(31)] + [(3.0 - 0.1 * i, 1.0) for i in range(31)]
    assert in_the_way({'door': (0.0, 1.4, 0.0)}, ROBOT, around) == []  # 1.4 m off, 7 m by the path


def test_without_a_path_no_door_opens() -> None:
    assert in_the_way({'door': (0.5, 0.0, 0.0)}, ROBOT, []) == []
