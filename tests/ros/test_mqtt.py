"""angen mqtt between the node and Debian's mosquitto."""
import os
import re
import shlex
import subprocess
from pathlib import Path
from typing import Iterator

import pytest
from harness import ROOT, Angen, end, until
from tests.angen_apps.mqtt.mosquitto import Client, Mosquitto
from tests.angen_apps.mqtt.schema import errors

SCRIPT = ROOT / 'src/angen_apps/scripts/mqtt'
STATE, LAMP = 'angen/bridge/state', 'angen/lamp/kitchen0'
OTHERS = {'homeassistant/light/angen/other/config': '{}', 'house2/lamp/kitchen0/state': 'OFF',
          'angen/lamp/other/state': 'ON'}


class Process:
    """angen mqtt, with its log."""

    def __init__(self, angen: Angen, port: int, folder: Path, *words: str) -> None:
        self.log = folder / f'log{len(list(folder.iterdir()))}'
        with self.log.open('w') as out:
            self.process = subprocess.Popen(
                ['/usr/bin/python3', '-u', str(SCRIPT), '--broker', f'127.0.0.1:{port}', *words],
                env=angen.master.environment, text=True, stdout=out, stderr=out)

    def lines(self) -> list[str]:
        return self.log.read_text().splitlines()

    def kill(self) -> None:
        self.process.kill()
        self.process.wait()

    def memory(self) -> float:
        """MB."""
        pages = int(Path(f'/proc/{self.process.pid}/statm').read_text().split()[1])
        return pages * os.sysconf('SC_PAGE_SIZE') / 1e6


@pytest.fixture(scope='module')
def mosquitto(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Mosquitto]:
    started = Mosquitto(tmp_path_factory.mktemp('broker'))
    yield started
    started.stop()


@pytest.fixture(scope='module')
def client(mosquitto: Mosquitto) -> Iterator[Client]:
    made = Client(mosquitto.port)
    yield made
    made.close()


class House:
    """The process under test, which some tests replace by another."""

    def __init__(self, angen: Angen, port: int, folder: Path, client: Client) -> None:
        self._place = angen, port, folder
        self.client = client
        self.bridge = self.start()

    def start(self, *words: str) -> Process:
        started = Process(*self._place, *words)
        self.bridge = started
        return started

    def is_up(self) -> None:
        until(lambda: self.client.retained.get(STATE) == 'online'
              and f'{LAMP}/state' in self.client.retained, 'the bridge is online')


@pytest.fixture(scope='module')
def house(angen: Angen, mosquitto: Mosquitto, client: Client,
          tmp_path_factory: pytest.TempPathFactory) -> Iterator[House]:
    made = House(angen, mosquitto.port, tmp_path_factory.mktemp('bridge'), client)
    made.is_up()
    yield made
    assert end(made.bridge.process) == 0, made.bridge.lines()
    client.has(STATE, 'offline')


def test_discovery(house: House, client: Client) -> None:
    configs = client.configs()
    assert [each for topic, config in configs.items() for each in errors(topic, config)] == []
    assert {topic.split('/', 1)[1] for topic in configs} >= {
        'light/angen/lamp_kitchen0_state/config', 'cover/angen/door_bathroom0_state/config',
        'binary_sensor/angen/pir_eye_motion/config',
        'sensor/angen/simulation_simulation_time/config',
        'device_tracker/angen/drive_turtlebot_room/config'}


def test_commands_and_back(house: House, client: Client) -> None:
    client.send(f'{LAMP}/brightness/set', '40')
    client.has(f'{LAMP}/brightness', '40')
    client.has(f'{LAMP}/state', 'ON')
    door = 'angen/door/bathroom0'
    client.send(f'{door}/state/set', 'OPEN')
    client.has(f'{door}/state', 'open', 60.0)
    client.has(f'{door}/position', '100')
    client.send(f'{door}/position/set', '30')
    client.has(f'{door}/position', '30', 60.0)
    states = [text for topic, text in client.received if topic == f'{door}/state']
    assert states[:4] == ['closed', 'opening', 'open', 'closing']


