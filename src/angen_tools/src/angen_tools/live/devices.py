"""The devices of a simulator that runs, as they come and go."""
from __future__ import annotations

import threading
from typing import Any, Callable, Generic, Sequence, TypeVar

import roslib.message
import rospy
from angen_msgs.msg import Event
from angen_msgs.srv import List

from angen_tools.live.states import states_by_name

Thing = TypeVar('Thing')
# topic, type of its messages, the handler of each, and its arguments before the message
Subscribe = Callable[..., Any]


def subscribe(topic: str, kind: type, handle: Callable[..., None], *given: Any) -> Any:
    """Messages are handled by a thread of their topic."""
    return rospy.Subscriber(topic, kind, lambda message: handle(*given, message))


class Devices(Generic[Thing]):
    """A thing for each device of some kinds, which gets the device's states."""

    def __init__(self, kinds: Sequence[str], make: Callable[[Any], Thing],
                 on_state: Callable[[Thing, Any], None], subscribe: Subscribe = subscribe,
                 renew: Callable[[Thing, Any], None] = lambda thing, entity: None) -> None:
        """`make`: of an entity of /angen/list.

        `renew` gets a thing that remains, and its entity, which may have another pose now.
        """
        self.changed = True  # something may have been spawned or deleted
        self._kinds = kinds
        self._make = make
        self._on_state = on_state
        self._subscribe = subscribe
        self._renew = renew
        self._lock = threading.Lock()  # of the next two
        self._things: dict[tuple[str, str, str], Thing] = {}
        self._early: dict[tuple[str, str], Any] = {}  # states of things not yet found
        self._subscribers: dict[str, Any] = {}
        self._entities = rospy.ServiceProxy('/angen/list', List)
        self._entities.wait_for_service()
        subscribe('/angen/events', Event, self._on_event)
        self.survey()

    def survey(self) -> None:
        """Follows the devices that there are now."""
        self.changed = False  # a change during the query is seen at the next call
        try:
            found = {(entity.kind, entity.name, entity.topic): entity
                     for kind in self._kinds for entity in self._entities(kind).entities}
        except rospy.ServiceException:
            self.changed = True  # the simulator ends, or begins
            return
        for deleted in self._things.keys() - found.keys():
            del self._things[deleted]
        for stays, thing in self._things.items():
            self._renew(thing, found[stays])
        for which, entity in found.items():  # in the world's order
            if which not in self._things:
                self._add(which, self._make(entity))
        topics = {entity.topic: entity for entity in found.values()}
        for topic in self._subscribers.keys() - topics.keys():
            self._subscribers.pop(topic).unregister()
        for topic, entity in topics.items():
            if topic in self._subscribers:
                continue
            self._subscribers[topic] = self._subscribe(
                topic, roslib.message.get_message_class(entity.type), self._on_message,
                entity.kind, topic)

    def _add(self, which: tuple[str, str, str], thing: Thing) -> None:
        with self._lock:
            self._things[which] = thing
            early = self._early.pop(which[:2], None)
        if early is not None:
            self._on_state(thing, early)

    def _on_message(self, kind: str, topic: str, message: Any) -> None:
        for name, state in states_by_name(message).items():
            with self._lock:
                thing = self._things.get((kind, name, topic))
                if thing is None:
                    self._early[kind, name] = state
            if thing is not None:
                self._on_state(thing, state)

    def of(self, kind: str) -> dict[str, Thing]:
        """By name."""
        return {name: thing for (its, name, _), thing in self._things.items() if its == kind}

    def _on_event(self, event: Any) -> None:
        self.changed = self.changed or event.event in ('spawned', 'deleted')
