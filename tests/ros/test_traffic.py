"""The messages that are sent: none without a subscriber, one for all of a kind."""
import json
import subprocess
from pathlib import Path
from typing import Any, Iterator

import pytest
import yaml
from harness import WORLD, Angen, Cli, Inbox, Master, end, until, world_file

TWO_PIRS = WORLD.replace('<include><uri>model://pir', '''
    <include><uri>model://pir</uri><name>other_eye</name><pose>2 4 1.5 0 0 0</pose></include>
    <include><uri>model://pir''')


class House:
    """A node with a master of its own, and no subscriber of /clock but roscpp in that node."""

    def __init__(self, folder: Path, **params: object) -> None:
        self.master = Master(folder)
        self.master.api.setParam('/test', '/use_sim_time', True)
        self.node = self.master.node(world_file(TWO_PIRS, folder), folder / 'log', **params)
        self.master.api.setParam('/test', '/use_sim_time', False)
        self.cli = Cli(self.master)

    def end(self) -> None:
        end(self.node)
        end(self.master.process)

    def echo(self, topic: str, count: int) -> list[Any]:
        """That many messages of a topic, as rostopic prints them."""
        done = subprocess.run(['/usr/bin/rostopic', 'echo', '-n', str(count), topic], text=True,
                              env=self.master.environment, capture_output=True, timeout=60)
        assert done.returncode == 0, done.stderr
        return [message for message in yaml.safe_load_all(done.stdout) if message]

    def start(self, *words: str) -> subprocess.Popen[str]:
        return subprocess.Popen(['/usr/bin/rostopic', *words], env=self.master.environment,
                                text=True, stdout=subprocess.DEVNULL)


@pytest.fixture(scope='module')
def house_of_kinds(tmp_path_factory: pytest.TempPathFactory) -> Iterator[House]:
    started = House(tmp_path_factory.mktemp('kinds'), topics='kind')
    yield started
    started.end()


