"""The parts of a generated day that a page plays."""
import pytest
from angen_apps.web.day import Moment, getting_up, moment_of

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


@pytest.mark.parametrize('activities, expected', [
    ('sleep sleep toilet sleep eat', [2.0, 4.0]),
    ('read sleep sleep eat', [3.0]),  # awake at midnight
    ('eat sleep', []),  # and on the next day
    ('', [])])
def test_one_gets_up_when_another_activity_follows_sleep(activities: str, expected: list[float]
                                                         ) -> None:
    spans = [[float(i), i + 1.0, name] for i, name in enumerate(activities.split())]
    assert getting_up(spans) == expected
