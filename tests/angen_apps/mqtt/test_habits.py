"""Habits of hardware, in simulated time."""
from pathlib import Path

import pytest
from angen_apps.mqtt.habits import SHOP, Habits, read
from angen_tools.common.failure import Failure

from tests.angen_apps.mqtt.fakes import Rig


@pytest.fixture
def rig() -> Rig:
    return Rig('pir/hall_pir', 'reed/front', 'temperature/hall', habits=Habits(SHOP))


def at(rig: Rig, now: float) -> list[tuple[str, str]]:
    """What is published at a time, without the simulation's own."""
    rig.world.now = now
    return [each for each in rig.after() if '/simulation/' not in each[0]]


def test_motion_lasts_the_hold_time(rig: Rig) -> None:
    topic = 'angen/pir/hall_pir/motion'
    rig.world.has_summary('pir', 'hall_pir', motion=0.0)
    rig.turns()
    rig.world.has_event('pir', 'hall_pir', 'motion', 10.0)
    assert at(rig, 10.0) == [(topic, 'ON')]
    rig.world.has_event('pir', 'hall_pir', 'still', 11.0)
    assert at(rig, 11.0) == []
    rig.world.has_event('pir', 'hall_pir', 'motion', 60.0)
    assert at(rig, 60.0) == []
    rig.world.has_event('pir', 'hall_pir', 'still', 61.0)
    assert at(rig, 61.0) == [] and at(rig, 150.0) == []
    assert at(rig, 151.5) == [(topic, 'OFF')]


def test_a_reed_is_late(rig: Rig) -> None:
    rig.world.has_summary('reed', 'front', closed=1.0)
    rig.turns()
    rig.world.has_event('reed', 'front', 'opened', 5.0)
    assert at(rig, 5.0) == [] and at(rig, 5.2) == []
    assert at(rig, 5.31) == [('angen/reed/front/open', 'ON')]


def test_a_thermometer_reports_steps_and_hours(rig: Rig) -> None:
    topic = 'angen/temperature/hall/temperature'
    rig.world.has_summary('temperature', 'hall', temperature=20.0)
    rig.turns()
    rig.world.has_summary('temperature', 'hall', temperature=20.1)
    assert at(rig, 60.0) == []
    rig.world.has_summary('temperature', 'hall', temperature=20.2)
    assert at(rig, 120.0) == [(topic, '20.2')]
    rig.world.has_summary('temperature', 'hall', temperature=20.3)
    assert at(rig, 3600.0) == []
    assert (topic, '20.3') in at(rig, 3721.0)


def test_batteries_empty(rig: Rig) -> None:
    topic = 'angen/reed/front/battery'
    rig.turns()
    assert rig.broker.retained[topic] == '100'
    assert rig.broker.json('homeassistant/sensor/angen/reed_front_battery/config')[
        'device_class'] == 'battery'
    rig.world.has_summary('reed', 'front', closed=1.0)
    at(rig, 450 * 86400.0)
    assert rig.broker.retained[topic] == '50'


@pytest.mark.parametrize('text, problem', [
    ('pirr: {hold: 3}', ":1: 'pirr' is not known in the file; did you mean pir"),
    ('pir:\n  hold: long', ":2: hold"), ('pir: {hold: 3, hot: 1}', "'hot' is not known in pir"),
    ('- pir', 'must'), ('pir: {hold: -1}', 'hold')])
def test_errors_have_file_and_line(tmp_path: Path, text: str, problem: str) -> None:
    path = tmp_path / 'habits.yaml'
    path.write_text(text)
    with pytest.raises(Failure) as error:
        read(path)
    assert str(error.value).startswith(f'{path}:') and problem in str(error.value)
