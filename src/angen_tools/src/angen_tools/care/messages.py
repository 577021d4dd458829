"""Warnings as ROS messages: the topic, the list of active ones, markers, the event log."""
from __future__ import annotations

from typing import Any, Collection, Sequence

from angen_tools.care.engine import ACKNOWLEDGED, ENDED, RAISED, CareWarning, Change, Engine
from angen_tools.care.report import event_of
from angen_tools.care.rules import Rule, Rules
from angen_tools.care.sources import first_source
from angen_tools.live.client import Client

WARNINGS, ACTIVE = '/angen/warnings', '/angen/warnings/active'
MARKERS, LOG = '/angen/warnings/markers', '/angen/events/add'
RED, AMBER = (0.9, 0.1, 0.1), (1.0, 0.7, 0.1)  # before and after it is acknowledged
ABOVE, LETTERS, RADIUS, THICK = 0.5, 0.18, 0.35, 0.04  # m


class Outlet:
    """Publishes what becomes of warnings."""

    def __init__(self, client: Client, rules: Rules, existing: Collection[str],
                 entities: Sequence[Any]) -> None:
        import rospy
        from angen_msgs.msg import CareWarning as Message
        from angen_msgs.msg import CareWarningArray, Event
        from visualization_msgs.msg import MarkerArray
        client.join()
        places = {entity.name: entity.pose.position for entity in reversed(entities)}
        self._places = {rule.name: places.get(_place(rule, rules, existing))
                        for rule in rules.rules}
        self._one = rospy.Publisher(WARNINGS, Message, queue_size=100)
        self._all = rospy.Publisher(ACTIVE, CareWarningArray, queue_size=10, latch=True)
        self._markers = rospy.Publisher(MARKERS, MarkerArray, queue_size=10, latch=True)
        self._log = client.publisher(LOG, Event)

    def publish(self, engine: Engine, changes: Sequence[Change]) -> None:
        """Publishes changes, and what is active after them."""
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
        """A ring and the reason at each place concerned."""
        from visualization_msgs.msg import Marker, MarkerArray
        array = MarkerArray([Marker(action=Marker.DELETEALL)])
        for number, warning in enumerate(engine.active.values()):
            place = self._places[warning.rule.name]
            if place is None:
                continue
            color = RED if warning.acknowledged is None else AMBER
            ring = _marker('warnings', 2 * number, Marker.CYLINDER, place, color, 0.0)
            ring.scale.x = ring.scale.y = 2 * RADIUS
            ring.scale.z, ring.color.a = THICK, 0.8
            text = _marker('warnings', 2 * number + 1, Marker.TEXT_VIEW_FACING, place, color,
                           ABOVE)
            text.scale.z, text.text = LETTERS, f'{warning.rule.name}\n{warning.rule.reason}'
            array.markers += [ring, text]
        self._markers.publish(array)


def _marker(space: str, number: int, kind: int, place: Any, color: Sequence[float], above: float
            ) -> Any:
    from visualization_msgs.msg import Marker
    marker = Marker(ns=space, id=number, type=kind, action=Marker.ADD)
    marker.header.frame_id = 'world'
    marker.pose.position.x, marker.pose.position.y = place.x, place.y
    marker.pose.position.z = place.z + above
    marker.pose.orientation.w = 1.0
    marker.color.r, marker.color.g, marker.color.b = color
    marker.color.a = 1.0
    return marker


def _place(rule: Rule, rules: Rules, existing: Collection[str]) -> str:
    """The name of what stands where a rule's warnings are shown."""
    if rule.at:
        return rule.at
    signal = next((condition.signal for condition in rule.when if condition.signal), '')
    return first_source(rules.signals[signal], existing) if signal else ''


def _time(seconds: float) -> Any:
    import rospy
    return rospy.Time.from_sec(seconds)
