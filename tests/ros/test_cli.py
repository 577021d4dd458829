"""The angen command against the real node."""
import json
import os
import signal
import socket
import subprocess
import termios
from pathlib import Path
from typing import Iterator

import pytest
from angen_msgs.srv import Delete, List, Step
from harness import Angen, Cli, Master, open_terminal, own_terminal
from gazebo_msgs.msg import ContactsState


@pytest.fixture
def spawned(angen: Angen) -> Iterator[list[str]]:
    """Names that are deleted when the test ends, where the test has not."""
    names: list[str] = []
    yield names
    for name in names:
        angen.call('/angen/delete', Delete, name=name)


def test_a_sensor_is_added_and_deleted(cli: Cli, angen: Angen, spawned: list[str]) -> None:
    spawned.append('cli_pir')
    said = cli.does('spawn', 'pir', 'cli_pir', '--pose', '-1 1 1.2 0 0 1.5',
                    '--set', 'ray/range/max=4')
    assert said == 'spawned the pir cli_pir, see /angen/pir/cli_pir'
    assert angen.master.topics()['/angen/pir/cli_pir'] == 'angen_msgs/PirMsg'
    entity, = [e for e in json.loads(cli.does('list', '--kind', 'pir', '--json'))
               if e['name'] == 'cli_pir']
    assert entity['pose']['position'] == pytest.approx([-1, 1, 1.2])
    assert 'exists' in cli.fails('spawn', 'pir', 'cli_pir', '--pose', '0 0 1')
    assert cli.does('delete', 'cli_pir') == 'deleted cli_pir'
    assert '/angen/pir/cli_pir' not in angen.master.topics()
    assert "no model or sensor named 'cli_pir'; did you mean" in cli.fails('delete', 'cli_pir')


def test_a_contact_sensor_watches_every_collision_of_its_link(
        cli: Cli, angen: Angen, spawned: list[str]) -> None:
    from gazebo_msgs.msg import ContactsState
    spawned += ['cli_touch', 'cli_table']
    cli.does('spawn', 'model', 'model://kitchen_table', 'cli_table', '--pose', '-5 -5 0.01')
    cli.does('spawn', 'contact', 'cli_touch', '--on', 'cli_table::body')
    touched = angen.wait('/angen/contact/cli_touch', ContactsState, lambda m: len(m.states) == 4)
    assert {state.collision2_name for state in touched.states} == {'ground::link::c'}
    assert 'known are body' in cli.fails('spawn', 'contact', 'c9', '--on', 'cli_table::top')


def test_a_sitter_is_seated_on_what_has_a_seat(
        cli: Cli, angen: Angen, spawned: list[str]) -> None:
    spawned += ['cli_sitter', 'cli_chair']
    cli.does('spawn', 'model', 'model://chair', 'cli_chair', '--pose', '-5 3 0.001 0 0 1')
    assert cli.does('spawn', 'sitter', 'cli_sitter', '--on', 'cli_chair') == (
        'seated cli_sitter, 75 kg, on cli_chair')
    angen.wait('/angen/contact/cli_chair', ContactsState, lambda message: abs(
        sum(state.total_wrench.force.z for state in message.states) + 75 * 9.8) < 0.02 * 735)
    assert "is 'cli_sitter'" in cli.fails('spawn', 'sitter', 'second', '--on', 'cli_chair')
    assert 'seat_collision' in cli.fails('spawn', 'sitter', 'second', '--on', 'eye')
    assert 'no model' in cli.fails('spawn', 'sitter', 'second', '--on', 'nothing')


def test_a_model_of_the_users_own(cli: Cli, spawned: list[str], tmp_path: Path) -> None:
    spawned.append('cli_box')
    file = tmp_path / 'box.sdf'
    file.write_text('<sdf version="1.6"><model name="b"><static>true</static><link name="l"/>'
                    '</model></sdf>')
    assert 'cli_box' in cli.does('spawn', 'model', str(file), 'cli_box', '--pose', '3 3 3')
    assert 'cli_box' in cli.listed('model')
    assert 'did you mean model://sofa' in cli.fails('spawn', 'model', 'model://soffa', 'x',
                                                    '--pose', '0 0 0')


def test_delete_asks_for_walls_at_a_terminal(cli: Cli, angen: Angen, spawned: list[str],
                                             tmp_path: Path) -> None:
    for name, size in (('cli_wall', '4 0.1 2.5'), ('cli_box', '1 1 1')):
        box = f'<geometry><box><size>{size}</size></box></geometry>'
        (tmp_path / f'{name}.sdf').write_text(
            '<sdf version="1.6"><model name="box"><static>true</static><link name="link">'
            f'<collision name="c">{box}</collision></link></model></sdf>')
        cli.does('spawn', 'model', str(tmp_path / f'{name}.sdf'), name, '--pose', '9 9 1.3')
        spawned.append(name)

    def deletes(answer: bytes, *words: str) -> int:
        keys, terminal = open_terminal()
        os.write(keys, answer)
        try:
            return subprocess.run([*cli.words, 'delete', *words], env=cli.environment, timeout=120,
                                  stdin=terminal, capture_output=True).returncode
        finally:
            os.close(keys)
            os.close(terminal)

    assert deletes(b'n\n', 'cli_wall') == 1 and 'cli_wall' in cli.listed('model')
    assert deletes(b'', 'cli_box') == 0
    assert deletes(b'y\n', 'cli_wall') == 0 and 'cli_wall' not in cli.listed('model')


