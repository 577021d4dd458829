"""The simulator accepts the models that docs/ shows, and the command the words."""
import re
import shlex
from pathlib import Path

import angen
import pytest

from angen_tools.cli import main as cli
from tests.docs.pages import PAGES, ROOT, blocks

PARSER = cli.make_parser()
WORDS = '|'.join(PARSER._subparsers._group_actions[0].choices)


def model(page: str, name: str) -> str:
    found, = [block for block in blocks(ROOT / 'docs' / page, 'xml')
              if f'<model name="{name}">' in block]
    return found


@pytest.mark.parametrize('file, language', [
    ('tape_measure.cpp', 'cpp'), ('CMakeLists.txt', 'cmake'), ('tape_measure.sdf', 'xml')])
def test_the_smallest_sensor_is_the_example(file: str, language: str) -> None:
    example = (ROOT / 'tests/examples/tape_measure' / file).read_text()
    assert example in blocks(ROOT / 'docs/plugins.md', language)


@pytest.fixture
def world() -> angen.World:
    return angen.World(str(ROOT / 'worlds/empty.world'))


def commands(page: Path) -> list[str]:
    """The angen commands in a page's blocks that hold no shell variable and no placeholder.

    Without --fast, ./angen run is roslaunch and takes its arguments.
    """
    text = page.read_text().replace('\\\n', ' ')
    lines = re.findall(rf'^\s*(?:\./)?angen ((?:{WORDS}) .*)$', text, re.MULTILINE)
    return [line for line in lines if not re.search(r'[$<…|]|NAME|\.\.\.', line)
            and not re.match('run (?!--fast)', line)]


@pytest.mark.parametrize('page', PAGES, ids=lambda page: page.name)
def test_every_command_that_is_shown_is_understood(page: Path) -> None:
    for line in commands(page):
        assert PARSER.parse_args(shlex.split(line, comments=True)).run, line


def test_the_pages_show_commands() -> None:
    assert sum(len(commands(page)) for page in PAGES) > 30


def test_the_shelf_is_found_by_its_address(monkeypatch: pytest.MonkeyPatch, tmp_path: Path
                                           ) -> None:
    folder = tmp_path / 'shelf'
    folder.mkdir()
    config, sdf, include, *_ = blocks(ROOT / 'docs/models.md', 'xml')
    (folder / 'model.config').write_text(config)
    (folder / 'model.sdf').write_text(sdf)
    monkeypatch.setenv('ANGEN_MODEL_PATH', str(tmp_path))
    world = angen.World(str(ROOT / 'worlds/empty.world'))
    world.spawn('model://shelf', 'shelf1', [0.2, 2, 1.5, 0, 0, 0])
    world.spawn(include, 'shelf2', [0, 0, 1, 0, 0, 0])
    assert world.models[-2:] == ['shelf1', 'shelf2']


def test_the_room_stands(world: angen.World) -> None:
    world.spawn(model('build_apartment.md', 'one_room'), 'room', [0, 0, 0, 0, 0, 0])
    world.spawn('model://kitchen_door', 'hall_door', [1.505, 3.99, 0, 0, 0, 0])
    world.command('door', 'hall0', 'Open')
    world.run(4)
    assert world.device('door', 'hall0')['mode'] == 'OPEN'


def test_the_door_opens(world: angen.World) -> None:
    world.spawn(model('build_apartment.md', 'cellar_door'), 'cellar_door', [1, -3, 0, 0, 0, 0])
    world.command('door', 'cellar0', 'Open')
    world.run(6)
    assert world.device('door', 'cellar0')['mode'] == 'OPEN'


def test_the_platform_reaches_its_third_floor(world: angen.World) -> None:
    world.spawn(model('build_apartment.md', 'platform'), 'goods_lift', [-6, 0, 0, 0, 0, 0])
    world.command('elevator', 'goods_lift', 'Floor2')
    world.run(14)
    state = world.device('elevator', 'goods_lift')
    assert state['floor'] == 2 and abs(state['position'] - 8) < 0.005
