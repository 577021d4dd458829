"""The world of the running simulator, by its public topics and services.

Each wait has a limit of wall time (s).
"""
import math
import queue
import re
import socket
import sys
import threading
import time
from collections import deque
from functools import partial
from typing import Any, Callable, Iterable, Sequence
from urllib.parse import urlsplit

from angen_tools.common.failure import Failure
from angen_tools.common.geometry import quaternion
from angen_tools.common.home import Home, Pose
from angen_tools.common.wait import wait
from angen_tools.session.messages import seconds, seven, state_of, states_by_name
from angen_tools.session.world import MOST, Entity, Event, State, Summary, World

SERVICE_LIMIT = 60.0  # a large model takes seconds to parse; the node itself gives up after 10 s
CONNECT_LIMIT = 5.0
LIST = 'angen/list'  # a service that each simulator has, in its namespace
MESSAGE_LIMIT = 10.0  # for a message of a topic; /clock comes while the simulation is paused, too
LAG = 0.1             # after which all events of a moment have arrived
ENDED = 'the simulator has ended'
PAUSED = 'the simulation is paused; rosservice call /gazebo/unpause_physics continues it'


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


class News(threading.Condition):
    """Guards the inboxes, and counts what comes."""

    count = 0


class Inbox:
    """The messages of a topic: the latest, and those that are not taken yet, at most `most`."""

    def __init__(self, news: News, topic: str, kind: type, most: int,
                 on_message: Callable[[Any], None]) -> None:
        """`on_message` is called by the thread of the topic. If `most` is 1, a slow machine skips
        messages."""
        import rospy
        self.topic = topic
        self.latest: Any = None
        self.count = 0  # messages so far
        self._news, self._on_message = news, on_message
        self._waiting: deque[Any] = deque(maxlen=most)
        self._subscriber = rospy.Subscriber(topic, kind, self._put, tcp_nodelay=True,
                                            queue_size=1 if most == 1 else None, buff_size=1 << 20)

    def _put(self, message: Any) -> None:
        with self._news:
            self.latest = message
            self.count += 1
            self._news.count += 1
            self._waiting.append(message)
            self._on_message(message)
            self._news.notify_all()

    def take(self) -> list[Any]:
        """The messages since the last call, in order."""
        with self._news:
            taken = list(self._waiting)
            self._waiting.clear()
        if len(taken) == MOST:
            raise Failure(f'{self.topic}: {MOST} messages and more have come since the last look')
        return taken

    def connect(self, limit: float = CONNECT_LIMIT) -> None:
        """Returns when messages arrive from now on."""
        wait(lambda: bool(self._subscriber.get_num_connections() > 0),
             f'{self.topic} has no publisher', limit)

    def close(self) -> None:
        """Unsubscribes."""
        self._subscriber.unregister()


