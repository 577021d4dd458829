"""The words of the angen command, and how it ends; no simulator runs here."""
import argparse
import os
import re
import shlex
import socket
import subprocess
import sys
from pathlib import Path
from typing import Callable, Iterator

import pytest

from angen_tools.cli import main as cli

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / 'src/angen_tools/scripts/angen'


def subcommands(parser: argparse.ArgumentParser, name: str = ''
                ) -> Iterator[tuple[str, argparse.ArgumentParser]]:
    """Those that run something, by their words."""
    groups = [action for action in parser._actions
              if isinstance(action, argparse._SubParsersAction)]
    if not groups:
        yield name.strip(), parser
    for group in groups:
        for word, sub in group.choices.items():
            yield from subcommands(sub, f'{name} {word}')


COMMANDS = dict(subcommands(cli.make_parser()))


@pytest.fixture
def no_master(monkeypatch: pytest.MonkeyPatch) -> str:
    """An address at which nothing listens."""
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        uri = f'http://127.0.0.1:{probe.getsockname()[1]}'
    monkeypatch.setenv('ROS_MASTER_URI', uri)
    return uri


def angen(*words: str, **options: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(SCRIPT), *words], text=True, timeout=60,
                          stdin=subprocess.DEVNULL, **{'capture_output': True, **options})


@pytest.mark.parametrize('words', ['', 'spawn', 'set door'])
def test_help_is_a_command_too(words: str, capsys: pytest.CaptureFixture[str]) -> None:
    pages = []
    for given in (['help', *words.split()], [*words.split(), '--help']):
        with pytest.raises(SystemExit) as end:
            cli.run(given)
        assert end.value.code == 0
        pages.append(capsys.readouterr().out)
    assert pages[0] == pages[1] and 'example' in pages[0]


@pytest.fixture(scope='module')
def parser() -> argparse.ArgumentParser:
    return cli.make_parser()


