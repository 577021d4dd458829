"""The words of the angen command, and how it ends; no simulator runs here."""
from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from angen_msgs.msg import DoorState, ElevatorState, LampState
from angen_tools import cli, control, listing, watch

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / 'src/angen_tools/scripts/angen'
COMMANDS = ['spawn', 'spawn pir', 'spawn switch', 'spawn luminosity', 'spawn camera',
            'spawn contact', 'spawn proximity', 'spawn pressure', 'spawn reed', 'spawn rfid',
            'spawn plug', 'spawn temperature', 'spawn humidity', 'spawn model', 'delete', 'list',
            'plugins', 'set', 'set door', 'set elevator', 'set lamp', 'set window', 'set cabinet',
            'set heater', 'save', 'watch', 'top', 'run', 'drive', 'map', 'task', 'task patrol',
            'check', 'luxcheck', 'completion']


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


def usage_error(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    with pytest.raises(SystemExit) as end:
        cli.run(words)
    assert end.value.code == 2
    line, = capsys.readouterr().err.splitlines()
    return line


@pytest.mark.parametrize('words', COMMANDS)
def test_help_has_an_example_that_parses(words: str, capsys: pytest.CaptureFixture[str]) -> None:
    import shlex
    with pytest.raises(SystemExit) as end:
        cli.run([*words.split(), '--help'])
    assert end.value.code == 0
    examples = capsys.readouterr().out.split('example:\n')[1].splitlines()
    assert examples
    for example in examples:
        program, *given = shlex.split(example.split('>>')[0])
        assert program == 'angen' and example.strip().startswith(f'angen {words}')
        assert cli.make_parser().parse_args(given).run


def test_help_needs_neither_ros_nor_lxml() -> None:
    code = ('import sys; from angen_tools import cli; cli.make_parser(); '
            'print([m for m in ("rospy", "lxml", "angen", "numpy") if m in sys.modules])')
    done = subprocess.run([sys.executable, '-c', code], text=True, capture_output=True, timeout=60)
    assert done.stdout == '[]\n', done.stderr


@pytest.mark.parametrize('words', [
    ['list'], ['delete', 'p1'], ['spawn', 'pir', 'p1', '--pose', '1 2 3'],
    ['spawn', 'model', 'model://chair', 'c1', '--pose', '-1 2 3 0 0 0'],
    ['set', 'door', 'kitchen0', '-1.2'], ['save', 'out.world'], ['watch', '--once'],
    ['top', '--once'], ['top']])
def test_without_a_simulator_one_line_says_so(words: list[str], no_master: str) -> None:
    done = angen(*words)
    assert done.returncode == 1 and done.stdout == ''
    assert done.stderr == (f'angen: no simulator is running at {no_master}; '
                           'start one with ./angen run\n')


@pytest.mark.parametrize('words, part', [
    ([], 'COMMAND'),
    (['dance'], 'dance'),
    (['spawn', 'pir', 'p1'], '--pose'),
    (['spawn', 'pir', 'p1', '--pose', '1 2'], '2 numbers'),
    (['spawn', 'pir', 'a::b', '--pose', '1 2 3'], 'a::b'),
    (['spawn', 'pir', 'p1', '--pose', '1 2 3', '--set', 'threshold'], 'KEY=VALUE'),
    (['spawn', 'pir', 'p1', '--pose', '1 2 3', '--on', 'table'], 'MODEL::LINK'),
    (['spawn', 'contact', 'c1'], '--on'),
    (['spawn', 'reed', 'r1', '--pose', '1 2 3'], '--on'),
    (['set', 'door', 'kitchen0', 'ajar'], 'open, close or an angle in rad'),
    (['set', 'door', 'kitchen0', 'nan'], 'open, close or an angle in rad'),
    (['set', 'elevator', 'elevator', '1.5'], 'no floor'),
    (['set', 'lamp', 'kitchen0', '101'], '0 to 100'),
    (['set', 'heater', 'h1', 'warm'], '0 to 100'),
    (['delete'], 'NAME'),
    (['completion', 'fish'], 'bash'),
])
def test_wrong_words_are_told_in_one_line(words: list[str], part: str,
                                          capsys: pytest.CaptureFixture[str]) -> None:
    assert part in usage_error(words, capsys)


@pytest.mark.parametrize('source, part', [('http://a/b', 'model://NAME'), ('nowhere', 'read'),
                                          ('', 'model.sdf')])
def test_what_is_no_model_is_told(source: str, part: str, tmp_path: Path,
                                  monkeypatch: pytest.MonkeyPatch,
                                  capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    assert cli.run(['spawn', 'model', source, 'm1', '--pose', '0 0 0']) == 1
    line, = capsys.readouterr().err.splitlines()
    assert part in line


def test_an_unknown_parameter_lists_the_known(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(['spawn', 'pir', 'p1', '--pose', '0 0 1', '--set', 'range=3']) == 1
    line, = capsys.readouterr().err.splitlines()
    assert "'range'" in line and 'ray/range/max' in line and 'threshold' in line


def test_plugins_lists_the_catalog() -> None:
    done = angen('plugins', '--json')
    kinds = {plugin['kind']: plugin for plugin in json.loads(done.stdout)}
    assert {'door', 'elevator', 'lamp', 'drive', 'person', 'pir', 'switch', 'luminosity',
            'contact', 'lidar', 'camera', 'depth'} <= set(kinds)
    p, = [param for param in kinds['door']['params'] if param['path'] == 'p']
    assert (p['type'], p['default'], p['unit']) == ('number', '70', 'N m/rad') and p['doc']
    text = angen('plugins').stdout
    assert all(plugin['library'] in text for plugin in kinds.values())


def test_check_of_a_right_world() -> None:
    done = angen('check', str(ROOT / 'worlds/empty.world'))
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout.endswith('nothing is wrong; 1 models, 0 devices, 0 sensors\n')


def test_check_of_a_broken_world_names_file_and_line(tmp_path: Path) -> None:
    broken = tmp_path / 'broken.world'
    broken.write_text('<sdf version="1.6"><world name="w">\n'
                      '<include><uri>model://no_such_model</uri></include>\n</world></sdf>')
    done = angen('check', str(broken))
    assert done.returncode == 1 and done.stdout == ''
    line, = done.stderr.splitlines()
    assert line.startswith(f'{broken}:2: ') and 'no_such_model' in line


def test_completion_completes_in_bash() -> None:
    script = f'''
        angen() {{ {sys.executable} {SCRIPT} "$@"; }}
        eval "$(angen completion bash)"
        COMP_LINE='angen sp' COMP_POINT=8 COMP_TYPE=9
        COMP_WORDS=(angen sp) COMP_CWORD=1
        _python_argcomplete angen
        printf '%s\\n' "${{COMPREPLY[@]}}"'''
    done = subprocess.run(['bash', '--norc', '-c', script], text=True, capture_output=True,
                          timeout=60)
    assert done.stdout.split() == ['spawn'], done


def test_a_reader_that_goes_away_is_no_error_text() -> None:
    done = subprocess.run(['bash', '-c', f'{sys.executable} {SCRIPT} plugins --json | true'],
                          text=True, capture_output=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, '')


def test_a_full_disk_is_told_in_one_line() -> None:
    with open('/dev/full', 'w') as full:
        done = angen('plugins', capture_output=False, stdout=full, stderr=subprocess.PIPE)
    assert done.returncode == 1
    assert done.stderr == f'angen: cannot write: {os.strerror(28)}\n'


def test_a_live_table_needs_a_terminal() -> None:
    done = angen('watch')
    assert done.returncode == 1 and '--once' in done.stderr and done.stdout == ''


@pytest.mark.parametrize('kind, value, text', [
    ('door', 'Open', 'Open, NAME'), ('door', 'close', 'Close, NAME'),
    ('door', '-1.2', 'Set, NAME, -1.2'), ('elevator', '01', 'Floor1, NAME'),
    ('lamp', 'on', 'On, NAME'), ('lamp', 'off', 'Off, NAME'), ('lamp', '40%', 'Dim, NAME, 40.0')])
def test_commands_are_those_of_the_topics(kind: str, value: str, text: str) -> None:
    assert control.make_order(kind, value).text == text


@pytest.mark.parametrize('kind, value, yes, no', [
    ('door', 'open', DoorState(mode=DoorState.OPENING), DoorState(mode=DoorState.CLOSED)),
    ('door', 'close', DoorState(mode=DoorState.CLOSED), DoorState(mode=DoorState.BLOCKED)),
    ('door', '-1.2', DoorState(target=-1.2), DoorState(target=-1.57)),
    ('elevator', '1', ElevatorState(target_floor=1), ElevatorState(floor=1)),
    ('lamp', 'on', LampState(on=True, level=100), LampState(on=True, level=40)),
    ('lamp', '40', LampState(on=True, level=40), LampState())])
def test_a_command_is_taken_when_its_state_follows(kind: str, value: str, yes: object, no: object
                                                   ) -> None:
    taken = control.make_order(kind, value).taken
    assert taken(yes) and not taken(no)


def test_what_a_command_may_wait_for() -> None:
    standing = ElevatorState(door_mode=ElevatorState.DOOR_OPEN)
    going = ElevatorState(mode=ElevatorState.UP)
    assert control.waits_for('elevator', [standing], False) == ''
    assert control.waits_for('elevator', [going], False) == 'next'
    assert control.waits_for('elevator', [ElevatorState()], False) == 'next'
    assert control.waits_for('door', [DoorState(mode=DoorState.BLOCKED)], False) == ''
    assert 'paused' in control.waits_for('door', [DoorState()], True)


@pytest.mark.parametrize('state, text', [
    (DoorState(mode=DoorState.OPENING, position=-0.5, target=-1.57),
     'opening at -0.50 rad, to -1.57 rad'),
    (DoorState(position=-0.0001), 'shut at 0.00 rad'),
    (ElevatorState(mode=ElevatorState.UP, position=2.5, floor=-1, target_floor=1),
     'going up at 2.50 m, to floor 1, doors shut'),
    (LampState(on=True, level=40, luminous_flux=320), 'on at 40 %, 320 lm')])
def test_states_in_words(state: object, text: str) -> None:
    assert watch.value_of(state) == text


def test_tables_are_aligned() -> None:
    assert listing.table(('A', 'B'), [('long', 'x'), ('s', 'yy')]) == 'A     B\nlong  x\ns     yy'
