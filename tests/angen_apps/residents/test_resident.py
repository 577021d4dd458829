"""Residents who use the things of a home."""
from __future__ import annotations

import datetime
import math
from dataclasses import replace
from pathlib import Path
from typing import Any, Iterator

import pytest

from angen_apps.data.site import Site, apartment
from angen_apps.residents.activities import Step
from angen_apps.residents.household import Household
from angen_apps.residents.profiles import read
from angen_apps.residents.members import make
from angen_tools.common.failure import Failure
from tests.angen_apps.residents.test_mover import home_of


def test_whoever_opens_a_front_stands_out_of_its_swing(tmp_path):
    """Of a fridge with a freezer above the fridge opens. Nobody is pushed, or has to step back."""
    apartment(tmp_path / 'home.world')
    site, household, anna = home_of(tmp_path / 'home.world')
    steps = [Step(at=('fridge',), opens='fridge'), Step(at=('wardrobe',), opens='wardrobe')]
    modes: dict[str, str] = {}

    def script():
        anna.enter(household.places.anywhere())
        for step in steps:
            for spot in household.places.spots(step):
                yield from anna.go(spot.stand, spot.storey)
                (kind, name, shut), = anna._use(step, spot)
                at = site.simulator.body('anna')
                yield anna.now + 4.0
                modes[name] = site.simulator.state(kind, name)['mode']
                household.do('anna', kind, name, shut)
                yield anna.now + 4.0
                assert site.simulator.state(kind, name)['mode'] == 'CLOSED'
                now = site.simulator.body('anna')
                assert math.dist((at.x, at.y), (now.x, now.y)) < 1e-3

    household.add(script())
    household.run(300.0)
    assert modes == {'kitchen_fridge0': 'OPEN', 'bedroom_wardrobe_b0': 'OPEN'}


def without(path: Path, *models: str) -> None:
    """Writes the furnished apartment without some models."""
    apartment(path)
    text = path.read_text()
    for name in models:
        start = text.rindex('<include>', 0, text.index(name))
        text = text[:start] + text[text.index('</include>', start) + len('</include>'):]
    path.write_text(text)


def test_what_a_home_has_no_place_for_is_left_out_and_said(tmp_path, capfd):
    without(tmp_path / 'home.world', 'kitchen_stove0', 'kitchen_fridge0', 'bathroom_toilet0')
    _, household, anna = home_of(tmp_path / 'home.world')
    lacks = {'cook': 'no stove in reach', 'toilet': 'no toilet in reach'}
    assert anna.leaves_out == lacks
    items = [item.activity for day in range(5) for item in anna.planner.plan(household.day(day))]
    assert not set(items) & set(lacks) and {'eat', 'sleep', 'snack'} <= set(items)
    assert [step.posture for step in anna._known['snack'].steps] == ['sit']  # not at a fridge
    household.residents.clear()
    with pytest.raises(Failure, match='2 remarks'):
        make(household, [('bert', anna.profile)], True)
    assert capfd.readouterr().err.splitlines() == [
        f'angen: bert ({anna.profile.name}) leaves out {name}: the home has {lacks[name]}'
        for name in lacks]


def test_who_finds_the_bed_taken_lies_on_the_floor(tmp_path):
    without(tmp_path / 'home.world', 'livingroom_sofa0')
    _, household, anna = home_of(tmp_path / 'home.world')
    for spot in anna._tasks['sleep'][0]:
        household.take(('spot', spot.key), 'bert')
    sleep = anna._known['sleep']

    def script():
        anna.enter(household.places.anywhere())
        yield from anna._step(sleep, sleep.steps[0], 0, anna.now + 60.0)

    household.add(script())
    household.run(60.0)
    anna.diary.end(household.now)
    does = next(i for i in anna.diary.closed if i.phase == 'does')
    assert (does.posture, does.thing, does.room) == ('lie', '', 'bedroom0')
    assert does.note == 'no place for sleep'


@pytest.mark.parametrize('places, leaves, found', [
    (1, 300.0, ('bed', 310.0, '')), (1, math.inf, ('', 800.0, 'no place for sleep')),
    (2, math.inf, ('bed', 60.0, ''))])
def test_who_finds_another_one_on_the_bed_does_not_stand_all_night(
        places: int, leaves: float, found: tuple[str, float, str], tmp_path: Path) -> None:
    """Bert, who is on a bed that nobody has taken, leaves it, or is still on it."""
    apartment(tmp_path / 'home.world')
    site, household, anna = home_of(tmp_path / 'home.world')
    bert = make(household, [('bert', anna.profile)])[1]
    household._queue.clear()
    sleep, spots = anna._known['sleep'], anna._tasks['sleep'][0][:places]
    anna._tasks['sleep'][0] = spots

    def lies() -> Iterator[float]:
        bert.enter(spots[0], True)
        if leaves < math.inf:
            yield leaves
            yield from bert.go(household.places.anywhere().stand, 0)

    def script() -> Iterator[float]:
        anna.enter(household.places.anywhere())
        yield from anna._step(sleep, sleep.steps[0], 0, 5000.0)

    household.add(lies())
    household.add(script())
    household.run(2000.0)
    household.close()
    thing, soon, note = found
    rows = anna.diary.closed
    last = rows[-1]
    kinds = {t.name: t.type for t in site.home.things}
    assert (last.phase, last.posture, kinds.get(last.thing, ''), last.note) == (
        'does', 'lie', thing, note)
    assert last.start < soon
    assert all(row.posture == 'lie' for row in rows if row.phase == 'does')
    assert places > 1 or any(row.phase == 'waits' and 'bert is on' in row.note for row in rows)


