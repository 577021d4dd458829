"""A place in each room of a storey, to which a menu sends people and robots."""
from __future__ import annotations

import math

import pytest
from angen_apps.controls.places import INSIDE, places

from angen_tools.common.home import Door, FloorPose, Home, Place, Room, Storey, Thing


def room(name: str, x: float, storey: int = 0) -> Room:
    """2 m x 3 m, from x."""
    corners = [(x, 0.0), (x + 2.0, 0.0), (x + 2.0, 3.0), (x, 3.0)]
    return Room(name, 'other', storey, corners, [], 3.0 * storey, 3.0 * storey + 2.5, 6.0, False)


def home(things: list[Thing], doors: list[Door]) -> Home:
    return Home(storeys=[Storey(0, 'lower', 0.0, 3.0), Storey(1, 'upper', 3.0, 2.5)],
                rooms=[room('west', 0.0), room('east', 2.0), room('above', 0.0, 1)],
                things=things, doors=doors)


def stove(*places: Place) -> Thing:
    return Thing('stove', 'stove', 'west', (0.3, 0.3, 0.0, 0.0, 0.0, 0.0, 1.0), list(places))


STAND, SIT = Place('stand', (0.3, 1.0, 0.0, -1.57)), Place('sit', (0.4, 0.4, 0.5, 0.0))
BESIDE_SEAT = Place('stand', (0.5, 0.7, 0.0, -1.57))
THROUGH_WALL = Place('stand', (-0.3, 1.0, 0.0, 0.0))
WINDOW = Door('window', 'window', ('west', ''), 1.0, 1.0, (0.0, 1.0, 1.0, math.pi / 2))
DOOR = Door('door', 'door', ('west', 'east'), 0.9, 2.0, (2.0, 2.0, 0.0, math.pi / 2))


@pytest.mark.parametrize('things, doors, expected', [
    ([stove(SIT, BESIDE_SEAT, STAND)], [DOOR], (0.3, 1.0, 0.0, -1.57)),
    ([stove(THROUGH_WALL)], [WINDOW, DOOR], (2.0 - INSIDE, 2.0, 0.0, math.pi)),
    ([stove(SIT)], [], (1.0, 1.5, 0.0, 0.0))])
def test_one_stands_at_a_thing_or_inside_a_door_or_in_the_middle(
        things: list[Thing], doors: list[Door], expected: FloorPose) -> None:
    found = dict(places(home(things, doors), 0.0))
    assert found['west'] == pytest.approx(expected)


def test_a_door_leads_into_the_rooms_on_both_its_sides() -> None:
    found = dict(places(home([], [DOOR]), 0.0))
    assert found['east'] == pytest.approx((2.0 + INSIDE, 2.0, 0.0, 0.0))


def test_the_rooms_are_those_of_the_storey() -> None:
    assert [name for name, _ in places(home([], []), 0.9)] == ['west', 'east']
    assert [name for name, _ in places(home([], []), 3.0)] == ['above']
    assert places(Home(), 0.0) == []
