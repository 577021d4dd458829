#!/usr/bin/env python3
"""Draws docs/images/rviz.png: the building of `./angen` in rviz.

    ./angen shell
    xvfb-run -s '-screen 0 1500x1060x24' python3 docs/rviz_picture.py [VIEW] [FILE]

VIEW is a saved view that ./angen run gives rviz.
"""
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import rospy
import yaml
from PIL import Image, ImageChops, ImageGrab, ImageOps

from angen_apps.viewer.start import received
from angen_tools.live.sandbox import Sandbox

ROOT = Path(__file__).resolve().parents[1]
CONFIGURATION = ROOT / 'src/angen_sim/launch/angen.rviz'
WORLD = ROOT / 'worlds/angen.world'
WIDTH, HEIGHT = 1500, 1060
LIT = ('livingroom0', 'livingroom1')
TICKS = '600'  # of 1 ms, until the person has walked into the living room
ROBOT = ('<pose>1.5 5 0.001 0 0 3.141593</pose>', '<pose>5.3 2 4.001 0 0 -0.7</pose>')  # old, new
TOOLBAR, MARGIN = 62, 16  # pixels of rviz's window around the picture
STATUS = 30
SETTLE = 15.0  # s; rviz draws in software
BACKGROUND = (58, 64, 74)
BORDER = 20


def configuration(view: str, path: Path) -> None:
    """angen.rviz at one of its views, with nothing but the picture in its window."""
    settings = received(yaml.safe_load(CONFIGURATION.read_text()))
    views = settings['Visualization Manager']['Views']
    if view:
        views['Current'] = next(saved for saved in views['Saved'] if saved['Name'] == view)
    building, = (display for display in settings['Visualization Manager']['Displays']
                 if display['Name'] == 'Building')
    building['Namespaces'].update({'PIR rays 0': False, 'PIR rays 1': False})
    settings['Panels'] = []
    settings['Window Geometry'] = {'Width': WIDTH, 'Height': HEIGHT, 'X': 0, 'Y': 0,
                                   'Hide Left Dock': True, 'Hide Right Dock': True}
    path.write_text(yaml.safe_dump(settings))


def trimmed(window: Image.Image) -> Image.Image:
    """The picture in rviz's window, without most of its background."""
    shown = window.crop((MARGIN, TOOLBAR, WIDTH - MARGIN, HEIGHT - STATUS))
    plain = Image.new('RGB', shown.size, shown.getpixel((0, 0)))
    return ImageOps.expand(shown.crop(ImageChops.difference(shown, plain).getbbox()), BORDER,
                           BACKGROUND)


def main() -> None:
    view = sys.argv[1] if len(sys.argv) > 1 else ''
    picture = Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / 'docs/images/rviz.png'
    with tempfile.TemporaryDirectory() as name, Sandbox(Path(name)) as sandbox:
        folder = Path(name)
        sandbox.environment['LIBGL_ALWAYS_SOFTWARE'] = '1'
        text = WORLD.read_text()
        if ROBOT[0] not in text:
            sys.exit(f'{WORLD} has the robot somewhere else')
        world = folder / 'angen.world'
        world.write_text(text.replace(*ROBOT))
        sandbox.node(world, 1.0, paused='true')
        for lamp in LIT:
            subprocess.run(['rostopic', 'pub', '-1', '/gazebo/Light_controller', 'std_msgs/String',
                            f'On, {lamp}'], env=sandbox.environment, check=True)
        subprocess.run(['rosservice', 'call', '/angen/step', TICKS], env=sandbox.environment,
                       check=True)
        rospy.init_node('picture')
        configuration(view, folder / 'view.rviz')
        sandbox.start(['rviz', '-d', str(folder / 'view.rviz')], 'rviz')
        time.sleep(SETTLE)
        trimmed(ImageGrab.grab(xdisplay='')).save(picture)
    print(picture)


if __name__ == '__main__':
    main()
