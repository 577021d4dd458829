"""The orders of a page to the simulator, all by public services and topics."""
import math
import threading
from contextlib import suppress
from typing import Any, Callable

from angen_apps.controls.places import Taken, place, things
from angen_apps.navigation.goal import TOPIC, publish_goal
from angen_apps.web.store import Store
from angen_apps.web.trips import Trips
from angen_tools.common.catalog import is_robot, kinds
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home
from angen_tools.common.wait import wait
from angen_tools.session.live import Live
from angen_tools.session.messages import twist

LONGEST = 4096  # bytes of a text, as the simulator's own limit
MOST_STEPS = 10_000_000
MOST_RATE = 1000.0
HOLD = 0.7  # s after the last order, and a robot stops
LIMIT = 15.0  # s that a service may take
SUBSCRIBED = 1.0  # s in which a subscriber of a new publisher connects


class Orders:
    """Each order is a method; `execute` runs the one that an order names."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self.trips = Trips(store)
        self._publishers: dict[str, Any] = {}
        self._stops: dict[str, threading.Timer] = {}
        self._lock = threading.Lock()  # guards these two
        self._known: dict[str, Callable[[dict[str, Any]], dict[str, Any] | None]] = {
            'command': self._command, 'pause': lambda _: Live().pause(),
            'resume': lambda _: Live().resume(), 'step': self._step,
            'reset': lambda _: Live().reset(), 'rate': self._rate, 'spawn': self._spawn,
            'delete': self._delete, 'save': lambda _: {'xml': Live().save()},
            'drive': self._drive, 'goal': self._goal, 'move': self._move,
            'halt': lambda order: self.trips.stop(self._robot(order))}

    def known(self) -> list[str]:
        """The names of orders."""
        return [*self._known]

    def execute(self, order: dict[str, Any]) -> dict[str, Any]:
        """The answer; ValueError where the simulator rejects it."""
        do = self._known.get(str(order.get('do')))
        if do is None:
            raise ValueError('unknown order; known are ' + ', '.join(self._known))
        try:
            return do(order) or {}
        except Failure as failure:
            raise ValueError(str(failure)) from None

    def _command(self, order: dict[str, Any]) -> dict[str, Any]:
        from angen_msgs.srv import SendCommand
        target, words = text(order, 'target'), text(order, 'text')
        answer = Live().call('angen/command', SendCommand, LIMIT, target=target, text=words)
        return {'text': answer.state}

    def _step(self, order: dict[str, Any]) -> dict[str, Any]:
        from angen_msgs.srv import Step
        stats = self._store.part('stats') or {}
        step = float(stats.get('step') or 0.001)
        ticks = round(number(order, 'seconds', step, MOST_STEPS * step) / step)
        taken = Live().call('angen/step', Step, 120.0, ticks=ticks).taken
        return {'text': f'{taken * step:g} s'}

    def _rate(self, order: dict[str, Any]) -> None:
        Live().rate = number(order, 'rate', 0.0, MOST_RATE)

    def _spawn(self, order: dict[str, Any]) -> dict[str, Any]:
        from angen_tools.world import sdf, sensor
        kind, name = text(order, 'kind'), text(order, 'name')
        if kind not in kinds('sensor'):
            raise Failure(f"'{kind}' is not a kind of sensor")
        place = [number(order.get('pose', {}), key, -1e6, 1e6)
                 for key in ('x', 'y', 'z', 'roll', 'pitch', 'yaw')]
        element = sensor.build(kind, name, [], False)
        Live().spawn(name, sdf.text(element), place)
        return {'text': f'spawned the {kind} {name}'}

    def _move(self, order: dict[str, Any]) -> dict[str, Any]:
        """A model to another place at its height, turned about the vertical."""
        from gazebo_msgs.msg import ModelState
        from gazebo_msgs.srv import SetModelState
        from geometry_msgs.msg import Point, Pose, Quaternion
        model = text(order, 'model')
        x, y, turn = (number(order, 'x', -1e6, 1e6), number(order, 'y', -1e6, 1e6),
                      number(order, 'turn', -math.tau, math.tau))
        live = Live()
        _, _, z, *turned = live.pose(model)
        live.call('gazebo/set_model_state', SetModelState, LIMIT, model_state=ModelState(
            model_name=model, pose=Pose(Point(x, y, z), Quaternion(*about_z(turn, *turned)))))
        return {'text': f'{model} is at {x:.2f}, {y:.2f}'}

    def _delete(self, order: dict[str, Any]) -> dict[str, Any]:
        from angen_msgs.srv import Delete
        name = text(order, 'name')
        return {'text': Live().call('angen/delete', Delete, LIMIT, name=name).message}

    def _drive(self, order: dict[str, Any]) -> None:
        name = self._robot(order)
        speed, turn = number(order, 'speed', -2.0, 2.0), number(order, 'turn', -6.0, 6.0)
        self.trips.stop(name)
        self._send(name, speed, turn)
        with self._lock:
            timer = self._stops.pop(name, None)
            if timer is not None:
                timer.cancel()
            if speed or turn:  # the browser may close the next moment
                self._stops[name] = threading.Timer(HOLD, self._send, (name, 0.0, 0.0))
                self._stops[name].daemon = True
                self._stops[name].start()

    def _send(self, name: str, speed: float, turn: float) -> None:
        command = twist(speed, turn)
        self._publisher(f'{name}/cmd_vel', type(command)).publish(command)

    def _robot(self, order: dict[str, Any]) -> str:
        name = text(order, 'name')
        if name not in {robot['name'] for robot in self._robots()}:
            raise Failure(f"no robot is named '{name}'")
        return name

    def _robots(self) -> list[dict[str, Any]]:
        kinds_of = {kind['kind'] for kind in kinds('device').values() if is_robot(kind)}
        return [e for e in self._store.part('entities') or [] if e['kind'] in kinds_of]

    def _goal(self, order: dict[str, Any]) -> dict[str, Any]:
        """A robot drives to a room, or to a place and its floor."""
        from geometry_msgs.msg import PoseStamped
        room = text(order, 'room') if 'room' in order else ''
        x, y, yaw = (number(order, 'x', -1e6, 1e6), number(order, 'y', -1e6, 1e6),
                     number(order, 'yaw', -math.tau, math.tau))
        floor = round(number(order, 'floor', -1000.0, 1000.0))
        name = self._robot(order)
        known = (self._store.part('home') or {'rooms': []})['rooms']
        if room and all(one['name'] != room for one in known):
            raise Failure(f"no room is named '{room}'")
        publisher = self._publisher(TOPIC, PoseStamped)
        goal = room or f'{x:.2f}, {y:.2f}'
        if not publisher.get_num_connections():
            words = [room] if room else [f'{x:.3f}', f'{y:.3f}', str(floor)]
            self.trips.go(name, goal, words)
            return {'text': f'{name} drives to {goal}'}
        if room:
            x, y, yaw = self._free_place(room)
        self.trips.follow(name, goal)
        publish_goal(publisher, x, y, yaw)
        return {'text': 'the goal is published'}

    def _free_place(self, room: str) -> tuple[float, float, float]:
        """x y yaw."""
        import rospy
        from angen_msgs.msg import Home as HomeMessage
        from angen_msgs.msg import Scene
        home = Home.of(rospy.wait_for_message('angen/home', HomeMessage, LIMIT))
        scene, found = rospy.wait_for_message('angen/scene', Scene, LIMIT), home.room(room)
        robots = {robot['model'] for robot in self._robots()}
        at = place(home, found, Taken(things(scene, found.floor, robots))) if found else None
        if at is None:
            raise Failure(f'no place is free in {room}')
        return at[0], at[1], at[3]

    def _publisher(self, topic: str, kind: type) -> Any:
        import rospy
        with self._lock:
            if topic not in self._publishers:
                made = self._publishers[topic] = rospy.Publisher(topic, kind, queue_size=1)
                with suppress(Failure):  # there may be none
                    wait(lambda: made.get_num_connections() > 0, '', SUBSCRIBED)
            return self._publishers[topic]


def about_z(angle: float, x: float, y: float, z: float, w: float
            ) -> tuple[float, float, float, float]:
    """A quaternion turned about the vertical."""
    c, s = math.cos(angle / 2), math.sin(angle / 2)
    return c * x - s * y, c * y + s * x, c * z + s * w, c * w - s * z


def text(order: dict[str, Any], key: str) -> str:
    """A text of an order; Failure if it is none, or too long."""
    value = order.get(key)
    if not isinstance(value, str) or not 0 < len(value.encode(errors='replace')) <= LONGEST \
            or any('\ud800' <= c <= '\udfff' for c in value):
        raise Failure(f"'{key}' must be a text of at most {LONGEST} bytes")
    return value


def number(order: Any, key: str, low: float, high: float) -> float:
    """A number of an order within limits; Failure if it is none."""
    value = order.get(key, 0.0) if isinstance(order, dict) else None
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not low <= value <= high:
        raise Failure(f"'{key}' must be a number from {low:g} to {high:g}")
    return float(value)
