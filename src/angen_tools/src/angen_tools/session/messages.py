"""The states of devices and readings of sensors in messages of ROS."""
import re
from typing import Any, Callable

from angen_tools.common.catalog import Plugin, kinds
from angen_tools.common.geometry import yaw_of
from angen_tools.common.home import Pose
from angen_tools.session.world import State

TYPES: dict[str, Callable[[Any], Any]] = {
    'flag': bool, 'integer': int, 'number': float, 'numbers': list, 'texts': list}


def seconds(time: Any) -> float:
    """A time of ROS."""
    return float(time.to_sec())


def twist(ahead: float, left: float) -> Any:
    """A geometry_msgs/Twist of m/s and rad/s."""
    from geometry_msgs.msg import Twist
    made = Twist()
    made.linear.x, made.angular.z = ahead, left
    return made


def seven(pose: Any) -> Pose:
    """A geometry_msgs/Pose."""
    at, turned = pose.position, pose.orientation
    return at.x, at.y, at.z, turned.x, turned.y, turned.z, turned.w


def states_by_name(message: Any, name: str = '') -> dict[str, Any]:
    """By the name of the device or sensor: one state, or with topics:=kind those in an array.

    `name` is that of a sensor, whose message does not say it.
    """
    if hasattr(message, 'readings'):
        return dict(zip(message.names, message.readings))
    return {getattr(message, 'name', name): message}


def state_of(kind: str, name: str, message: Any) -> State:
    """The fields of a kind that its message has."""
    found, values = _slots(message), {}
    for field in kinds().get(kind, {'fields': []})['fields']:
        if field['name'] in found:
            values[field['name']] = _value(field, found[field['name']])
    return State(kind, name, seconds(message.header.stamp), values or found)


def _value(field: Plugin, value: Any) -> Any:
    if field['type'] == 'choice' and isinstance(value, int):
        return field['words'][value]
    return TYPES[field['type']](value) if field['type'] in TYPES else value


def _slots(message: Any) -> dict[str, Any]:
    if hasattr(message, 'texts'):  # angen_msgs/Reading
        return _joined({**dict(zip(message.names, message.values)),
                        **dict(zip(message.text_names, message.texts))})
    found = {slot: getattr(message, slot) for slot in message.__slots__}
    if 'pose' in found:
        pose = getattr(message.pose, 'pose', message.pose)  # one with or without a covariance
        at = pose.position
        found.update(x=at.x, y=at.y, z=at.z, yaw=yaw_of(pose.orientation))
    if hasattr(message, 'twist') and hasattr(message.twist, 'twist'):  # nav_msgs/Odometry
        found.update(v=message.twist.twist.linear.x, w=message.twist.twist.angular.z)
    return found


def _joined(values: dict[str, Any]) -> dict[str, Any]:
    """Arrays, which come as NAME[0], NAME[1], …, as lists."""
    found: dict[str, Any] = {}
    for name, value in values.items():
        array = re.fullmatch(r'(.*)\[\d+\]', name)
        if array:
            found.setdefault(array[1], []).append(value)
        else:
            found[name] = value
    return found
