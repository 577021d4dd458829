"""/angen/summary: the last reading or state of every sensor and device, in words."""
from __future__ import annotations

import math
import time
from dataclasses import dataclass
from typing import Any, Sequence

from angen_tools.common.catalog import kinds
from angen_tools.common.failure import Failure
from angen_tools.live.client import CONNECT_LIMIT, Client, Mailbox

TOPIC = '/angen/summary'
STATS = '/angen/stats'
RECENT = 5.0  # s of wall time for which a change counts as activity


@dataclass(frozen=True)
class Filter:
    """Which rows are shown; an empty part lets all pass."""

    names: Sequence[str] = ()
    kinds: Sequence[str] = ()
    room: str = ''
    active: bool = False

    def passes(self, kind: str, name: str, room: str = '') -> bool:
        """Whether a sensor or device is shown, whatever it does."""
        return ((not self.names or name in self.names)
                and (not self.kinds or kind in self.kinds)
                and any(self.room.lower() in text.lower() for text in (room, name)))


@dataclass
class Row:
    """A sensor or device, as the simulator summarizes it."""

    kind: str
    name: str
    text: str       # '' before its first reading
    alarm: bool     # it detects something
    stamp: float    # s, of that reading
    period: float   # s, how often a sensor publishes; 0 for a device and a sensor on demand
    room: str = ''
    changed: float = -math.inf  # s of wall time, when its text changed last

    @property
    def waits(self) -> bool:
        """Whether it is a sensor whose first reading has still to come."""
        return self.period > 0 and not self.text


class Board:
    """The messages of /angen/summary, and the state of time in the simulation."""

    def __init__(self, client: Client) -> None:
        from angen_msgs.msg import Stats, Summary
        self.rows: dict[tuple[str, str], Row] = {}
        self.time = 0.0       # s simulated
        self.paused = False
        self._complete = False
        self._rooms = {(e.kind, e.name): e.room for e in client.entities()}
        self._mail = Mailbox(client)
        self._mail.subscribe(STATS, Stats)
        self._mail.subscribe(TOPIC, Summary)
        if not self._mail.until(self._begins, CONNECT_LIMIT):
            raise Failure(f'{TOPIC} is not published')

    def _begins(self, topic: str, message: Any) -> bool:
        self.take(topic, message)
        return self._complete

    def receive(self, limit: float) -> bool:
        """Takes the messages of up to `limit` s of wall time; false where none came."""
        return self._mail.drain(self.take, limit)

    def take(self, topic: str, message: Any) -> None:
        """Takes a Summary or Stats message."""
        if topic == STATS:
            self.paused = message.paused
            self.time = max(self.time, message.sim_time.to_sec())
            return
        self.time = message.header.stamp.to_sec()
        before = self.rows
        if message.complete:
            self._complete = True
            self.rows = {}
        for entry in message.entries:
            key = (entry.kind, entry.name)
            row = Row(*key, entry.text, entry.alarm, entry.stamp.to_sec(), entry.period,
                      self._rooms.get(key, ''))
            old = before.get(key)
            if old is not None:
                row.changed = old.changed if old.text == row.text else time.monotonic()
            self.rows[key] = row

    def chosen(self, rule: Filter) -> list[Row]:
        """The rows to show, by kind and name."""
        rows = (row for _, row in sorted(self.rows.items())
                if rule.passes(row.kind, row.name, row.room))
        return [row for row in rows if not rule.active or is_active(row)]


def is_active(row: Row) -> bool:
    """Whether a row is an alarm; for kinds without alarms, whether it has changed lately."""
    kind = kinds().get(row.kind)
    if kind is not None and any(field['alarm'] for field in kind['fields']):
        return row.alarm
    return time.monotonic() - row.changed < RECENT