class Live(World):
    """The simulator at ROS_MASTER_URI; Failure if there is none. See World."""

    def __init__(self, patience: float = 0.0, limit: float = CONNECT_LIMIT, pauses: bool = True
                 ) -> None:
        """`patience`: how long to wait for a simulator that is starting; `limit`: for a master.
        `pauses`: to `run` while the simulation is paused waits, and is no Failure."""
        import_genpy()
        import rosgraph
        from rosgraph.names import get_ros_namespace
        self.uri = rosgraph.get_master_uri()
        self._namespace = get_ros_namespace()
        self._news = News()
        self._is_node, self._pauses = False, pauses
        self._now, self._ticked = -1.0, 0.0  # simulated time and wall time of its message, s
        self._seen: deque[tuple[float, float]] = deque()  # wall and simulated time, s
        self._inboxes: dict[str, Inbox] = {}
        self._entities: dict[tuple[str, str], Entity] = {}
        self._latest: dict[tuple[str, str], tuple[float, Any]] = {}  # stamp, s, and message
        self._changed: deque[tuple[str, str, Any]] = deque(maxlen=MOST)
        self._followed: set[str] = set()  # kinds
        self._listed: set[str] = set()  # kinds without spawned or deleted ones
        self._summaries: dict[tuple[str, str], Summary] | None = None
        end = time.monotonic() + patience
        while (absent := self._find(rosgraph, limit)) is not None:
            if time.monotonic() > end:
                raise absent
            time.sleep(LAG)

    def _find(self, rosgraph: Any, limit: float) -> Failure | None:
        """Why there is no simulator; None if there is one."""
        try:
            address = urlsplit(self.uri)
            socket.create_connection((address.hostname, address.port or 11311), limit).close()
            services = dict(rosgraph.Master('/angen_command').getSystemState()[2])
        except (OSError, ValueError, rosgraph.MasterException):
            return self._absent()
        if self._namespace + LIST in services:
            return None
        return self._absent([name.removesuffix(f'/{LIST}') for name in services
                             if name.endswith(LIST)])

    def _absent(self, others: Sequence[str] = ()) -> Failure:
        if others:
            return Failure(f'no simulator is running in the namespace {self._namespace}, but in '
                           f"{', '.join(name or '/' for name in sorted(others))}; choose one: "
                           'angen --ns NAMESPACE …')
        return Failure(f'no simulator is running at {self.uri}; start one with ./angen run')

    # --- services and topics

    def call(self, service: str, kind: type, limit: float = SERVICE_LIMIT, /, **fields: Any) -> Any:
        """The answer of a service; Failure if it rejects, or does not answer within `limit`."""
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
        return accepted(answer)

    def join(self) -> None:
        """Makes this process a ROS node, as publishing and subscribing need."""
        import rospy
        if not self._is_node:
            if not rospy.core.is_initialized():
                rospy.init_node('angen_command', anonymous=True, disable_signals=True,
                                disable_rosout=True)
            self._is_node = True

    def subscribe(self, topic: str, kind: str | type, most: int = MOST,
                  on_message: Callable[[Any], None] = lambda _: None) -> Inbox:
        """The inbox of a topic; `kind` is a message class or its name, as angen_msgs/PirMsg."""
        import roslib.message
        self.join()
        found: Any = kind
        if isinstance(kind, str):
            found = roslib.message.get_message_class(kind)
        if found is None:
            raise Failure(f'{topic} has messages of the type {kind}, which is not built here')
        return Inbox(self._news, topic, found, most, on_message)

    def publisher(self, topic: str, kind: type) -> Any:
        """A publisher that the simulator has subscribed to already."""
        import rospy
        self.join()
        made = rospy.Publisher(topic, kind, queue_size=10, tcp_nodelay=True)
        wait(lambda: bool(made.get_num_connections() > 0), f'{topic} has no subscriber',
             CONNECT_LIMIT)
        return made

    def fence(self) -> float:
        """Returns when the simulator has handled all that it has received, paused or not: the
        simulated time then (s).
        """
        from angen_msgs.srv import Step
        return seconds(self.call('angen/step', Step, ticks=0).sim_time)

    def until(self, condition: Callable[[], Any], limit: float) -> bool:
        """Whether the condition, which messages change, becomes true within `limit`."""
        with self._news:
            return bool(self._news.wait_for(condition, limit))

    def wake(self) -> None:
        """Has `until` look at its condition; for other threads that change it."""
        with self._news:
            self._news.notify_all()

    @property
    def received(self) -> int:
        """Messages so far, of all topics."""
        return self._news.count

    def _inbox(self, topic: str, kind: str | type, most: int = 1,
               on_message: Callable[[Any], None] = lambda _: None) -> Inbox:
        """The inbox that stays."""
        if topic not in self._inboxes:
            self._inboxes[topic] = self.subscribe(topic, kind, most, on_message)
        return self._inboxes[topic]

    def _first(self, topic: str, kind: type, otherwise: str) -> Any:
        """The latest message of a topic, once there is one."""
        inbox = self._inbox(topic, kind)
        if not self.until(lambda: inbox.latest is not None, CONNECT_LIMIT):
            raise Failure(f'/{topic} {otherwise}')
        return inbox.latest

    @property
    def stats(self) -> Any:
        """The latest angen_msgs/Stats."""
        from angen_msgs.msg import Stats
        return self._first('angen/stats', Stats, 'is not published')

    # --- time

    @property
    def now(self) -> float:
        from rosgraph_msgs.msg import Clock
        if self._now < 0.0:
            self._inbox('clock', Clock, 1, self._tick)
            if not self.until(lambda: self._now >= 0.0, MESSAGE_LIMIT):
                raise Failure('/clock is not published')
        return self._now

    def _tick(self, message: Any) -> None:
        now, wall = seconds(message.clock), time.monotonic()
        if now < self._now:  # a reset, or another node
            self._seen.clear()
            self._summaries = None
        self._now, self._ticked = now, wall
        self._seen.append((wall, now))
        while len(self._seen) > 1 and self._seen[1][0] <= wall - LAG:
            self._seen.popleft()

    @property
    def complete_until(self) -> float:
        if self.now >= 0.0 and time.monotonic() > self._ticked + MESSAGE_LIMIT:
            raise Failure(ENDED)
        with self._news:
            arrived = time.monotonic() - LAG
            return max((now for wall, now in self._seen if wall <= arrived), default=0.0)

    def run(self, seconds: float) -> None:
        """Returns at a reset, too."""
        began, wall = self.now, time.monotonic()
        while began <= self._now < began + seconds - 1e-9:
            with self._news:
                self._news.wait(1.0)
            if not self._pauses and self._now == began and time.monotonic() > wall + MESSAGE_LIMIT:
                raise Failure(PAUSED)
            if time.monotonic() > self._ticked + MESSAGE_LIMIT:
                raise Failure(ENDED)

    def pause(self) -> None:
        """Stops simulated time."""
        self._empty('gazebo/pause_physics')

    def resume(self) -> None:
        """Continues it."""
        self._empty('gazebo/unpause_physics')

    def reset(self) -> None:
        """Puts everything back to the start, and time to 0."""
        self._empty('gazebo/reset_simulation')

    def _empty(self, service: str) -> None:
        from std_srvs.srv import Empty
        self.call(service, Empty)

    def _properties(self) -> Any:
        from gazebo_msgs.srv import GetPhysicsProperties
        return self.call('gazebo/get_physics_properties', GetPhysicsProperties)

    @property
    def rate(self) -> float:
        """Simulated seconds a second of wall time that it keeps to; 0: as fast as possible."""
        now = self._properties()
        return float(now.time_step * now.max_update_rate)

    @rate.setter
    def rate(self, value: float) -> None:
        from gazebo_msgs.srv import SetPhysicsProperties
        now = self._properties()
        self.call('gazebo/set_physics_properties', SetPhysicsProperties,
                  time_step=now.time_step, max_update_rate=value / now.time_step,
                  gravity=now.gravity, ode_config=now.ode_config)

    # --- the contents

    @property
    def home(self) -> Home:
        from angen_msgs.msg import Home as Message
        return Home.of(self._first('angen/home', Message,
                                   'has no message; is the simulator an older one?'))

    def entities(self, kind: str = '') -> list[Entity]:
        from angen_msgs.srv import List
        return [Entity(e.kind, e.name, e.model, seven(e.pose), e.room, e.topic, e.type)
                for e in self.call(LIST, List, kind=kind).entities]

    def pose(self, name: str) -> Pose:
        from gazebo_msgs.srv import GetLinkState, GetModelState
        try:
            if '::' in name:
                return seven(self.call('gazebo/get_link_state', GetLinkState,
                                       link_name=name).link_state.pose)
            return seven(self.call('gazebo/get_model_state', GetModelState, model_name=name).pose)
        except Failure as why:
            raise Failure(f'{name}: {why}') from None

    def command(self, kind: str, name: str, text: str) -> str:
        from angen_msgs.srv import SendCommand
        return str(self.call('angen/command', SendCommand, target=f'{kind}/{name}',
                             text=text).state)

    def spawn(self, name: str, what: str, pose: Sequence[float] = (0.0,) * 6, on: str = '') -> None:
        from angen_msgs.srv import Spawn
        try:
            self.call('angen/spawn', Spawn, name=name, xml=what, on=on, pose=_pose(pose))
        except Failure as error:  # the text that was built has lines that no user has seen
            raise Failure(re.sub(r'\(text\):\d+: ', '', str(error))) from None

    def delete(self, name: str) -> None:
        from angen_msgs.srv import Delete
        self.call('angen/delete', Delete, name=name)

    def place(self, model: str, pose: Sequence[float]) -> None:
        from gazebo_msgs.msg import ModelState
        from gazebo_msgs.srv import SetModelState
        self.call('gazebo/set_model_state', SetModelState,
                  model_state=ModelState(model_name=model, pose=_pose(pose)))

    def save(self) -> str:
        from angen_msgs.srv import Save
        return str(self.call('angen/save', Save).xml)

    # --- states and events

    def events(self) -> list[Event]:
        return [Event(seconds(m.header.stamp), m.source, m.kind, m.event, m.detail)
                for m in self._events().take()]

    def _events(self) -> Inbox:
        from angen_msgs.msg import Event as Message
        is_new = 'angen/events' not in self._inboxes
        inbox = self._inbox('angen/events', Message, MOST, self._on_event)
        if is_new:
            inbox.connect()
        return inbox

    def _on_event(self, event: Any) -> None:
        if event.event in ('spawned', 'deleted'):
            self._listed.clear()

    def state(self, kind: str, name: str, since: float = -math.inf) -> State:
        self._follow([self._entity(kind, name)])
        if not self.until(lambda: self._latest.get((kind, name), (-math.inf,))[0] >= since - 1e-6
                          and (kind, name) in self._latest, MESSAGE_LIMIT):
            paused = PAUSED if (kind, name) in self._latest else ''
            raise Failure(paused or f'{kind} {name} has measured nothing yet')
        return state_of(kind, name, self._latest[kind, name][1])

    def _entity(self, kind: str, name: str) -> Entity:
        found = self._entities.get((kind, name))
        if found is None:
            self._entities.update({(e.kind, e.name): e for e in self.entities()})
            found = self._entities.get((kind, name))
        if found is None or not found.topic:
            known = ', '.join(its for of, its in self._entities if of == kind)
            raise Failure(f"no {kind} named '{name}'; known are {known or 'none'}")
        return found

    def _follow(self, entities: Iterable[Entity], most: int = 1) -> None:
        """Keeps the states of entities from now on."""
        for entity in entities:
            if entity.topic:
                self._inbox(entity.topic, entity.type, most, partial(self._take, entity))

    def _take(self, entity: Entity, message: Any) -> None:
        for name, state in states_by_name(message, entity.name).items():
            self._latest[entity.kind, name] = seconds(message.header.stamp), state
            if entity.kind in self._followed:
                self._changed.append((entity.kind, name, state))

    def states(self, *kinds: str) -> list[State]:
        self._events()
        for kind in set(kinds) - self._listed:
            self._followed.add(kind)
            self._listed.add(kind)
            self._follow(self.entities(kind), 0)
        with self._news:
            if len(self._changed) == MOST:
                raise Failure(f'{MOST} states and more have come since the last look')
            changed = [each for each in self._changed if each[0] in kinds]
            kept = [each for each in self._changed if each[0] not in kinds]
            self._changed = deque(kept, MOST)
        return [state_of(*each) for each in changed]

    def request(self, kind: str, name: str, wanted: bool = True) -> None:
        """A sensor samples while it has a subscriber."""
        entity = self._entity(kind, name)
        if wanted:
            self._follow([entity])
        elif entity.topic in self._inboxes:
            self._inboxes.pop(entity.topic).close()

    def summaries(self) -> dict[tuple[str, str], Summary]:
        from angen_msgs.msg import Summary as Message
        if self._summaries is None and 'angen/summary' in self._inboxes:
            self._inboxes.pop('angen/summary').close()  # a new subscriber gets all of them
        self._inbox('angen/summary', Message, 0, self._on_summary)
        if not self.until(lambda: self._summaries is not None, CONNECT_LIMIT):
            raise Failure('/angen/summary is not published')
        return dict(self._summaries or {})

    def _on_summary(self, message: Any) -> None:
        if message.complete:
            self._summaries = {}
        if self._summaries is not None:
            self._summaries.update({(e.kind, e.name): Summary(
                e.kind, e.name, e.text, e.alarm, seconds(e.stamp), e.values, e.period)
                for e in message.entries})


def accepted(answer: Any) -> Any:
    """The answer of a service; Failure if it rejects."""
    if not getattr(answer, 'success', True):
        raise Failure(getattr(answer, 'message', '') or answer.status_message)
    return answer


def _pose(pose: Sequence[float]) -> Any:
    from geometry_msgs.msg import Point, Pose, Quaternion
    return Pose(Point(*pose[:3]), Quaternion(*quaternion(*pose[3:])))
