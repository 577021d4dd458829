"""angen web --replay without ROS: of a generated day residents, leaves and sensors are as its files
say."""
import asyncio
import gzip
import itertools
import json
import math
import os
from pathlib import Path
from typing import Any, Iterator

import pytest
from aiohttp import ClientSession, WSMsgType
from browser import LIMIT, Page, Server
from harness import SCRIPT, WORLD, Cli, Master, end
from selenium.webdriver.common.action_chains import ActionChains

from angen_apps.data.generate import sha256
from angen_apps.data.site import apartment

MISSING = ('rospy', 'rosgraph', 'genpy', 'std_msgs', 'angen_msgs')
TRUTH = '''start,end,resident,activity,cause,phase,room,thing,posture,x,y,note
0.000,100.000,anna,sleep,scheduled,does,bedroom0,bedroom_bed0,lie,1.990,8.450,
100.000,110.000,anna,wash,free,goes,bedroom0,,stand,1.990,8.450,
110.000,200.000,anna,wash,free,does,bathroom0,bathroom_washbasin0,stand,4.900,7.000,
200.000,86400.000,anna,work,scheduled,away,,,stand,nan,nan,
0.000,86400.000,bert,sleep,scheduled,does,bedroom0,bedroom_bed0,lie,1.210,8.450,
'''
TRACK = 'time,resident,x,y,storey\n101.0,anna,2.500,8.450,0\n102.0,anna,2.500,7.450,0\n'
LOADS = '''time,kind,device,watts
0.000,lamp,bathroom0,0.000
150.000,lamp,bathroom0,10.000
155.000,appliance,workroom_stereo0,0.500
160.000,appliance,livingroom_tv0,73.200
170.000,appliance,livingroom_tv0,0.500
190.000,lamp,bathroom0,0.000
'''
EVENTS = '''time,sensor,kind,room,value,resident,activity,cause
2026-03-21 00:01:41.000000,D001,door,bathroom0,OPEN,anna,wash,hand
2026-03-21 00:01:45.000000,D001,door,bathroom0,CLOSE,anna,wash,hand
2026-03-21 00:05:00.000000,T001,temperature,bathroom0,19.5,,,air
'''
PLACE = {'room': 'bathroom0', 'x': 5.0, 'y': 7.0, 'z': 2.0}
SENSORS = [{'id': 'D001', 'kind': 'door', 'name': 'bathroom0_contact', **PLACE},
           {'id': 'T001', 'kind': 'temperature', 'name': 'bathroom0_temperature', **PLACE}]


@pytest.fixture
def day(tmp_path: Path) -> Path:
    folder = tmp_path / 'out'
    folder.mkdir()
    for name, text in (('truth', TRUTH), ('track', TRACK), ('events', EVENTS), ('loads', LOADS)):
        with gzip.open(folder / f'{name}.csv.gz', 'wt', encoding='utf-8') as file:
            file.write(text)
    (folder / 'layout.json').write_text(json.dumps({
        'start': '2026-03-21T00:00:00', 'days': 1, 'sensors': SENSORS, 'rooms': [], 'doors': [],
        'things': [],
        'residents': [{'name': name, 'profile': 'worker', 'speed': 1.0}
                      for name in ('anna', 'bert')]}))
    (folder / 'home.json').write_text(json.dumps({'settings': {
        'world': '', 'seed': 1, 'own_sensors': False, 'light': False, 'formats': []}, 'files': {}}))
    return folder


async def played(port: int, end: float = 86400.0) -> tuple[dict[str, Any], list[Any]]:
    """The parts and the entries of a time line, once it is whole, and the scene."""
    url, found, entries = f'http://127.0.0.1:{port}', dict[str, Any](), list[Any]()
    async with ClientSession() as session:
        async with session.ws_connect(f'{url}/socket', headers={'Origin': url},
                                      max_msg_size=0) as socket:
            while found.get('line', {}).get('loaded') != end or 'entities' not in found:
                message = await socket.receive(timeout=LIMIT)
                assert message.type == WSMsgType.TEXT, message
                parts = json.loads(message.data)
                entries += parts.pop('timeline', [])
                found.update(parts)
        async with session.get(f'{url}/scene.json') as answer:
            found['scene'] = await answer.json()
    return found, entries


