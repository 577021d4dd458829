"""The devices of a simulator that runs, as they come and go."""
from __future__ import annotations

from typing import Any, Callable, Generic, Mapping, TypeVar

import rospy
from angen_msgs.msg import Event
from angen_msgs.srv import List

Thing = TypeVar('Thing')
# topic, type of its messages, what handles each, and what that is given before the message
Subscribe = Callable[..., Any]


def subscribe(topic: str, kind: type, handle: Callable[..., None], *given: Any) -> Any:
    """Messages are handled by a thread of their topic."""
    return rospy.Subscriber(topic, kind, lambda message: handle(*given, message))


class Devices(Generic[Thing]):
    """A thing for each device of some kinds, which gets the device's states."""

    def __init__(self, states: Mapping[str, type], make: Callable[[Any], Thing],
                 on_state: Callable[[Thing, Any], None], subscribe: Subscribe = subscribe,
                 renew: Callable[[Thing, Any], None] = lambda thing, entity: None) -> None:
        """`states`: the message of each kind; `make`: of an entity of /angen/list.

        `renew` gets a thing that stays, and its entity, which may stand elsewhere now.
        """
        self.changed = True  # something may have come or gone
        self._states = states
        self._make = make
        self._on_state = on_state
        self._subscribe = subscribe
        self._renew = renew
        self._things: dict[tuple[str, str, str], tuple[Thing, Any]] = {}
        self._entities = rospy.ServiceProxy('/angen/list', List)
        self._entities.wait_for_service()
        subscribe('/angen/events', Event, self._on_event)
        self.survey()

    def survey(self) -> None:
        """Follows the devices that there are now."""
        self.changed = False  # what comes while it asks is seen at the next call
        try:
            found = {(entity.kind, entity.name, entity.topic): entity
                     for kind in self._states for entity in self._entities(kind).entities}
        except rospy.ServiceException:
            self.changed = True  # the simulator ends, or begins
            return
        for gone in self._things.keys() - found.keys():
            self._things.pop(gone)[1].unregister()
        for stays in self._things:
            self._renew(self._things[stays][0], found[stays])
        for came in found.keys() - self._things.keys():
            entity = found[came]
            thing = self._make(entity)
            subscriber = self._subscribe(entity.topic, self._states[entity.kind], self._on_state,
                                         thing)
            self._things[came] = thing, subscriber

    def of(self, kind: str) -> dict[str, Thing]:
        """By name."""
        return {name: thing for (its, name, _), (thing, _) in self._things.items() if its == kind}

    def _on_event(self, event: Any) -> None:
        self.changed = self.changed or event.event in ('spawned', 'deleted')
