"""angen task patrol in two rooms with a door between them: its files, and that it repeats."""
import csv
import os
import random
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from harness import SCRIPT, processes_with, until, without_sanitizer
from two_rooms import two_rooms

ROUTE = '''waypoints:
- {name: kitchen, floor: 0, at: [4.8, 1.5]}
- {name: back, floor: 0, at: [1.0, 1.5]}
'''


PERSON = '''<actor name="person"><script><trajectory id="0" type="walk">
  <waypoint><time>0</time><pose>2 1.5 0 0 0 0</pose></waypoint>
  <waypoint><time>9</time><pose>2 2.5 0 0 0 0</pose></waypoint></trajectory></script></actor>'''
WORLD = two_rooms(('kitchen_switch0', 'optical_switch', '3.005 1.25 2.125 0 0 1.570796'),
                  ('kitchen_pir0', 'pir', '5.95 1.5 1.0 0 0.2 3.141593'),
                  ('turtlebot', 'turtlebot', '1.0 1.5 0.001 0 0 0'), more=PERSON)


def start(folder: Path, name: str, route: str = ROUTE, largest: int = -1) -> subprocess.Popen[str]:
    """`largest`: of a file that it writes, bytes; as on a full disk."""
    (folder / 'rooms.world').write_text(WORLD)
    (folder / 'route.yaml').write_text(route)
    command = [sys.executable, str(SCRIPT), 'task', 'patrol',
               str(folder / 'rooms.world'),
               '--route', str(folder / 'route.yaml'), '--seed', '3', '--out', str(folder / name)]
    return subprocess.Popen(command, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE,
                            preexec_fn=lambda: prepare(largest))


def prepare(largest: int) -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if largest > 0:
        resource.setrlimit(resource.RLIMIT_FSIZE, (largest, largest))


def running(folder: Path) -> list[int]:
    """Processes that a patrol has started and left."""
    return processes_with(f'ROS_HOME={folder}/')


def read(path: Path) -> list[dict[str, str]]:
    with path.open() as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope='module')
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """The folder of a whole patrol, and its output."""
    folder = tmp_path_factory.mktemp('patrol')
    patrol = start(folder, 'out')
    said, trouble = patrol.communicate(timeout=300)
    assert patrol.returncode == 0, said + trouble
    return folder, said


def test_the_door_is_opened_before_the_robot_and_shut_behind_it(run: tuple[Path, str]) -> None:
    events = read(run[0] / 'out/events.csv')
    assert [e['event'] for e in events if (e['source'], e['kind']) == ('kitchen0', 'door')] == [
        'opening', 'opened', 'closing', 'closed'] * 2
    assert not [e for e in events if e['kind'] == 'person']
    assert 'collisions: 0' in run[1]


def test_the_sensors_notice_it_after_they_could(run: tuple[Path, str]) -> None:
    rows = {row['sensor']: row for row in read(run[0] / 'out/rooms.csv')}
    for sensor in ('kitchen_pir0', 'kitchen_switch0'):
        assert 0 <= float(rows[sensor]['delay_s']) < 5, rows[sensor]
    opening = next(float(e['time_s']) for e in read(run[0] / 'out/events.csv')
                   if e['event'] == 'opening')
    assert float(rows['kitchen_switch0']['first_sight_s']) > opening
    assert float(rows['kitchen_pir0']['first_sight_s']) > opening


@without_sanitizer
def test_it_leaves_a_bag_and_a_figure_and_no_process(run: tuple[Path, str]) -> None:
    import rosbag
    with rosbag.Bag(str(run[0] / 'out/patrol.bag')) as bag:
        counts = {name: topic.message_count for name, topic in
                  bag.get_type_and_topic_info().topics.items()}
        seconds = bag.get_end_time() - bag.get_start_time()
        whole = next(message for _, message, _ in bag.read_messages('/angen/markers'))
    assert counts['/angen/pir/kitchen_pir0'] == pytest.approx(10 * seconds, abs=5)
    assert counts['/turtlebot/cmd_vel'] == pytest.approx(10 * seconds, abs=5)
    assert {'doors 0', 'sensors 0', 'robots'} <= {marker.ns for marker in whole.markers}
    assert counts['/tf_static'] and counts['/clock'] and counts['/tf']
    assert (run[0] / 'out/floor_0.png').read_bytes().startswith(b'\x89PNG')
    assert not running(run[0])


def test_the_same_seed_gives_the_same_run(run: tuple[Path, str]) -> None:
    again = start(run[0], 'again')
    said, trouble = again.communicate(timeout=300)
    assert again.returncode == 0, said + trouble
    for name in ('events.csv', 'rooms.csv'):
        assert (run[0] / 'again' / name).read_text() == (run[0] / 'out' / name).read_text()


