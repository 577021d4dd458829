"""Faults happen as often as they are asked for, and each is written down."""
from dataclasses import replace

import pytest

from angen_apps.data.faults import apply, read
from angen_apps.data.recorder import Event
from angen_tools.common.failure import Failure
from tests.angen_apps.data.synthetic import data

COUNT = 4000


def many():
    events = [Event(20.0 * i, 'M001', 'OFF' if i % 2 else 'ON', 'anna', 'eat', 'motion')
              for i in range(COUNT)]
    return replace(data(), events=events)


def given(tmp_path, text):
    file = tmp_path / 'faults.yaml'
    file.write_text(f'faults:\n  - {text}\n')
    return read(file)


def test_drop_outs_are_binomial_and_in_the_truth(tmp_path):
    after, happened = apply(many(), given(tmp_path, '{fault: dropout, share: 0.1, sensors: M*}'))
    lost = COUNT - len(after.events)
    assert lost == len(happened)
    assert abs(lost - 0.1 * COUNT) < 2.58 * (COUNT * 0.1 * 0.9) ** 0.5  # 99 %


def test_a_clock_runs_ahead_and_a_battery_fades(tmp_path):
    after, _ = apply(many(), given(tmp_path, '{fault: clock, seconds_per_day: 8.64}'))
    assert after.events[1000].time == pytest.approx(20000 * (1 + 1e-4))
    after, happened = apply(many(), given(tmp_path, '{fault: battery, from: 10 h, lasts: 5 h}'))
    assert min(h.time for h in happened) >= 36000
    assert max(e.time for e in after.events) < 15 * 3600


def test_stuck_sensors_send_nothing_and_duplicates_twice(tmp_path):
    after, _ = apply(many(), given(tmp_path, '{fault: stuck, from: 1 h, lasts: 2 h}'))
    assert not [e for e in after.events if 3600 <= e.time < 3 * 3600]
    after, happened = apply(many(), given(tmp_path, '{fault: duplicate, share: 1}'))
    assert len(after.events) == 2 * COUNT == 2 * len(happened)


def test_false_alarms_have_no_resident(tmp_path):
    after, happened = apply(data(), given(tmp_path, '{fault: false_alarm, per_day: 200, '
                                                    'sensors: M001}'))
    alarms = [e for e in after.events if e.cause == 'noise']
    assert len(alarms) == 2 * len(happened) and not any(e.resident for e in alarms)
    assert 150 < len(happened) < 250


def test_what_is_wrong_is_said_with_its_line(tmp_path):
    with pytest.raises(Failure, match=r"faults\.yaml:2: .*did you mean dropout"):
        given(tmp_path, '{fault: dropouts, share: 0.1}')
    with pytest.raises(Failure, match=r'faults\.yaml:2: dropout has no share'):
        given(tmp_path, '{fault: dropout}')
