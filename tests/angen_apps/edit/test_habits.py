"""Days that are drawn: from profiles, and back to profiles that residents read."""
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from angen_apps.edit.habits import check_day, planned, residents_of, write_profiles
from angen_apps.plan.drawing import from_json
from angen_apps.plan.model import Mover, Planned
from angen_apps.residents.node import read_household
from angen_apps.residents.profiles import names, read
from angen_tools.common.failure import Failure

HOUR = 3600.0


def person(habits: str = 'worker') -> Mover:
    return Mover('ann', 'person', 0.0, 0.0, habits=habits, day=planned(read(habits)))


@pytest.mark.parametrize('profile', names())
def test_the_day_of_each_profile_is_written_as_that_profile(tmp_path: Path, profile: str) -> None:
    usual = read(profile)
    if not usual.lives:  # one who only visits may have no day
        return
    found = write_profiles(tmp_path / 'home.world', {'ann': person(profile)}, 7)
    made = read(found['ann'])
    assert replace(made, name=profile, scheduled=()) == replace(usual, scheduled=())
    for one, other in zip(made.scheduled, usual.scheduled, strict=True):
        assert replace(one, lasts=None) == replace(other, lasts=None)
        assert (one.lasts or ()) == pytest.approx(other.lasts or (), rel=1e-3)


def test_a_day_that_was_changed_is_what_residents_read(tmp_path: Path) -> None:
    world = tmp_path / 'home.world'
    day = [replace(part, low=part.low + HOUR, high=part.high + HOUR) for part in person().day]
    day.append(Planned(('read',), 16.5 * HOUR, 17 * HOUR, 'weekend'))
    people = {'ann': replace(person(), day=tuple(day)),
              'bob': Mover('bob', 'person', 1.0, 0.0, habits='retired'),
              'cid': Mover('cid', 'person', 2.0, 0.0)}
    found = write_profiles(world, people, 7)
    assert found == {'ann': str(tmp_path / 'home_ann.yaml'), 'bob': 'retired'}
    who, seed, starts = read_household(residents_of(world))
    assert [(name, profile.name) for name, profile in who] == [('ann', 'home_ann'),
                                                               ('bob', 'retired')]
    ann = who[0][1]
    assert ann.wakes['weekday'].low == 7.25 * HOUR and starts == 7 * HOUR
    assert ann.sleeps['weekend'].low == 0.0 and ann.sleeps['weekend'].high == 1 * HOUR + 2400
    assert ann.scheduled[-1].do == ('read',) and ann.scheduled[-1].days == 'weekend'
    first = {path: path.read_bytes() for path in tmp_path.iterdir()}
    write_profiles(world, people, 7)
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == first
    (tmp_path / 'home_ann.yaml').write_text('speed: 1\n')
    with pytest.raises(Failure, match='home_ann.yaml: is not of angen edit'):
        write_profiles(world, people, 7)
    assert (tmp_path / 'home_ann.yaml').read_text() == 'speed: 1\n'


@pytest.mark.parametrize('part, why', [
    (Planned(('juggle',), 0.0, HOUR), 'the day of ann: .*juggle'),
    (Planned(('leave',), 0.0, HOUR, lasts=(20 * HOUR, 20 * HOUR)), 'the day of ann: .* awake for'),
    (Planned(('wake', 'eat'), 0.0, HOUR), 'the day of ann: .*wake')])
def test_what_is_no_day(tmp_path: Path, part: Planned, why: str) -> None:
    one = replace(person(), day=(*person().day, part))
    with pytest.raises(Failure, match=why) as failed:
        check_day(one)
    assert str(failed.value).count('\n') == 0 and 'day.yaml' not in str(failed.value)
    with pytest.raises(Failure):
        write_profiles(tmp_path / 'home.world', {'ann': one}, 7)
    assert not list(tmp_path.iterdir())


def test_one_who_never_sleeps() -> None:
    awake = tuple(part for part in person().day if part.do != ('sleep',))
    with pytest.raises(Failure, match='the day of ann must say once when it sleeps on weekdays'):
        check_day(replace(person(), day=awake))


def test_a_day_in_a_drawing_is_checked() -> None:
    def given(**more: Any) -> Any:
        part = {'do': ['eat'], 'low': 0, 'high': 600, **more}
        return from_json({'plan': {'name': 'h', 'storeys': [{
            'number': 0, 'name': '', 'elevation': 0, 'height': 3, 'movers': [
                {'name': 'a', 'kind': 'person', 'x': 0, 'y': 0, 'day': [part]}]}]}}, 'it')
    assert given(lasts=[60, 90]).plan.storeys[0].movers[0].day == (
        Planned(('eat',), 0.0, 600.0, lasts=(60.0, 90.0)),)
    for more in ({'days': 'monday'}, {'low': -1}, {'do': 'eat'}, {'do': ['../x\n']}):
        with pytest.raises(Failure, match=r'it: plan.storeys\[0\].movers\[0\].day\[0\]'):
            given(**more)
