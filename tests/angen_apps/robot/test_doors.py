"""Doors by their description and the states of their devices."""
import math

import pytest

from angen_apps.robot.doors import door_of
from angen_tools.common.home import Door as Described

SHUT = Described('d_left', 'door', ('hall', 'den'), 0.8, 2.0, (2.0, 1.0, 0.5, math.pi / 2),
                 'd_right')


def test_a_leaf_turns_about_the_hinge_of_its_device() -> None:
    door = door_of(SHUT, {'hinge': [2.02, 0.6, 0.5], 'shut': 1.6, 'opens': -1.5, 'width': 0.81})
    assert (door.hinge, door.shut, door.width, door.partner) == ((2.02, 0.6), 1.6, 0.81, 'd_right')
    assert (door.open, door.bottom, door.top) == (pytest.approx(0.1), 0.5, 2.5)


def test_a_leaf_without_a_hinge_slides() -> None:
    door = door_of(SHUT, {'width': 0.81})
    assert door.shut == door.open and (door.bottom, door.top) == (0.5, 2.5)
    assert door.hinge == pytest.approx((2.0, 0.6)) and door.tip(door.shut) == pytest.approx(
        (2.0, 1.4))
    assert door.room_for((3.0, 1.0)) == pytest.approx(1.0)


def test_a_sliding_leaf_needs_its_way_along_the_wall() -> None:
    door = door_of(SHUT, {'width': 0.81})
    for y in (0.0, 2.0):  # beside it, where the leaf may slide: the shut one is farther away
        assert door.room_for((2.3, y)) == pytest.approx(0.3)
        assert not door.crosses((1.7, y), (2.3, y))
