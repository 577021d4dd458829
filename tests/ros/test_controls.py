"""Interactive markers: what rviz sends when one clicks opens doors and switches lamps."""
from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Iterator

import pytest
import rospy
from angen_msgs.msg import DoorState, LampState
from angen_msgs.srv import Delete, Spawn
from geometry_msgs.msg import Point, Pose
from harness import Angen, Inbox, end, until
from visualization_msgs.msg import (InteractiveMarker, InteractiveMarkerControl,
                                    InteractiveMarkerFeedback,
                                    InteractiveMarkerInit, InteractiveMarkerUpdate)

SCRIPT = Path(__file__).resolve().parents[2] / 'src/angen_apps/scripts/controls'
TOPIC = '/angen_controls'


@pytest.fixture(scope='module')
def markers(angen: Angen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Inbox]:
    """The messages that rviz gets first."""
    log = tmp_path_factory.mktemp('controls') / 'log'
    with log.open('w') as out:
        process = subprocess.Popen(['/usr/bin/python3', '-u', str(SCRIPT)], text=True, stdout=out,
                                   env=angen.master.environment, stderr=out)
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


def test_a_click_opens_a_door_and_another_closes_it(markers: Inbox) -> None:
    shown = marker(markers, 'door/bathroom0')
    assert shown.controls[0].interaction_mode == InteractiveMarkerControl.BUTTON
    assert abs(shown.pose.position.x) < 1.0 and abs(shown.pose.position.y) < 0.2
    with Inbox('/angen/door/bathroom0', DoorState) as states:
        press('door/bathroom0', InteractiveMarkerFeedback.BUTTON_CLICK)
        states.wait(lambda state: state.mode == DoorState.OPEN, 'an open door')
        press('door/bathroom0', InteractiveMarkerFeedback.BUTTON_CLICK)
        states.wait(lambda state: state.mode == DoorState.CLOSING, 'a closing door')


def test_the_menu_dims_a_lamp(markers: Inbox) -> None:
    entry = next(one for one in marker(markers, 'lamp/kitchen0').menu_entries
                 if one.title == 'Dim 75 %')
    with Inbox('/angen/lamp/kitchen0', LampState) as states:
        press('lamp/kitchen0', InteractiveMarkerFeedback.MENU_SELECT, entry.id)
        states.wait(lambda state: state.level == 75.0, 'a dimmed lamp')


def test_markers_come_and_go_with_models(angen: Angen, markers: Inbox) -> None:
    with Inbox(f'{TOPIC}/update', InteractiveMarkerUpdate) as updates:
        answer = angen.call('/angen/spawn', Spawn, name='hall_lamp0', xml='model://ceiling_lamp',
                            pose=Pose(position=Point(3, 3, 2.5)))
        assert answer.success, answer.message
        updates.wait(lambda m: any(one.name == 'lamp/hall0' for one in m.markers), 'its marker')
        angen.call('/angen/delete', Delete, name='hall_lamp0')
        updates.wait(lambda m: 'lamp/hall0' in m.erases, 'its end')
