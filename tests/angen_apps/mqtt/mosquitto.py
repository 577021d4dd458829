"""Debian's mosquitto on a free port of 127.0.0.1, and a client that watches it."""
import json
import subprocess
from pathlib import Path
from typing import Any, Callable

import paho.mqtt.client as paho
from harness import free_port, until

OPEN = 'allow_anonymous true\n'


class Mosquitto:
    """A broker without persistence, which can be stopped and started again."""

    def __init__(self, folder: Path, config: str = OPEN) -> None:
        self.port = free_port()
        self._file = folder / 'mosquitto.conf'
        self._file.write_text(f'user root\nlistener {self.port} 127.0.0.1\n{config}')
        self._log = folder / 'mosquitto.log'
        self.process: subprocess.Popen[bytes] | None = None
        self.start()

    def start(self) -> None:
        with self._log.open('wb') as out:
            self.process = subprocess.Popen(['/usr/sbin/mosquitto', '-c', str(self._file)],
                                            stdout=out, stderr=out)
        until(lambda: 'running' in self._log.read_text(), 'the broker runs')

    def stop(self) -> None:
        if self.process is not None:
            self.process.terminate()
            self.process.wait(10.0)
            self.process = None


class Client:
    """All that a broker has; `retained` as a newcomer would find it."""

    def __init__(self, port: int) -> None:
        self.retained: dict[str, str] = {}
        self.received: list[tuple[str, str]] = []
        self._is_subscribed = False
        self._client = paho.Client()
        self._client.on_message = self._on_message
        self._client.on_subscribe = self._on_subscribe
        self._client.on_connect = lambda client, *_: client.subscribe('#', 0)
        self._client.max_inflight_messages_set(1000)
        self._client.connect('127.0.0.1', port)
        self._client.loop_start()
        until(lambda: self._is_subscribed, 'the client has subscribed')

    def _on_subscribe(self, *_: Any) -> None:
        self._is_subscribed = True

    def _on_message(self, _: Any, __: Any, message: Any) -> None:
        text = message.payload[:100_000].decode(errors='replace')
        self.received.append((message.topic, text))
        if text:
            self.retained[message.topic] = text
        else:
            self.retained.pop(message.topic, None)

    def send(self, topic: str, payload: str | bytes, retain: bool = False) -> None:
        self._client.publish(topic, payload, 0, retain).wait_for_publish(20.0)

    def has(self, topic: str, payload: str, limit: float = 30.0) -> None:
        """Returns when that is the latest message of the topic."""
        until(lambda: self.retained.get(topic) == payload,
              f'{topic} is {payload}, not {self.retained.get(topic)}', limit)

    def gets(self, topic: str, accept: Callable[[str], bool] = lambda _: True) -> str:
        """A message of a topic that is accepted, of all so far and to come."""
        found: list[str] = until(lambda: [text for name, text in list(self.received)
                                          if name == topic and accept(text)], topic)
        return found[-1]

    def configs(self) -> dict[str, Any]:
        return {topic: json.loads(text) for topic, text in list(self.retained.items())
                if topic.startswith('homeassistant/') and topic.endswith('/config')}

    def close(self) -> None:
        self._client.disconnect()
        self._client.loop_stop()
