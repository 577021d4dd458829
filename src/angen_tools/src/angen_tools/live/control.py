"""angen set: commands to devices, checked before and after they are sent."""
from __future__ import annotations

import math
import time
from dataclasses import dataclass
from typing import Any, Callable, Iterable

from angen_tools.common.failure import Failure
from angen_tools.common.output import number
from angen_tools.live.client import CONNECT_LIMIT, Client, Mailbox

TOPICS = {'door': '/gazebo/Door_controller', 'window': '/gazebo/Window_controller',
          'cabinet': '/gazebo/Cabinet_controller', 'elevator': '/gazebo/Elevator_controller',
          'lamp': '/gazebo/Light_controller'}
TAKEN_LIMIT = 5.0  # s of wall time
QUEUED_AFTER = 1.0  # s of wall time without a rejection
DOOR_MODES = ('shut', 'open', 'opening', 'closing', 'blocked', 'ajar')
ELEVATOR_MODES = ('at rest', 'going up', 'going down', 'blocked')
CABIN_MODES = ('shut', 'open', 'opening', 'closing', 'blocked')


@dataclass(frozen=True)
class Order:
    """A command: `text` has NAME in the name's place; taken(state) once the state shows it."""

    text: str
    taken: Callable[[Any], bool]


def make_order(kind: str, value: str) -> Order:
    """The command that sets a device of a kind to `value`; ValueError says what is right."""
    orders = {'elevator': _elevator, 'lamp': _lamp, 'heater': _heater}
    return orders.get(kind, _door)(value.strip().lower())


def _door(value: str) -> Order:
    if value == 'open':
        return Order('Open, NAME', lambda s: s.mode in (s.OPEN, s.OPENING))
    if value == 'close':
        return Order('Close, NAME', lambda s: s.mode in (s.CLOSED, s.CLOSING))
    angle = _number(value, 'a door takes open, close or an angle in rad')
    return Order(f'Set, NAME, {angle!r}', lambda s: abs(s.target - angle) < 1e-9)


def _elevator(value: str) -> Order:
    if not value.isascii() or not value.isdigit():
        raise ValueError(f"'{value}' is not a floor; an elevator takes 0, 1, …")
    return Order(f'Floor{int(value)}, NAME', lambda s: s.target_floor == int(value))


def _percent(value: str, what: str) -> float:
    form = f'a {what} takes on, off or 0 to 100 percent'
    level = {'on': 100.0, 'off': 0.0}.get(value)
    if level is None:
        level = _number(value.removesuffix('%'), form)
    if not 0 <= level <= 100:
        raise ValueError(f"'{value}' is out of range; {form}")
    return level


def _lamp(value: str) -> Order:
    level = _percent(value, 'lamp')
    words = {'on': 'On, NAME', 'off': 'Off, NAME'}
    return Order(words.get(value, f'Dim, NAME, {level!r}'), lambda s: abs(s.level - level) < 1e-9)


def _heater(value: str) -> Order:
    level = _percent(value, 'heater')
    return Order(f'Set, NAME, {level!r}', lambda s: abs(fields(s)['level'] - level) < 1e-9)


def fields(reading: Any) -> dict[str, float]:
    """The numbers of an angen_msgs/Reading by name."""
    return dict(zip(reading.names, reading.values))


def _number(text: str, form: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"'{text}' is not a valid value; {form}")
    return number


def describe(state: Any) -> str:
    """A DoorState, ElevatorState, LampState or a heater's Reading in a few words."""
    kind = type(state).__name__
    if kind == 'DoorState':
        going = state.mode in (state.OPENING, state.CLOSING, state.BLOCKED)
        to = f', to {number(state.target)} rad' if going else ''
        return f'{DOOR_MODES[state.mode]} at {number(state.position)} rad{to}'
    if kind == 'ElevatorState':
        where = f'at floor {state.floor}' if state.floor >= 0 else f'at {number(state.position)} m'
        to = f', to floor {state.target_floor}' if state.target_floor != state.floor else ''
        return (f'{ELEVATOR_MODES[state.mode]} {where}{to}, doors '
                f'{CABIN_MODES[state.door_mode]}')
    if kind == 'Reading':
        values = fields(state)
        return f'on at {values["level"]:g} %, {values["power"]:.0f} W' if values['on'] else 'off'
    return f'on at {state.level:g} %, {state.luminous_flux:.0f} lm' if state.on else 'off'