@pytest.fixture(params=['sensor', 'kind'])
def house(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[House]:
    if request.param == 'kind':
        yield request.getfixturevalue('house_of_kinds')
        return
    started = House(tmp_path, topics='sensor')
    yield started
    started.end()


def test_nothing_is_sent_that_nobody_hears(house: House) -> None:
    """While a robot drives, a door opens, a lamp lights up, and every sensor reads."""
    driving = house.start('pub', '-r', '10', '/cmd_vel', 'geometry_msgs/Twist',
                          '{linear: {x: 0.2}}')
    subscriber = None
    try:
        until(lambda: '/cmd_vel' in house.master.topics(), 'the robot is driven')
        for kind, name, value in (('door', 'bathroom0', 'open'), ('lamp', 'kitchen0', 'on')):
            house.cli.does('set', kind, name, value)
        stats = house.echo('/angen/stats', 4)
        assert [b['messages'] - a['messages'] for a, b in zip(stats, stats[1:])] == [1, 1, 1]
        assert stats[-1]['readings'] > stats[0]['readings']
        subscriber = house.start('echo', '/odom')
        stats = house.echo('/angen/stats', 4)
        assert stats[-1]['messages'] - stats[0]['messages'] > 10
    finally:
        for process in (driving, subscriber):
            if process:
                end(process)


def test_all_of_a_kind_share_a_topic(house_of_kinds: House) -> None:
    until(lambda: '/bumper' in house_of_kinds.master.topics(), 'the sensors are there')
    topics = house_of_kinds.master.topics()
    assert topics['/angen/pir'] == 'angen_msgs/PirArray'
    assert not [topic for topic in topics if topic.startswith('/angen/pir/')]
    assert topics['/scan'] == 'sensor_msgs/LaserScan'  # a robot's sensors keep theirs
    assert topics['/bumper'] == 'gazebo_msgs/ContactsState'


def test_what_falls_due_in_one_tick_goes_in_one_message(house_of_kinds: House) -> None:
    first, second = house_of_kinds.echo('/angen/pir', 2)
    for message in (first, second):
        assert sorted(message['names']) == ['eye', 'other_eye']
        assert [r['header']['frame_id'] for r in message['readings']] == message['names']
        assert all(r['header']['stamp'] == message['header']['stamp']
                   for r in message['readings'])
    stamps = [m['header']['stamp']['secs'] + 1e-9 * m['header']['stamp']['nsecs']
              for m in (first, second)]
    assert stamps[1] - stamps[0] == pytest.approx(0.1)


def test_devices_of_a_kind_share_a_topic_too(house_of_kinds: House) -> None:
    """A new subscriber gets the states of all devices, of whatever age; then the changed ones."""
    cli, master = house_of_kinds.cli, house_of_kinds.master
    assert master.topics()['/angen/door'] == 'angen_msgs/DoorStateArray'
    assert not [topic for topic in master.topics() if topic.startswith('/angen/door/')]
    cli.does('spawn', 'model', 'model://ceiling_lamp', 'late', '--pose', '1 1 2')
    lamps, = house_of_kinds.echo('/angen/lamp', 1)
    assert {'kitchen0', 'late0'} <= set(lamps['names'])
    assert [lamp['name'] for lamp in lamps['readings']] == lamps['names']
    echo = subprocess.Popen(['/usr/bin/rostopic', 'echo', '-n', '2', '/angen/lamp'],
                            env=master.environment, text=True, stdout=subprocess.PIPE)
    assert echo.stdout is not None
    try:
        while echo.stdout.readline() != '---\n':
            pass
        cli.does('set', 'lamp', 'late0', 'on')
        change = yaml.safe_load(echo.communicate(timeout=60)[0].split('---')[0])
        assert change['names'] == ['late0'] and change['readings'][0]['level'] > 0
    finally:
        end(echo)
    cli.does('delete', 'late')
    lamps, = house_of_kinds.echo('/angen/lamp', 1)
    assert 'kitchen0' in lamps['names'] and 'late0' not in lamps['names']


def test_lists_and_tables_know_shared_topics(house_of_kinds: House) -> None:
    cli = house_of_kinds.cli
    listed = {e['name']: e for e in json.loads(cli.does('list', '--kind', 'pir', '--json'))}
    assert set(listed) == {'eye', 'other_eye'}
    assert listed['eye']['topic'] == '/angen/pir'
    assert listed['eye']['type'] == 'angen_msgs/PirArray'
    door, = json.loads(cli.does('list', '--kind', 'door', '--json'))
    assert (door['topic'], door['type']) == ('/angen/door', 'angen_msgs/DoorStateArray')
    rows = {tuple(row.split()[:2]): row for row in cli.does('watch', '--once').splitlines()}
    assert ' m ' in rows['pir', 'eye'] and ' m ' in rows['pir', 'other_eye']


def test_who_comes_later_speaks_where_the_others_do(house_of_kinds: House) -> None:
    cli = house_of_kinds.cli
    said = cli.does('spawn', 'pir', 'late', '--pose', '1 1 1')
    assert said.endswith('see /angen/pir')
    assert any('late' in message['names'] for message in house_of_kinds.echo('/angen/pir', 4))
    cli.does('delete', 'late')
    assert not any('late' in message['names'] for message in house_of_kinds.echo('/angen/pir', 4))


def test_other_words_for_topics_are_rejected(master: Master, tmp_path: Path) -> None:
    said = master.rejected(world_file(WORLD, tmp_path), '_topics:=all', '__name:=odd_topics')
    assert said.splitlines()[-1] == "~topics is 'all', must be sensor or kind"


def test_latched_topics_say_so(angen: Angen) -> None:
    """As rosbag and rostopic want to know, although the node keeps the last message itself."""
    from angen_msgs.msg import DoorState
    from tf2_msgs.msg import TFMessage
    for topic, kind in (('/angen/door/bathroom0', DoorState), ('/tf_static', TFMessage)):
        with Inbox(topic, kind) as inbox:
            message = inbox.wait(lambda m: True, f'what {topic} said last')
            assert message._connection_header['latching'] == '1'
