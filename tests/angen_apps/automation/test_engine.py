"""Automations do what Home Assistant documents of theirs."""
import datetime
from pathlib import Path

import pytest

from angen_apps.automation.engine import Sky
from tests.angen_apps.automation.stage import Stage

TRIGGER = '''
- trigger: {platform: state, entity_id: binary_sensor.hall_motion_sensor, to: 'on'%s}
  mode: %s
  action:
    - service: light.turn_on
      target: {entity_id: light.hall_lamp}
    - delay: '00:01:00'
    - service: light.turn_off
      target: {entity_id: light.hall_lamp}
'''
ON = [{'service': 'light.turn_on', 'target': {'entity_id': 'light.hall_lamp'}}]


def one(trigger: str, condition: str = '') -> str:
    """An automation that switches the lamp on."""
    return (f'trigger: {{{trigger}}}\n' + f'condition: {{{condition}}}\n' * bool(condition)
            + 'action: [{service: light.turn_on, entity_id: light.hall_lamp}]\n')


@pytest.mark.parametrize('lasts, mode, called', [
    ('', 'single', [(10, 'turn_on'), (70, 'turn_off')]),
    ('', 'restart', [(10, 'turn_on'), (30, 'turn_on'), (90, 'turn_off')]),
    ('', 'parallel', [(10, 'turn_on'), (30, 'turn_on'), (70, 'turn_off'), (90, 'turn_off')]),
    (', for: 15', 'single', [(45, 'turn_on'), (105, 'turn_off')])])
def test_a_second_trigger_goes_by_the_mode_and_for_counts_while_the_state_stays(
        tmp_path: Path, lasts: str, mode: str, called: list[tuple[float, str]]) -> None:
    stage = Stage(tmp_path, TRIGGER % (lasts, mode))
    for time, on in ((10, True), (20, False), (30, True)):
        stage.motion(time, on)
    stage.until(200)
    assert stage.called == called


def test_for_counts_from_when_a_state_was_left_on_through_others(tmp_path: Path) -> None:
    """`from` alone: 5, 6, 7 is one way of not being 5; it ends with 5."""
    stage = Stage(tmp_path, one('platform: state, entity_id: sensor.hall_light_sensor, from: "5", '
                                'for: 60'))
    for time, lux in ((10, 6.0), (13, 7.0), (40, 6.0), (43, 5.0), (100, 6.0), (103, 7.0)):
        stage.tell(time, 'luminosity', illuminance=lux)
    stage.until(300)
    assert stage.called == [(160, 'turn_on')]


def test_a_condition_that_fails_ends_its_block(tmp_path: Path) -> None:
    """An if's block, not what follows it; at the end of the actions, all that follows."""
    stage = Stage(tmp_path, '''
trigger: {platform: state, entity_id: binary_sensor.hall_motion_sensor, to: 'on'}
action:
  - if: {condition: state, entity_id: sensor.hall_light_sensor, state: '5'}
    then:
      - {condition: state, entity_id: sensor.hall_light_sensor, state: '7'}
      - {service: light.toggle, entity_id: light.hall_lamp}
  - {service: light.turn_on, entity_id: light.hall_lamp}
  - {condition: state, entity_id: sensor.hall_light_sensor, state: '7'}
  - {service: light.turn_off, entity_id: light.hall_lamp}
''')
    stage.motion(10, True)
    stage.until(20)
    assert stage.called == [(10, 'turn_on')]


def test_a_number_triggers_when_it_crosses_the_limit(tmp_path: Path) -> None:
    """5 lx are below 20 from the start on: that is no crossing."""
    stage = Stage(tmp_path, one('platform: numeric_state, entity_id: sensor.hall_light_sensor, '
                                'below: 20'))
    for time, lux in ((10, 4.0), (20, 30.0), (30, 15.0), (40, 10.0), (50, 20.0), (60, 19.0)):
        stage.tell(time, 'luminosity', illuminance=lux)
    assert [time for time, _ in stage.called] == [30, 60]


