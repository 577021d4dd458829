"""Interactive markers: what rviz sends when one clicks opens doors and switches lamps."""
import subprocess
from pathlib import Path
from typing import Iterator

import pytest
import rospy
from angen_apps.controls.offers import SEND
from angen_msgs.msg import DoorState, Home as HomeMessage, LampState
from angen_msgs.srv import List
from geometry_msgs.msg import Point, Pose, PoseStamped, Twist
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import SetModelState
from harness import Angen, Inbox, end, until
from visualization_msgs.msg import (InteractiveMarker, InteractiveMarkerControl,
                                    InteractiveMarkerFeedback,
                                    InteractiveMarkerInit, InteractiveMarkerUpdate)

SCRIPT = Path(__file__).resolve().parents[2] / 'src/angen_apps/scripts/controls'
TOPIC = '/angen_controls'


@pytest.fixture(scope='module')
def markers(home: Angen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Inbox]:
    """The messages that rviz gets first."""
    log = tmp_path_factory.mktemp('controls') / 'log'
    with log.open('w') as out:
        process = subprocess.Popen(['/usr/bin/python3', '-u', str(SCRIPT)], text=True, stdout=out,
                                   env=home.master.environment, stderr=out)
    try:
        with Inbox(f'{TOPIC}/update_full', InteractiveMarkerInit) as inbox:
            inbox.wait(lambda message: len(message.markers) >= 2, 'markers')
            rospy.sleep(1.5)  # the server ignores clicks of the first second
            yield inbox
    finally:
        end(process)
    assert 'Traceback' not in log.read_text()


def marker(inbox: Inbox, name: str) -> InteractiveMarker:
    return until(lambda: next((m for m in inbox.messages[-1].markers if m.name == name), None),
                 f'the marker of {name}')


def press(name: str, event: int, entry: int = 0) -> None:
    publisher = rospy.Publisher(f'{TOPIC}/feedback', InteractiveMarkerFeedback, queue_size=10)
    until(lambda: publisher.get_num_connections() > 0, 'the server')
    publisher.publish(InteractiveMarkerFeedback(
        client_id='rviz', marker_name=name, control_name='button', event_type=event,
        menu_entry_id=entry))


def test_a_click_opens_a_door_and_another_closes_it(home: Angen, markers: Inbox) -> None:
    shown = marker(markers, 'door/bathroom0')
    assert shown.controls[0].interaction_mode == InteractiveMarkerControl.BUTTON
    door = next(door for door in home.wait('/angen/home', HomeMessage).doors
                if door.name == 'bathroom0')
    assert shown.pose == door.pose
    assert shown.controls[0].markers[0].color.a == 1.0  # walls that are seen through cover it less
    with Inbox('/angen/door/bathroom0', DoorState) as states:
        press('door/bathroom0', InteractiveMarkerFeedback.BUTTON_CLICK)
        states.wait(lambda state: state.mode == DoorState.OPEN, 'an open door')
        press('door/bathroom0', InteractiveMarkerFeedback.BUTTON_CLICK)
        states.wait(lambda state: state.mode == DoorState.CLOSING, 'a closing door')


def test_an_elevator_is_clicked_on_each_landing(home: Angen, markers: Inbox) -> None:
    lift = home.wait('/angen/home', HomeMessage).elevators[0]
    button = marker(markers, 'elevator/elevator').controls[0]
    balls = [ball.pose.position for ball in button.markers]
    places = [landing.pose.position for landing in lift.landings]
    assert [(at.x, at.y) for at in balls] == [(at.x, at.y) for at in places]
    assert [ball.z - at.z for ball, at in zip(balls, places)] == pytest.approx([1.05, 1.05])


def choose(inbox: Inbox, name: str, title: str) -> None:
    """An entry of a menu."""
    entry = next(one for one in marker(inbox, name).menu_entries if one.title == title)
    press(name, InteractiveMarkerFeedback.MENU_SELECT, entry.id)


def test_the_menu_dims_a_lamp(markers: Inbox) -> None:
    with Inbox('/angen/lamp/kitchen0', LampState) as states:
        choose(markers, 'lamp/kitchen0', 'Dim 75 %')
        states.wait(lambda state: state.level == 75.0, 'a dimmed lamp')


def sendable(shown: InteractiveMarker) -> set[str]:
    """The rooms of a mover's menu."""
    under = next((one.id for one in shown.menu_entries if one.title == SEND), None)
    return {one.title for one in shown.menu_entries if one.parent_id == under}


def rooms(home: Angen, storey: int) -> set[str]:
    return {room.name for room in home.wait('/angen/home', HomeMessage).rooms
            if room.storey == storey}


def test_the_menu_sends_a_person_to_a_room(home: Angen, markers: Inbox) -> None:
    lower = rooms(home, 0)
    until(lambda: sendable(marker(markers, 'person/person')) == lower, 'the rooms of floor 0')
    choose(markers, 'person/person', 'bathroom0')
    until(lambda: home.call('/angen/list', List, kind='person').entities[0].room == 'bathroom0',
          'the person is there', 120.0)


def test_the_menu_sends_a_robot_by_navigation(markers: Inbox) -> None:
    with Inbox('/move_base_simple/goal', PoseStamped) as goals:
        choose(markers, 'drive/turtlebot', 'bathroom0')
        goals.wait(lambda goal: goal.header.frame_id == 'map', 'a goal')


def test_the_button_of_a_battery_follows_its_robot(markers: Inbox) -> None:
    robot = marker(markers, 'drive/turtlebot')
    battery = until(lambda: next((m for m in markers.messages[-1].markers
                                  if m.name.startswith('battery/')), None), 'its marker')
    assert battery.header.frame_id == robot.header.frame_id != 'world'
    below, above = (m.controls[0].markers[0].pose.position.z for m in (robot, battery))
    assert above - below == pytest.approx(0.4)


def test_the_menu_follows_a_robot_to_another_floor(home: Angen, markers: Inbox) -> None:
    upper = rooms(home, 1)
    state = ModelState('turtlebot', Pose(position=Point(5.3, 2.0, 4.001)), Twist(), 'world')
    home.call('/gazebo/set_model_state', SetModelState, model_state=state)
    home.command('elevator/all', 'Floor1')
    until(lambda: sendable(marker(markers, 'drive/turtlebot')) == upper, 'the rooms of floor 1')


def test_markers_come_and_go_with_models(home: Angen, markers: Inbox) -> None:
    with Inbox(f'{TOPIC}/update', InteractiveMarkerUpdate) as updates:
        home.spawn('attic_lamp0', 'model://ceiling_lamp', 3, 3, 2.5)
        updates.wait(lambda m: any(one.name == 'lamp/attic0' for one in m.markers), 'its marker')
        home.delete('attic_lamp0')
        updates.wait(lambda m: 'lamp/attic0' in m.erases, 'its end')
