"""The words with which a building starts again."""
import os
from pathlib import Path

import pytest

from angen_tools.entry.run import help_text, resolved, with_world


def test_the_rest_of_the_words_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('ANGEN_MODEL_PATH', '/mine')
    monkeypatch.setenv('GAZEBO_RESOURCE_PATH', '')
    words = ['--screen', 'world:=/a/b.world', 'seed:=7', 'replay:=/a/bug.log', 'until:=3',
             'commands:=lamp/all On']
    for _ in range(2):
        assert with_world(words, Path('/run/rescued.world')) == [
            '--screen', 'world:=/run/rescued.world', 'seed:=7']
    assert os.environ['ANGEN_MODEL_PATH'] == '/a/models:/mine'
    assert os.environ['GAZEBO_RESOURCE_PATH'] == '/a'  # files beside the first may be named


def test_no_log_is_written_over(tmp_path: Path) -> None:
    for number in (2, 3):
        assert with_world([f'record:={tmp_path}/bug.log'], Path('/w')) == [
            f'record:={tmp_path}/bug_{number}.log', 'world:=/w']
        (tmp_path / f'bug_{number}.log').touch()  # as of an earlier run


def test_files_are_those_of_this_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert resolved('world:=a.world') == f'world:={tmp_path}/a.world'
    assert resolved('seed:=1') == 'seed:=1' and resolved('--screen') == '--screen'


@pytest.mark.parametrize('given, seconds', [('41.5', '41.5'), ('2min', '120'), ('1h30m', '5400')])
def test_times_are_in_seconds(given: str, seconds: str) -> None:
    assert resolved(f'until:={given}') == f'until:={seconds}'


def test_what_to_try_fits_the_world() -> None:
    angen = Path('/a/angen')
    assert '"Open, bathroom1"' in help_text(angen, ['gui:=false'])
    for word in ('world:=/a/flat.world', 'replay:=/a/bug.log'):
        assert 'bathroom1' not in help_text(angen, [word]) and 'angen list' in help_text(
            angen, [word])
