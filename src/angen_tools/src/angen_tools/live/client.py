"""The running simulator, as the angen command reaches it; each wait has a limit (wall seconds)."""
from __future__ import annotations

import queue
import socket
import sys
import threading
import time
from typing import Any, Callable
from urllib.parse import urlsplit

from angen_tools.common.failure import Failure
from angen_tools.common.home import Home
from angen_tools.common.wait import wait

SERVICE_LIMIT = 60.0  # a large model takes seconds to parse; the node itself gives up after 10 s
CONNECT_LIMIT = 5.0


def import_genpy() -> None:
    """Imports genpy without numpy, which takes 0.05 s of a command's start.

    genpy imports it only to accept its numbers in a check of fields.
    """
    if 'numpy' in sys.modules or 'genpy' in sys.modules:
        return
    sys.modules['numpy'] = None  # type: ignore[assignment]
    try:
        import genpy  # noqa: F401
    finally:
        del sys.modules['numpy']


class Client:
    """Services and topics of the simulator at ROS_MASTER_URI; Failure where there is none."""

    def __init__(self, limit: float = CONNECT_LIMIT) -> None:
        import_genpy()
        import rosgraph
        self.uri = rosgraph.get_master_uri()
        self._is_node = False
        try:
            address = urlsplit(self.uri)
            socket.create_connection((address.hostname, address.port or 11311), limit).close()
            rosgraph.Master('/angen_command').lookupService('/angen/list')
        except (OSError, ValueError, rosgraph.MasterException):
            raise self._absent() from None

    def _absent(self) -> Failure:
        return Failure(f'no simulator is running at {self.uri}; start one with ./angen run')

    def call(self, service: str, kind: type, limit: float = SERVICE_LIMIT, /, **fields: Any) -> Any:
        """The answer of a service; Failure where it rejects, or does not answer within `limit`."""
        import rospy
        done: queue.SimpleQueue[Any] = queue.SimpleQueue()

        def request() -> None:
            try:
                done.put(rospy.ServiceProxy(service, kind)(**fields))
            except Exception as error:  # the waiting thread reports it
                done.put(error)

        threading.Thread(target=request, daemon=True).start()
        try:
            answer = done.get(timeout=limit)
        except queue.Empty:
            raise Failure(f'{service} has not answered within {limit:g} s') from None
        if isinstance(answer, rospy.ServiceException) and 'unable to connect' in str(answer):
            raise self._absent()
        if isinstance(answer, Exception):
            raise Failure(f'{service}: {answer}')
        if not getattr(answer, 'success', True):
            raise Failure(answer.message)
        return answer

    def entities(self, kind: str = '') -> list[Any]:
        """angen_msgs/Entity of all that is in the world, or of one kind."""
        from angen_msgs.srv import List
        return self.call('/angen/list', List, kind=kind).entities

    def home(self) -> Home:
        """The home that the world describes."""
        from angen_msgs.msg import Home as Message
        mail = Mailbox(self)
        mail.subscribe('/angen/home', Message)
        got = mail.get(CONNECT_LIMIT)
        mail.unsubscribe('/angen/home')
        if got is None:
            raise Failure('/angen/home has no message; is the simulator an older one?')
        return Home.of_message(got[1])

    def join(self) -> None:
        """Makes this process a ROS node, as publishing and subscribing need."""
        import rospy
        if not self._is_node:
            rospy.init_node('angen_command', anonymous=True, disable_signals=True,
                            disable_rosout=True)
            self._is_node = True

    def publisher(self, topic: str, kind: type) -> Any:
        """A publisher that the simulator has subscribed to already."""
        import rospy
        self.join()
        made = rospy.Publisher(topic, kind, queue_size=10)
        wait(lambda: made.get_num_connections() > 0, f'{topic} has no subscriber', CONNECT_LIMIT)
        return made

    def fence(self) -> float:
        """Returns when the simulator has handled all that it has received, paused or not: the
        simulated time then (s).
        """
        from angen_msgs.srv import Step
        return float(self.call('/angen/step', Step, ticks=0).sim_time.to_sec())


class Mailbox:
    """The messages of any number of topics, in the order in which they come."""

    def __init__(self, client: Client) -> None:
        client.join()
        self._queue: queue.SimpleQueue[tuple[str, Any]] = queue.SimpleQueue()
        self._subscribers: dict[str, Any] = {}

    def subscribe(self, topic: str, kind: str | type) -> None:
        """Subscribes; `kind` is a message class or its name, as angen_msgs/PirMsg."""
        import roslib.message
        import rospy
        if isinstance(kind, str):
            found = roslib.message.get_message_class(kind)
            if found is None:
                raise Failure(f'{topic} has messages of the type {kind}, which is not built here')
            kind = found
        self._subscribers[topic] = rospy.Subscriber(
            topic, kind, lambda message: self._queue.put((topic, message)))

    def unsubscribe(self, topic: str) -> None:
        """Unsubscribes."""
        self._subscribers.pop(topic).unregister()

    def connected(self, topic: str, limit: float = CONNECT_LIMIT) -> None:
        """Returns when messages of that topic arrive from now on."""
        wait(lambda: self._subscribers[topic].get_num_connections() > 0,
             f'{topic} has no publisher', limit)

    def get(self, limit: float) -> tuple[str, Any] | None:
        """The next (topic, message); None when there is none within `limit`."""
        try:
            return self._queue.get(timeout=max(0.0, limit))
        except queue.Empty:
            return None

    def drain(self, take: Callable[[str, Any], None], limit: float) -> bool:
        """Hands `take` the messages that come within `limit` s, and those after the first that are
        there already; false where none came."""
        mail = self.get(limit)
        came = mail is not None
        while mail is not None:
            take(*mail)
            mail = self.get(0.0)
        return came

    def until(self, done: Callable[[str, Any], bool], limit: float) -> bool:
        """Hands messages to `done` until it returns true; false when it has not within `limit`."""
        end = time.monotonic() + limit
        while (left := end - time.monotonic()) > 0:
            mail = self.get(left)
            if mail is not None and done(*mail):
                return True
        return False