class Bare:
    """The environment of a wheel: no module of ROS can be imported."""

    def __init__(self, folder: Path) -> None:
        self.environment = dict(os.environ, PYTHONPATH=f'{folder}:{os.environ["PYTHONPATH"]}')
        for name in MISSING:
            (folder / f'{name}.py').write_text(f'raise ModuleNotFoundError(name="{name}")\n')


class BareServer(Server):
    """Without a node."""

    program = [str(SCRIPT), 'web']


@pytest.fixture
def bare(tmp_path: Path) -> Bare:
    (tmp_path / 'bare').mkdir()
    return Bare(tmp_path / 'bare')


@pytest.fixture
def server(bare: Bare, tmp_path: Path, day: Path) -> Iterator[Server]:
    with BareServer(bare, tmp_path, '--replay', str(day)) as started:
        yield started


def test_a_day_is_played(server: Server) -> None:
    found, entries = asyncio.run(played(server.port))
    assert (found['line']['begin'], found['line']['speed']) == (70.0, 20.0)  # anna gets up at 100 s
    scene = found['scene']
    ids = {f'{link["model"]}::{link["name"]}': number
           for number, link in zip(scene['ids'], scene['links'])}

    def poses(model: str) -> list[tuple[float, list[float]]]:
        links = {number for name, number in ids.items() if name.startswith(f'{model}::')}
        return [(e[1], e[3][:7]) for e in entries if e[0] == 'p' and links & set(e[2])]

    anna = {time: pose for time, pose in poses('anna')}
    assert anna[110.0][:2] == [4.9, 7.0] and anna[200.0][:2] == [4.9, 7.0]  # away: as it was
    assert math.hypot(anna[0.0][0] - 1.99, anna[0.0][1] - 8.45) < 0.7  # on the bed's place
    ahead = 2 * math.atan2(anna[102.0][5], anna[102.0][6])
    assert ahead == pytest.approx(-math.pi / 2, abs=0.01)  # the way from the step before
    door = next(e['model'] for e in found['entities'] if (e['kind'], e['name']) == (
        'door', 'bathroom0'))
    turns = {time: 2 * math.atan2(pose[5], pose[6]) for time, pose in poses(door)}
    assert abs(turns[101.0] - turns[0.0]) == pytest.approx(1.57, abs=0.05)
    assert turns[105.0] == pytest.approx(turns[0.0], abs=1e-3)
    rows = [e[2:] for e in entries if e[0] == 'r']
    assert [(row[2], row[4]) for row in rows if row[:2] == ['person', 'anna']][1:] == [
        ('lying · sleep', 0.0), ('walking · wash', 100.0), ('standing · wash', 110.0),
        ('away · work', 200.0)]
    assert [row[2] for row in rows if row[1] == 'bathroom0_temperature'][-1] == '19.5 °C'
    assert [row[2] for row in rows if row[1] == 'bathroom0_temperature'][0] == ''  # none before
    assert [row[2] for row in rows if row[1] == 'bathroom0_contact'][0] != ''
    assert {row[2] for row in rows if row[0] == 'stove'} == {''}  # not in the files
    light = scene['light_ids'][next(i for i, one in enumerate(scene['lights'])
                                    if one['model'] == 'bathroom_lamp0')]
    assert [(e[1], e[3]) for e in entries if e[0] == 'l' and light in e[2]] == [
        (0.0, [0.0]), (150.0, [1.0]), (190.0, [0.0])]
    assert [row[2] for row in rows if row[:2] == ['lamp', 'bathroom0']][1:] == [
        'OFF 0 W', 'ON 10 W', 'OFF 0 W']
    assert [row[2] for row in rows if row[:2] == ['appliance', 'livingroom_tv0']][-2:] == [
        'ON 73.2 W', 'OFF 0.5 W']  # on standby
    assert [row[2] for row in rows if row[1] == 'workroom_stereo0'][-1] == 'OFF 0.5 W'
    assert found['line']['ribbon'] == [['anna', [
        [0.0, 100.0, 'sleep'], [100.0, 110.0, 'wash'], [110.0, 200.0, 'wash'],
        [200.0, 86400.0, 'work']]], ['bert', [[0.0, 86400.0, 'sleep']]]]
    assert found['home']['start'] == '2026-03-21T00:00:00'


