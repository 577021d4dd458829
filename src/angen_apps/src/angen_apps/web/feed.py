"""The store filled from a running node, by its public topics: readings always, for their history;
the others while a browser is open."""
import asyncio
import contextlib
import dataclasses
import threading
import time
import xmlrpc.client
from typing import Any

import numpy as np

from angen_apps.web import scene
from angen_apps.web.images import jpeg
from angen_apps.web.orders import Orders
from angen_apps.web.store import PICTURE, SCAN, Store, summary
from angen_apps.web.threads import in_thread
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home
from angen_tools.session.live import Live

WATCH = 0.5  # s between looks at the master and the node
LINGER = 5.0  # s for which topics stay subscribed after the last browser has left
PICTURE_PERIOD = 0.2  # s between two pictures of a camera
COST = 'cost'
ALWAYS = ('summary', 'stats')  # subscribed without a browser, too
CALM = 2.0  # s between looks at the master without one


class Feed:
    """A Source, see server.py."""

    def __init__(self) -> None:
        self.store: Store = Store()
        self._orders = Orders(self.store)
        self._requested: set[str] | None = None
        self._subscribers: dict[str, Any] = {}
        self._lock = threading.Lock()  # guards the subscribers
        self._wake = asyncio.Event()
        self._master = 0  # its process
        self._listed = -1  # the scene of the last survey
        self._now = 0.0
        self._fixed = -1, np.zeros(0, bool)  # revision of a scene, its links that do not move
        self.store.put('status', {'node': False, 'replay': False})

    def request(self, topics: set[str] | None) -> None:
        self._requested = topics
        self._wake.set()

    async def order(self, order: dict[str, Any]) -> dict[str, Any]:
        answer: dict[str, Any] = await in_thread(self._orders.execute, order)
        return answer

    def close(self) -> None:
        self._orders.trips.close()
        self._unsubscribe_all()

    async def serve(self) -> None:
        loop = asyncio.get_running_loop()
        left = -LINGER  # when the last browser has left
        while True:
            requested = self._requested
            if requested is not None:
                left = loop.time()
            lingers = loop.time() - left < LINGER
            await in_thread(self._follow, set(requested or ()), lingers)
            self._wake.clear()
            if requested != self._requested:
                continue
            with contextlib.suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self._wake.wait(), WATCH if lingers else CALM)

    # --- the master and the node

    def _follow(self, requested: set[str], is_shown: bool) -> None:
        """Subscribes the requested topics of the present node, the usual ones while it is shown."""
        master = master_process()
        if master != self._master:  # topics of a master that ended are lost
            self._unsubscribe_all()
            self.store.history.clear()
            self._master = master
        if master and not self._subscribers:
            self._subscribe_always()
        if not is_shown:
            self._rest()
            return
        if master and 'scene' not in self._subscribers:
            self._subscribe_shown()
        for topic in [name for name in self._subscribers if ':' in name or name == COST]:
            if topic not in requested:
                self._drop(topic)
        for topic in requested - self._subscribers.keys():
            self._subscribe_requested(topic)
        scene_topic = self._subscribers.get('scene')
        alive = scene_topic is not None and scene_topic.get_num_connections() > 0
        before = self.store.part('status') or {}
        if alive != before.get('node'):
            self.store.put('status', {'node': alive, 'replay': False,
                                      **({'seed': seed()} if alive else {})})
            self._listed = -1
        number = self.store.part('scene') or 0
        if alive and self._listed != number:
            self._listed = number
            self._survey()

    def _survey(self) -> None:
        """The answer of /angen/list, after models were spawned or deleted."""
        try:
            entities = Live().entities()
        except Failure:
            self._listed = -1
            return
        self.store.put('entities', [*map(scene.of_entity, entities)])

    def _subscribe(self, key: str, topic: str, kind: Any, handle: Any, queue: int = 50) -> None:
        import rospy
        with self._lock:
            self._subscribers[key] = rospy.Subscriber(topic, kind, handle, queue_size=queue,
                                                      buff_size=1 << 22)

    def _drop(self, key: str) -> None:
        with self._lock:
            subscriber = self._subscribers.pop(key, None)
        if subscriber is not None:
            subscriber.unregister()

    def _rest(self) -> None:
        """Without a browser."""
        for key in self._subscribers.keys() - set(ALWAYS):
            self._drop(key)
        self.store.clear_named()
        self.store.put('status', {'node': False, 'replay': False})

    def _unsubscribe_all(self) -> None:
        for key in list(self._subscribers):
            self._drop(key)
        self.store.clear()
        self.store.put('status', {'node': False, 'replay': False})

    def _subscribe_usual(self) -> None:
        self._subscribe_always()
        self._subscribe_shown()

    def _subscribe_always(self) -> None:
        from angen_msgs.msg import Stats, Summary
        self._subscribe('summary', 'angen/summary', Summary, self._on_summary)
        self._subscribe('stats', 'angen/stats', Stats, self._on_stats)

    def _subscribe_shown(self) -> None:
        from angen_msgs.msg import Event, Scene, SceneChanges
        from angen_msgs.msg import Home as HomeMessage
        from rospy.numpy_msg import numpy_msg
        self._subscribe('scene', 'angen/scene', Scene, self._on_scene)
        self._subscribe('changes', 'angen/scene_changes', numpy_msg(SceneChanges),
                        self._on_changes)
        self._subscribe('events', 'angen/events', Event, self._on_event)
        self._subscribe('home', 'angen/home', HomeMessage, self._on_home)

    def _subscribe_requested(self, topic: str) -> None:
        from sensor_msgs.msg import Image, LaserScan
        if topic == COST:
            from angen_msgs.msg import Cost
            self._subscribe(COST, 'angen/cost', Cost, self._on_cost)
            return
        kind, _, name = topic.partition(':')
        entity = next((e for e in self.store.part('entities') or []
                       if e['name'] == name and e['topic']), None)
        if entity is None:
            return
        if kind == 'picture' and entity['type'] == 'sensor_msgs/Image':
            self._subscribe(topic, entity['topic'], Image, Pictures(self.store, topic), 1)
        elif kind == 'scan' and entity['type'] == 'sensor_msgs/LaserScan':
            self._subscribe(topic, entity['topic'], LaserScan,
                            lambda scan: self._on_scan(topic, scan), 1)

    # --- messages

    def _on_scene(self, message: Any) -> None:
        self.store.put_scene(scene.packed(scene.as_dict(message)), message.revision)
        self._fixed = message.revision, np.array([not link.moves for link in message.links], bool)

    def _on_changes(self, message: Any) -> None:
        self.store.put_changes(message.revision, message.links, message.poses, message.lights,
                               message.levels, message.header.stamp.to_sec())
        revision, fixed = self._fixed
        if revision == message.revision and fixed[message.links].any():
            self._listed = -1  # a static model was put elsewhere

    def _on_summary(self, message: Any) -> None:
        self.store.put_rows([
            summary(e.kind, e.name, e.text, bool(e.alarm), e.stamp.to_sec(), e.values)
            for e in message.entries], message.complete)

    def _on_stats(self, message: Any) -> None:
        now = message.sim_time.to_sec()
        if now < self._now - 1.0:  # a reset, or another run
            self.store.history.clear()
        self._now = now
        self.store.put('stats', {
            'time': now, 'factor': message.real_time_factor,
            'paused': bool(message.paused), 'step': message.step, 'models': message.models,
            'devices': message.devices, 'sensors': message.sensors,
            'awake': message.awake_bodies})

    def _on_event(self, event: Any) -> None:
        self.store.add_event([event.header.stamp.to_sec(), event.kind, event.source, event.event,
                              event.detail])

    def _on_home(self, message: Any) -> None:
        self.store.put('home', dataclasses.asdict(Home.of(message)))

    def _on_cost(self, cost: Any) -> None:
        parts = ('process', 'physics', 'devices', 'sensors', 'commands', 'snapshots', 'publishing')
        self.store.put(COST, {
            'parts': {part: getattr(cost, part) for part in parts},
            'instances': [[one.kind, one.name, round(one.cost, 2)] for one in sorted(
                cost.instances, key=lambda one: -one.cost)[:200]]})

    def _on_scan(self, topic: str, scan: Any) -> None:
        head = np.array([scan.angle_min, scan.angle_increment], '<f4').tobytes()
        self.store.put_named(SCAN, topic, head + np.asarray(scan.ranges, '<f4').tobytes())


class Pictures:
    """Images of a camera as JPEG, a few per second."""

    def __init__(self, store: Store, topic: str) -> None:
        self._store = store
        self._topic = topic
        self._next = 0.0

    def __call__(self, image: Any) -> None:
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + PICTURE_PERIOD
        content = jpeg(image)
        if content:
            self._store.put_named(PICTURE, self._topic, content)


def seed() -> int:
    """The seed of the noise of the run."""
    import rospy
    return int(rospy.get_param('angen/seed', 1))


def master_process() -> int:
    """The process of the ROS master, 0 if there is none."""
    import rosgraph
    try:
        return int(rosgraph.Master('/angen_web').getPid())
    except (OSError, ValueError, xmlrpc.client.Error, rosgraph.MasterException):
        return 0
