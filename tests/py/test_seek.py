"""angen task seek in two rooms with a door between them: with a person, and without one."""
from __future__ import annotations

import csv
import json
import math
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[2] / 'src/angen_tools/scripts/angen'
WALLS = {'south': (3, -0.06, 6.24, 0.12), 'north': (3, 3.06, 6.24, 0.12),
         'west': (-0.06, 1.5, 0.12, 3), 'east': (6.06, 1.5, 0.12, 3),
         'low': (3, 0.4975, 0.12, 0.995), 'high': (3, 2.5, 0.12, 1.0)}
ROUTE = '''waypoints:
- {name: unused, floor: 0, at: [4.8, 1.5]}
'''


def box(name: str, x: float, y: float, z: float, wide: float, deep: float, high: float) -> str:
    shape = f'<geometry><box><size>{wide} {deep} {high}</size></box></geometry>'
    return (f'<collision name="{name}"><pose>{x} {y} {z} 0 0 0</pose>{shape}</collision>'
            f'<visual name="{name}"><pose>{x} {y} {z} 0 0 0</pose>{shape}</visual>')


def world_text(person: bool) -> str:
    walls = ''.join(box(name, x, y, 1.2, wide, deep, 2.4)
                    for name, (x, y, wide, deep) in WALLS.items())
    floors = ''.join(f'<link name="floor_{name}"><pose>{x} 1.5 -0.05 0 0 0</pose>'
                     f'{box(name, 0, 0, 0, 3.12, 3.24, 0.1)}</link>'
                     for name, x in (('hall', 1.5), ('kitchen', 4.5)))
    parts = [('kitchen_door0', 'kitchen_door', '3.0 1.0 0 0 0 1.570796'),
             ('kitchen_pir0', 'pir', '5.95 0.05 2.2 0 0.45 2.356'),
             ('turtlebot', 'turtlebot', '0.7 1.5 0.001 0 0 0')]
    models = ''.join(f'<include><name>{name}</name><pose>{pose}</pose><uri>model://{uri}</uri>'
                     '</include>' for name, uri, pose in parts)
    return f'''<sdf version="1.6"><world name="rooms"><gravity>0 0 -9.8</gravity>
      <model name="house"><static>true</static><link name="link">{walls}</link>{floors}</model>
      {models}{'<actor name="anna"/>' * person}
      <plugin name="doors" filename="libdoor_world_plugin.so"/>
      <plugin name="robots" filename="librobot_controller.so"/></world></sdf>'''


def seek(folder: Path, *words: str, person: bool = True, world: str = ''
         ) -> subprocess.CompletedProcess[str]:
    (folder / 'rooms.world').write_text(world_text(person))
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