def test_a_cabin_rides_with_who_is_in_it(bare: Bare, tmp_path: Path, day: Path) -> None:
    world = tmp_path / 'lift.world'
    apartment(world)
    world.write_text(world.read_text().replace('</world>', '''<include>
        <uri>model://elevator</uri><name>lift</name><pose>30 0 0 0 0 0</pose></include></world>'''))
    settings = json.loads((day / 'home.json').read_text())
    settings['settings']['world'] = sha256(world)
    (day / 'home.json').write_text(json.dumps(settings))
    with gzip.open(day / 'cabins.csv.gz', 'wt', encoding='utf-8') as file:
        file.write('time,model,link,x,y,z\n0.000,lift,cabin,30.0,0.0,0.0\n'
                   '50.500,lift,cabin,30.0,0.0,1.5\n51.000,lift,cabin,30.0,0.0,2.0\n')
    with gzip.open(day / 'track.csv.gz', 'wt', encoding='utf-8') as file:
        file.write(f'{TRACK}40.0,anna,30.2,0.0,0\n60.0,anna,20.0,0.0,0\n')
    with BareServer(bare, tmp_path, '--replay', str(day), str(world)) as server:
        found, entries = asyncio.run(played(server.port))
    scene = found['scene']
    cabin = next(number for number, link in zip(scene['ids'], scene['links'])
                 if (link['model'], link['name']) == ('lift', 'cabin'))
    rides = [(e[1], e[3][2]) for e in entries if e[0] == 'p' and cabin in e[2] and e[1] > 0.0]
    assert rides == [(50.5, 1.5), (51.0, 2.0)]
    assert [(e[4], e[1]) for e in entries if e[0] == 'r' and e[2] == 'elevator'][-3:] == [
        ('IDLE  0.00 m', 0.0), ('UP  1.50 m', 50.5), ('IDLE  2.00 m', 51.0)]
    anna = scene['ids'][[link['model'] for link in scene['links']].index('anna')]
    heights = {e[1]: e[3][e[2].index(anna) * 7 + 2] for e in entries
               if e[0] == 'p' and anna in e[2]}
    floor = heights[40.0]
    assert [heights[time] - floor for time in (50.5, 51.0, 60.0)] == pytest.approx([1.5, 2.0, 0.0])


def test_a_recording_without_duration_shows_its_moment(master: Master, bare: Bare,
                                                       tmp_path: Path) -> None:
    (tmp_path / 'small.world').write_text(WORLD)
    log = tmp_path / 'run.log'
    assert end(master.node(tmp_path / 'small.world', tmp_path / 'node', record=log,
                           paused=True)) == 0
    with BareServer(bare, tmp_path, '--replay', str(log)) as server:
        found, _ = asyncio.run(asyncio.wait_for(played(server.port, 0.0), LIMIT))
    assert {e['name'] for e in found['entities']} >= {'bathroom0', 'kitchen0', 'eye'}
    assert {link['model'] for link in found['scene']['links']} >= {'turtlebot'}


