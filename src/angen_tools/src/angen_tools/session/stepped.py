"""The world of a paused node, stepped from here: what is sent and received belongs to one step.

No result depends on how fast messages travel: before a step the node has counted all commands as
received, and after it all events have arrived that it has counted as published.
"""
import time
from typing import Any, Iterable

from angen_tools.common.failure import Failure
from angen_tools.common.wait import wait
from angen_tools.session.live import SERVICE_LIMIT, Live, accepted

LIMIT = 30.0  # s of wall time for any message


class Stepped(Live):
    """See World; `run` is a step."""

    def __init__(self) -> None:
        super().__init__()
        self._services: dict[str, Any] = {}
        self._publishers: dict[str, Any] = {}
        self._sent = 0
        self._missed: int | None = None  # events before those that are waited for
        self._time = 0.0
        self._events()
        began = self._step(0).sim_time
        self.tick = float((self._step(1).sim_time - began).to_sec())

    def call(self, service: str, kind: type, limit: float = SERVICE_LIMIT, /, **fields: Any) -> Any:
        """By a connection that stays, as thousands of steps need."""
        import rospy
        if service not in self._services:
            self._services[service] = rospy.ServiceProxy(service, kind, persistent=True)
        try:
            answer = self._services[service](**fields)
        except rospy.ServiceException as error:
            raise Failure(f'the simulator has ended: {error}') from None
        return accepted(answer)

    def _step(self, ticks: int) -> Any:
        from angen_msgs.srv import Step
        return self.call('angen/step', Step, ticks=ticks)

    @property
    def now(self) -> float:
        return self._time

    @property
    def complete_until(self) -> float:
        return self._time

    def advertise(self, topic: str, kind: type) -> None:
        """Makes the publisher of a topic of commands."""
        self._publishers[topic] = self.publisher(topic, kind)

    def wait_for_subscribers(self, count: int) -> None:
        """Returns when each topic of commands has that many subscribers, the node being one."""
        for topic, publisher in self._publishers.items():
            wait(lambda: bool(publisher.get_num_connections() >= count),
                 f'not enough subscribers of {topic}', LIMIT)

    def send(self, topic: str, message: Any) -> None:
        """Sends a command, which takes effect with the next step's first tick."""
        self._publishers[topic].publish(message)
        self._sent += 1

    def command(self, kind: str, name: str, text: str) -> str:
        """As a message on the topic of a kind."""
        from std_msgs.msg import String
        self.send(f'gazebo/{kind.title()}_controller', String(f'{text}, {name}'))
        return ''

    def begin(self, followed: Iterable[tuple[str, str]], step: float) -> None:
        """Puts everything back to the start and time to 0, once the devices and sensors that are
        followed have had a state; then takes a first step of `step` s."""
        self._follow([self._entity(*key) for key in followed])
        end = time.monotonic() + LIMIT
        while silent := [f'{kind} {name}' for kind, name in followed
                         if (kind, name) not in self._latest]:
            if time.monotonic() > end:
                raise Failure(f'no message comes of {", ".join(silent)}')
            self.run(step)
        self.reset()
        self._missed = self._step(0).events
        inbox, past = self._events(), list[Any]()

        def is_reset() -> bool:
            past.extend(inbox.take())
            return any(event.event == 'reset' for event in past)

        if not self.until(is_reset, LIMIT):
            raise Failure(f'not within {LIMIT:g} s: the event of the reset')
        with self._news:
            self._base = inbox.count
            inbox.take()
            self._latest.clear()
            self._changed.clear()
        self.run(step)

    def run(self, seconds: float) -> None:
        end = time.monotonic() + LIMIT
        while (received := self._step(0).commands) < self._sent:
            if time.monotonic() > end:
                raise Failure(f'the simulator has received {received} of {self._sent} commands')
        answer = self._step(round(seconds / self.tick))
        self._time = float(answer.sim_time.to_sec())
        if self._missed is None:
            return
        due, inbox = self._base + answer.events - self._missed, self._events()
        if not self.until(lambda: inbox.count >= due, LIMIT):
            raise Failure(f'not within {LIMIT:g} s: all events of a step')
