"""A world and a broker in this process."""
from __future__ import annotations

import json
from collections import deque
from typing import Any

from angen_apps.mqtt import bridge
from angen_apps.mqtt.bridge import Bridge
from angen_apps.mqtt.broker import Log, Message
from angen_apps.mqtt.discovery import Discovery
from angen_apps.mqtt.habits import Habits
from angen_apps.mqtt.styles import STYLES
from angen_tools.common.catalog import kinds
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home, Room, Storey
from angen_tools.session import Entity, Event, State, Summary

POSE = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
SQUARE = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
OUTSIDE = (9.0, 9.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def home(storeys: int = 1) -> Home:
    return Home(storeys=[Storey(n, f'floor{n}', 3.0 * n, 3.0) for n in range(storeys)],
                rooms=[Room(f'kitchen{n}', 'kitchen', n, SQUARE, [], 3.0 * n, 3.0 * n + 2.5, 4.0,
                            False) for n in range(storeys)])


class Stats:
    """As angen_msgs/Stats."""

    class sim_time:
        @staticmethod
        def to_sec() -> float:
            return 61.0

    real_time_factor, paused = 1.0, False


class FakeWorld:
    """What a Bridge uses of a World; `commands` are those that were executed."""

    def __init__(self, *keys: str) -> None:
        self.keys = list(keys)
        self.home = home()
        self.now, self.rate, self.stats = 0.0, 1.0, Stats()
        self.commands: list[str] = []
        self.rejects = ''
        self.at = POSE
        self._states: list[State] = []
        self._events: list[Event] = []
        self._summaries: dict[tuple[str, str], Summary] = {}

    def entities(self, kind: str = '') -> list[Entity]:
        return [Entity(its, name, name, POSE, 'kitchen0')
                for its, _, name in (key.partition('/') for key in self.keys)]

    def pose(self, name: str) -> Any:
        return self.at

    def state(self, kind: str, name: str) -> State:
        return State(kind, name, 0.0, {'floors': 2, 'heating': 20.0})

    def states(self, *kinds: str) -> list[State]:
        taken = [state for state in self._states if state.kind in kinds]
        self._states = [state for state in self._states if state.kind not in kinds]
        return taken

    def events(self) -> list[Event]:
        taken, self._events = self._events, []
        return taken

    def summaries(self) -> dict[tuple[str, str], Summary]:
        return dict(self._summaries)

    def command(self, kind: str, name: str, text: str) -> str:
        if self.rejects and self.rejects in text:
            raise Failure(f"'{text}' is rejected")
        self.commands.append(f'{kind}/{name} {text}')
        return ''

    def pause(self) -> None:
        self.commands.append('pause')

    resume = reset = pause

    # --- what the test does to it

    def has_state(self, kind: str, name: str, **values: Any) -> None:
        self._states.append(State(kind, name, self.now, values))

    def has_event(self, kind: str, name: str, event: str, time: float = 0.0) -> None:
        self._events.append(Event(time, name, kind, event))

    def has_summary(self, kind: str, name: str, time: float = 0.0, **values: float) -> None:
        fields = [each['name'] for each in kinds()[kind]['fields']
                  if each['type'] in ('flag', 'integer', 'number')]
        self._summaries[kind, name] = Summary(kind, name, 'text', False, time, [
            values.get(each, float('nan')) for each in fields])


class FakeBroker:
    """Keeps what is retained, as a broker does; `sent` are all messages."""

    def __init__(self, other: FakeBroker | None = None) -> None:
        """`other` is the connection of another client to the same broker."""
        self.retained: dict[str, str] = other.retained if other else {}
        self.clients: list[FakeBroker] = [*(other.clients if other else ()), self]
        if other:
            other.clients = self.clients
        self.sent: list[tuple[str, str]] = []
        self.connected, self.connections = True, 1
        self.filters: set[str] = set()
        self._inbox: deque[Message] = deque()

    @property
    def waiting(self) -> bool:
        return bool(self._inbox)

    def take(self, most: int) -> list[Message]:
        return [self._inbox.popleft() for _ in range(min(most, len(self._inbox)))]

    def subscribe(self, filters: list[str]) -> None:
        self.filters |= set(filters)
        self._inbox += [Message(topic, self.retained[topic].encode(), True) for topic in filters
                        if topic in self.retained]

    def unsubscribe(self, filters: list[str]) -> None:
        self.filters -= set(filters)

    def publish(self, topic: str, payload: str, retain: bool = True) -> None:
        self.sent.append((topic, payload))
        if retain:
            self.retained[topic] = payload
            if not payload:
                del self.retained[topic]
        for client in self.clients:
            if topic in client.filters:
                client.receives(topic, payload)

    # --- what the test does to it

    def receives(self, topic: str, payload: str | bytes, retained: bool = False) -> None:
        sent = payload.encode() if isinstance(payload, str) else payload
        self._inbox.append(Message(topic, sent, retained))

    def restarts(self) -> None:
        """Without its memory."""
        self.retained.clear()
        self.filters.clear()
        self._inbox.clear()
        self.connections += 1

    def json(self, topic: str) -> Any:
        return json.loads(self.retained[topic])


class Rig:
    """A bridge between both."""

    def __init__(self, *keys: str, style: str = 'plain', by_device: bool = False,
                 truth: bool = False, habits: Habits | None = None, prefix: str = 'angen') -> None:
        self.world, self.broker = FakeWorld(*keys), FakeBroker()
        self.options = style, by_device, truth, habits, prefix
        self.log: list[str] = []
        self.bridge = self.another()

    def another(self, broker: FakeBroker | None = None) -> Bridge:
        """A second process; with a broker it runs beside the first."""
        style, by_device, truth, habits, prefix = self.options
        made = STYLES[style](prefix)
        log = Log()
        log.say = lambda text, again=False: self.log.append(text)  # type: ignore
        world: Any = self.world
        bridge.SUMMARY_PERIOD = 0.0
        return Bridge(world, broker or self.broker, made, Discovery(made, by_device, '1.0'),
                      habits or Habits(), truth, log)

    def turns(self, count: int = 12) -> Rig:
        for _ in range(count):
            self.bridge.turn()
        return self

    def after(self) -> list[tuple[str, str]]:
        """What is published by some turns from now on."""
        self.broker.sent.clear()
        self.turns()
        return self.broker.sent