def apart(page: Page, selector: str) -> int:
    """The number of visible elements, of which none covers another."""
    boxes = page.run('''return [...document.querySelectorAll(arguments[0])].filter(
        (e) => getComputedStyle(e).visibility === "visible").map((e) => e.getBoundingClientRect())
        .filter((r) => r.width).map((r) => [r.left, r.right, r.top, r.bottom])''', selector)
    for (a, b, c, d), (e, f, g, h) in itertools.combinations(boxes, 2):
        assert b <= e or f <= a or d <= g or h <= c, boxes
    return len(boxes)


def test_a_link_opens_at_its_time(server: Server, tmp_path: Path) -> None:
    with Page(tmp_path, 500, 400) as page:  # opened before the day is read
        page.driver.get(f'{server.url}?t=105')
        page.until('return window.angen?.player.loaded === 86400')
        page.until('return angen.home.rows.get("person/anna")?.text.endsWith("· wash")')
        assert page.run('return angen.player.time') >= 105
        lit = 'return angen.plan.items.get("room/bathroom0").classList.contains("lit")'
        assert not page.run(lit)
        page.run('angen.player.seek(155)')
        assert page.until(lit)
        page.run('angen.player.playing = false; angen.player.seek(155.5); angen.player.next()')
        assert page.run('return angen.player.time') == 160  # of the next event
        page.run('angen.player.seek(195)')
        page.until(lit.replace('return ', 'return !'))
        assert page.run('return document.querySelector("#player").scrollWidth') <= 500
        page.run('document.querySelector("#replay").focus()')
        ActionChains(page.driver, duration=0).send_keys(' ').perform()
        assert page.run('return angen.player.playing')
        page.run('angen.player.seek(angen.player.end)')
        page.press('#replay')  # from the beginning
        assert page.run('return angen.player.playing && angen.player.time < 1000')
        card = '''angen.show(angen.home.entities.find((e) => e.kind === arguments[0]));
            return document.querySelector("#card .state").textContent'''
        assert page.run(card, 'stove') == 'The recording does not have it.'
        page.run('angen.player.playing = false; angen.player.seek(50)')
        assert page.run(card, 'temperature') == 'no reading yet'
        page.run('''angen.home.take({access: {
            role: "build", may: null, reason: "", tokens: {build: "secret"}}})''')
        page.press('#player button', 'Link')
        assert page.run('return location.search') == '?t=50.0&token=secret'
        page.run('angen.card.close()')
        assert apart(page, '#plan .who') == 2  # both in one bed
        page.press('#view-3d')
        page.first_view()
        assert apart(page, '.label.person') == 2
        page.driver.get(server.url)  # it begins where one gets up
        page.until('return window.angen?.player.time > 70 && angen.player.speed === 20')
        assert page.run('return document.querySelector("#player select").value') == '20'


def test_a_day_is_filmed_to_its_end(bare: Bare, tmp_path: Path, day: Path) -> None:
    path = tmp_path / 'day.gif'
    done = Cli(bare).run('web', '--replay', str(day), '--video', str(path), '--start', '23:59:50',
                         '--size', '320x240', '--view', 'plan')
    assert done.returncode == 0, done.stderr
    assert '0.5 s from 86390.0 s on, 20 times as fast, 320 x 240' in done.stdout
    assert 'frame 5 of 5' in done.stderr and path.stat().st_size > 1000


def test_folders_without_a_day_are_rejected(bare: Bare, tmp_path: Path, day: Path) -> None:
    cli = Cli(bare)
    empty = tmp_path / 'empty'
    empty.mkdir()
    assert 'has no data of angen generate' in cli.fails('web', '--replay', str(empty))
    settings = json.loads((day / 'home.json').read_text())
    settings['settings']['world'] = 'f' * 64
    (day / 'home.json').write_text(json.dumps(settings))
    assert 'give the same file, too' in cli.fails('web', '--replay', str(day))
    assert 'web needs ROS (the Python module ros' in cli.fails('web')