@pytest.mark.parametrize('words', COMMANDS)
def test_help_has_an_example_that_parses(words: str, parser: argparse.ArgumentParser,
                                         capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        cli.run([*words.split(), '--help'])
    assert end.value.code == 0
    examples = capsys.readouterr().out.split('example:\n')[1].split('\n\n')[0].splitlines()
    assert examples
    for example in examples:
        program, *given = shlex.split(example.split('>>')[0])
        assert program == 'angen' and example.strip().startswith(f'angen {words}')
        assert parser.parse_args(given).run
        assert not capsys.readouterr().err  # a former spelling of an option
        for word in given:
            assert not word.startswith(('examples/', 'worlds/')) or (ROOT / word).exists()


NO_RESULT = {'completion', 'mqtt'}  # a script; a bridge that runs until it is ended


def test_every_command_that_prints_a_result_prints_json() -> None:
    assert {words for words, parser in COMMANDS.items()
            if '--json' not in parser._option_string_actions} == NO_RESULT


def test_help_needs_neither_ros_nor_lxml() -> None:
    code = ('import sys; from angen_tools.cli.main import make_parser; make_parser(); '
            'print([m for m in ("rospy", "lxml", "angen", "numpy", "rich") if m in sys.modules])')
    done = subprocess.run([sys.executable, '-c', code], text=True, capture_output=True, timeout=60)
    assert done.stdout == '[]\n', done.stderr


@pytest.mark.parametrize('words', [
    ['list'], ['delete', 'p1'], ['spawn', 'pir', 'p1', '--pose', '1 2 3'],
    ['spawn', 'model', 'model://chair', 'c1', '--pose', '-1 2 3 0 0 0'],
    ['set', 'door', 'kitchen0', '-1.2'], ['save', 'out.world'], ['watch', '--once'],
    ['top', '--once'], ['top']])
def test_without_a_simulator_one_line_says_so(
        words: list[str], no_master: str,
        command: Callable[..., subprocess.CompletedProcess[str]]) -> None:
    done = command(*words)
    assert done.returncode == 1 and done.stdout == ''
    assert done.stderr == (f'angen: no simulator is running at {no_master}; '
                           'start one with ./angen run\n')


def completed(line: str) -> list[str]:
    """The completions that bash offers after the line."""
    words = line.split(' ')
    script = f'''
        angen() {{ {sys.executable} {SCRIPT} "$@"; }}
        eval "$(angen completion bash)"
        COMP_LINE='{line}' COMP_POINT={len(line)} COMP_TYPE=9
        COMP_WORDS=({line}) COMP_CWORD={len(words) - 1}
        _python_argcomplete angen
        printf '%s\\n' "${{COMPREPLY[@]}}"'''
    done = subprocess.run(['bash', '--norc', '-c', script], text=True, capture_output=True,
                          timeout=60)
    assert done.returncode == 0, done
    return done.stdout.split()


@pytest.mark.parametrize('line, words', [
    ('angen sp', ['spawn']), ('angen spawn press', ['pressure']), ('angen set ele', ['elevator']),
    ('angen list --kind pi', ['pir']), ('angen watch --kind hea', ['heater']),
    ('angen set door kitchen0 cl', ['close', 'closebyhand']),
    ('angen spawn pir p1 --set thr', ['threshold='])])
def test_completion_completes_in_bash(line: str, words: list[str]) -> None:
    assert completed(line) == words


@pytest.mark.parametrize('words', [('check',), ('replay',), ('set', 'door'), ('spawn', 'pir')])
def test_words_that_are_not_utf_8_are_reported(words: tuple[str, ...]) -> None:
    done = angen(*words, '\udcff\udcfe')
    assert done.returncode == 2
    assert "'\\udcff\\udcfe' is not text in UTF-8" in done.stderr
    assert 'Traceback' not in done.stderr


def test_completion_of_addresses_on_the_model_path() -> None:
    assert '//chair' in completed('angen spawn model model://cha')  # bash has taken model: itself


@pytest.mark.parametrize('words', [
    'run --fast {root}/worlds/empty.world --for 1', 'task patrol', 'task patrol --seeds 2',
    'task seek', 'bench sensors', 'bench core', 'bench load', 'walktest --profile nema-wd7', 'care',
    'care {root}/worlds/empty.world', 'locate --for 1', 'pid door'])
def test_a_folder_that_cannot_be_written_is_named_before_the_work(
        words: str, no_master: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / 'file').touch()
    assert cli.run([*words.format(root=ROOT).split(), '--out', str(tmp_path / 'file/out')]) == 1
    assert capsys.readouterr() == ('', f'angen: {tmp_path}/file: is not a folder\n')


def test_a_former_spelling_is_a_warning(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        cli.run(['locate', '--world', 'a.world'])
    first, second = capsys.readouterr().err.splitlines()
    assert first == 'angen locate: --world is now WORLD, without an option'
    assert 'WORLD needs --for TIME' in second


@pytest.mark.parametrize('words', ['list', 'top', 'set door kitchen0 Open'])
def test_without_ros_a_line_says_so(words: str, tmp_path: Path) -> None:
    """As in a wheel's environment: ROS cannot be imported."""
    for name in cli.ROS:
        (tmp_path / f'{name}.py').write_text(f'raise ModuleNotFoundError("no", name="{name}")\n')
    path = os.pathsep.join([str(tmp_path), os.environ.get('PYTHONPATH', '')])
    result = angen(*words.split(), env=dict(os.environ, PYTHONPATH=path))
    assert result.returncode == 1
    assert re.fullmatch(rf'angen: {words.split()[0]} needs ROS .*\n', result.stderr)


@pytest.mark.parametrize('stream', [0, 1, 2])
def test_a_closed_stream_is_as_dev_null(stream: int) -> None:
    done = subprocess.run([sys.executable, SCRIPT, 'plugins'], capture_output=True, text=True,
                          preexec_fn=lambda: os.close(stream))
    assert (done.returncode, done.stderr) == (0, '')
    assert bool(done.stdout) == (stream != 1)
