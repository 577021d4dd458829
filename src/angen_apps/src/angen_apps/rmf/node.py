"""The node that serves doors and elevators to Open-RMF."""
import math
from typing import Any, Iterable

import rospy
from rmf_door_msgs.msg import DoorRequest, DoorState
from rmf_lift_msgs.msg import LiftRequest, LiftState

from angen_apps.rmf.doors import Door
from angen_apps.rmf.lifts import Lift
from angen_apps.robot.door_client import DoorClient
from angen_tools.common.failure import Failure
from angen_tools.session.live import Live

PERIOD = rospy.Duration(1.0)  # simulated, between two states of a door that does nothing
TURN = 0.05  # s of wall time, for messages to come
MOST_LINES = 100  # in the log
KINDS = {'door': Door, 'elevator': Lift}


class Node:
    """Open-RMF's topics on one side, Angen's on the other."""

    def __init__(self) -> None:
        rospy.init_node('rmf')
        self._said: set[str] = set()
        self._now = rospy.Time()
        self._due = rospy.Time()
        self._things: dict[tuple[str, str], Any] = {}
        self._door_states = rospy.Publisher('door_states', DoorState, queue_size=1000)
        self._lift_states = rospy.Publisher('lift_states', LiftState, queue_size=1000)
        rospy.loginfo('waiting for the simulator')
        world = Live(patience=math.inf)
        self._client = DoorClient(world)
        self._door_requests = world.subscribe('door_requests', DoorRequest)
        self._lift_requests = world.subscribe('lift_requests', LiftRequest)
        self._follow()
        rospy.loginfo('serving %d doors and %d lifts', len(self._of('door')),
                      len(self._of('elevator')))

    def spin(self) -> None:
        """Serves until ROS ends."""
        while not rospy.is_shutdown():
            for request in self._door_requests.take():
                self._on_door_request(request)
            for request in self._lift_requests.take():
                self._on_lift_request(request)
            self._follow()
            self._advance(rospy.Time.now())
            rospy.rostime.wallsleep(TURN)

    def _follow(self) -> None:
        new = self._client.follow()
        before = self._things
        self._things = {key: before.get(key) or KINDS[key[0]](key[1])
                        for key in self._client.entities}
        first = [state for key, state in self._client.states.items() if key not in before]
        for state in [*first, *new]:
            thing = self._things.get((state.kind, state.name))
            if thing is not None and thing.take(state):
                self._publish([thing], rospy.Time.from_sec(state.time))

    def _advance(self, now: Any) -> None:
        if now < self._now:  # a reset, or another simulator
            self._due = now
            self._client.is_stale = True
            for lift in self._of('elevator').values():
                lift.session = None
        self._now = now
        if now >= self._due:
            due = self._due + PERIOD
            self._due = due if due > now else now + PERIOD
            for lift in self._of('elevator').values():
                if lift.is_standing:  # others can call it too
                    self._send('elevator', lift.name, lift.command())
            self._publish(self._things.values(), now)

    def _of(self, kind: str) -> dict[str, Any]:
        return {name: thing for (its, name), thing in self._things.items() if its == kind}

    def _on_door_request(self, message: Any) -> None:
        door = self._find(self._of('door'), 'door', message.door_name)
        if door is None:
            return
        try:
            self._send('door', door.name, door.request(message.requested_mode.value))
        except ValueError as problem:
            self._say(str(problem))

    def _on_lift_request(self, message: Any) -> None:
        lift = self._find(self._of('elevator'), 'lift', message.lift_name)
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
            try:
                self._client.world.command(kind, name, text)
            except Failure as failure:
                self._say(str(failure))

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
