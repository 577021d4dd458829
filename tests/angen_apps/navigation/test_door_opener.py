"""Which doors are opened on a path."""
from __future__ import annotations

import pytest
from angen_apps.navigation.door_opener import AHEAD, Doorway, in_the_way
from angen_msgs.msg import DoorState

PATH = [(0.1 * i, 0.0) for i in range(101)]  # 10 m along x
ROBOT = (0.0, 0.0, 0.0)


def doorway(x: float, y: float, z: float = 0.0, mode: int = DoorState.CLOSED) -> Doorway:
    return Doorway('door', (x, y, z), mode)


@pytest.mark.parametrize('door, opened', [
    (doorway(1.5, 0.45), True), (doorway(1.5, -0.45), True),
    (doorway(1.5, 1.2), False),  # beside the path
    (doorway(AHEAD + 2.0, 0.45), False),  # later
    (doorway(1.5, 0.45, 4.0), False),  # upstairs
    (doorway(1.5, 0.45, mode=DoorState.CLOSING), True),
    (doorway(1.5, 0.45, mode=DoorState.AJAR), True),
    (doorway(1.5, 0.45, mode=DoorState.OPENING), False),
    (doorway(1.5, 0.45, mode=DoorState.OPEN), False)])
def test_what_is_shut_and_ahead(door: Doorway, opened: bool) -> None:
    assert in_the_way([door], ROBOT, PATH) == [door] * opened


def test_what_it_has_passed_stays_as_it_is() -> None:
    door = doorway(1.5, 0.45)
    assert in_the_way([door], (4.0, 0.0, 0.0), PATH) == []
    assert in_the_way([door], (0.5, 0.1, 0.0), PATH) == [door]


def test_the_way_counts_along_the_path() -> None:
    around = [(0.1 * i, 0.0) for i in range(31)] + [(3.0 - 0.1 * i, 1.0) for i in range(31)]
    assert in_the_way([doorway(0.0, 1.4)], ROBOT, around) == []  # 1.4 m off, 7 m by the path


def test_without_a_path_no_door_opens() -> None:
    assert in_the_way([doorway(0.5, 0.0)], ROBOT, []) == []
