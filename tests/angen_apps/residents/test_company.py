"""Residents with each other: who waits for the bathroom, watches TV with another one, and talks."""
from __future__ import annotations

import datetime
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from angen_apps.data.site import Site, apartment
from angen_apps.plan.apartment import apartment as plan
from angen_apps.plan.writer import write_world
from angen_apps.residents.agenda import Item
from angen_apps.residents.household import Household
from angen_apps.residents.members import make
from angen_apps.residents.profiles import Profile, read


def two(path: Path, **habits: tuple[float, float]) -> tuple[Site, Household, list[Any]]:
    """Two retired people with these habits, in a home, whose days have not begun."""
    site = Site(path, 3, placed=False)
    household = Household(site.simulator, site.floors, 3, 'home', datetime.date(2026, 3, 23),
                          12 * 3600.0)
    profile: Profile = replace(read('retired'), guests=(0.0, 0.0), **habits)
    who = make(household, [('anna', profile), ('bert', profile)])
    household._queue.clear()
    return site, household, [one for one in who if one.profile.lives]


def script(household: Household, one: Any, start: str, *items: Item) -> None:
    """Has one appear at the first place of an activity and do items."""
    one.enter(one._tasks[start][-1][0])
    one.settle(one._tasks[start][-1][0])
    household.take(('spot', one.spot.key), one.name)
    one.item = replace(one.item, activity=start)
    one._note('does', start)

    def run():
        for item in items:
            yield from one._do(item)

    household.add(run())


@pytest.mark.parametrize('queues', [0.0, 1.0])
def test_who_finds_the_bathroom_taken_waits_at_its_door_or_goes_on(tmp_path, queues):
    apartment(tmp_path / 'home.world')
    site, household, (anna, bert) = two(tmp_path / 'home.world', queues=(queues, queues))
    anna.enter(anna._tasks['wash'][0][0])
    household.take(('room', 'bathroom0'), 'anna')
    script(household, bert, 'relax', Item(20.0, 400.0, 'toilet', 'interrupts'))
    household.run(200.0)
    assert bert.room != 'bathroom0'
    waits = [i for i in (*bert.diary.closed, bert.diary.now) if i.phase == 'waits']
    if queues:
        door = next(d for d in site.home.doors if d.name == 'bathroom0')
        assert bert.posture == 'stand' and waits[-1].activity == 'toilet'
        assert 1.0 < math.dist(bert.at, door.pose[:2]) < 1.6
    else:
        assert bert.posture == 'sit' and not waits and bert.item.activity == 'relax'
    household.leave(('room', 'bathroom0'), 'anna')
    anna.vanish()
    household.run(300.0)
    assert (bert.room, bert.diary.now.activity) == ('bathroom0', 'toilet')


def test_each_of_two_bathrooms_is_used_by_one(tmp_path):
    write_world(plan(1, 2, 7), tmp_path / 'two.world')
    _, household, (anna, bert) = two(tmp_path / 'two.world')
    toilet = anna._known['toilet']
    bert.storey = 0
    assert bert._rooms(toilet) == ['bathroom0', 'bathroom1']
    bert.storey = 1
    assert bert._rooms(toilet) == ['bathroom1', 'bathroom0']
    household.take(('room', 'bathroom0'), 'anna')
    household.take(('room', 'bathroom1'), 'bert')
    for one, room in ((anna, 'bathroom0'), (bert, 'bathroom1')):
        assert {spot.room for spot in one._of_own(toilet, one._tasks['toilet'][0])} == {room}
    household.leave(('room', 'bathroom1'), 'bert')
    assert not bert._of_own(toilet, bert._tasks['toilet'][0])


@pytest.mark.parametrize('joins', [0.0, 1.0])
def test_who_has_time_watches_tv_with_another_one(tmp_path, joins):
    apartment(tmp_path / 'home.world')
    _, household, (anna, bert) = two(tmp_path / 'home.world', joins=(joins, joins))
    script(household, anna, 'watch_tv', Item(1.0, 500.0, 'watch_tv', 'free'))
    script(household, bert, 'relax', Item(30.0, 200.0, 'read', 'free'),
           Item(200.0, 230.0, 'take_medicine', 'interrupts'),
           Item(230.0, 500.0, 'read', 'continues'))
    household.run(60.0)
    assert bert.item.activity == ('watch_tv' if joins else 'read')
    household.run(400.0)
    assert bert.item.activity == ('watch_tv' if joins else 'read')
    if joins:
        assert bert.room == anna.room and math.dist(anna.at, bert.at) < 2.5


@pytest.mark.parametrize('talks', [0.0, 1.0])
def test_two_in_a_room_talk_in_turn_and_are_turned_to_each_other(tmp_path, talks):
    apartment(tmp_path / 'home.world')
    site, household, (anna, bert) = two(tmp_path / 'home.world', talks=(talks, talks))
    for one in (anna, bert):
        script(household, one, 'relax', Item(1.0, 900.0, 'watch_tv', 'scheduled'))
    turned = []

    def heard():
        speaks = [one for one in (anna, bert)
                  if site.simulator.state('person', one.name)['speaking']]
        assert len(speaks) < 2
        if speaks:
            turned.append((aside(site, anna, bert), aside(site, bert, anna)))

    household.heard = heard
    household.run(910.0)  # the last talk ends with the item
    said = sorted([*anna.talks, *bert.talks])
    if not talks:
        assert not said and not turned
        return
    assert len(said) > 8 and {talk.resident for talk in said} == {'anna', 'bert'}
    assert all(talk.to != talk.resident and 0.5 < talk.end - talk.start < 23.0 for talk in said)
    assert all(before.end <= after.start + 1e-6 for before, after in zip(said, said[1:]))
    assert turned and all(min(both) >= 0.0 for both in turned)
    assert not any(site.simulator.state('person', one.name)['speaking'] for one in (anna, bert))


def aside(site: Site, one: Any, other: Any) -> float:
    """How far (rad) one is turned to the side of another one; less than 0: away."""
    x, y = other.at[0] - one.at[0], other.at[1] - one.at[1]
    ahead = site.simulator.body(one.name).yaw - one._turned
    return one._turned * math.copysign(1.0, math.remainder(math.atan2(y, x) - ahead, 2 * math.pi))


def test_sensors_see_that_somebody_on_a_seat_leans(tmp_path):
    apartment(tmp_path / 'home.world')
    site = Site(tmp_path / 'home.world', 3)
    household = Household(site.simulator, site.floors, 3, 'home', datetime.date(2026, 3, 23))
    anna = make(household, [('anna', read('retired'))])[0]
    household._queue.clear()
    seen = []

    def moves():
        for activity, thing in (('eat', 'kitchen_chair'), ('watch_tv', 'sofa'), ('read', 'arm')):
            spot = next(s for s in anna._tasks[activity][-1] if thing in s.thing)
            anna.enter(spot, True)
            anna.settle(spot)
            yield anna.now + 40.0
            for _ in range(20):
                site.world.events()
                yield from anna._move()
                yield anna.now + 10.0
                seen.append(any(event == 'motion' for _, _, kind, event, _ in site.world.events()
                                if kind == 'pir'))
            anna.vanish()

    household.add(moves())
    household.run(800.0)
    assert len(seen) == 60 and sum(seen) > 15, seen
