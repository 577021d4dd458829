"""Warnings as ROS messages: the topic, the list of active ones, markers, the event log."""
from textwrap import fill
from typing import Any, Sequence

from angen_apps.care.engine import ACKNOWLEDGED, ENDED, RAISED, CareWarning, Change, Engine
from angen_apps.care.report import event_of
from angen_tools.session import Entity
from angen_tools.session.live import Live

WARNINGS, ACTIVE = 'angen/warnings', 'angen/warnings/active'
MARKERS, LOG = 'angen/warnings/markers', 'angen/events/add'
RED, AMBER = (1.0, 0.2, 0.15), (1.0, 0.7, 0.1)  # before and after it is acknowledged
RADIUS, THICK, POLE, LETTERS = 0.6, 0.06, 3.0, 0.2  # m
LINE = 18  # letters


class WarningPublisher:
    """Publishes changes of warnings."""

    def __init__(self, world: Live, engine: Engine, entities: Sequence[Entity]) -> None:
        import rospy
        from angen_msgs.msg import CareWarning as Message
        from angen_msgs.msg import CareWarningArray, Event
        from geometry_msgs.msg import Point
        from visualization_msgs.msg import MarkerArray
        world.join()
        places = {entity.name: Point(*entity.pose[:3]) for entity in reversed(entities)}
        self._places = {rule: places.get(name) for rule, name in engine.places.items()}
        self._one = rospy.Publisher(WARNINGS, Message, queue_size=100)
        self._all = rospy.Publisher(ACTIVE, CareWarningArray, queue_size=10, latch=True)
        self._markers = rospy.Publisher(MARKERS, MarkerArray, queue_size=10, latch=True)
        self._log = world.publisher(LOG, Event)

    def publish(self, engine: Engine, changes: Sequence[Change]) -> None:
        """Publishes changes, and the warnings that are active after them."""
        from angen_msgs.msg import CareWarningArray, Event
        for change in changes:
            self._one.publish(self._message(change.warning, change.event, change.time,
                                            change.degree))
            event = event_of(change)
            self._log.publish(Event(source=event.source, kind=event.kind, event=event.event,
                                    detail=event.detail))
        array = CareWarningArray()
        array.header.stamp = _time(engine.now)
        array.warnings = [
            self._message(warning, RAISED if warning.acknowledged is None else ACKNOWLEDGED,
                          engine.now, engine.degree(warning.rule, engine.now))
            for warning in engine.active.values()]
        self._all.publish(array)
        self._draw(engine)

    def _message(self, warning: CareWarning, state: str, now: float, degree: float) -> Any:
        from angen_msgs.msg import CareWarning as Message
        message = Message()
        message.header.stamp = _time(now)
        message.header.frame_id = 'world'
        message.state = {RAISED: Message.RAISED, ACKNOWLEDGED: Message.ACKNOWLEDGED,
                         ENDED: Message.ENDED}[state]
        message.rule, message.reason = warning.rule.name, warning.rule.reason
        message.detail, message.degree = warning.detail, degree
        message.raised = _time(warning.raised)
        place = self._places[warning.rule.name]
        if place is not None:
            message.place = place
        return message

    def _draw(self, engine: Engine) -> None:
        """A disc, a pole and the reason at each place concerned."""
        from visualization_msgs.msg import Marker, MarkerArray
        array = MarkerArray([Marker(action=Marker.DELETEALL)])
        for warning in engine.active.values():
            place = self._places[warning.rule.name]
            if place is not None:
                color = RED if warning.acknowledged is None else AMBER
                array.markers += _markers(len(array.markers), place, color, warning.rule.reason)
        self._markers.publish(array)


def _markers(number: int, place: Any, color: Sequence[float], reason: str) -> list[Any]:
    """The markers that show one warning; `number`: of the first marker."""
    from visualization_msgs.msg import Marker
    disc = _marker(number, Marker.CYLINDER, place, color, 0.7, THICK / 2)
    disc.scale.x, disc.scale.y, disc.scale.z = 2 * RADIUS, 2 * RADIUS, THICK
    pole = _marker(number + 1, Marker.CYLINDER, place, color, 1.0, POLE / 2)
    pole.scale.x, pole.scale.y, pole.scale.z = THICK, THICK, POLE
    text = _marker(number + 2, Marker.TEXT_VIEW_FACING, place, color, 1.0, POLE + 2 * LETTERS)
    text.scale.z, text.text = LETTERS, fill(reason, LINE)
    return [disc, pole, text]


def _marker(number: int, kind: int, place: Any, color: Sequence[float], alpha: float, above: float
            ) -> Any:
    from visualization_msgs.msg import Marker
    marker = Marker(ns='warnings', id=number, type=kind, action=Marker.ADD)
    marker.header.frame_id = 'world'
    marker.pose.position.x, marker.pose.position.y = place.x, place.y
    marker.pose.position.z = place.z + above
    marker.pose.orientation.w = 1.0
    marker.color.r, marker.color.g, marker.color.b = color
    marker.color.a = alpha
    return marker


def _time(seconds: float) -> Any:
    import rospy
    return rospy.Time.from_sec(seconds)
