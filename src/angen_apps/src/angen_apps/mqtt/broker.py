"""The connection to an MQTT broker: comes back by itself, and says of each trouble one line."""
import secrets
import socket
import ssl
import sys
import threading
from collections import deque
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Iterable

import paho.mqtt.client as paho

from angen_tools.common.failure import Failure

MOST = 200  # messages that wait to be handled; then of each topic the latest
TOPICS = 1000  # with waiting messages beyond these
LONGEST = 64 * 1024  # bytes of a message that is read
LINES = 100  # in the log, different ones
RETRY = (1, 30)  # s between two attempts to connect, first and at most
KEEP_ALIVE = 20  # s
CONNECT_LIMIT = 5.0  # s
REASONS = {1: 'does not speak MQTT 3.1.1', 2: 'rejects the client id', 3: 'is not available',
           4: 'rejects the user name or password', 5: 'does not authorize this client'}


@dataclass(frozen=True)
class Access:
    """How to reach a broker, and who one is there."""

    host: str
    port: int
    user: str = ''
    password: str = ''
    tls: bool = False
    ca: Path | None = None
    certificate: Path | None = None
    key: Path | None = None

    @property
    def address(self) -> str:
        return f'{self.host}:{self.port}'


@dataclass(frozen=True)
class Message:
    topic: str
    payload: bytes
    retained: bool


class Log:
    """Lines on stderr, each text once."""

    def __init__(self) -> None:
        self._said: set[str] = set()

    def say(self, text: str, again: bool = False) -> None:
        """`again`: also if it was said before."""
        line = ''.join(c if c.isprintable() else '?' for c in text)[:500]
        if again or (line not in self._said and len(self._said) < LINES):
            self._said.add(line)
            print(f'angen mqtt: {line}', file=sys.stderr, flush=True)


class Broker:
    """Messages in both directions; `wake` is called by its thread when there is something new."""

    def __init__(self, access: Access, log: Log, wake: Callable[[], None]) -> None:
        self._access, self._log, self._wake = access, log, wake
        self._lock = threading.Lock()
        self._waiting: deque[Message] = deque()
        self._latest: dict[str, Message] = {}  # by topic, when too many wait
        self.connected = False
        self.connections = 0
        self._is_new = False  # the connection, or its end
        self._trouble = ''
        self._client = paho.Client(f'angen-{secrets.token_hex(8)}')
        self._client.max_queued_messages_set(MOST)
        self._client.reconnect_delay_set(*RETRY)
        self._client.on_connect = self._on_connect
        self._client.on_disconnect = self._on_disconnect
        self._client.on_message = self._on_message
        self._client.on_connect_fail = self._on_connect_fail
        self._client._connect_timeout = CONNECT_LIMIT
        if access.user:
            self._client.username_pw_set(access.user, access.password or None)
        if access.tls:
            self._secure(access)

    def _secure(self, access: Access) -> None:
        paths = [path for path in (access.ca, access.certificate, access.key) if path is not None]
        for path in paths:
            if not path.is_file():
                raise Failure(f'{path}: no such file')
        try:
            self._client.tls_set(*(str(path) if path else None for path in (
                access.ca, access.certificate, access.key)), tls_version=ssl.PROTOCOL_TLS_CLIENT)
        except (ssl.SSLError, OSError, ValueError) as error:
            raise Failure(f'{", ".join(map(str, paths))}: cannot be used for TLS: {error}'
                          ) from None

    def start(self, will: tuple[str, str]) -> None:
        """Connects, now or when there is a broker; `will` is published if this process ends."""
        self._client.will_set(*will, qos=1, retain=True)
        self._client.connect_async(self._access.host, self._access.port, KEEP_ALIVE)
        self._client.loop_start()

    def stop(self) -> None:
        """Sends what waits, and ends the connection."""
        self._client.disconnect()
        self._client.loop_stop()

    def subscribe(self, filters: Iterable[str]) -> None:
        self._client.subscribe([(topic, 0) for topic in filters])

    def unsubscribe(self, filters: Iterable[str]) -> None:
        self._client.unsubscribe(list(filters))

    def publish(self, topic: str, payload: str, retain: bool = True) -> None:
        """A state is retained; another message is kept for a broker that is away."""
        self._client.publish(topic, payload.encode(errors='replace'), qos=0 if retain else 1,
                             retain=retain)

    def take(self, most: int) -> list[Message]:
        """The next messages; empty if there are none."""
        with self._lock:
            self._is_new = False
            taken = [self._waiting.popleft() for _ in range(min(most, len(self._waiting)))]
            if not self._waiting and len(taken) < most:
                taken += self._latest.values()
                self._latest.clear()
            return taken

    @property
    def waiting(self) -> bool:
        """Whether there is something new."""
        return bool(self._waiting or self._latest or self._is_new)

    # --- the client's thread

    def _on_connect(self, _: Any, __: Any, ___: Any, code: int) -> None:
        if code != 0:
            self._fail(REASONS.get(code, f'refuses the connection ({code})'))
            return
        self._client.socket().setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        with self._lock:
            self.connected = self._is_new = True
            self.connections += 1
        if self._trouble:
            self._log.say(f'connected to {self._access.address}', True)
        self._trouble = ''
        self._wake()

    def _on_disconnect(self, _: Any, __: Any, code: int) -> None:
        if self.connected and code != 0:
            self._fail('has closed the connection')
        self.connected, self._is_new = False, True
        self._wake()

    def _on_connect_fail(self, _: Any, __: Any) -> None:
        error = sys.exc_info()[1]
        self._fail(f'cannot be reached{f": {error}" if error else ""}')

    def _fail(self, reason: str) -> None:
        if reason != self._trouble:
            self._trouble = reason
            self._log.say(f'the broker {self._access.address} {reason}; it is tried again', True)

    def _on_message(self, _: Any, __: Any, message: Any) -> None:
        if len(message.payload) > LONGEST:
            self._log.say(f'a message of {len(message.payload)} bytes is not read; {LONGEST} are '
                          'the most')
            return
        try:
            received = Message(message.topic, message.payload, bool(message.retain))
        except UnicodeDecodeError:  # in the topic, of a broker that does not check it
            return
        with self._lock:
            if len(self._waiting) < MOST and not self._latest:
                self._waiting.append(received)
            elif received.topic in self._latest or len(self._latest) < TOPICS:
                self._latest.pop(received.topic, None)
                self._latest[received.topic] = received
                self._log.say(f'more than {MOST} messages wait: of each topic the latest is kept')
            else:
                self._log.say(f'messages on more than {TOPICS} topics wait: others are not read')
        self._wake()
