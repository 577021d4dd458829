"""What the bench does not run is told with file and line."""
from pathlib import Path

import pytest

from angen_apps.automation.automation_file import read_automations
from angen_apps.automation.entities import Entities
from angen_tools.common.failure import Failure
from tests.angen_apps.automation.stage import Told

GOOD = '''- alias: Light
  trigger:
    - {platform: state, entity_id: binary_sensor.hall_motion_sensor, to: 'on'}
  action:
    - {service: light.turn_on, target: {entity_id: light.hall_lamp}, data: {brightness_pct: 40}}
'''


def read(folder: Path, text: str) -> list:  # type: ignore[type-arg]
    world = Told()
    entities = Entities(world)  # type: ignore[arg-type]
    (folder / 'a.yaml').write_text(text)
    return read_automations(folder / 'a.yaml', entities)


@pytest.mark.parametrize('old, new, line, words', [
    ('hall_motion', 'hal_motion', 3, 'did you mean binary_sensor.hall_motion_sensor'),
    ("to: 'on'", 'to: bright', 3, "never 'bright'"),
    ('platform: state', 'platform: zwave', 3, 'zwave'),
    ("to: 'on'", "tu: 'on'", 3, "'tu' is not known"),
    ("{platform: state, entity_id: binary_sensor.hall_motion_sensor, to: 'on'}",
     '{platform: numeric_state, entity_id: sensor.hall_light_sensor, above: 30, below: 20}', 3,
     'no number is above 30 and below 20'),
    ('light.turn_on', 'light.turn_onn', 5, 'did you mean light.turn_on'),
    ('light.hall_lamp', 'binary_sensor.hall_motion_sensor', 5, 'is for entities of light'),
    ('brightness_pct: 40', 'brightness_pct: 140', 5, 'not a number of 0 to 100'),
    ('brightness_pct', 'colour', 5, "'colour' is not known"),
    ("to: 'on'", "to: '{{ x }}'", 3, 'templates'),
    ("to: 'on'", "to: 'on', for: soon", 3, 'must be a number'),
    ('service: light.turn_on', 'repeat: 3', 5, "does not run 'repeat'"),
    ('  trigger:', '  mode: queued\n  trigger:', 2, 'queued'),
    ('action', 'actionz', 4, "'actionz' is not known")])
def test_mistakes(tmp_path: Path, old: str, new: str, line: int, words: str) -> None:
    assert old in GOOD
    with pytest.raises(Failure) as error:
        read(tmp_path, GOOD.replace(old, new))
    assert str(error.value).startswith(f'{tmp_path}/a.yaml:{line}: ') and words in str(error.value)


def test_the_words_of_later_releases_mean_the_same(tmp_path: Path) -> None:
    """Home Assistant 2024.10 renamed trigger, platform, action and service."""
    later = (GOOD.replace('trigger:', 'triggers:').replace('action:', 'actions:')
             .replace('platform:', 'trigger:').replace('service:', 'action:'))
    before, = read(tmp_path, GOOD)
    after, = read(tmp_path, later)
    assert (before.triggers, before.actions) == (after.triggers, after.actions)
