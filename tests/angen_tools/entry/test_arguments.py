"""Arguments of the launch file that are wrong."""
from __future__ import annotations

from pathlib import Path

import pytest

from angen_tools.common.failure import Failure
from angen_tools.entry.arguments import check_arguments, check_roslaunch, kinds

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


def test_roslaunch_itself_is_checked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr('sys.argv', ['/usr/bin/roslaunch', 'angen_sim', 'angen.launch', 'wrld:=x'])
    with pytest.raises(Failure, match='wrld:=x: not an argument'):
        check_roslaunch(str(LAUNCH))


def test_a_launch_file_that_includes_it_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr('sys.argv', ['/usr/bin/roslaunch', 'mine.launch', 'mine:=x'])
    check_roslaunch(str(LAUNCH))
