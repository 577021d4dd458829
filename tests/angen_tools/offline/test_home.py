"""angen home: tables, JSON and findings."""
import json
import re
from pathlib import Path

import pytest

from angen_tools.common.failure import Failure
from angen_tools.common.home import Home
from angen_tools.offline.home import home_json, home_text, load_home

WORLD = Path(__file__).resolve().parents[3] / 'worlds/angen.world'
ROOM = ('<angen:room name="{}"><angen:polygon>{}</angen:polygon></angen:room>')


def written(folder: Path, inside: str, strict: bool = False) -> str:
    path = folder / 'my.world'
    path.write_text(f'<sdf version="1.6"><world name="w" angen:strict="{str(strict).lower()}">'
                    f'{inside}</world></sdf>')
    return str(path)


def test_our_building_is_shown_without_findings() -> None:
    text = home_text(*load_home(str(WORLD)))
    lines = [line.split() for line in text.splitlines()]
    assert ['kitchen1', 'kitchen', '1', '15.21', '2.80', 'entrance1'] in lines
    assert ['door', 'entrance0', 'landing0', '-', 'entrance0', '0.99', '2.09'] in lines
    assert ['bed', 'bedroom_bed0', 'bedroom0', 'lie', 'sit'] in lines
    assert 'elevator elevator: storey 0 in landing0, storey 1 in landing1' in text
    assert text.endswith('\nno findings')


def test_json_is_the_dict_of_the_world() -> None:
    described, findings = load_home(str(WORLD))
    read = json.loads(home_json(described, findings))
    assert read.pop('findings') == {'guessed': [], 'contradicting': []}
    assert Home.of(read) == Home.of(described)


def test_findings_are_listed(tmp_path: Path) -> None:
    path = written(tmp_path, ROOM.format('a', '0 0 4 0 4 3 0 3')
                   + ROOM.format('b', '3 0 8 0 8 3 3 3'))
    text = home_text(*load_home(path))
    assert re.search(r"contradicting: rooms 'a' and 'b' overlap by 2\.\d\d m\^2", text)
    assert "contradicting: no person can reach room 'b'" in text
    assert 'guessed: no <angen:latitude> is given' in text


def test_a_world_that_does_not_load_is_one_line(tmp_path: Path) -> None:
    path = written(tmp_path, ROOM.format('a', '0 0 4 0'), strict=True)
    with pytest.raises(Failure, match='my.world:1: <angen:polygon> of room .a. has 4 numbers'):
        load_home(path)
