"""The node of interactive markers: a click switches a device, its menu has all that its kind does.

It follows spawns, deletions and rides of elevators only; the state of a device is read when it is
clicked.
"""
from typing import Any

import roslib.message
import rospy
from angen_msgs.msg import Event, Home as HomeMessage, Scene
from angen_msgs.srv import List, SendCommand
from geometry_msgs.msg import Pose, PoseStamped
from interactive_markers.interactive_marker_server import InteractiveMarkerServer
from interactive_markers.menu_handler import MenuHandler
from visualization_msgs.msg import InteractiveMarker, InteractiveMarkerControl, Marker

from angen_apps.controls.offers import SEND, Offer, offers, pair, toggled, walk
from angen_apps.controls.places import Taken, place, rooms, things
from angen_apps.navigation.goal import TOPIC, publish_goal
from angen_tools.common.catalog import is_robot, kinds
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home
from angen_tools.session.messages import states_by_name

SERVER = 'angen_controls'
HANDLE = 0.2  # m, diameter of a button
MOVER = 0.3  # m, of a person's or robot's: seen from above, their label covers less
HAND = 1.05  # m over the foot of a door, where its button is
OVER = {'person': 2.2, 'drive': 0.9}  # m over a mover's origin: over its label
SCENE_LIMIT = 10.0  # s that the scene takes to come
STATE_LIMIT = 1.0  # s that a latched state takes to come
ABOVE = 0.4  # m from a mover's button to that of its battery, or of another device on it
COLORS = {'lamp': (1.0, 0.8, 0.2), 'door': (0.0, 0.85, 0.75)}
OTHER = (0.3, 0.5, 0.9)
CHANGES = ('spawned', 'deleted', 'reset', 'arrived')  # the last: an elevator, perhaps with a mover
QUIET = 0.3  # s without such an event, after which the markers are made again


def ball(kind: str, x: float, y: float, z: float) -> Marker:
    """A control that is clicked."""
    made = Marker()
    made.type = Marker.SPHERE
    made.scale.x = made.scale.y = made.scale.z = MOVER if kind in OVER else HANDLE
    made.pose.orientation.w = 1.0
    made.pose.position.x, made.pose.position.y, made.pose.position.z = x, y, z
    made.color.r, made.color.g, made.color.b = COLORS.get(kind, OTHER)
    made.color.a = 1.0  # else rviz draws it among the see-through walls, also over it those behind
    return made


