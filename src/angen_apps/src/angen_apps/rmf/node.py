"""The node that serves doors and elevators to Open-RMF."""
from __future__ import annotations

import queue
from typing import Any, Callable, Iterable

import rospy
from angen_msgs.msg import Command
from rmf_door_msgs.msg import DoorRequest, DoorState
from rmf_lift_msgs.msg import LiftRequest, LiftState

from angen_apps.rmf.doors import Door
from angen_apps.rmf.lifts import Lift
from angen_tools.live.devices import Devices

PERIOD = rospy.Duration(1.0)  # simulated, between two states of a door that does nothing
TURN = 0.05  # s of wall time, for messages to come
MOST_LINES = 100  # in the log
KINDS = {'door': Door, 'elevator': Lift}


class Node:
    """Open-RMF's topics on one side, Angen's on the other."""

    def __init__(self) -> None:
        rospy.init_node('rmf')
        # not a SimpleQueue: while its get() waits, rospy's handlers of signals do not run
        self._mail: queue.Queue[tuple[Callable[..., None], tuple[Any, ...]]] = queue.Queue()
        self._said: set[str] = set()
        self._now = rospy.Time()
        self._due = rospy.Time()
        self._commands = rospy.Publisher('/angen/command', Command, queue_size=1000)
        self._door_states = rospy.Publisher('door_states', DoorState, queue_size=1000)
        self._lift_states = rospy.Publisher('lift_states', LiftState, queue_size=1000)
        rospy.loginfo('waiting for the simulator')
        self._devices: Devices[Any] = Devices(
            list(KINDS), lambda entity: KINDS[entity.kind](entity.name), self._on_state,
            self._subscribe)
        self._subscribe('door_requests', DoorRequest, self._on_door_request)
        self._subscribe('lift_requests', LiftRequest, self._on_lift_request)
        rospy.loginfo('serving %d doors and %d lifts', len(self._doors), len(self._lifts))

    def spin(self) -> None:
        """Serves until ROS ends."""
        while not rospy.is_shutdown():
            try:
                handle, given = self._mail.get(timeout=TURN)
                handle(*given)
            except queue.Empty:
                pass
            self._advance(rospy.Time.now())

    def _advance(self, now: Any) -> None:
        if now < self._now:  # a reset, or another simulator
            self._due = now
            self._devices.changed = True
            for lift in self._lifts.values():
                lift.session = None
        self._now = now
        if self._devices.changed and self._mail.empty():
            self._devices.survey()
        if now >= self._due:
            due = self._due + PERIOD
            self._due = due if due > now else now + PERIOD
            for lift in self._lifts.values():
                if lift.is_standing:  # others can call it too
                    self._send('elevator', lift.name, lift.command())
            self._publish([*self._doors.values(), *self._lifts.values()], now)

    def _subscribe(self, topic: str, kind: type, handle: Callable[..., None], *given: Any) -> Any:
        """All messages are handled by one thread."""
        return rospy.Subscriber(topic, kind, lambda m: self._mail.put((handle, (*given, m))))

    @property
    def _doors(self) -> dict[str, Any]:
        return self._devices.of('door')

    @property
    def _lifts(self) -> dict[str, Any]:
        return self._devices.of('elevator')

    def _on_state(self, thing: Door | Lift, state: Any) -> None:
        if thing.take(state):
            self._publish([thing], state.header.stamp)

    def _on_door_request(self, message: Any) -> None:
        door = self._find(self._doors, 'door', message.door_name)
        if door is None:
            return
        try:
            self._send('door', door.name, door.request(message.requested_mode.value))
        except ValueError as problem:
            self._say(str(problem))

    def _on_lift_request(self, message: Any) -> None:
        lift = self._find(self._lifts, 'lift', message.lift_name)
        if lift is None:
            return
        try:
            self._send('elevator', lift.name, lift.request(message))
        except ValueError as problem:
            self._say(str(problem))
        self._publish([lift], self._now)

    def _find(self, things: dict[str, Any], what: str, name: str) -> Any:
        thing = things.get(name)
        if thing is None:
            known = ', '.join(sorted(things)[:10]) + ' …' * (len(things) > 10)
            self._say(f"there is no {what} '{name:.80}'; there are: {known or 'none'}")
        return thing

    def _send(self, kind: str, name: str, text: str) -> None:
        if text:
            self._commands.publish(Command(target=f'{kind}/{name}', text=text))

    def _publish(self, things: Iterable[Door | Lift], stamp: Any) -> None:
        for thing in things:
            message = thing.report(stamp)
            if message is not None:
                out = self._door_states if isinstance(thing, Door) else self._lift_states
                out.publish(message)

    def _say(self, text: str) -> None:
        """A request has no answer: a line in the log, once."""
        if text not in self._said and len(self._said) < MOST_LINES:
            self._said.add(text)
            rospy.logwarn('%s', text)


def main() -> None:
    """The node rmf."""
    Node().spin()
