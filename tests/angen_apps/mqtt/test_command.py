"""The words of angen mqtt."""
import sys
from pathlib import Path

import pytest
from angen_apps.cli.mqtt import address, prefix
from angen_apps.mqtt import command
from angen_apps.mqtt.bridge import Taken
from angen_apps.mqtt.broker import Access
from angen_apps.mqtt.command import read_password
from angen_tools.cli.main import run
from angen_tools.common.failure import Failure
from angen_tools.session.live import ENDED
from tests.angen_apps.mqtt.fakes import FakeWorld


@pytest.mark.parametrize('text, expected', [
    ('localhost', ('localhost', 1883)), ('10.0.0.1:1884', ('10.0.0.1', 1884)),
    ('[::1]:1884', ('::1', 1884)), ('[::1]', ('::1', 1883)), ('::1', ('::1', 1883))])
def test_addresses(text: str, expected: tuple[str, int]) -> None:
    assert address(text) == expected


@pytest.mark.parametrize('words, problem', [
    (('--broker', 'localhost:http'), 'not the address of a broker'),
    (('--broker', 'localhost:'), 'not the address'), (('--broker', ':1883'), 'not the address'),
    (('--broker', 'localhost:70000'), 'not the address'),
    (('--prefix', 'a/#'), 'cannot begin a topic'), (('--prefix', 'a//b'), 'cannot begin a topic'),
    (('--prefix', 'homeassistant'), 'cannot begin a topic'),
    (('--user', 'anna'), 'belong together'), (('--cert', 'a.crt'), 'belong together'),
    (('--style', 'tasmota'), 'not known')])
def test_wrong_words(words: tuple[str, ...], problem: str, capsys: pytest.CaptureFixture[str]
                     ) -> None:
    with pytest.raises(SystemExit) as ended:
        run(['mqtt', *words])
    line, = capsys.readouterr().err.splitlines()
    assert ended.value.code == 2 and problem in line


def test_prefixes() -> None:
    assert [prefix(text) for text in ('angen', 'house1/angen')] == ['angen', 'house1/angen']


def test_a_password_is_the_first_line(tmp_path: Path) -> None:
    path = tmp_path / 'password'
    path.write_text('secret\nsecond\n')
    assert read_password(path) == 'secret' and read_password(None) == ''
    with pytest.raises(Failure, match='cannot be read'):
        read_password(tmp_path / 'missing')


@pytest.mark.parametrize('why, again', [(Failure(ENDED), True), (Taken('another'), False)])
def test_it_waits_for_the_next_simulator(monkeypatch: pytest.MonkeyPatch, why: Failure, again: bool,
                                         capsys: pytest.CaptureFixture[str]) -> None:
    """After the end of one it starts again, with the same words; other troubles end it."""
    started: list[list[str]] = []

    class World(FakeWorld):
        received = 0

        def wake(self) -> None: ...

        def entities(self, kind: str = '') -> list[object]:  # type: ignore[override]
            raise why

    monkeypatch.setattr(command, 'start_node', lambda _: None)
    monkeypatch.setattr(command, '_simulator', lambda _: World())
    monkeypatch.setattr(command, 'PAUSE', 0.0)
    monkeypatch.setattr('os.execv', lambda _, words: started.append(words))
    try:
        command.serve(Access('127.0.0.1', 1), 'angen', 'plain', 'none', '', False)
    except Failure as failure:
        assert not again and failure is why
    assert started == [sys.orig_argv] * again
    assert ('waits for the next' in capsys.readouterr().err) == again
