"""A motion light as a program on MQTT: works beside angen mqtt, and in angen automation-test.

    python3 hall_light.py HOST PORT

Times are simulated, of the topic angen/simulation/simulation/time.
"""
import socket
import sys
from typing import Any

import paho.mqtt.client as mqtt

MOTION = 'angen/pir/hall_pir/motion'
LAMP = 'angen/lamp/entrance0/state/set'
TIME = 'angen/simulation/simulation/time'
BARRIER = 'angen/bridge/barrier'  # the bench asks whether all before it has been read
HOLD = 120.0  # s


class MotionLight:
    """Switches the lamp on by motion, and off when there was none for a while."""

    def __init__(self, client: mqtt.Client) -> None:
        self.client = client
        self.now = self.seen = 0.0
        self.moves = self.is_on = False

    def switch(self, on: bool) -> None:
        self.is_on = on
        self.client.publish(LAMP, 'ON' if on else 'OFF')

    def receive(self, topic: str, payload: str) -> None:
        if topic == MOTION:
            self.moves, self.seen = payload == 'ON', self.now
            if self.moves and not self.is_on:
                self.switch(True)
        elif topic == TIME:
            self.now = float(payload)
            if self.is_on and not self.moves and self.now >= self.seen + HOLD:
                self.switch(False)
        elif topic == BARRIER:
            self.client.publish(f'{BARRIER}/done', payload)


def main() -> None:
    client = mqtt.Client()
    light = MotionLight(client)

    def on_message(_: Any, __: Any, message: Any) -> None:
        light.receive(message.topic, message.payload.decode())

    def on_connect(*_: Any) -> None:
        client.socket().setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # no 40 ms pauses
        client.subscribe([(topic, 0) for topic in (MOTION, TIME, BARRIER)])

    client.on_message, client.on_connect = on_message, on_connect
    client.connect(sys.argv[1], int(sys.argv[2]))
    client.loop_forever()


if __name__ == '__main__':
    main()
