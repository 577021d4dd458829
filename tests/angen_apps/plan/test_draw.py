"""Odd names of rooms and storeys, as a world has them, on the plan and in the table."""
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from angen_apps.plan.apartment import apartment
from angen_apps.plan.draw import draw
from angen_apps.plan.overlays import What
from angen_apps.plan.writer import write_world
from angen_tools.cli import main as cli

KEPT = ('101', 'a/b', 'Küche', r'$\frac$', '&lt;b&gt;', 'two  words')


@pytest.fixture(scope='module')
def text(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp('names') / 'home.world'
    write_world(apartment(1, 1, 3), path, 'none')
    return path.read_text()


def named(text: str, name: str) -> str:
    """The world with that name of its kitchen and of its storey."""
    start = text.index('<angen:storey name="') + len('<angen:storey name="')
    text = text[:start] + name + text[text.index('"', start):]
    return text.replace('<angen:room name="kitchen0"', f'<angen:room name="{name}"')


@pytest.mark.parametrize('name', KEPT)
def test_a_name_is_kept(name: str, text: str, tmp_path: Path,
                        capsys: pytest.CaptureFixture[str]) -> None:
    world = tmp_path / 'home.world'
    world.write_text(named(text, name))
    draw(world, tmp_path / 'plan.svg', What())
    drawn = unescape((tmp_path / 'plan.svg').read_text())
    assert drawn.count(f'>{unescape(name)}<') == 2  # the room and the storey
    assert cli.run(['home', str(world)]) == 0
    assert unescape(name) in capsys.readouterr().out


@pytest.mark.parametrize('name, why', [('', 'has no name'), ('  ', 'blank'),
                                       ('a&#10;b', 'control character'), ('x' * 10_000, '10000')])
def test_a_wrong_name_is_one_line_with_its_place(name: str, why: str, text: str, tmp_path: Path,
                                                 capsys: pytest.CaptureFixture[str]) -> None:
    world = tmp_path / 'home.world'
    world.write_text(text.replace('<angen:room name="kitchen0"', f'<angen:room name="{name}"'))
    line = 1 + world.read_text().partition(f'<angen:room name="{name}"')[0].count('\n')
    for command in (['home', str(world)], ['plan', str(world), '-o', str(tmp_path / 'p.svg')]):
        assert cli.run(command) == 1
        said = capsys.readouterr().err.strip()
        assert f'{world}:{line}: ' in said and why in said and '\n' not in said
        assert len(said) < 1000
    assert not (tmp_path / 'p.svg').exists()


def test_a_roof_over_a_room_does_not_cover_its_plan(text: str, tmp_path: Path) -> None:
    roof = ('<model name="roof"><static>true</static><pose>2 2 1.5 0 0.4 0</pose><link name="l">'
            '<collision name="c"><geometry><box><size>6 6 0.1</size></box></geometry></collision>'
            '</link></model></world>')
    dark = []
    for name, world in (('plain', text), ('roof', text.replace('</world>', roof))):
        (tmp_path / f'{name}.world').write_text(world)
        draw(tmp_path / f'{name}.world', tmp_path / f'{name}.png', What())
        with Image.open(tmp_path / f'{name}.png') as picture:
            dark.append(float((np.asarray(picture.convert('L')) < 64).mean()))
    assert 0 < dark[1] < 1.1 * dark[0]
