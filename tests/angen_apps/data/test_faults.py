"""Faults of a YAML file: in the home's sensors, and each in the truth. tests/py/test_faults.py has
what each does."""
from collections import Counter

import pytest

from angen_apps.data.faults import give, read
from angen_apps.data.site import Site, apartment
from angen_apps.data.recorder import Recorder
from angen_apps.residents.household import Household
from angen_tools.common.failure import Failure
import datetime


def given(tmp_path, *texts):
    file = tmp_path / 'faults.yaml'
    file.write_text('faults:\n' + ''.join(f'  - {text}\n' for text in texts))
    return read(file)


@pytest.fixture(name='site')
def home_site(tmp_path):
    apartment(tmp_path / 'home.world')
    return Site(tmp_path / 'home.world', 7)


def recorded(site, seconds):
    """A recording while no one is at home and the doors of two rooms move."""
    household = Household(site.simulator, site.floors, 7, 'home', datetime.date(2026, 3, 23))
    recorder = Recorder(site, household)
    recorder.start()
    for door in ('Open', 'Close'):
        for room in ('kitchen0', 'bathroom0'):
            site.world.command('door', room, door)
        household.run(household.now + 10.0)
    household.run(seconds)
    return recorder.recording


def test_faults_reach_the_data_and_the_truth(site, tmp_path):
    give(site, given(tmp_path, '{fault: false_alarm, per_day: 400, sensors: M001}',
                     '{fault: delay, by: 2-2 min, sensors: D*}',
                     '{fault: moved, from: 0.1 h, yaw: 0.3, sensors: M002}'))
    left = recorded(site, 7200.0)
    doors = [e for e in left.events if e.sensor[0] == 'D' and e.time > 60.0]
    late = [h for h in left.faults if h.fault == 'delay']
    assert len(doors) == len(late) >= 3
    assert sorted(e.time for e in doors) == pytest.approx(sorted(h.time + 120.0 for h in late))
    alarms = [e for e in left.events if e.sensor == 'M001' and e.value == 'ON']
    count = Counter(h.fault for h in left.faults)
    assert count['false_alarm'] == len(alarms) and 15 < len(alarms) < 55  # 33.3
    assert {e.cause for e in alarms} == {'noise'} and count['moved'] == 1


def test_what_is_wrong_is_said_with_its_line(site, tmp_path):
    with pytest.raises(Failure, match=r"faults\.yaml:2: .*did you mean dropout"):
        given(tmp_path, '{fault: dropouts, share: 0.1}')
    with pytest.raises(Failure, match=r'faults\.yaml:2: dropout has no share'):
        given(tmp_path, '{fault: dropout}')
    with pytest.raises(Failure, match=r"faults\.yaml:2: no sensor with this fault matches 'X'"):
        give(site, given(tmp_path, '{fault: dropout, share: 0.1, sensors: X}'))
