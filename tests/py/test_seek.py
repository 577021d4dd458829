"""angen task seek in two rooms with a door between them: with a person, and without one."""
import csv
import json
import math
import subprocess
import sys
from pathlib import Path

import pytest
from harness import SCRIPT
from two_rooms import two_rooms

ROUTE = '''waypoints:
- {name: unused, floor: 0, at: [4.8, 1.5]}
'''


PARTS = (('kitchen_pir0', 'pir', '5.95 0.05 2.2 0 0.45 2.356'),
         ('turtlebot', 'turtlebot', '0.7 1.5 0.001 0 0 0'))


def seek(folder: Path, *words: str, person: bool = True, world: str = ''
         ) -> subprocess.CompletedProcess[str]:
    (folder / 'rooms.world').write_text(two_rooms(*PARTS, more='<actor name="anna"/>' * person))
    (folder / 'route.yaml').write_text(ROUTE)
    return subprocess.run(
        [sys.executable, str(SCRIPT), 'task', 'seek', world or str(folder / 'rooms.world'),
         '--route', str(folder / 'route.yaml'), '--out', str(folder / 'out'), *words],
        text=True, stdin=subprocess.DEVNULL, capture_output=True, timeout=500)


def events(folder: Path) -> list[dict[str, str]]:
    with (folder / 'out/events.csv').open() as file:
        return list(csv.DictReader(file))


def test_he_is_found_behind_a_door(tmp_path: Path) -> None:
    done = seek(tmp_path, '--seed', '2', '--json')
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads(done.stdout)
    assert found['found'] and found['collisions'] == 0
    assert found['room'] == found['true_room']
    assert found['error_m'] < 0.2
    assert found['time_s'] < 120
    assert (tmp_path / 'out/search.png').read_bytes().startswith(b'\x89PNG')
    with (tmp_path / 'out/person.csv').open() as file:
        last = list(csv.DictReader(file))[-1]
    assert math.dist((float(last['x_m']), float(last['y_m'])),
                     (found['x_m'], found['y_m'])) < 0.4


def test_a_world_without_people_has_no_person_to_find(tmp_path: Path) -> None:
    done = seek(tmp_path, '--limit', '40', person=False)
    assert done.returncode == 1, done.stdout + done.stderr
    assert done.stdout.startswith('no person was found within 40 s; most probable is ')
    assert 'collisions: 0' in done.stdout
    assert done.stderr.splitlines()[-1] == 'angen: no person was found within 40 s'
    opened = [e['event'] for e in events(tmp_path)
              if (e['source'], e['kind']) == ('kitchen0', 'door')]
    assert opened[:2] == ['opening', 'opened']  # it has looked there


def test_the_same_seed_gives_the_same_search(tmp_path: Path) -> None:
    logs = []
    for _ in range(2):
        seek(tmp_path, '--seed', '3', '--limit', '15')
        logs.append((events(tmp_path), (tmp_path / 'out/track.csv').read_text()))
    assert logs[0] == logs[1]


def test_a_world_must_have_the_robot_and_a_floor(tmp_path: Path) -> None:
    plugin = '<plugin name="robots" filename="librobot_controller.so"/>'
    robot = '<include><uri>model://turtlebot</uri><name>turtlebot</name></include>'
    for content, says in (('', 'has no robot turtlebot; include model://turtlebot'),
                          (robot + plugin, 'there is no floor')):
        (tmp_path / 'bare.world').write_text(
            f'<sdf version="1.6"><world name="w">{content}</world></sdf>')
        for more in ((), ('--seeds', '2')):
            done = seek(tmp_path, *more, world=str(tmp_path / 'bare.world'))
            assert done.returncode == 1 and says in done.stderr.splitlines()[-1], done.stderr
            assert 'Traceback' not in done.stderr


@pytest.mark.parametrize('words, world, says', [
    (('--limit', '0'), '', "'0' is not a valid time"), ((), '/nowhere.world', '/nowhere.world')])
def test_what_is_wrong_is_said(tmp_path: Path, words: tuple[str, ...], world: str, says: str
                               ) -> None:
    done = seek(tmp_path, *words, world=world)
    assert done.returncode != 0 and says in done.stderr
    assert 'Traceback' not in done.stderr
