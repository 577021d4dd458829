"""The parts of a generated day that a page plays."""
from __future__ import annotations

import pytest
from angen_apps.web.day import Moment, moment_of

ROW = {'start': '5.0', 'x': '1.0', 'y': '2.0', 'activity': 'read_a_book', 'phase': 'does',
       'thing': 'sofa', 'posture': 'sit', 'room': 'attic'}
THINGS = {'sofa': {'places': [{'posture': 'sit', 'pose': [1.1, 2.1, 3.4, 0.5]},
                              {'posture': 'sit', 'pose': [9.0, 9.0, 3.4, 0.0]}]}}


@pytest.mark.parametrize('more, expected', [
    ({}, Moment(5.0, 0, 1.1, 2.1, 0.5, 'sitting · read a book', floor=3.0)),
    ({'phase': 'goes'}, Moment(5.0, 0, 1.0, 2.0, None, 'walking · read a book', 1.0, 3.0)),
    ({'room': '', 'phase': 'away'}, Moment(5.0, 0, 1.0, 2.0, 0.0, 'away · read a book')),
])
def test_a_resident_is_on_the_floor_of_its_room(more: dict[str, str], expected: Moment) -> None:
    assert moment_of(ROW | more, THINGS, {'attic': 3.0}) == expected
