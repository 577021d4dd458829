#!/usr/bin/env python3
"""Draws docs/images/residents.png: four moments of residents' days, in rviz.

    ./angen shell
    xvfb-run -s '-screen 0 1500x1060x24' python3 docs/residents_picture.py [FILE]

Residents live in this process until such a moment; its world is saved, and shown by a node.
"""
import datetime
import math
import multiprocessing
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from random import Random
from typing import Any, Callable, Iterator

import rospy
import rviz_picture
import yaml
from matplotlib.font_manager import findfont
from PIL import Image, ImageDraw, ImageFont, ImageGrab

from angen_apps.data.site import Site, apartment as furnished
from angen_apps.plan.apartment import apartment
from angen_apps.plan.writer import write_world
from angen_apps.residents.household import Household
from angen_apps.residents.profiles import read
from angen_apps.residents.members import make
from angen_apps.residents.resident import Resident
from angen_tools.live.sandbox import Sandbox

SIZE = (720, 560)
LATEST = 30 * 3600.0  # s
SETTLE = 20.0  # s; rviz draws in software
MIDNIGHT = 2 * 3600.0
INSIDE = 0.4  # m from the middle of a cabin

Moment = tuple[str, str, tuple[float, float, float], float]  # caption, world, place, yaw
PITCH = {'in the elevator': 0.3}  # rad; 0.75 of others


def household(path: Path, since: float) -> tuple[Site, Household]:
    site = Site(path, 3, placed=False)
    return site, Household(site.simulator, site.ground, 3, 'home', datetime.date(2026, 3, 23),
                           since)


def moments(folder: Path) -> Iterator[Moment]:
    """A day of two retired people, and a ride of a worker."""
    furnished(folder / 'home.world')
    site, home = household(folder / 'home.world', MIDNIGHT)
    anna, bert, *_ = make(home, [('anna', read('retired')), ('bert', read('retired'))])

    def until(caption: str, who: Any, there: Callable[[], bool], yaw: float) -> Moment:
        while not there() and home.now < LATEST:
            home.run(home.now + 5.0)
        x, y = who.at
        return caption, site.world.save(), (x, y, 0.6), yaw

    def both(activity: str, posture: str) -> bool:
        return all((r.item.activity, r.posture) == (activity, posture) for r in (anna, bert))

    def cook() -> Resident | None:
        return next((r for r in (anna, bert) if r.item.activity == 'cook' and not r.walks
                     and r.spot and 'stove' in r.spot.thing), None)

    yield until('asleep', anna, lambda: both('sleep', 'lie'), 0.6)
    yield until('cooking', anna if cook() is anna else bert, lambda: cook() is not None, 1.0)
    yield until('at the table together', anna, lambda: both('eat', 'sit'), 0.6)
    yield ride(folder)


def ride(folder: Path) -> Moment:
    """A worker on the way to another floor."""
    write_world(apartment(1, 2, 7), folder / 'two.world')
    site, home = household(folder / 'two.world', 0.0)
    clara = Resident(home, 'clara', 0, read('worker'))
    home.residents.append(clara)

    def script() -> Iterator[float]:
        clara.enter(home.places.anywhere())
        for storey in (1, 0):
            room = next(r for r in site.home.rooms if (r.storey, r.use) == (storey, 'bathroom'))
            yield from clara.go(site.ground.spots(room.name, 1, Random(2))[0], storey)

    home.add(script())
    home.run(1.0)

    lift = site.ground.lift(0, 1)
    assert lift is not None

    def aboard() -> bool:
        doors = site.simulator.state('elevator', lift.name).get('door_mode')
        return math.dist(site.simulator.body('clara')[:2], lift.cabin) < INSIDE and doors == 'OPEN'

    while not aboard() and home.now < LATEST:
        home.run(home.now + 0.5)
    body = site.simulator.body('clara')
    yaw = math.atan2(lift.waits[1] - lift.cabin[1], lift.waits[0] - lift.cabin[0])
    return 'in the elevator', site.world.save(), (body.x, body.y, body.z + 0.9), yaw - 0.25


def configuration(at: tuple[float, float, float], yaw: float, pitch: float, path: Path) -> None:
    """rviz_picture's, from a place above this one."""
    rviz_picture.configuration('', path)
    settings = yaml.safe_load(path.read_text())
    manager = settings['Visualization Manager']
    manager['Views']['Current'].update({
        'Class': 'rviz/Orbit', 'Distance': 4.2, 'Pitch': pitch, 'Yaw': yaw,
        'Focal Point': dict(zip('XYZ', at)), 'Target Frame': 'world'})
    settings['Window Geometry'].update({'Width': SIZE[0], 'Height': SIZE[1] + 90})
    path.write_text(yaml.safe_dump(settings))


def shown(moment: Moment, folder: Path) -> Image.Image:
    caption, world, at, yaw = moment
    folder.mkdir()
    (folder / 'moment.world').write_text(world)
    with Sandbox(folder) as sandbox:
        sandbox.environment['LIBGL_ALWAYS_SOFTWARE'] = '1'
        sandbox.node(folder / 'moment.world', 1.0, paused='true')
        rospy.init_node('picture', disable_signals=True)
        configuration(at, yaw, PITCH.get(caption, 0.75), folder / 'view.rviz')
        sandbox.start(['rviz', '-d', str(folder / 'view.rviz')], 'rviz')
        time.sleep(SETTLE)
        picture = ImageGrab.grab(xdisplay='').crop((16, 62, SIZE[0] - 16, SIZE[1] + 40))
    font = ImageFont.truetype(findfont('DejaVu Sans'), 22)
    ImageDraw.Draw(picture).text((12, 8), caption, fill=(255, 255, 255), font=font)
    return picture


def main() -> None:
    picture = Path(sys.argv[1]) if len(sys.argv) > 1 \
        else rviz_picture.ROOT / 'docs/images/residents.png'
    alone = multiprocessing.get_context('spawn')  # a process knows one master
    with tempfile.TemporaryDirectory() as name, \
            ProcessPoolExecutor(1, alone, max_tasks_per_child=1) as pool:
        found = [pool.submit(shown, moment, Path(name) / str(number)).result()
                 for number, moment in enumerate(moments(Path(name)))]
    width, height = found[0].size
    sheet = Image.new('RGB', (2 * width, math.ceil(len(found) / 2) * height))
    for number, each in enumerate(found):
        sheet.paste(each, (number % 2 * width, number // 2 * height))
    sheet.save(picture, optimize=True)
    print(picture)


if __name__ == '__main__':
    main()
