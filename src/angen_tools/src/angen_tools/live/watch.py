"""angen watch: every device and sensor, live."""
from __future__ import annotations

import math
import sys
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Iterable

from angen_tools.common.failure import Failure
from angen_tools.common.geometry import yaw_of
from angen_tools.common.output import as_json, number, table
from angen_tools.live.client import Client, Mailbox
from angen_tools.live.control import describe

if TYPE_CHECKING:
    from rich.console import RenderableType

ONCE_LIMIT = 3.0   # s of wall time that `--once` gives to sensors of 1 Hz
REFRESH = 0.25     # s of wall time between two pictures
RELIST = 2.0       # s of wall time between two queries of what there is
WIDEST = 72        # characters of a generic reading that are shown
PERSON_MODES = ('standing', 'walking', 'blocked')
HEAD = ('KIND', 'NAME', 'VALUE', 'TIME')


def value_of(message: Any) -> str:
    """A state or reading in a few words, by the name of its type."""
    kind = type(message).__name__
    words = VALUES.get(kind)
    return words(message) if words else ''


def _pir(m: Any) -> str:
    return f'{"MOTION" if m.motion else "still"}  {m.difference:.3f} m'


def _switch(m: Any) -> str:
    return f'{"closed" if m.closed else "open"}  {m.ranges[0]:.3f} {m.ranges[1]:.3f} m'


def _light(m: Any) -> str:
    return f'{m.illuminance:.2f} lx  rgb {m.r:.2f} {m.g:.2f} {m.b:.2f}'


def _contacts(m: Any) -> str:
    force = sum(state.total_wrench.force.z for state in m.states)
    others = sorted({state.collision2_name.split('::')[0] for state in m.states})
    return f'{", ".join(others)}  {force:.1f} N' if m.states else 'nothing'


def _person(m: Any) -> str:
    at = m.pose.position
    return f'{PERSON_MODES[m.mode]} at {number(at.x)} {number(at.y)} {number(at.z)}'


def _odometry(m: Any) -> str:
    at, speed = m.pose.pose, m.twist.twist
    yaw = yaw_of(at.orientation)
    return (f'at {number(at.position.x)} {number(at.position.y)} m, {number(yaw)} rad, '
            f'{number(speed.linear.x)} m/s {number(speed.angular.z)} rad/s')


def _range(m: Any) -> str:
    return f'{m.range:.3f} m' if math.isfinite(m.range) else 'nothing near'


def _pressure(m: Any) -> str:
    return f'{"PRESSED" if m.pressed else "free"}  {m.load:.1f} kg'


def _reed(m: Any) -> str:
    return f'{"closed" if m.closed else "open"}  {1000 * m.distance:.1f} mm'


def _rfid(m: Any) -> str:
    return ', '.join(f'{i} {d:.2f} m' for i, d in zip(m.ids, m.distances)) or 'no tag'


def _plug(m: Any) -> str:
    load = m.load if m.connected else 'no load'
    return f'{load}  {m.power:.1f} W  {m.energy / 3.6e6:.4f} kWh'


def _temperature(m: Any) -> str:
    return f'{m.temperature:.2f} °C'


def _humidity(m: Any) -> str:
    return f'{100 * m.relative_humidity:.1f} %'


def _battery(m: Any) -> str:
    return f'{100 * m.percentage:.1f} %  {m.voltage * abs(m.current):.1f} W'


def _reading(m: Any) -> str:
    numbers = [f'{name}={value:g}' for name, value in zip(m.names, m.values)]
    text = ' '.join(numbers + [f'{n}={t}' for n, t in zip(m.text_names, m.texts)])
    return text if len(text) <= WIDEST else text[:WIDEST - 1] + '…'


VALUES = {'PirMsg': _pir, 'SwitchMsg': _switch, 'LightSensMsg': _light, 'ContactsState': _contacts,
          'PersonState': _person, 'Odometry': _odometry, 'Reading': _reading,
          'Range': _range, 'PressureMsg': _pressure, 'ReedMsg': _reed, 'RfidMsg': _rfid,
          'PlugMsg': _plug, 'Temperature': _temperature, 'RelativeHumidity': _humidity,
          'BatteryState': _battery,
          'DoorState': describe, 'ElevatorState': describe, 'LampState': describe}


def readings_in(message: Any) -> Iterable[tuple[str, Any]]:
    """(name, reading) of all whose readings a message holds, with "" for a topic of its own."""
    if hasattr(message, 'readings'):
        return zip(message.names, message.readings)
    return [('', message)]


def _source(entity: Any) -> tuple[str, str]:
    """The topic of an entity, and its name in the messages if it shares the topic."""
    return entity.topic, entity.name if entity.type.endswith('Array') else ''


class Board:
    """The latest message of every device and sensor."""

    def __init__(self) -> None:
        self._client = Client()
        self._mail = Mailbox(self._client)
        self._entities: list[Any] = []
        self._latest: dict[tuple[str, str], Any] = {}  # by source
        self._waiting: set[tuple[str, str]] = set()
        self.relist()

    def relist(self) -> None:
        """Follows what was spawned and deleted."""
        entities = [e for e in self._client.entities() if e.topic]
        old = {e.topic for e in self._entities}
        new = {e.topic: e.type for e in entities}
        for topic in old - set(new):
            self._mail.unsubscribe(topic)
        for topic in sorted(set(new) - old):
            self._mail.subscribe(topic, new[topic])
        self._entities = sorted(entities, key=lambda e: (e.kind, e.name))
        sources = {_source(entity) for entity in entities}
        self._latest = {who: last for who, last in self._latest.items() if who in sources}
        self._waiting = sources - set(self._latest)

    def receive(self, limit: float) -> None:
        """Takes messages for `limit` s of wall time, or until each source has sent its first."""
        waiting = bool(self._waiting)
        self._mail.until(lambda *mail: self._take(*mail) and waiting, limit)

    def _take(self, topic: str, message: Any) -> bool:
        """True when each source has sent one. Messages of what is deleted now are dropped."""
        for name, reading in readings_in(message):
            source = (topic, name)
            if source in self._latest or source in self._waiting:
                self._latest[source] = reading
                self._waiting.discard(source)
        return not self._waiting

    def rows(self) -> list[list[str]]:
        """The rows of the table."""
        return [self._row(entity) for entity in self._entities]

    def _row(self, entity: Any) -> list[str]:
        message = self._latest.get(_source(entity))
        if message is None:
            return [entity.kind, entity.name, '-', '']
        return [entity.kind, entity.name, value_of(message),
                f'{message.header.stamp.to_sec():.1f}']


def watch_once(json: bool = False) -> RenderableType:
    """The table of what each device and sensor sent, after at most ONCE_LIMIT s."""
    board = Board()
    board.receive(ONCE_LIMIT)
    if json:
        return as_json([dict(zip((word.lower() for word in HEAD), row)) for row in board.rows()])
    return table(HEAD, board.rows())


def watch() -> None:
    """Draws the table anew until q or Ctrl-C; space turns its pages."""
    from angen_tools.common.terminal import LiveTable
    if not sys.stdin.isatty() or not sys.stdout.isatty():
        raise Failure('a live table needs a terminal; use --once for one table')
    board = Board()
    listed = time.monotonic()
    with LiveTable() as screen, suppress(KeyboardInterrupt):
        while not screen.closed():
            board.receive(REFRESH)
            if time.monotonic() - listed > RELIST:
                board.relist()
                listed = time.monotonic()
            screen.draw('', HEAD, board.rows())
