"""Care rules on the running simulator: follows its public topics and publishes warnings."""
from __future__ import annotations

import time
from collections import deque
from typing import Any, Callable

from angen_apps.care.engine import Change, Engine
from angen_apps.care.messages import WarningPublisher
from angen_apps.care.rules import Rules
from angen_apps.care.signals import Event
from angen_apps.care.sources import at_home, check_sources
from angen_tools.common.failure import Failure
from angen_tools.live.client import CONNECT_LIMIT, Client, Mailbox

EVENTS, SUMMARY = '/angen/events', '/angen/summary'
ACKNOWLEDGE = '/angen/warnings/acknowledge'
LAG = 0.1     # s of wall time after which all events of a moment have arrived
SILENCE = 10.0  # s of wall time without a clock: the simulator has ended; it ticks while paused


class Clock:
    """Simulated time, as late as events may be."""

    def __init__(self) -> None:
        import rospy
        from rosgraph_msgs.msg import Clock as Message
        self._seen: deque[tuple[float, float]] = deque()  # wall and simulated time, s
        self._now, self._ticked = 0.0, time.monotonic()
        self.time = 0.0
        self.went_back = False
        self._subscriber = rospy.Subscriber('/clock', Message, self._tick, queue_size=1)

    def _tick(self, message: Any) -> None:
        now = message.clock.to_sec()
        self.went_back = self.went_back or now < self._now
        self._now, self._ticked = now, time.monotonic()

    def advance(self) -> float:
        """The time up to which all events have arrived, s."""
        wall = time.monotonic()
        if wall - self._ticked > SILENCE:
            raise Failure('the simulator has ended')
        if self.went_back:
            self._seen.clear()
            self.time = 0.0
        self._seen.append((wall, self._now))
        while self._seen[0][0] <= wall - LAG:
            self.time = self._seen.popleft()[1]
        return self.time


class Live:
    """An engine that follows the simulator; a reset of its time starts it again."""

    def __init__(self, rules: Rules, tell: Callable[[Change, float], None]) -> None:
        from angen_msgs.msg import Event as Message
        from std_msgs.msg import String
        self._written, self._rules, self._tell = rules, rules, tell
        self._client = Client()
        self._mail = Mailbox(self._client)
        self._mail.subscribe(EVENTS, Message)
        self._mail.connected(EVENTS)
        self._clock = Clock()
        self._begin()
        self._mail.subscribe(ACKNOWLEDGE, String)

    def _begin(self) -> None:
        """Reads which devices and sensors exist, and their present states."""
        from angen_msgs.msg import Summary
        entities = self._client.entities()
        found: list[Any] = []
        self._mail.subscribe(SUMMARY, Summary)
        kept: list[tuple[str, Any]] = []

        def complete(topic: str, message: Any) -> bool:
            if topic != SUMMARY:
                kept.append((topic, message))
            elif message.complete:
                found.append(message)
            return bool(found)

        if not self._mail.until(complete, CONNECT_LIMIT):
            raise Failure(f'{SUMMARY} is not published')
        self._mail.unsubscribe(SUMMARY)
        summaries = {f'{entry.kind}/{entry.name}': entry.text for entry in found[0].entries}
        rooms = {f'{entity.kind}/{entity.name}': entity.room for entity in entities}
        self._rules = at_home(self._written, self._client.home(), rooms, summaries)
        check_sources(self._rules, summaries, {entity.name for entity in entities})
        self._start = found[0].header.stamp.to_sec()
        self.engine = Engine(self._rules, summaries, summaries, self._start)
        self._publisher = WarningPublisher(self._client, self.engine, entities)
        self._publisher.publish(self.engine, [])
        for mail in kept:
            self._take(*mail)

    @property
    def left_out(self) -> tuple[str, ...]:
        """Why some rules have nothing to watch in this home."""
        return self._rules.left_out

    def follow(self) -> None:
        """Handles the messages of a moment."""
        self._mail.drain(self._take, LAG)
        self._publish(self.engine.advance(self._clock.advance()))
        if self._clock.went_back:
            self._clock.went_back = False
            self._begin()

    def _take(self, topic: str, message: Any) -> None:
        if topic == EVENTS:
            at = message.header.stamp.to_sec()
            if at > self._start:
                self._publish(self.engine.observe(Event(
                    at, message.source, message.kind, message.event, message.detail)))
        elif topic == ACKNOWLEDGE:
            self._publish(self.engine.acknowledge(message.data.strip()))

    def _publish(self, changes: list[Change]) -> None:
        for change in changes:
            self._tell(change, self.engine.starts)
        if changes:
            self._publisher.publish(self.engine, changes)
