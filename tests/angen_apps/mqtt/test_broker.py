"""The connection to a real broker."""
import subprocess
from pathlib import Path
from typing import Any, Iterator

import pytest
from angen_apps.mqtt.broker import LONGEST, MOST, Access, Broker, Log, Message
from angen_tools.common.failure import Failure
from harness import free_port, until

from tests.angen_apps.mqtt.mosquitto import Client, Mosquitto

WILL = ('angen/bridge/state', 'offline')


@pytest.fixture
def lines(capsys: pytest.CaptureFixture[str]) -> Any:
    read: list[str] = []

    def so_far() -> list[str]:
        read.extend(capsys.readouterr().err.splitlines())
        return read
    return so_far


@pytest.fixture
def mosquitto(tmp_path: Path) -> Iterator[Mosquitto]:
    started = Mosquitto(tmp_path)
    yield started
    started.stop()


def connected(access: Access) -> Broker:
    broker = Broker(access, Log(), lambda: None)
    broker.start(WILL)
    return broker


def test_a_broker_that_is_absent_goes_and_comes_back(mosquitto: Mosquitto, lines: Any,
                                                     monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr('angen_apps.mqtt.broker.RETRY', (1, 1))
    mosquitto.stop()
    broker = connected(Access('127.0.0.1', mosquitto.port))
    try:
        until(lambda: len(lines()) == 1, 'a line')
        mosquitto.start()
        until(lambda: broker.connected, 'it is connected')
        broker.subscribe(['a'])
        broker.publish('a', 'x')
        until(lambda: broker.take(10) == [Message('a', b'x', False)], 'a message')
        mosquitto.stop()
        until(lambda: not broker.connected, 'it is disconnected')
        broker.publish('bell', 'rings', retain=False)
        mosquitto.start()
        client = Client(mosquitto.port)
        client.gets('bell')
        client.close()
        assert broker.connections == 2
        said = lines()
        assert [part in line for part, line in zip(
            ('cannot be reached', 'connected', 'has closed the connection'), said)] == [True] * 3
        assert len(said) <= 5  # refused once more while it starts, and connected
    finally:
        broker.stop()


def test_a_wrong_password_is_one_line(tmp_path: Path, lines: Any) -> None:
    passwords = tmp_path / 'passwords'
    passwords.touch(0o600)
    subprocess.run(['mosquitto_passwd', '-b', passwords, 'anna', 'right'], check=True)
    passwords.chmod(0o644)
    mosquitto = Mosquitto(tmp_path, f'allow_anonymous false\npassword_file {passwords}\n')
    right = connected(Access('127.0.0.1', mosquitto.port, 'anna', 'right'))
    wrong = connected(Access('127.0.0.1', mosquitto.port, 'anna', 'wrong'))
    try:
        until(lambda: right.connected, 'the right one is connected')
        until(lambda: 'rejects the user name or password' in ''.join(lines())
              or 'does not authorize' in ''.join(lines()), 'a line')
        assert not wrong.connected and len(lines()) == 1
    finally:
        right.stop()
        wrong.stop()
        mosquitto.stop()


def certificate(folder: Path, name: str, signer: str = '') -> None:
    """A key, and a certificate for 127.0.0.1 by a signer or by itself."""
    by = ['-CA', folder / f'{signer}.crt', '-CAkey', folder / f'{signer}.key'] if signer else []
    subprocess.run(['openssl', 'req', '-x509', '-newkey', 'rsa:2048', '-nodes', '-days', '2',
                    '-subj', f'/CN={name}', '-addext', 'subjectAltName=IP:127.0.0.1',
                    '-keyout', folder / f'{name}.key', '-out', folder / f'{name}.crt', *by],
                   check=True, capture_output=True)


def test_tls_with_a_client_certificate(tmp_path: Path, lines: Any) -> None:
    certificate(tmp_path, 'ca')
    for name in ('server', 'client'):
        certificate(tmp_path, name, 'ca')
    for file in tmp_path.glob('*.key'):
        file.chmod(0o644)
    mosquitto = Mosquitto(tmp_path, f'allow_anonymous true\ncafile {tmp_path}/ca.crt\n'
                          f'certfile {tmp_path}/server.crt\nkeyfile {tmp_path}/server.key\n'
                          'require_certificate true\n')
    files = [tmp_path / name for name in ('ca.crt', 'client.crt', 'client.key')]
    right = connected(Access('127.0.0.1', mosquitto.port, '', '', True, *files))
    strange = connected(Access('127.0.0.1', mosquitto.port, '', '', True))
    try:
        until(lambda: right.connected, 'the right one is connected')
        until(lambda: any('certificate verify failed' in line for line in lines()), 'a line')
        assert not strange.connected
    finally:
        right.stop()
        strange.stop()
        mosquitto.stop()


@pytest.mark.parametrize('content', [None, 'no certificate'])
def test_files_that_cannot_be_used_are_named(tmp_path: Path, content: str | None) -> None:
    path = tmp_path / 'ca.crt'
    if content is not None:
        path.write_text(content)
    with pytest.raises(Failure, match=f'{path}: '):
        Broker(Access('127.0.0.1', free_port(), tls=True, ca=path), Log(), lambda: None)


class Sent:
    """A message of paho."""

    def __init__(self, topic: str, payload: bytes) -> None:
        self.topic, self.payload, self.retain = topic, payload, 0


def test_memory_is_bounded_and_the_latest_of_each_topic_stays(lines: Any) -> None:
    broker = Broker(Access('127.0.0.1', free_port()), Log(), lambda: None)
    for number in range(10 * MOST):
        broker._on_message(None, None, Sent(f'topic{number % 3}', str(number).encode()))
    broker._on_message(None, None, Sent('huge', bytes(LONGEST + 1)))
    taken: list[Message] = []
    while broker.waiting:
        taken += broker.take(50)
    assert len(taken) <= MOST + 3
    latest = {message.topic: int(message.payload) for message in taken}
    assert sorted(latest.values()) == [10 * MOST - 3, 10 * MOST - 2, 10 * MOST - 1]
    assert len(lines()) == 2