def test_delete_stops_at_the_first_that_is_not_there(cli: Cli, spawned: list[str]) -> None:
    spawned += ['cli_a', 'cli_b']
    for name in spawned:
        cli.does('spawn', 'switch', name, '--pose', '0 -3 1')
    line = cli.fails('delete', 'cli_a', 'cli_nobody', 'cli_b')
    assert 'cli_nobody' in line and line.endswith('deleted before: cli_a')
    assert [n for n in cli.listed('switch') if n.startswith('cli_')] == ['cli_b']


def test_list_is_an_aligned_table(cli: Cli, angen: Angen) -> None:
    head, *rows = cli.does('list').splitlines()
    columns = [head.index(word) for word in ('NAME', 'KIND', 'MODEL', 'X')]
    assert all(row[at - 1:at] in ('', ' ') and row[at] != ' ' for row in rows for at in columns)
    assert cli.does('list', '--kind', 'person').splitlines() == [
        'NAME  KIND  MODEL  ROOM  X  Y  Z  YAW  TOPIC']
    listed = json.loads(cli.does('list', '--kind', 'door', '--json'))
    answer = angen.call('/angen/list', List, kind='door')
    assert [door['room'] for door in listed] == [door.room for door in answer.entities] != []
    assert 'did you mean door' in cli.fails('list', '--kind', 'dor')


def test_a_door_is_set(cli: Cli) -> None:
    assert cli.does('set', 'door', 'bathroom0', '-0.4').startswith('door bathroom0: OPENING, ')
    assert cli.does('set', 'door', 'all', 'close') == 'all of kind door, 1: Close'
    assert cli.fails('set', 'door', 'cellar7', 'open') == (
        "no door named 'cellar7'; did you mean bathroom0?")
    assert 'outside the hinge' in cli.fails('set', 'door', 'bathroom0', '-3')


def test_a_lamp_is_set(cli: Cli) -> None:
    assert cli.does('set', 'lamp', 'kitchen0', '40') == 'lamp kitchen0: on, 40 %, 320 lm'
    assert cli.does('set', 'lamp', 'kitchen0', 'Dim', '50') == 'lamp kitchen0: on, 50 %, 400 lm'
    assert cli.does('set', 'lamp', 'kitchen0', 'off') == 'lamp kitchen0: off, 0 %, 0 lm'
    assert cli.does('set', 'lamp', 'kitchen0', 'off') == 'lamp kitchen0: off, 0 %, 0 lm'


def test_a_robot_is_set_by_numbers_alone(cli: Cli) -> None:
    assert cli.does('set', 'drive', 'turtlebot', '0', '-0.2').endswith('rad/s')
    assert cli.does('set', 'drive', 'turtlebot', 'stop').startswith('drive turtlebot: ')


def test_an_elevator_that_is_not_there(cli: Cli) -> None:
    assert cli.fails('set', 'elevator', 'elevator', '1') == (
        "no elevator named 'elevator'; there are none")
    assert cli.fails('set', 'elevator', 'all', '1') == 'the world has no elevator'


def test_what_an_accepted_command_waits_for(cli: Cli, angen: Angen, spawned: list[str]) -> None:
    spawned.append('cli_lift')
    cli.does('spawn', 'model', 'model://elevator', 'cli_lift', '--pose', '-9 -9 0.3')
    with angen.paused():
        angen.call('/angen/step', Step, ticks=6000)
        assert cli.does('set', 'elevator', 'cli_lift', '1').endswith(
            'Floor 1 is executed when the simulation is no longer paused')
    assert cli.does('set', 'elevator', 'cli_lift', '0').endswith('; Floor 0 is executed next')
    assert 'Floor0 to Floor1' in cli.fails('set', 'elevator', 'cli_lift', '2')


def test_no_command_stays_with_the_master(cli: Cli, angen: Angen) -> None:
    cli.does('set', 'lamp', 'kitchen0', 'off')
    cli.does('watch', '--once')
    state = angen.master.api.getSystemState('/test')[2]
    nodes = {node for kind in state for _, names in kind for node in names}
    assert not [node for node in nodes if 'angen_command' in node]


def test_save_writes_a_world_that_loads(cli: Cli, tmp_path: Path) -> None:
    out = tmp_path / 'out.world'
    assert cli.does('save', str(out)) == f'saved {len(cli.listed("model"))} models to {out}'
    assert 'no errors' in cli.does('check', str(out))
    assert [path.name for path in tmp_path.iterdir()] == ['out.world']
    assert 'cannot be written' in cli.fails('save', str(tmp_path / 'no/out.world'))


