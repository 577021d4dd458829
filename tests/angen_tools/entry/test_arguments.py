"""Arguments of the launch file that are wrong."""
import subprocess
from pathlib import Path

import pytest

from angen_tools.common.failure import Failure
from angen_tools.entry.arguments import check_arguments, check_roslaunch, kinds
from angen_tools.entry.run import resolved

ROOT = Path(__file__).resolve().parents[3]
LAUNCH = ROOT / 'launch/angen.launch'


def test_the_types_are_those_of_the_launch_file() -> None:
    assert kinds(LAUNCH).items() >= {
        'world': 'str', 'fast': 'bool', 'rate': 'double', 'paused': 'bool', 'seed': 'int',
        'topics': 'str', 'gui': 'bool', 'headless': 'bool', 'rescue': 'str'}.items()


def test_right_words_pass() -> None:
    check_arguments(LAUNCH, [f'world:={ROOT}/worlds/empty.world', 'gui:=False', 'paused:=1',
                             'rate:=0.5', 'seed:=7', 'topics:=kind', '--screen'])


@pytest.mark.parametrize(('word', 'parts'), [
    ('wrld:=x', ['did you mean world:=?', 'headless:=']),
    ('Seed:=1', ['did you mean seed:=?']),
    ('gui:=fasle', ['neither true nor false; did you mean false?']),
    ('paused:=treu', ['did you mean true?']),
    ('rate:=fast', ['not a number']),
    ('rate:=nan', ['not a number']),
    ('seed:=1.5', ['not a whole number']),
    ('gui=false', ['not NAME:=VALUE; did you mean gui:=false?']),
    (str(ROOT / 'worlds/empty.world'), ['did you mean world:=']),
    ('nothing', ['not NAME:=VALUE']),
    ('gui:=', ['has no value']),
    ('rate:=-1', ['must be at least 0']),
    ('rate:=1,5', ['not a number; a decimal has a point: 1.5']),
    ('seed:=99999999999999999999', ['must be at most 2147483647']),
    (f'world:={ROOT}/worlds', ['is a folder; give a file']),
    ('world:=none.world', ['no such file; one that is there']),
    (f'world:={ROOT}/worlds/angen.wrld', [f'did you mean world:={ROOT}/worlds/angen.world?']),
])
def test_a_wrong_word_is_named_with_near_ones(word: str, parts: list[str]) -> None:
    with pytest.raises(Failure) as failed:
        check_arguments(LAUNCH, ['seed:=1', word])
    assert str(failed.value).startswith(f'{word}: ')
    for part in parts:
        assert part in str(failed.value)


def test_a_world_of_the_users_own_folder_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch
                                                  ) -> None:
    monkeypatch.setenv('HOME', str(tmp_path))
    (tmp_path / 'my.world').write_text('')
    check_arguments(LAUNCH, ['world:=~/my.world'])
    assert resolved('world:=~/my.world') == f'world:={tmp_path}/my.world'
    with pytest.raises(Failure, match=f'did you mean world:={tmp_path}/my.world?'):
        check_arguments(LAUNCH, ['world:=~/my.wrld'])


@pytest.mark.parametrize(('words', 'lit'), [
    (['web:=true', 'gui:=false'], 'livingroom0 On'), (['gui:=false'], "''"),
    (['web:=true', 'gui:=false', f'world:={ROOT}/worlds/empty.world'], "''")])
def test_living_rooms_are_lit_where_one_sees_them(words: list[str], lit: str) -> None:
    told = subprocess.run(['roslaunch', '--dump-params', str(LAUNCH), *words], text=True,
                          capture_output=True, timeout=60).stdout
    line, = (line for line in told.splitlines() if line.startswith('/angen/commands'))
    assert lit in line


def test_a_missing_package_is_one_line_of_roslaunch(tmp_path: Path) -> None:
    file = tmp_path / 'my.launch'
    file.write_text((ROOT / 'launch/navigation.launch').read_text()
                    .replace('amcl move_base', 'no_such_package'))
    done = subprocess.run(['roslaunch', '--dump-params', str(file)], capture_output=True,
                          text=True, timeout=60)
    assert done.returncode == 1
    line, = done.stderr.splitlines()
    assert line.startswith('angen: no_such_package is not installed') and 'eval' not in line


def test_a_launch_file_that_includes_it_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr('sys.argv', ['/usr/bin/roslaunch', 'mine.launch', 'mine:=x'])
    check_roslaunch(str(LAUNCH))
