"""rviz itself, on a display without a screen: a click of the mouse on a door's button opens it."""
import os
import subprocess
import time
from pathlib import Path
from typing import Any, Iterator

import pytest
import yaml
from angen_msgs.msg import DoorState, Home
from geometry_msgs.msg import Point
from harness import Angen, Inbox, end, until
from test_controls import SCRIPT, TOPIC
from visualization_msgs.msg import InteractiveMarkerFeedback

CONFIGURATION = Path(__file__).resolve().parents[2] / 'src/angen_sim/launch/angen.rviz'
DOOR = 'door/bathroom0'
WIDTH, HEIGHT = 900, 700
MIDDLE = 450, 366  # of the view, below the toolbar
HAND = 1.05  # m over a door's foot, where its button is
DISTANCE = 1.6  # m of the camera: the button has some 70 pixels
LIMIT = 90.0  # s until rviz shows the button; it draws in software
PAUSE = 1.0  # s between attempts


@pytest.fixture(scope='module')
def display() -> Iterator[str]:
    """The name of a display of the test's own."""
    read, write = os.pipe()
    server = subprocess.Popen(['Xvfb', '-displayfd', str(write), '-screen', '0',
                               f'{WIDTH}x{HEIGHT}x24', '-nolisten', 'tcp'], pass_fds=[write],
                              text=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    with open(read) as number:
        name = number.readline().strip()
    assert name, 'Xvfb does not start'
    yield f':{name}'
    end(server)


def configuration(at: Point) -> dict[str, Any]:
    """rviz as ./angen run shows it, with a door's button in its middle."""
    settings: dict[str, Any] = yaml.safe_load(CONFIGURATION.read_text())
    settings['Panels'] = []
    settings['Window Geometry'] = {'Width': WIDTH, 'Height': HEIGHT, 'X': 0, 'Y': 0,
                                   'Hide Left Dock': True, 'Hide Right Dock': True}
    settings['Visualization Manager']['Views']['Current'] |= {
        'Distance': DISTANCE, 'Pitch': 0.3, 'Yaw': 1.0,
        'Focal Point': {'X': at.x, 'Y': at.y, 'Z': at.z + HAND}}
    return settings


def test_a_click_in_rviz_opens_a_door(angen: Angen, display: str, tmp_path: Path) -> None:
    environment = dict(angen.master.environment, DISPLAY=display, LIBGL_ALWAYS_SOFTWARE='1',
                       XDG_RUNTIME_DIR=str(tmp_path), HOME=str(tmp_path))

    def start(*words: str) -> subprocess.Popen[str]:
        with (tmp_path / 'log').open('a') as out:
            return subprocess.Popen(words, text=True, stdout=out, stderr=out, env=environment)

    def click() -> None:
        for x in (MIDDLE[0] - 9, MIDDLE[0]):
            subprocess.run(['xdotool', 'mousemove', str(x), str(MIDDLE[1])], env=environment,
                           check=True)
            time.sleep(0.3)  # until rviz has drawn the object under the mouse
        subprocess.run(['xdotool', 'click', '1'], env=environment, check=True)

    started = [start('/usr/bin/python3', '-u', str(SCRIPT))]
    try:
        home = angen.wait('/angen/home', Home, lambda home: len(home.doors) > 0)
        at = next(door.pose.position for door in home.doors if door.name == 'bathroom0')
        (tmp_path / 'view.rviz').write_text(yaml.safe_dump(configuration(at)))
        with Inbox(f'{TOPIC}/feedback', InteractiveMarkerFeedback) as clicks, \
                Inbox('/angen/door/bathroom0', DoorState) as states:
            states.wait(lambda state: state.mode == DoorState.CLOSED, 'a closed door')
            started.append(start('rviz', '-d', str(tmp_path / 'view.rviz')))

            def clicked() -> bool:
                click()
                time.sleep(PAUSE)
                return any(one.event_type == one.BUTTON_CLICK and one.marker_name == DOOR
                           for one in list(clicks.messages))

            def opened() -> bool:
                if states.messages[-1].mode == DoorState.CLOSED:  # two clicks came before an answer
                    click()
                    time.sleep(PAUSE)
                return any(state.mode == DoorState.OPEN for state in list(states.messages))

            until(clicked, 'rviz sends the click', LIMIT)
            until(opened, 'an open door')
    finally:
        for process in reversed(started):
            end(process)
    assert 'Traceback' not in (tmp_path / 'log').read_text()