def test_conditions_of_time_go_over_midnight(tmp_path: Path) -> None:
    """The day begins at 18:00."""
    stage = Stage(tmp_path, one(
        'platform: state, entity_id: binary_sensor.hall_motion_sensor, to: "on"',
        'condition: time, after: "22:00:00", before: "06:00:00"'))
    for hour in (1, 5, 9, 13):  # 19:00, 23:00, 3:00, 7:00
        stage.motion(hour * 3600.0, True)
        stage.motion(hour * 3600.0 + 5.0, False)
    assert [time / 3600.0 for time, _ in stage.called] == [5, 9]


def test_a_time_triggers_each_day(tmp_path: Path) -> None:
    stage = Stage(tmp_path, one('platform: time, at: "07:30:00"'))
    stage.until(2 * 86400.0)
    assert [time / 3600.0 for time, _ in stage.called] == [13.5, 37.5]


@pytest.mark.parametrize('fires, called', [((), [(100, 'turn_on'), (130, 'turn_off')]),
                                           ((110,), [(100, 'turn_on'), (110, 'turn_off')])])
def test_a_wait_ends_by_its_trigger_or_its_timeout(tmp_path: Path, fires: tuple[int, ...],
                                                   called: list[tuple[float, str]]) -> None:
    stage = Stage(tmp_path, '''
trigger: {platform: state, entity_id: binary_sensor.hall_motion_sensor, to: 'on'}
action:
  - {service: light.turn_on, entity_id: light.hall_lamp}
  - wait_for_trigger: {platform: numeric_state, entity_id: sensor.hall_light_sensor, above: 50}
    timeout: {seconds: 30}
  - {service: light.turn_off, entity_id: light.hall_lamp}
''')
    stage.motion(100, True)
    for time in fires:
        stage.tell(time, 'luminosity', illuminance=80.0)
    stage.until(500)
    assert stage.called == called


def test_a_timeout_can_end_the_run(tmp_path: Path) -> None:
    stage = Stage(tmp_path, '''
trigger: {platform: state, entity_id: binary_sensor.hall_motion_sensor, to: 'on'}
action:
  - wait_for_trigger: {platform: state, entity_id: light.hall_lamp}
    timeout: 30
    continue_on_timeout: false
  - {service: light.turn_off, entity_id: light.hall_lamp}
''')
    stage.motion(100, True)
    stage.until(500)
    assert stage.called == []


def test_choices_go_by_the_id_of_the_trigger(tmp_path: Path) -> None:
    stage = Stage(tmp_path, '''
trigger:
  - {platform: state, entity_id: binary_sensor.hall_motion_sensor, to: 'on', id: comes}
  - {platform: state, entity_id: binary_sensor.hall_motion_sensor, to: 'off', id: goes}
action:
  - choose:
      - conditions: {condition: trigger, id: comes}
        sequence: {service: light.turn_on, entity_id: light.hall_lamp}
    default:
      - if: {condition: state, entity_id: sensor.hall_light_sensor, state: '5'}
        then: {service: light.turn_off, entity_id: light.hall_lamp}
''')
    stage.motion(10, True)
    stage.motion(20, False)
    assert stage.called == [(10, 'turn_on'), (20, 'turn_off')]


def test_the_sun_sets_as_the_almanac_says() -> None:
    """48.1 degrees north, local mean time. In Munich (11.6 degrees east, 13.6 min before the
    meridian of Central European Time) timeanddate.com has 18:31 for 2026-03-23 and 6:09 for its
    sunrise; 20:17 less the hour of summer time for 2026-06-21."""
    sky = Sky(datetime.datetime(2026, 3, 23), 48.1)
    for event, clock in (('sunrise', 6 * 60 + 9 - 13.6), ('sunset', 18 * 60 + 31 - 13.6)):
        found = sky.of_day(0.0, event)
        assert found is not None and abs(found / 60.0 - clock) < 2.0, (event, found / 60.0)