def test_one_table_of_all_values(cli: Cli) -> None:
    rows = {tuple(row.split()[:2]): row for row in cli.does('watch', '--once').splitlines()}
    assert 'rad' in rows['door', 'bathroom0'] and 'm/s' in rows['drive', 'turtlebot']
    assert ('lamp', 'kitchen0') in rows and ' m ' in rows['pir', 'eye']


def test_the_table_can_be_filtered(cli: Cli) -> None:
    def shown(*words: str) -> set[tuple[str, str]]:
        rows = json.loads(cli.does('watch', '--once', '--json', *words))
        return {(row['kind'], row['name']) for row in rows}
    assert shown('--kind', 'pir', '--kind', 'lamp') == {('pir', 'eye'), ('lamp', 'kitchen0')}
    assert shown('--room', 'kitchen') == {('lamp', 'kitchen0')}
    assert shown('eye', 'bathroom0') == {('pir', 'eye'), ('door', 'bathroom0')}
    assert shown('--kind', 'lamp', '--active') == set()
    assert 'did you mean eye' in cli.fails('watch', '--once', 'eyes')
    assert 'did you mean pir' in cli.fails('watch', '--once', '--kind', 'pri')


def test_a_table_that_lacks_a_reading_ends_with_1(cli: Cli, angen: Angen, spawned: list[str]
                                                  ) -> None:
    with angen.paused():
        spawned.append('cli_silent')
        cli.does('spawn', 'humidity', 'cli_silent', '--pose', '0 0 1')
        done = cli.run('watch', '--once', 'cli_silent')
        assert done.returncode == 1 and 'humidity  cli_silent  -' in done.stdout
        assert done.stderr == ('angen: no reading of humidity cli_silent: '
                               'the simulation is paused\n')
    assert 'cli_silent' in cli.does('watch', '--once', 'cli_silent')


def test_a_sensor_without_a_model_is_spawned(cli: Cli, angen: Angen, spawned: list[str]) -> None:
    from sensor_msgs.msg import LaserScan
    spawned += ['cli_lidar', 'cli_lidar2']
    cli.does('spawn', 'lidar', 'cli_lidar', '--pose', '0 0 1', '--set', 'ray/range/max=3')
    assert angen.wait('/angen/lidar/cli_lidar', LaserScan).range_max == 3
    assert ' on turtlebot::' in cli.does('spawn', 'lidar', 'cli_lidar2', '--on',
                                         'turtlebot::base_footprint')


def test_one_table_of_all_costs(cli: Cli) -> None:
    once = cli.does('top', '--once').splitlines()
    assert ' s simulated in ' in once[0] and 'physics' in once[1]
    rows = [line.split() for line in once[3:]]
    everything = {(e['kind'], e['name']) for e in json.loads(cli.does('list', '--json'))
                  if e['kind'] != 'model'}
    assert {(row[0], row[1]) for row in rows} == everything
    costs = [float(row[2]) for row in rows]
    assert costs == sorted(costs, reverse=True) and costs[0] > 0
    again = cli.does('top').splitlines()[2]  # as much where there is no terminal
    assert again.split() == once[2].split()


@pytest.mark.parametrize('word, row', [('watch', b'kitchen0'), ('top', b'bathroom0')])
@pytest.mark.parametrize('key', [b'q', b'\x03'])
def test_a_live_table_ends_by_a_key_and_cleans_the_terminal(cli: Cli, key: bytes, word: str,
                                                            row: bytes) -> None:
    ours, theirs = open_terminal()
    before = termios.tcgetattr(theirs)
    watching = subprocess.Popen(
        [*cli.words, word], env=cli.environment, stdin=theirs, stdout=theirs, stderr=theirs,
        preexec_fn=own_terminal)
    shown = b''
    while row not in shown:
        shown += os.read(ours, 4096)
    os.write(ours, key)
    code = watching.wait(30)
    os.set_blocking(ours, False)
    assert code == 0, os.read(ours, 1 << 16)
    assert termios.tcgetattr(theirs) == before
    os.close(theirs)
    os.close(ours)


def test_ctrl_c_is_quiet(tmp_path: Path) -> None:
    """While the command waits for a simulator that has its request and does not answer."""
    with Master(tmp_path) as master, socket.create_server(('127.0.0.1', 0)) as silent:
        silent.settimeout(60)
        master.api.registerService('/silent', '/angen/list',
                                   f'rosrpc://127.0.0.1:{silent.getsockname()[1]}', master.uri)
        cli = Cli(master)
        listing = subprocess.Popen([*cli.words, 'list'], env=cli.environment, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        connection, _ = silent.accept()
        with connection:
            assert b'service=/angen/list' in connection.recv(4096)
            listing.send_signal(signal.SIGINT)
            said = listing.communicate(timeout=30)
        assert (listing.returncode, said) == (130, ('', ''))
