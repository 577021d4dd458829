"""Lengths and angles in other units, which angen check says."""
import re
from pathlib import Path

import pytest

from angen_tools.offline.check import check
from angen_tools.world.models import building

ROOT = Path(__file__).resolve().parents[3]
TUTORIAL = re.search('```xml\n(<sdf.*?</sdf>)', (ROOT / 'docs/tutorial.md').read_text(), re.DOTALL)


def warnings(tmp_path: Path, *changes: tuple[str, str]) -> list[str]:
    """Of the tutorial's apartment with other words; without its file."""
    assert TUTORIAL
    text = TUTORIAL[1]
    for old, new in changes:
        assert re.search(old, text), old
        text = re.sub(old, new, text)
    world = tmp_path / 'home.world'
    world.write_text(text)
    checked = check(str(world))
    assert not checked.wrong
    assert ('no errors' in checked.found) == (not checked.warnings)
    return [line.removeprefix(str(world)) for line in checked.warnings]


@pytest.mark.parametrize('world', ['angen.world', 'empty.world'])
def test_a_world_in_m_and_rad_has_none(tmp_path: Path, world: str) -> None:
    assert warnings(tmp_path) == []
    assert check(str(building().parent / world)).warnings == []


def test_an_angle_in_degrees_has_its_line(tmp_path: Path) -> None:
    line, = warnings(tmp_path, ('0.1 0.1 2.3 0 0 0.785', '0.1 0.1 2.3 0 0 45'))
    assert re.match(r':\d+: the angle 45 is in rad, more than a turn; 45 degrees are 0.7854', line)


@pytest.mark.parametrize(('size', 'meant'), [('12200', '12.2 m'), ('820', '8.2 m')])
def test_a_length_in_another_unit_has_the_likely_one(tmp_path: Path, size: str, meant: str) -> None:
    line, = warnings(tmp_path, (r'<size>8.2 0.1 2.8', f'<size>{size} 0.1 2.8'))
    assert f' is {size} m wide; lengths are in m' in line and line.endswith(meant)


def test_a_door_beside_its_wall_joins_nothing(tmp_path: Path) -> None:
    line, = warnings(tmp_path, ('<pose>5.505 2.99 0', '<pose>5.505 1.49 0'))
    assert "'bedroom0' at" in line and 'joins nothing' in line