def test_the_commands_of_the_page(house: House, mosquitto: Mosquitto) -> None:
    page = (ROOT / 'docs/automation.md').read_text()
    commands = re.findall(r'^(mosquitto_(?:sub|pub)) (.*?)(?: +# .*)?$', page, re.MULTILINE)
    assert len(commands) >= 4
    for program, words in commands:
        done = subprocess.run([program, '-p', str(mosquitto.port), *shlex.split(words)],
                              capture_output=True, timeout=60.0)
        assert done.returncode == 0, done.stderr


def test_motion_is_seen_and_so_are_faults(house: House, client: Client, angen: Angen) -> None:
    client.has('angen/pir/eye/motion', 'OFF')
    for fault, state in ('false_alarm per_day=80000', 'ON'), ('Off', 'OFF'):
        angen.command('fault/pir/eye', fault)
        client.has('angen/pir/eye/motion', state)


def test_a_broker_that_restarts_gets_everything_again(house: House, client: Client,
                                                      mosquitto: Mosquitto) -> None:
    before = {**client.configs()}
    mosquitto.stop()
    client.retained.clear()
    mosquitto.start()
    house.is_up()
    until(lambda: client.configs() == before, 'all entities are there again')
    client.send(f'{LAMP}/state/set', 'OFF')
    client.has(f'{LAMP}/state', 'OFF')


def test_the_will_of_a_killed_bridge_and_its_leftovers(house: House, client: Client, angen: Angen
                                                       ) -> None:
    angen.spawn('old_lamp0', 'model://ceiling_lamp', 3.0, -4.0, 2.5)
    until(lambda: 'angen/lamp/old0/state' in client.retained, 'the lamp is there')
    house.bridge.kill()
    client.has(STATE, 'offline')
    angen.delete('old_lamp0')
    for topic, payload in OTHERS.items():
        client.send(topic, payload, retain=True)
    house.start()
    client.has(STATE, 'online')
    until(lambda: not [topic for topic in list(client.retained) if '/old' in topic
                       or '_old' in topic], 'the leftovers are gone')
    until(lambda: OTHERS.items() <= client.retained.items(), 'those of others are there')


def test_two_houses_on_one_broker(house: House, client: Client, angen: Angen, tmp_path: Path
                                  ) -> None:
    same = Process(angen, house._place[1], tmp_path)
    second = Process(angen, house._place[1], tmp_path, '--prefix', 'house3', '--style',
                     'zigbee2mqtt')
    try:
        until(lambda: 'house3/Kitchen lamp' in client.retained, 'the second house')
        client.send('house3/Kitchen lamp/set', '{"brightness": 127}')
        client.has(f'{LAMP}/brightness', '50')
        assert same.process.wait(60.0) == 1
        assert 'has the prefix angen on this broker' in same.lines()[-1]
        client.has(STATE, 'online')
    finally:
        same.kill()
        assert end(second.process) == 0
    client.has('house3/bridge/state', '{"state": "offline"}')


def hostile(client: Client) -> None:
    for payload in (b'x' * 1_000_000, b'\xff\xfe\x00', 'NaN', '', '[' * 60_000, '-1e400'):
        for topic in (f'{LAMP}/brightness', 'angen/lamp/%s/state' % ('y' * 1000)):
            client.send(f'{topic}/set', payload)


def test_a_flood_is_survived_and_the_last_command_holds(house: House, client: Client) -> None:
    hostile(client)
    before = house.bridge.memory()
    for number in range(10_000):
        client._client.publish(f'{LAMP}/brightness/set', str(number % 100), 0)
    client.send(f'{LAMP}/brightness/set', '73')
    client.has(f'{LAMP}/brightness', '73', 60.0)
    assert house.bridge.memory() < before + 50.0
    assert len(house.bridge.lines()) < 15, house.bridge.lines()
    assert not [line for line in house.bridge.lines() if len(line) > 600 or 'Traceback' in line]