def test_a_touch_is_felt_and_told(tmp_path: Path) -> None:
    """Nearer to a wall than a robot of 0.177 m radius can come."""
    patrol = start(tmp_path, 'out', 'clearance: 0.05\nwaypoints:\n'
                   '- {name: wall, floor: 0, at: [1.5, 0.1]}\n')
    said, trouble = patrol.communicate(timeout=300)
    assert patrol.returncode == 1, said + trouble
    last = trouble.splitlines()[-1]
    assert last.startswith('angen: the robot is stuck at 1.') and 'house::link::south' in last


def test_an_unreachable_waypoint_is_named_before_anything_moves(tmp_path: Path) -> None:
    patrol = start(tmp_path, 'out', ROUTE + '- {name: garden, floor: 0, at: [8, 1]}\n')
    said, trouble = patrol.communicate(timeout=300)
    assert patrol.returncode == 1 and said == ''
    assert trouble.startswith(f'angen: {tmp_path}/route.yaml:4: waypoint garden: ')
    assert not (tmp_path / 'out/patrol.bag').exists()
    assert not running(tmp_path)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_all(tmp_path: Path, number: int) -> None:
    patrol = start(tmp_path, 'out')
    for line in patrol.stderr:
        if 'patrol' in line:
            break
    assert running(tmp_path)
    os.kill(patrol.pid, number)
    _, trouble = patrol.communicate(timeout=60)
    assert patrol.returncode == 128 + number, trouble
    assert 'Traceback' not in trouble
    assert not running(tmp_path)


@pytest.mark.parametrize('seed', range(3))
def test_a_kill_while_it_starts_leaves_nothing(tmp_path: Path, seed: int) -> None:
    patrol = start(tmp_path, 'out')
    until(lambda: len(running(tmp_path)) > seed, 'master, node, rosbag')
    time.sleep(random.Random(seed).uniform(0.0, 0.5))
    patrol.kill()
    patrol.communicate()
    until(lambda: not running(tmp_path), 'all that it started ends', 5.0)


@without_sanitizer
def test_a_kill_while_it_drives_leaves_a_bag_that_can_be_read(tmp_path: Path) -> None:
    import rosbag
    patrol = start(tmp_path, 'out')
    for line in patrol.stderr:
        if 'reached' in line:
            break
    assert len(running(tmp_path)) > 2
    patrol.kill()
    patrol.communicate()
    until(lambda: not running(tmp_path), 'all that it started ends', 5.0)
    with rosbag.Bag(str(tmp_path / 'out/patrol.bag')) as bag:
        assert bag.get_message_count('/clock') > 10
    assert not (tmp_path / 'out/summary.csv').exists()


def test_a_bag_that_the_disk_has_no_room_for_ends_it_in_a_line(tmp_path: Path) -> None:
    import rosbag
    patrol = start(tmp_path, 'out', largest=2_000_000)
    said, trouble = patrol.communicate(timeout=300)
    assert patrol.returncode == 1 and said == '' and 'Traceback' not in trouble
    last = trouble.splitlines()[-1]
    assert last.startswith(f'angen: {tmp_path}/out/patrol.bag: cannot be written: ')
    assert 'rosbag reindex' in last and not (tmp_path / 'out/patrol.bag').exists()
    until(lambda: not running(tmp_path), 'all that it started ends', 5.0)
    with rosbag.Bag(str(tmp_path / 'out/patrol.bag.active'), 'a', allow_unindexed=True) as bag:
        for _ in bag.reindex():
            pass
    with rosbag.Bag(str(tmp_path / 'out/patrol.bag.active')) as bag:
        assert bag.get_message_count('/clock') > 10


def test_a_disk_that_is_too_small_ends_it_in_a_line(tmp_path: Path) -> None:
    disk = tmp_path / 'disk'
    disk.mkdir()
    in_it = ['unshare', '-rm', 'sh', '-c', 'mount -t tmpfs -o size=20m none "$0" && exec "$@"',
             str(disk)]
    if subprocess.run([*in_it, 'true'], capture_output=True).returncode != 0:
        pytest.skip('this user may not mount a file system of its own')
    (tmp_path / 'rooms.world').write_text(WORLD)
    (tmp_path / 'route.yaml').write_text(ROUTE)
    done = subprocess.run(
        [*in_it, sys.executable, str(SCRIPT), 'task', 'patrol',
         str(tmp_path / 'rooms.world'), '--route', str(tmp_path / 'route.yaml'), '--out',
         str(disk / 'out')], text=True, capture_output=True, timeout=120)
    assert done.returncode == 1 and 'Traceback' not in done.stderr
    last = done.stderr.splitlines()[-1]
    assert last.startswith(f'angen: {disk}/out/patrol.bag: cannot be written: the disk has ')
    assert 'MB left' in last and 'Less than 32M' in last