def waits_for(kind: str, states: Iterable[Any], paused: bool) -> str:
    """What a command that was not rejected may wait for, "" if nothing."""
    if paused:
        return 'when time goes on: the simulation is paused'
    # An elevator on its way takes further floors in their turn.
    on_its_way = kind == 'elevator' and any(
        s.mode != s.IDLE or s.door_mode != s.DOOR_OPEN for s in states)
    return 'next' if on_its_way else ''


def set_device(kind: str, name: str, value: str) -> str:
    """Sends the command and waits until the states show it; returns what was done.

    Failure where nothing has that name, the simulator rejects it, or no state follows.
    """
    from std_msgs.msg import String

    from angen_msgs.msg import Command
    order = make_order(kind, value)
    client = Client()
    devices = _chosen(kind, name, client.entities(kind))
    watch = _Watch(client, kind, name, devices, order)
    if kind in TOPICS:
        client.publisher(TOPICS[kind], String).publish(String(watch.text))
    else:
        words = order.text.replace('NAME', '').replace(',', ' ').split()
        client.publisher('/angen/command', Command).publish(
            Command(f'{kind}/{name}', ' '.join(words)))
    client.fence()
    return watch.outcome()


def _chosen(kind: str, name: str, devices: list[Any]) -> list[Any]:
    if name == 'all' and kind != 'elevator' and devices:
        return devices
    chosen = [device for device in devices if device.name == name]
    if not chosen:
        known = ', '.join(device.name for device in devices)
        raise Failure(f"there is no {kind} '{name}'; " +
                      (f'known are {known}' if known else f'the world has no {kind}'))
    return chosen


class _Watch:
    """The states of the devices that a command is for, and whether it is rejected."""

    def __init__(self, client: Client, kind: str, name: str, devices: list[Any], order: Order
                 ) -> None:
        from angen_msgs.msg import Event, Stats
        self.text = order.text.replace('NAME', name)
        self._order, self._kind, self._name = order, kind, name
        self._states: dict[str, Any] = {}
        self._paused = False
        self._wanted = {device.topic: device.name for device in devices}
        self._mail = Mailbox(client)
        self._mail.subscribe('/angen/events', Event)
        self._mail.subscribe('/angen/stats', Stats)
        for device in devices:
            self._mail.subscribe(device.topic, device.type)
        self._mail.connected('/angen/events')
        if not self._mail.until(self._receive, CONNECT_LIMIT):
            raise Failure(f'the state of {kind} {name} is not published')

    def _receive(self, topic: str, message: Any) -> bool:
        """Takes a message; Failure on our rejection. True when every device has a state."""
        if topic in self._wanted:
            self._states[topic] = message
        elif topic == '/angen/stats':
            self._paused = message.paused
        elif message.event == 'rejected' and (
                (message.source == self._name and message.kind == self._kind)
                or f'`{self.text}`' in message.detail):
            raise Failure(f'rejected: {message.detail}')
        return len(self._states) == len(self._wanted)

    def _taken(self) -> bool:
        return all(self._order.taken(state) for state in self._states.values())

    def outcome(self) -> str:
        """The states in words once they show the command, within the limit."""
        start = time.monotonic()
        while True:
            while mail := self._mail.get(0.0):
                self._receive(*mail)
            if self._taken():
                return self._outcome_text()
            waited = time.monotonic() - start
            later = waits_for(self._kind, self._states.values(), self._paused)
            if waited > QUEUED_AFTER and later:
                return f'{self._outcome_text()}; {self._verb()} comes {later}'
            if waited > TAKEN_LIMIT:
                raise Failure(f'not taken within {TAKEN_LIMIT:g} s; {self._outcome_text()}')
            time.sleep(0.02)

    def _verb(self) -> str:
        return self.text.split(',')[0].lower()

    def _outcome_text(self) -> str:
        if self._name == 'all':
            return f'all {len(self._states)} {self._kind}s: {self._verb()}'
        return f'{self._kind} {self._name}: {describe(next(iter(self._states.values())))}'
