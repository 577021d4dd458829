"""Openings between rooms that touch without a wall."""
from math import cos, pi, sin

import pytest

from angen_apps.plan.model import Opening, Point, Room, Storey, Wall
from angen_apps.plan.passages import passages


def storey(*rooms: list[Point], walls: tuple[Wall, ...] = ()) -> Storey:
    made = Storey(0, 'Ground floor', 0.0, 2.5)
    made.rooms = [Room(f'room{i}', 'other', tuple(points), 0.0, 2.5)
                  for i, points in enumerate(rooms)]
    made.walls = list(walls)
    return made


def box(west: float, south: float, east: float, north: float) -> list[Point]:
    return [(west, south), (east, south), (east, north), (west, north)]


def places(found: list[Opening]) -> list[tuple[float, float, float, float]]:
    return [(o.x, o.y, o.yaw, o.width) for o in found]


def test_each_side_of_a_corner_is_open():
    around = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)]
    found = places(passages(storey(around, box(1.0, 1.0, 4.0, 4.0))))
    assert len(found) == 2
    for x, y, yaw, width in found:
        level = yaw == 0.0
        assert width == pytest.approx(3.0, abs=0.2)
        assert (x, y) == pytest.approx((2.5, 1.0) if level else (1.0, 2.5), abs=0.11)
    assert {yaw for _, _, yaw, _ in found} == {0.0, pi / 2}


def test_a_wall_between_two_openings():
    wall = Wall((1.0, 2.0), (3.0, 2.0), 0.2, 0.0, 2.5, None, (1.0, 1.0, 1.0), 0)
    found = passages(storey(box(0, 0, 4, 2), box(0, 2, 4, 4), walls=(wall,)))
    assert [round(o.width, 1) for o in found] == [1.0, 1.0]
    assert sorted(round(o.x, 1) for o in found) == [0.5, 3.5]


def test_three_rooms_share_a_passage_that_none_of_two_has():
    wall = Wall((0.0, 2.0), (3.2, 2.0), 0.2, 0.0, 2.5, None, (1.0, 1.0, 1.0), 0)
    rooms = [box(0, 0, 4, 2), box(0, 2, 3.6, 4), box(3.6, 2, 4, 4)]
    inner = Wall((3.6, 2.1), (3.6, 4.0), 0.1, 0.0, 2.5, None, (1.0, 1.0, 1.0), 0)
    found = passages(storey(*rooms, walls=(wall, inner)))
    assert [o.width for o in found] == pytest.approx([0.4, 0.4], abs=0.06)
    across = Wall((3.6, 2.0), (4.0, 2.0), 0.2, 0.0, 2.5, None, (1.0, 1.0, 1.0), 0)
    assert not passages(storey(*rooms, walls=(wall, inner, across)))  # 0.4 m is too narrow


@pytest.mark.parametrize('degrees', [10, 30, 40, 50, 60, 80])
def test_an_oblique_line_is_one_opening(degrees):
    c, s = cos(degrees * pi / 180), sin(degrees * pi / 180)

    def turned(points: list[Point]) -> list[Point]:
        return [(x * c - y * s, x * s + y * c) for x, y in points]

    one, = passages(storey(turned(box(0, 0, 3, 2)), turned(box(0, 2, 3, 4))))
    assert (one.x, one.y) == pytest.approx(turned([(1.5, 2.0)])[0], abs=0.1)
    assert one.width == pytest.approx(3.0 * max(c, s), abs=0.1)
