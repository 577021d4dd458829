"""The bridge between a world and a broker: states to topics, messages to commands."""
import json
import math
import secrets
import time
from contextlib import suppress
from typing import Any, Protocol

from angen_apps.mqtt.broker import Log, Message
from angen_apps.mqtt.discovery import ROOT, Discovery
from angen_apps.mqtt.habits import Habits
from angen_apps.mqtt.naming import area
from angen_apps.mqtt.styles import Style, Topics
from angen_apps.mqtt.table import SCALARS, SIMULATION, Part
from angen_apps.mqtt.things import OUTSIDE, Thing, flags_by_event, followed, things_of
from angen_apps.mqtt.values import Value, command_of, value_of
from angen_tools.common.catalog import kinds
from angen_tools.common.failure import Failure
from angen_tools.session import State, Summary
from angen_tools.session.live import ENDED, Live

BATCH = 50  # messages between two looks at the world
ANSWER = 3.0  # s in which another bridge with our prefix answers
SILENCE = 10.0  # s without statistics: the simulator has ended
ROOM_PERIOD = 1.0  # s between two looks at the room of a robot
SUMMARY_PERIOD = 0.1  # s between two looks at the summaries, which come 4 times a second
MINUTE = 60.0
UNKNOWN = 'None'
BIRTH = f'{ROOT}/status'  # Home Assistant sends it when it starts


class Taken(Failure):
    """Another bridge has our prefix."""


class Link(Protocol):
    """A Broker, or what stands for it in a test."""

    connected: bool
    connections: int

    @property
    def waiting(self) -> bool: ...

    def take(self, most: int) -> list[Message]: ...

    def subscribe(self, filters: list[str]) -> None: ...

    def unsubscribe(self, filters: list[str]) -> None: ...

    def publish(self, topic: str, payload: str, retain: bool = True) -> None: ...


