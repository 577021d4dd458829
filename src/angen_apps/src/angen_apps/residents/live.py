"""Residents' back end in ROS: the node's public topics and services."""
from __future__ import annotations

import json
import time
from typing import Any

from angen_apps.residents.figures import figure, walker
from angen_apps.residents.interface import Body, Rejected
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import quaternion, yaw_of
from angen_tools.common.home import Home, Place
from angen_tools.session.live import CONNECT_LIMIT, Live as Client

ABOVE = 0.002  # m between the support and a placed figure
LOOK = 0.02  # s of wall time between two looks at the clock
START = 120.0  # s of wall time until the simulator has started, which is started beside this
SILENCE = 10.0  # s of wall time without a clock: the simulator has ended
TRUTH = 'angen/residents'


class Live:
    """See interface.Simulator."""

    def __init__(self) -> None:
        import rospy
        from angen_msgs.msg import Home as Message
        from rosgraph_msgs.msg import Clock
        from std_msgs.msg import String
        self._client = _client()
        self._client.join()
        self._now, self._ticked = 0.0, time.monotonic()
        self._states: dict[str, Any] = {}
        self._subscribed: set[str] = set()
        self._here: set[str] = set()  # residents that have a body
        self._topics: dict[tuple[str, str], tuple[str, str]] = {}
        self._clock = rospy.Subscriber('clock', Clock, self._tick, queue_size=1)
        self._truth = rospy.Publisher(TRUTH, String, queue_size=50, latch=True)
        try:
            self.home = Home.of(rospy.wait_for_message('angen/home', Message, CONNECT_LIMIT))
        except rospy.ROSException:
            raise Failure('/angen/home is not published') from None

    def _tick(self, message: Any) -> None:
        self._now, self._ticked = message.clock.to_sec(), time.monotonic()

    @property
    def now(self) -> float:
        return self._now

    def run(self, seconds: float) -> None:
        until = self._now + seconds
        while self._now < until - 1e-9:
            time.sleep(LOOK)
            if time.monotonic() - self._ticked > SILENCE:
                raise Failure('the simulator has ended')

    def publish(self, row: dict[str, Any]) -> None:
        """Publishes the true state of a resident; JSON has no NaN, so an unknown place is null."""
        self._truth.publish(json.dumps({key: None if value != value else value
                                        for key, value in row.items()}))

    def devices(self) -> list[tuple[str, str, str, tuple[float, ...]]]:
        self._topics = {(e.kind, e.name): (e.topic, e.type) for e in self._client.entities()}
        return [(e.kind, e.name, e.model, e.pose) for e in self._client.entities()]

    def state(self, kind: str, name: str) -> dict[str, Any]:
        """The latest message of its topic, modes by their names; waits for the first a moment."""
        import roslib.message
        import rospy
        if (kind, name) not in self._topics:  # a person who has appeared since
            self.devices()
        topic, kind_of = self._topics.get((kind, name), ('', ''))
        if not topic:
            return {}
        if topic not in self._subscribed:
            self._subscribed.add(topic)
            rospy.Subscriber(topic, roslib.message.get_message_class(kind_of),
                             lambda message: self._states.__setitem__(topic, message))
            end = time.monotonic() + 2.0
            while topic not in self._states and time.monotonic() < end:
                time.sleep(LOOK)
        message = self._states.get(topic)
        if message is None:
            return {}
        if hasattr(message, 'texts'):  # angen_msgs/Reading
            return {**dict(zip(message.names, message.values)),
                    **dict(zip(message.text_names, message.texts))}
        found = {slot: getattr(message, slot) for slot in message.__slots__}
        if isinstance(found.get('mode'), int):
            modes = {value: key for key, value in vars(type(message)).items()
                     if key.isupper() and isinstance(value, int)}
            found['mode'] = modes.get(found['mode'], '')
        return found

    def command(self, kind: str, name: str, text: str) -> None:
        from angen_msgs.srv import SendCommand
        self._call('angen/command', SendCommand, target=f'{kind}/{name}', text=text)

    def appear(self, name: str, x: float, y: float, z: float, yaw: float, speed: float, body: str
               ) -> None:
        self._put(name, walker(name, speed, body), x, y, z, yaw)

    def settle(self, name: str, place: Place) -> None:
        x, y, z, yaw = place.pose
        self._put(name, figure(name, place.posture), x, y, z + ABOVE, yaw)

    def _put(self, name: str, sdf: str, x: float, y: float, z: float, yaw: float) -> None:
        from angen_msgs.srv import Spawn
        self.vanish(name)
        self._call('angen/spawn', Spawn, name=name, xml=sdf, on='', pose=_pose(x, y, z, yaw))
        self._here.add(name)

    def vanish(self, name: str) -> None:
        from angen_msgs.srv import Delete
        if name in self._here:
            self._here.remove(name)
            self._call('angen/delete', Delete, name=name)

    def fidget(self, name: str, turn: float) -> None:
        from gazebo_msgs.msg import ModelState
        from gazebo_msgs.srv import SetModelState
        body = self.body(name)
        self._call('gazebo/set_model_state', SetModelState, model_state=ModelState(
            model_name=name, pose=_pose(body.x, body.y, body.z, body.yaw + turn)))

    def body(self, name: str) -> Body:
        from gazebo_msgs.srv import GetModelState
        answer = self._call('gazebo/get_model_state', GetModelState, model_name=name,
                            relative_entity_name='')
        at = answer.pose.position
        return Body(at.x, at.y, at.z, yaw_of(answer.pose.orientation))

    def _call(self, service: str, kind: type, **fields: Any) -> Any:
        try:
            return self._client.call(service, kind, **fields)
        except Failure as failure:
            raise Rejected(str(failure)) from None


def _client() -> Client:
    """The client of a simulator that may be starting."""
    end = time.monotonic() + START
    while True:
        try:
            return Client()
        except Failure:
            if time.monotonic() > end:
                raise
            time.sleep(LOOK)


def _pose(x: float, y: float, z: float, yaw: float) -> Any:
    from geometry_msgs.msg import Point, Pose, Quaternion
    return Pose(Point(x, y, z), Quaternion(*quaternion(0.0, 0.0, yaw)))
