"""Mistakes that people make, and the answer to each: a line, an exit code, no traceback."""
import functools
import os
import shlex
import socket
from pathlib import Path
from typing import Any

import pytest
import yaml

from angen_tools.cli import main as cli

ROOT = Path(__file__).resolve().parents[2]
MISTAKES: dict[str, list[Any]] = yaml.safe_load(
    (Path(__file__).parent / 'mistakes.yaml').read_text())
PARSER = functools.cache(cli.make_parser)  # 0.05 s a mistake
DOOR = '<plugin name="d" filename="libdoor_world_plugin.so"/>' \
    '<include><uri>model://bath_door0</uri></include>'


@pytest.fixture(autouse=True)
def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the checkout, with an address at which no master listens."""
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        monkeypatch.setenv('ROS_MASTER_URI', f'http://127.0.0.1:{probe.getsockname()[1]}')
    monkeypatch.setenv('ANGEN_MODEL_PATH', os.environ.get('ANGEN_MODEL_PATH', ''))  # it is set
    monkeypatch.setattr(cli, 'make_parser', PARSER)
    monkeypatch.chdir(ROOT)


def answer(words: list[str], capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    """The exit code, and the one line on stderr."""
    try:
        code = cli.run(words)
    except SystemExit as end:
        code = int(str(end.code))
    line, = capsys.readouterr().err.splitlines()
    return code, line


def mistakes(kind: str) -> Any:
    return pytest.mark.parametrize('code, part, mistake', MISTAKES[kind])


@mistakes('commands')
def test_wrong_words(code: int, part: str, mistake: str,
                     capsys: pytest.CaptureFixture[str]) -> None:
    found, line = answer(shlex.split(mistake), capsys)
    assert part in line and found == code


@mistakes('worlds')
def test_wrong_worlds(code: int, part: str, mistake: str, tmp_path: Path,
                      capsys: pytest.CaptureFixture[str]) -> None:
    world = tmp_path / 'my.world'
    world.write_text(f'<sdf version="1.6">\n<world name="w">\n{mistake}\n</world>\n</sdf>\n')
    found, line = answer(['check', str(world)], capsys)
    assert part in line and found == code
    assert f'{world}:2: ' in line or f'{world}:3: ' in line


@mistakes('days')
def test_wrong_days(code: int, part: str, mistake: str, tmp_path: Path,
                    capsys: pytest.CaptureFixture[str]) -> None:
    world, day = tmp_path / 'my.world', tmp_path / 'day.csv'
    world.write_text(f'<sdf version="1.6"><world name="w">{DOOR}</world></sdf>')
    day.write_text(f'time,target,command\n{mistake}\n')
    found, line = answer(['run', '--fast', str(world), '--for', '10s', '--day', str(day), '--out',
                          str(tmp_path)], capsys)
    assert part in line and found == code and f'{day}:2: ' in line


@mistakes('files')
def test_wrong_files(code: int, part: str, mistake: str, tmp_path: Path,
                     capsys: pytest.CaptureFixture[str]) -> None:
    # latin-1: the arguments have no other letters, and their bytes are not UTF-8
    text, words = mistake.split(' | ')
    (tmp_path / 'file.csv').write_bytes(text.encode('latin-1'))
    found, line = answer(shlex.split(words.replace('FILE', str(tmp_path / 'file.csv'))), capsys)
    assert part in line and found == code and f'{tmp_path / "file.csv"}:' in line


def test_there_are_a_hundred() -> None:
    assert sum(map(len, MISTAKES.values())) >= 100