class Bridge:
    """Does its work in `turn`, which the thread of the world calls again and again."""

    def __init__(self, world: Live, broker: Link, style: Style, discovery: Discovery | None,
                 habits: Habits, truth: bool, log: Log) -> None:
        self._world, self._broker, self._style = world, broker, style
        self._discovery, self._habits, self._truth, self._log = discovery, habits, truth, log
        self._id = secrets.token_hex(8)
        self._connection = 0
        self._ready_at = math.inf  # wall time from which it publishes
        self._is_ready = False
        self._other = ''  # the id of a bridge that has our prefix
        self._left: list[str] = []  # topics of the bridge before
        self._sent: Topics = {}  # retained, since the connection began
        self._things: dict[tuple[str, str], Thing] = {}
        self._followed: list[str] = []  # kinds
        self._reached = 0  # kinds that it has subscribed to, which takes time
        self._early: dict[tuple[str, str], State] = {}  # the things are not listed yet
        self._stated: dict[str, set[str]] = {}  # by kind, the fields that states have
        self._summaries: dict[tuple[str, str], Summary] = {}
        self._is_stale = True  # the things
        self._stats: Any = None
        self._stats_at = time.monotonic()
        self._looked = self._rooms_at = 0.0  # wall time of the next look at summaries and rooms
        self._counts: dict[tuple[tuple[str, str], str], float] = {}  # by part with an event

    @property
    def will(self) -> tuple[str, str]:
        """What is published if the process ends."""
        return self._topic('state'), self._style.offline

    def _topic(self, name: str) -> str:
        return f'{self._style.base}/bridge/{name}'

    def turn(self) -> None:
        """Handles what has come from either side."""
        if self._is_stale:
            self._list()
        self._follow_connection()
        for message in self._broker.take(BATCH):
            self._on_message(message)
        if self._is_ready or self._ready_at == math.inf:  # else it waits for an answer only
            self._follow_world()
        self._reached += self._is_ready and self._reached < len(self._followed)

    @property
    def has_work(self) -> bool:
        """Whether the next turn need not wait for news."""
        return self._is_stale or self._broker.waiting or (
            self._is_ready and self._reached < len(self._followed))

    def stop(self) -> None:
        """Leaves all things unavailable."""
        if self._is_ready and self._broker.connected:
            self._broker.publish(*self.will)

    # --- the connection

    def _follow_connection(self) -> None:
        if not self._broker.connected:
            self._is_ready = False
            self._ready_at = math.inf
        elif self._broker.connections != self._connection:
            self._connection = self._broker.connections
            self._is_ready, self._ready_at = False, math.inf
            self._broker.subscribe([self._topic(name) for name in ('hello', 'topics', 'state')])
            self._broker.publish(self._topic('hello'), self._id, retain=False)
        elif not self._is_ready and time.monotonic() >= self._ready_at \
                and not self._broker.waiting:
            self._begin()

    def _begin(self) -> None:
        """All that is retained has come: publishes everything, and takes commands."""
        self._is_ready = True
        self._sent = {}
        self._broker.unsubscribe([self._topic('topics'), self._topic('state')])
        self._announce()
        self._broker.publish(self._topic('state'), self._style.online)
        self._broker.subscribe([*self._style.filters, BIRTH])

    def _on_message(self, message: Message) -> None:
        name = message.topic.removeprefix(f'{self._style.base}/bridge/')
        if message.topic == BIRTH:
            if message.payload == b'online' and not message.retained and self._is_ready:
                self._begin()
        elif name in ('hello', 'topics', 'state'):
            self._on_own(name, message.payload.decode(errors='replace'))
        elif message.retained:
            self._log.say(f'{message.topic}: a retained command is not executed')
        else:
            self._on_command(message)

    def _on_own(self, name: str, text: str) -> None:
        if name == 'topics':
            self._left, self._other = self._topics_before(text)
        elif name == 'state':
            if text != self._style.online:
                self._other = ''
        elif text == self._id:
            waits = bool(self._other) and self._other != self._id
            self._ready_at = time.monotonic() + ANSWER * waits
        elif self._is_ready:  # the newcomer waits for this
            if ' ' not in text:
                self._broker.publish(self._topic('hello'), f'{text} {self._id}', retain=False)
        elif text.startswith(f'{self._id} '):
            raise Taken(f'another angen mqtt has the prefix {self._style.base} on this broker; '
                        'give this one another --prefix')

    def _topics_before(self, text: str) -> tuple[list[str], str]:
        """Topics that a bridge with our prefix has left, and its id."""
        with suppress(ValueError, TypeError, KeyError, RecursionError):
            read = json.loads(text)
            ours = (f'{self._style.base}/', f'{ROOT}/')
            return ([topic for topic in map(str, read['topics'])
                     if topic.startswith(ours) and not set(topic) & set('+#\0')], str(read['id']))
        return [], ''

    # --- what is published

    def _announce(self) -> None:
        """Publishes the things, and removes those that there are no more."""
        fixed = self._style.fixed(self._things.values())
        if self._discovery is not None:
            for thing in self._things.values():
                fixed |= self._discovery.messages(thing)
        states = [self._style.topic(thing, part) for thing in self._things.values()
                  for part in thing.parts() if part.field and not part.event]
        present = dict.fromkeys([*fixed, *states])
        self._broker.publish(self._topic('topics'),
                             json.dumps({'id': self._id, 'topics': list(present)}))
        for topic in [*self._left, *self._sent]:
            if topic not in present:
                self._broker.publish(topic, '')
                self._sent.pop(topic, None)
        self._left = []
        self._send(fixed)
        for thing in self._things.values():
            self._report(thing)

    def _send(self, topics: Topics, again: bool = False) -> None:
        for topic, payload in topics.items():
            before = self._sent.get(topic, UNKNOWN)  # what was never known is not sent
            if payload != before or (again and before != UNKNOWN):
                self._sent[topic] = payload
                self._broker.publish(topic, payload)

    def _report(self, thing: Thing, again: bool = False) -> None:
        """Publishes what has changed of a thing."""
        now = self._world.now if self._habits else 0.0
        if self._habits:
            self._habits.charge(thing, now)
        for part in thing.parts():
            value = value_of(part, thing.fields, thing.shown.get(part.key)) \
                if part.field in thing.fields else None
            if part.event:
                self._on_count(thing, part, value)
            elif part.field:
                thing.shown[part.key] = self._habits.shown(thing, part, value, now)
        if self._is_ready:
            self._send(self._style.states(thing, thing.shown), again)

    def _on_count(self, thing: Thing, part: Part, value: Value) -> None:
        """An event for each that was counted since the last state."""
        if not isinstance(value, float):
            return
        before = self._counts.get((thing.key, part.key))
        self._counts[thing.key, part.key] = value
        if before is None or value <= before:
            return
        topic = self._style.topic(thing, part)
        if self._style.template(part):  # the thing's values are there
            topic += f'/{part.key}'
        for _ in range(round(value - before)):
            self._broker.publish(topic, json.dumps({'event_type': part.event}), retain=False)

    # --- the world

    def _list(self) -> None:
        self._is_stale = False
        before, self._things = self._things, things_of(self._world, self._truth)
        for key, thing in self._things.items():
            self._habits.equip(thing)
            if key in self._early:
                thing.fields.update(self._early[key].values)
            if key in before:
                thing.fields, thing.shown = before[key].fields, before[key].shown
                thing.time = before[key].time
        self._early.clear()
        self._followed = followed(self._things)
        self._home = self._world.home
        self._summaries = {}
        self._things[SIMULATION, SIMULATION].fields.setdefault('rate', self._world.rate)
        if self._is_ready:
            self._announce()

    def _follow_world(self) -> None:
        for state in self._world.states(*self._followed[:self._reached]):
            self._on_state(state)
        for event in self._world.events():
            thing = self._things.get((event.kind, event.source))
            if event.event in ('spawned', 'deleted'):
                self._is_stale = True
            elif event.event == 'reset':
                self._on_reset()
            elif thing is not None and event.event in (flags := flags_by_event(event.kind)):
                name, value = flags[event.event]
                thing.fields[name], thing.time = value, event.time
                self._report(thing)
        if time.monotonic() >= self._looked:
            self._looked = time.monotonic() + SUMMARY_PERIOD
            self._follow_summaries()
            self._follow_stats()
        self._follow_rooms()
        if self._habits:
            for key in self._habits.waiting(self._world.now):
                if key in self._things:
                    self._report(self._things[key])

    def _follow_summaries(self) -> None:
        for key, summary in self._world.summaries().items():
            if self._summaries.get(key) is not summary:
                self._summaries[key] = summary
                if key in self._things:
                    self._on_summary(self._things[key], summary)

    def _on_state(self, state: State) -> None:
        self._stated.setdefault(state.kind, set()).update(state.values)
        thing = self._things.get((state.kind, state.name))
        if thing is None:
            self._early[state.kind, state.name] = state
            return
        thing.fields.update(state.values)
        self._report(thing)

    def _on_summary(self, thing: Thing, summary: Summary) -> None:
        """Numbers and flags; those that states have, or that an event has changed since, stay."""
        described = [each for each in kinds()[thing.kind]['fields'] if each['type'] in SCALARS]
        stated = self._stated.get(thing.kind, set())
        is_old = summary.time < thing.time
        for each, value in zip(described, summary.values):
            if each['name'] not in stated and not (is_old and each['type'] == 'flag') \
                    and not _is_other(each, value, thing.fields):
                thing.fields[each['name']] = value
        self._report(thing)

    def _on_reset(self) -> None:
        self._habits.forget()
        for thing in self._things.values():
            thing.time = 0.0

    def _follow_rooms(self) -> None:
        now = time.monotonic()
        if now < self._rooms_at:
            return
        self._rooms_at = now + ROOM_PERIOD
        for thing in self._things.values():
            if thing.moves:
                with suppress(Failure):  # it is deleted at this moment
                    room = self._home.room_at(*self._world.pose(thing.model)[:3])
                    thing.fields['room'] = area(room.name, self._home) if room else OUTSIDE
                    self._report(thing)

    def _follow_stats(self) -> None:
        stats = self._world.stats
        if stats is self._stats:
            if time.monotonic() > self._stats_at + SILENCE:
                raise Failure(ENDED)
            return
        self._stats, self._stats_at = stats, time.monotonic()
        thing = self._things[SIMULATION, SIMULATION]
        thing.fields |= {'time': stats.sim_time.to_sec() // MINUTE * MINUTE,
                         'factor': stats.real_time_factor, 'paused': bool(stats.paused)}
        self._report(thing)

    # --- commands

    def _on_command(self, message: Message) -> None:
        topic = self._topic('error')
        shown = message.payload[:200].decode(errors='replace')
        try:
            payload = _text(message.payload)
            asked = self._style.asks(message.topic, self._things.values())
            if asked is not None:
                self._report(asked, again=True)
                return
            for thing, part, text in self._style.find(message.topic, payload,
                                                      self._things.values()):
                topic = f'{self._style.things_topic(thing)}/error'
                self._command(thing, part, text)
        except (ValueError, Failure) as problem:
            self._log.say(f'{message.topic}: {problem}')
            self._broker.publish(topic, json.dumps({'topic': message.topic, 'payload': shown,
                                                    'error': str(problem)}), retain=False)

    def _command(self, thing: Thing, part: Part, payload: str) -> None:
        """Executes what a part is commanded; if it is rejected the state that holds is sent."""
        try:
            texts = command_of(part, payload, thing.fields)
            for text in texts:
                try:
                    self._execute(thing, text)
                    return
                except Failure:
                    if text == texts[-1]:
                        raise
        except (ValueError, Failure):
            self._report(thing, again=True)
            raise

    def _execute(self, thing: Thing, text: str) -> None:
        if thing.kind != SIMULATION:
            self._world.command(thing.kind, thing.name, text)
            return
        verb, _, number = text.partition(' ')
        if verb == 'rate':
            self._world.rate = float(number)
            thing.fields['rate'] = float(number)
            self._report(thing)
        else:
            {'pause': self._world.pause, 'resume': self._world.resume,
             'reset': self._world.reset}[verb]()


def _text(payload: bytes) -> str:
    try:
        return payload.decode()
    except UnicodeDecodeError:
        raise ValueError('the message is not UTF-8') from None


def _is_other(described: dict[str, Any], value: float, fields: dict[str, Any]) -> bool:
    """Whether a field that is there twice, for two parameters, has the value of the other."""
    return bool(described.get('with')) and math.isnan(value) and described['name'] in fields
