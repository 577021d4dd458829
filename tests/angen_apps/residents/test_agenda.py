"""Days are whole, alone and as their profile says."""
import datetime
import statistics
from dataclasses import replace

import pytest

from angen_apps.residents import profiles
from angen_apps.residents.agenda import Planner
from angen_apps.residents.moods import Day
from angen_tools.common.failure import Failure

MONDAY = Day(0, datetime.date(2026, 3, 23))


def later(days: int) -> Day:
    return Day(days, MONDAY.date + datetime.timedelta(days=days))


@pytest.mark.parametrize('name', profiles.names())
def test_a_day_follows_the_day_before_without_overlap(name):
    planner = Planner(7, 'home', 'anna', profiles.read(name))
    for number in range(14):
        items = planner.plan(later(number))
        following = planner.plan(later(number + 1))
        for a, b in zip(items, items[1:]):
            assert a.start < a.end <= b.start + 1e-6
        if profiles.read(name).lives and items[-1].activity == 'sleep':
            # the last item ends when the resident gets up on the next day
            assert following[0].start + 86400 <= items[-1].end + 4 * 3600


def test_a_day_is_planned_again_alone():
    profile = profiles.read('worker')
    whole = [Planner(7, 'home', 'anna', profile).plan(later(n)) for n in range(5)]
    assert Planner(7, 'home', 'anna', profile).plan(later(3)) == whole[3]
    assert Planner(8, 'home', 'anna', profile).plan(later(3)) != whole[3]


def test_a_worker_is_out_on_workdays_and_sleeps_seven_to_nine_hours():
    planner = Planner(3, 'home', 'anna', profiles.read('worker'))
    out, slept = [], []
    for number in range(50):
        day = later(number)
        items = planner.plan(day)
        if day.kind == 'weekday':
            out.append(sum(i.end - i.start for i in items if i.activity == 'leave') / 3600)
        slept.append(sum(i.end - i.start for i in items if i.activity == 'sleep') / 3600)
    assert 8.5 < statistics.median(out) < 10
    assert 7 < statistics.mean(slept) < 9.2


@pytest.mark.parametrize('other, least', [('retired', 0.8), ('child', 0.8), ('worker', 0.5)])
def test_residents_who_eat_together_wait_for_each_other_and_one_of_them_cooks(other, least):
    """A worker has lunch elsewhere."""
    whole = shared = 0.0
    cooked = []
    for seed in range(3):
        home = [Planner(seed, 'home', name, profiles.read(profile))
                for name, profile in (('anna', 'retired' if other != 'child' else 'worker'),
                                      ('bert', other))]
        for planner in home:
            planner.table = home
        for number in range(30):
            plans = [planner.plan(later(number)) for planner in home]
            eats = [[i for i in items if i.activity == 'eat'] for items in plans]
            whole += sum(i.end - i.start for items in eats for i in items)
            shared += 2 * sum(max(0.0, min(a.end, b.end) - max(a.start, b.start))
                              for a in eats[0] for b in eats[1])
            cooks = [i.start for items in plans for i in items
                     if i.activity == 'cook' and i.cause == 'scheduled']
            cooked.append(len({round(start / 60) for start in cooks}) == len(cooks))
    assert shared > least * whole, shared / whole
    assert all(cooked)


def test_dishes_stand_for_days_and_are_washed_at_once():
    days, washed = 60, {}
    for stand in (0.0, 2.0):
        profile = replace(profiles.read('retired'), dishes=(stand, stand), free={}, needs={})
        items = [item for seed in range(4) for n in range(days)
                 for item in Planner(seed, 'home', 'anna', profile).plan(later(n))
                 if item.activity == 'wash_dishes' and item.cause == 'scheduled']
        washed[stand] = (len(items) / days / 4,
                         statistics.mean(item.end - item.start for item in items))
    assert 2.6 < washed[0.0][0] <= 3.0
    assert 0.35 < washed[2.0][0] < 0.8  # once in two days, more on good ones
    assert 1.6 < washed[2.0][1] / washed[0.0][1] < 2.9


def test_days_of_a_person_and_persons_differ():
    profile = profiles.read('retired')
    usual, spread, hours = [], [], []
    for seed in range(4):
        planner = Planner(seed, 'home', 'anna', profile)
        days = [planner.plan(later(number)) for number in range(100)]
        cooked = [sum(item.activity == 'cook' for item in items) for items in days]
        usual.append(statistics.mean(cooked))
        spread.append(statistics.pstdev(cooked) / usual[-1])
        hours.append(statistics.pstdev(items[0].start / 3600 for items in days))
    assert 0.25 < min(spread) and max(spread) < 0.8, spread
    assert 0.5 < min(hours) and max(hours) < 2.0 and max(hours) - min(hours) > 0.3, hours
    assert statistics.pstdev(usual) > 0.5, usual


def test_an_ill_person_is_at_home_for_days():
    planner = Planner(2, 'home', 'anna', profiles.read('worker'))
    days = [later(number) for number in range(730)]
    ill = [day for day in days if planner.person.mood(day).ill]
    assert 4 <= len(ill) <= 60  # 1 to 4 illnesses a year
    assert sum(planner.person.mood(day.following()).ill for day in ill) >= len(ill) / 2
    left = [any(item.activity == 'leave' for item in planner.plan(day)) for day in ill
            if day.kind == 'weekday']
    assert left.count(True) < len(left) / 2


@pytest.mark.parametrize('change, message', [
    (('watch_tv', 'watch_telly'), r"mine\.yaml:\d+: 'watch_telly' is not an activity; did you"),
    (("{weekday: '6:15-7:00'", "{weekday: '6:15-27:00'"), r'must be two times of day'),
    (('lasts: 8.5-10 h', 'lasts: 20-26 h'), r'of a weekday take 2\d\.\d h, but mine is awake'),
    (('cook: 0.1-0.4', 'cook: 0.4-0.1'), r"cook is '0\.4-0\.1', must be two numbers up to 1 as"),
    (('speed: 1.1', 'sped: 1.1'), r"'sped' is not known in a profile; did you mean"),
])
def test_what_is_wrong_with_a_profile_is_said_with_its_line(tmp_path, change, message):
    text = (profiles.FOLDER / 'worker.yaml').read_text()
    assert change[0] in text
    file = tmp_path / 'mine.yaml'
    file.write_text(text.replace(*change))
    with pytest.raises(Failure, match=message):
        profiles.read(str(file))
