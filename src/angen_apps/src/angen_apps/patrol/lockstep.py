"""A paused node, stepped from here: its commands and its messages belong to one cycle each.

No result depends on how fast messages travel: before a step the node has counted all commands as
received, and after it all events have arrived that it has counted as published.
"""
from __future__ import annotations

import threading
import time
from typing import Any, Callable

from angen_apps.robot.interface import Event
from angen_tools.common.failure import Failure

LIMIT = 30.0  # s of wall time for any message


class Lockstep:
    """Cycles of `cycle` s of simulated time on the node of this process's master."""

    def __init__(self, cycle: float) -> None:
        import rospy

        from angen_msgs.msg import Event as EventMessage
        from angen_msgs.srv import List, Step
        rospy.init_node('angen_task', disable_signals=True, disable_rosout=True)
        self.cycle = cycle
        self.now = 0.0
        self.events: list[Event] = []  # in their order
        self.kept: dict[str, list[Any]] = {}
        self._news = threading.Condition()
        self._step = rospy.ServiceProxy('/angen/step', Step, persistent=True)
        self._list = rospy.ServiceProxy('/angen/list', List, persistent=True)
        self._sent = 0
        self._missed: int | None = None  # events before those that are kept
        self._topics: list[str] = []
        self._publishers: dict[str, Any] = {}
        self._latest: dict[str, Any] = {}
        self._subscribers = [rospy.Subscriber('/angen/events', EventMessage,
                                              self._receive_event, tcp_nodelay=True)]
        began = self._call(0).sim_time
        self.tick = (self._call(1).sim_time - began).to_sec()
        self._ticks = round(cycle / self.tick)

    def _call(self, ticks: int) -> Any:
        import rospy
        try:
            answer = self._step(ticks=ticks)
        except rospy.ServiceException as error:
            raise Failure(f'the simulator has ended: {error}') from None
        if not answer.success:
            raise Failure(answer.message)
        return answer

    def entities(self, kind: str = '') -> list[Any]:
        """angen_msgs/Entity of everything in the world."""
        return self._list(kind=kind).entities

    def spawn(self, name: str, xml: str, on: str) -> None:
        """Puts a sensor on a link; Failure says why not."""
        import rospy

        from angen_msgs.srv import Spawn
        answer = rospy.ServiceProxy('/angen/spawn', Spawn)(name=name, xml=xml, on=on)
        if not answer.success:
            raise Failure(answer.message)

    def subscribe(self, topic: str, kind: type, keep: bool = False) -> None:
        """Keeps the latest message of a topic, or with `keep` all of them, in `kept`."""
        import rospy

        def receive(message: Any) -> None:
            with self._news:
                self._latest[topic] = message
                if keep:
                    self.kept.setdefault(topic, []).append(message)
                self._news.notify_all()

        self._topics.append(topic)
        self._subscribers.append(rospy.Subscriber(topic, kind, receive, tcp_nodelay=True))

    def _receive_event(self, message: Any) -> None:
        with self._news:
            self.events.append(Event(message.header.stamp.to_sec(), message.source, message.kind,
                                     message.event, message.detail))
            self._news.notify_all()

    def _wait(self, condition: Callable[[], bool], what: str) -> None:
        with self._news:
            if not self._news.wait_for(condition, LIMIT):
                raise Failure(f'not within {LIMIT:g} s: {what}')

    def latest(self, topic: str, since: float = -1.0) -> Any:
        """The latest message of a topic, once there is one stamped `since` (s) or later."""
        self._wait(lambda: topic in self._latest
                   and self._latest[topic].header.stamp.to_sec() >= since - 1e-6,
                   f'a message on {topic}')
        return self._latest[topic]

    def advertise(self, topic: str, kind: type) -> None:
        """Makes a publisher that the node has subscribed to."""
        import rospy
        self._publishers[topic] = rospy.Publisher(topic, kind, queue_size=100, tcp_nodelay=True)
        self.wait_for_subscribers(1)

    def wait_for_subscribers(self, count: int) -> None:
        """Returns when each command topic has that many subscribers, the node being one."""
        end = time.monotonic() + LIMIT
        while missing := [topic for topic, publisher in self._publishers.items()
                          if publisher.get_num_connections() < count]:
            if time.monotonic() > end:
                raise Failure(f'not enough subscribers of {", ".join(missing)}')
            time.sleep(0.005)

    def send(self, topic: str, message: Any) -> None:
        """Sends a command, which takes effect with the next cycle's first tick."""
        self._publishers[topic].publish(message)
        self._sent += 1

    def begin(self) -> None:
        """Puts everything back to the start and time to 0, once every topic has had a message;
        then runs a first cycle."""
        import rospy
        from std_srvs.srv import Empty
        end = time.monotonic() + LIMIT
        while silent := [topic for topic in self._topics if topic not in self._latest]:
            if time.monotonic() > end:
                raise Failure(f'no message comes on {", ".join(silent)}')
            self.run()
        rospy.ServiceProxy('/gazebo/reset_simulation', Empty)()
        published = self._call(0).events
        self._wait(lambda: any(event.event == 'reset' for event in self.events),
                   'the event of the reset')
        with self._news:
            self._missed = published
            self.events.clear()
            self._latest.clear()
            self.kept.clear()
        self.run()

    def run(self) -> float:
        """One cycle; the time after it, s."""
        end = time.monotonic() + LIMIT
        while (received := self._call(0).commands) < self._sent:
            if time.monotonic() > end:
                raise Failure(f'the simulator has received {received} of {self._sent} commands')
        answer = self._call(self._ticks)
        self.now = answer.sim_time.to_sec()
        if self._missed is not None:
            due = answer.events - self._missed
            self._wait(lambda: len(self.events) >= due, 'all events of a cycle')
        return self.now