class Controls:
    """Serves the markers until ROS ends."""

    def __init__(self) -> None:
        self._server = InteractiveMarkerServer(SERVER)
        self._menus: dict[str, MenuHandler] = {}  # whose callbacks live with them
        self._made: dict[str, tuple[InteractiveMarker, list[Offer]]] = {}
        self._shown: dict[str, Any] = {}
        self._frames: dict[str, str] = {}
        self._movers: dict[str, Any] = {}  # people and robots, by their models
        self._doors: dict[str, Any] = {}
        self._home = Home()
        self._goal = rospy.Publisher(TOPIC, PoseStamped, queue_size=1)
        self._list = rospy.ServiceProxy('angen/list', List)
        self._command = rospy.ServiceProxy('angen/command', SendCommand)
        self._list.wait_for_service()
        rospy.Subscriber('angen/events', Event, self._on_event)
        rospy.Subscriber('angen/home', HomeMessage, self._on_home)
        self._is_stale = True

    def spin(self) -> None:
        """Makes the markers again after models were spawned or deleted, or rode to a floor."""
        while not rospy.is_shutdown():
            if self._is_stale:
                self._is_stale = False
                try:
                    self.make()
                except (rospy.ServiceException, rospy.ROSException):  # it ends, or begins
                    self._is_stale = True
            rospy.rostime.wallsleep(QUIET)

    def _on_event(self, event: Any) -> None:
        self._is_stale = self._is_stale or event.event in CHANGES

    def _on_home(self, home: Any) -> None:
        self._doors = {f'{door.kind}/{door.name}': door.pose for door in home.doors}
        self._home = Home.of(home)
        self._is_stale = True

    def make(self) -> None:
        """A marker for each device that takes commands."""
        entities = {f'{e.kind}/{e.name}': e for e in self._list('').entities}
        self._frames = self._moving_frames()
        self._movers = {e.model: e for e in entities.values() if e.kind in OVER}
        offered = {key: self._offers(e) for key, e in entities.items() if e.kind in kinds('device')}
        self._shown = {key: entities[key] for key, found in offered.items() if found}
        for key in self._made.keys() - self._shown.keys():
            self._server.erase(key)
            del self._made[key], self._menus[key]
        for key, entity in self._shown.items():
            made = self._marker(key, entity), offered[key]
            if self._made.get(key) != made:  # rviz closes the menu of a control that is sent again
                self._made[key] = made
                self._server.insert(made[0], self._on_click)
                self._menus[key] = self._menu(entity, made[1])
                self._menus[key].apply(self._server, key)
        self._server.applyChanges()

    def _offers(self, entity: Any) -> list[Offer]:
        return offers(kinds()[entity.kind], self._floors(entity),
                      [room.name for room in rooms(self._home, entity.pose.position.z)])

    @staticmethod
    def _scene() -> Any:
        return rospy.wait_for_message('angen/scene', Scene, SCENE_LIMIT)

    def _moving_frames(self) -> dict[str, str]:
        """The frame of each model's first link that moves: a marker in it follows the model."""
        frames: dict[str, str] = {}
        for link in self._scene().links:
            if link.moves:
                frames.setdefault(link.model, f'{link.model}/{link.name}')
        return frames

    def _frame(self, entity: Any) -> str:
        """The frame of a mover; rviz shows no marker while one is in a frame that TF lacks."""
        if entity.type != 'nav_msgs/Odometry':
            return self._frames.get(entity.model, '')
        odometry = self._message(entity)
        return odometry.child_frame_id if odometry is not None else ''

    def _floors(self, entity: Any) -> list[int]:
        """The stops of an elevator."""
        state = self._state(entity) if entity.kind == 'elevator' else None
        return list(range(state.floors)) if state is not None else []

    def _marker(self, key: str, entity: Any) -> InteractiveMarker:
        marker = InteractiveMarker()
        marker.name, marker.description = key, ''
        marker.scale = HANDLE
        mover = self._movers.get(entity.model)
        frame = self._frame(mover) if mover is not None else ''
        marker.header.frame_id = frame or 'world'
        marker.pose = Pose() if frame else self._doors.get(key, entity.pose)
        marker.pose.orientation.w = marker.pose.orientation.w or 1.0
        control = InteractiveMarkerControl()
        control.interaction_mode = InteractiveMarkerControl.BUTTON
        control.name = 'button'
        control.always_visible = True
        landings = self._landings(entity)
        if landings:
            marker.pose, marker.pose.orientation.w = Pose(), 1.0
        over = HAND if key in self._doors else self._over(mover, entity)
        control.markers = [ball(entity.kind, *at) for at in landings or [(0.0, 0.0, over)]]
        marker.controls.append(control)
        return marker

    def _over(self, mover: Any, entity: Any) -> float:
        """m over the origin of a mover, or of the entity itself where it is on none."""
        if mover is None:
            return 0.0
        others = sorted(key for key, e in self._shown.items()
                        if e.model == mover.model and e is not mover)
        key = f'{entity.kind}/{entity.name}'
        return OVER[mover.kind] + ABOVE * (others.index(key) + 1 if key in others else 0)

    def _landings(self, entity: Any) -> list[tuple[float, float, float]]:
        """The call button of an elevator: its cabin hides the controls in it."""
        return [(x, y, z + HAND) for one in self._home.elevators
                if (entity.kind, entity.name) == ('elevator', one.name)
                for x, y, z, _ in (landing.pose for landing in one.landings)]

    def _menu(self, entity: Any, offered: list[Offer]) -> MenuHandler:
        menu = MenuHandler()
        menu.insert(f'{entity.kind} {entity.name}')
        lines: dict[str, Any] = {'': None}  # lines with a submenu
        for offer in offered:
            if offer.under not in lines:
                lines[offer.under] = menu.insert(offer.under)
            menu.insert(offer.label, parent=lines[offer.under],
                        callback=lambda _, offer=offer: self._send(entity, offer))
        return menu

    def _on_click(self, feedback: Any) -> None:
        entity = self._shown.get(feedback.marker_name)
        if entity is None or feedback.event_type != feedback.BUTTON_CLICK:
            return
        verbs = pair(kinds()[entity.kind])
        if verbs is None:
            rospy.loginfo('%s %s: the right button opens the menu of its commands', entity.kind,
                          entity.name)
            return
        verb = toggled(verbs, self._state(entity))
        self._send(entity, Offer(verb, verb))

    def _state(self, entity: Any) -> Any:
        """The state of a device as it is now, or None."""
        message = self._message(entity)
        return None if message is None else states_by_name(message).get(entity.name)

    def _message(self, entity: Any) -> Any:
        """The next or latched message of an entity, or None."""
        kind = roslib.message.get_message_class(entity.type) if entity.topic else None
        if kind is None:
            return None
        try:
            return rospy.wait_for_message(entity.topic, kind, STATE_LIMIT)
        except rospy.ROSException:
            return None

    def _send(self, entity: Any, offer: Offer) -> None:
        try:
            text = self._to_room(entity, offer.label) if offer.under == SEND else offer.text
            if not text:
                return
            answer = self._command(f'{entity.kind}/{entity.name}', text)
        except (rospy.ServiceException, rospy.ROSException, Failure) as error:
            rospy.logwarn('%s: %s', offer.text or offer.label, error)
            return
        if not answer.success:
            rospy.logwarn('%s', answer.message)

    def _to_room(self, entity: Any, name: str) -> str:
        """The command that sends a person there; '' for a robot, which gets a goal."""
        kind, room = kinds()[entity.kind], self._home.room(name)
        at = place(self._home, room, self._taken(entity, room.floor)) if room else None
        if at is None:
            raise Failure(f'no place is free there for {entity.kind} {entity.name}')
        x, y, _, yaw = at
        if is_robot(kind):
            publish_goal(self._goal, x, y, yaw)
            return ''
        return f'{walk(kind)} {x:.2f} {y:.2f}'

    def _taken(self, entity: Any, floor: float) -> Taken:
        """The obstacles of a mover on a floor."""
        movers = [e for e in self._list('').entities if e.kind in kinds('device') and (
            is_robot(kinds()[e.kind]) or walk(kinds()[e.kind]))]
        storey = self._home.storey_at(floor)
        at = [e.pose.position for e in movers if e.model != entity.model]
        return Taken(things(self._scene(), floor, {e.model for e in movers}),
                     [(p.x, p.y) for p in at if self._home.storey_at(p.z) == storey])