def test_residents_are_at_home_when_a_run_begins_in_the_day(tmp_path):
    """A cat would otherwise come in by the entrance, whose door it cannot open."""
    apartment(tmp_path / 'home.world')
    site = Site(tmp_path / 'home.world', 3, placed=False)
    household = Household(site.simulator, site.floors, 3, 'home', datetime.date(2026, 3, 23),
                          12 * 3600.0)
    cat, = make(household, [('tom', read('cat'))])
    household.run(1.0)
    assert not cat.away and cat.room != 'landing0'


def test_a_cook_goes_among_things_and_a_sitter_gets_up_and_sits_down_again(tmp_path):
    apartment(tmp_path / 'home.world')
    site, household, anna = home_of(tmp_path / 'home.world')
    turns: list[Any] = []
    times: list[float] = []
    fidget = site.simulator.fidget
    site.simulator.fidget = lambda name, to: (turns.append(to), times.append(anna.now),
                                              fidget(name, to))
    cook, relax = anna._known['cook'], anna._known['relax']
    relax = replace(relax, moves=(5.0, 20.0), visits=replace(relax.visits, every=(60.0, 90.0)))

    def script():
        anna.enter(household.places.anywhere())
        stove = [step.runs for step in cook.steps].index('stove')
        yield from anna._step(cook, cook.steps[stove], stove, 180.0)
        yield from anna._step(relax, relax.steps[0], 0, 600.0)
        yield from anna._busy(replace(relax, moves=None, visits=None), 0, anna.spot, 18000.0)

    household.add(script())
    household.run(18000.0)
    anna.diary.end(household.now)
    does = [i for i in anna.diary.closed if i.phase == 'does']
    assert not any(i.note for i in does)
    things = {t.name: t.type for t in site.home.things}
    cooked = [things[i.thing] for i in does if i.activity == 'cook']
    assert len(cooked) > 6 and len(set(cooked)) >= 3 and cooked.count('stove') >= len(cooked) / 3
    assert max(i.end - i.start for i in does if i.activity == 'cook') < 60.0
    postures = [i.posture for i in does if i.activity == 'relax']
    assert postures[:3] == ['sit', 'stand', 'sit'] and anna.posture == 'sit'
    assert len(turns) > 10
    for values, most in (([to.yaw for to in turns], 0.25), ([to.x for to in turns], 0.14),
                         ([to.y for to in turns], 0.14)):
        assert 0.0 < max(values) - min(values) < most
    rests = [after - time for time, after in zip(times, times[1:]) if time > 600.0]
    assert len(rests) > 100 and max(rests) > 180.0  # most are short, and a few long
    assert sum(rest < 10.0 for rest in rests) > 0.7 * len(rests)


def test_who_eats_sits_at_the_table_of_another_who_does(tmp_path):
    apartment(tmp_path / 'home.world')
    _, household, anna = home_of(tmp_path / 'home.world')
    bert = make(household, [('bert', anna.profile)])[1]
    seats = bert._tasks['eat'][0]
    assert bert._in_company(seats, 'eat') == seats and seats[0].room == 'kitchen0'
    for thing in ('livingroom_chair0_a', 'kitchen_chair0_c'):
        seat = next(seat for seat in seats if seat.thing == thing)
        household.held = {('spot', seat.key): 'anna'}
        anna.item = replace(anna.item, activity='relax')
        assert bert._in_company(seats, 'eat') == seats
        anna.item = replace(anna.item, activity='eat')
        others = [other for other in bert._in_company(seats, 'eat') if other != seat]
        assert others[0].room == seat.room


def test_a_cook_does_not_go_to_the_fridge_because_all_else_is_taken(tmp_path):
    apartment(tmp_path / 'home.world')
    _, household, anna = home_of(tmp_path / 'home.world')
    stove = anna._tasks['cook'][-1][0]
    anna._somebody_at = lambda spot: 'fridge' not in spot.thing
    goes = [anna._other(anna._known['cook'].visits, stove) for _ in range(300)]
    assert 0 < len([spot for spot in goes if spot]) < 40
    kept = []
    anna._step = lambda activity, step, index, end: kept.append(step.opens) or iter(())
    for cause in ('free', 'continues'):
        list(anna._do(replace(anna.item, activity='cook', end=600.0, cause=cause)))
    assert kept == ['fridge', '', '', '', '']


def test_two_who_get_up_from_seats_beside_each_other_are_not_in_each_others_way(tmp_path):
    apartment(tmp_path / 'home.world')
    _, household, anna = home_of(tmp_path / 'home.world')
    bert, clara = make(household, [('bert', anna.profile), ('clara', anna.profile)])[1:3]
    goals = anna._tasks['eat'][0]
    beside = [next(seat for seat in anna._tasks['relax'][0] if seat.thing == thing
                   and seat.place.pose[0] > 7.0)
              for thing in ('livingroom_armchair0', 'livingroom_sofa0')]
    found = []

    def script(resident, seat, goal):
        resident.enter(seat, True)
        yield 20.0
        yield from resident.go(goal.stand, 0)
        found.append((resident.name, resident.arrived, household.now < 50.0))

    household._queue.clear()
    for resident, seat, goal in zip((bert, clara), beside, goals):
        household.add(script(resident, seat, goal))
    household.run(100.0)
    assert sorted(found) == [('bert', True, True), ('clara', True, True)]
