"""A place in each room of a storey, to which a menu sends people and robots."""
import math
from types import SimpleNamespace
from typing import Any

import pytest
from angen_apps.controls.places import INSIDE, Box, Taken, place, rooms, things

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


def placed(home: Home, name: str, taken: Taken = Taken()) -> FloorPose | None:
    found = home.room(name)
    assert found is not None
    return place(home, found, taken)


STAND, SIT = Place('stand', (0.3, 1.0, 0.0, -1.57)), Place('sit', (0.4, 0.4, 0.5, 0.0))
BESIDE_SEAT = Place('stand', (0.5, 0.7, 0.0, -1.57))
THROUGH_WALL = Place('stand', (-0.3, 1.0, 0.0, 0.0))
WINDOW = Door('window', 'window', ('west', ''), 1.0, 1.0, (0.0, 1.0, 1.0, math.pi / 2))
DOOR = Door('door', 'door', ('west', 'east'), 0.9, 2.0, (2.0, 2.0, 0.0, math.pi / 2))


@pytest.mark.parametrize('found, doors, expected', [
    ([stove(SIT, BESIDE_SEAT, STAND)], [DOOR], (0.3, 1.0, 0.0, -1.57)),
    ([stove(THROUGH_WALL)], [WINDOW, DOOR], (2.0 - INSIDE, 2.0, 0.0, math.pi)),
    ([stove(SIT)], [], (1.0, 1.5, 0.0, 0.0))])
def test_places_are_at_a_thing_or_inside_a_door_or_in_the_middle(
        found: list[Thing], doors: list[Door], expected: FloorPose) -> None:
    assert placed(home(found, doors), 'west') == pytest.approx(expected)


def test_a_door_leads_into_the_rooms_on_both_its_sides() -> None:
    assert placed(home([], [DOOR]), 'east') == pytest.approx((2.0 + INSIDE, 2.0, 0.0, 0.0))


def test_the_rooms_are_those_of_the_storey() -> None:
    assert [room.name for room in rooms(home([], []), 0.9)] == ['west', 'east']
    assert [room.name for room in rooms(home([], []), 3.0)] == ['above']
    assert rooms(Home(), 0.0) == []


def test_a_mover_is_not_sent_to_the_place_of_another() -> None:
    found = home([stove(STAND)], [DOOR])
    at = placed(found, 'west', Taken(movers=[(0.3, 1.2)]))
    assert at == pytest.approx((2.0 - INSIDE, 2.0, 0.0, math.pi))
    at = placed(found, 'west', Taken(movers=[(0.3, 1.2), (1.2, 2.0)]))
    assert at is not None and min(math.dist(at[:2], p) for p in ((0.3, 1.2), (1.2, 2.0))) > 0.7


def test_one_does_not_go_into_things() -> None:
    table = Box(1.2, 1.6, math.pi / 2, (0.9, 0.5))
    at = placed(home([], [DOOR]), 'west', Taken([table]))
    assert at is not None and table.distance(*at[:2]) > 0.3 and 0.3 < at[0] < 1.7
    assert placed(home([], []), 'west', Taken([Box(1.0, 1.5, 0.0, (0.9, 1.4))])) is None


def test_things_are_models_on_the_floor() -> None:
    def pose(x: float, z: float, yaw: float = 0.0) -> Any:
        return SimpleNamespace(position=SimpleNamespace(x=x, y=0.0, z=z), orientation=(
            SimpleNamespace(x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2))))

    def shape(link: int, x: float, z: float, height: float, kind: int = 0) -> Any:
        return SimpleNamespace(link=link, type=kind, pose=pose(x, z),
                               size=SimpleNamespace(x=2.0, y=1.0, z=height))

    scene = SimpleNamespace(links=[SimpleNamespace(model='table', pose=pose(3.0, 3.0, math.pi / 2)),
                                   SimpleNamespace(model='robot', pose=pose(0.0, 3.0))], shapes=[
        shape(0, 1.0, 0.5, 1.0), shape(0, 0.0, -0.1, 0.2), shape(0, 0.0, 2.2, 0.2),
        shape(1, 0.0, 0.5, 1.0), shape(0, 0.0, 0.5, 1.0, 3)])
    box, = things(scene, 3.0, {'robot'})
    assert (box.x, box.y, box.yaw) == pytest.approx((3.0, 1.0, math.pi / 2))
    assert box.distance(3.0, 2.5) == pytest.approx(0.5)
