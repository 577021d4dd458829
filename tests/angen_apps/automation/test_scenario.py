"""Mistakes in a scenario are told with file and line."""
from pathlib import Path

import pytest

from angen_apps.automation.scenario import read_scenario
from angen_tools.common.failure import Failure

GOOD = '''start: 2026-03-23 21:00
lasts: 20 min
people: [{name: anna, at: bedroom0}]
script: [{at: 2 min, do: anna goes to kitchen0}]
automation: light.yaml
expect:
  - {expect: light.hall is on, within: 2 s, of: anyone in kitchen0}
'''


def test_a_time_of_day_is_from_the_start_on(tmp_path: Path) -> None:
    path = tmp_path / 's.yaml'
    path.write_text(GOOD.replace('lasts: 20 min', 'lasts: 2 d').replace('2 min,', "'1d 6:30',"))
    assert read_scenario(path).script[0].time == (24 - 21 + 6.5) * 3600


@pytest.mark.parametrize('old, new, line, words', [
    ('20 min', 'twenty', 2, 'is not a duration'),
    ('2026-03-23 21:00', 'monday', 1, 'must be as 2026-03-23 18:00'),
    ('2 min', '30 min', 4, 'is not within the scenario'),
    ('at: 2 min', "at: '20:59'", 4, 'is not within the scenario'),
    ('within: 2 s', 'within: 30 min', 7, 'can never be judged'),
    ('within: 2 s, ', '', 7, 'has no within'),
    ('light.hall is on', 'the hall is bright', 7, 'is no claim'),
    ('light.hall is on', 'light.hall is on and light.hall is off', 7, 'is a contradiction'),
    ('light.hall is on', 'sensor.lux above 30 and sensor.lux below 20', 7, 'is a contradiction'),
    ('within: 2 s', 'within: 2 s, while: "time 9:00 to 20:59"', 7, 'is never within the scenario'),
    ('expect: light.hall', 'hope: light.hall', 7, 'has one of expect, never'),
    ('{expect: light.hall is on, within: 2 s, of: anyone in kitchen0}',
     '{at_most: much, energy_of: light.hall}', 7, 'an energy as 0.5 kWh'),
    ('{expect: light.hall is on, within: 2 s, of: anyone in kitchen0}',
     '{at_most: 1, changes_of: light.hall, while: anyone in kitchen0}', 7, "'while'"),
    ('automation: light', 'weather: [{at: 0 s}]\nautomation: light', 5, 'outside or daylight'),
    ('automation: light', 'weather: [{at: 1 h, outside: 3}]\nautomation: light', 5, 'not within'),
    ('automation: light.yaml', 'automation: light.yaml\nprogram: {run: x}', 1,
     'an automation or a program'),
    ('at: bedroom0', 'at: bedroom0, sits_on: sofa', 3, 'one of at, sits_on, lies_on')])
def test_mistakes(tmp_path: Path, old: str, new: str, line: int, words: str) -> None:
    assert old in GOOD
    path = tmp_path / 's.yaml'
    path.write_text(GOOD.replace(old, new))
    with pytest.raises(Failure) as error:
        read_scenario(path)
    assert str(error.value).startswith(f'{path}:{line}: ') and words in str(error.value)
