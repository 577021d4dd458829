"""The page of angen web in a real browser, on a real node."""
import concurrent.futures
import subprocess
import time
import urllib.error
import urllib.request
from pathlib import Path
from typing import Iterator

import numpy as np
import pytest
from angen_msgs.msg import DoorState, LampState
from browser import LIMIT, Page, Server
from geometry_msgs.msg import Twist, Vector3
from harness import Angen, Cli, Inbox, Master, end, publisher_of
from selenium.webdriver.common.action_chains import ActionChains

LONG = 'x' * 200
WORLD = f'''<?xml version="1.0"?>
<sdf version="1.6" xmlns:angen="angen"><world name="home">
  <angen:storey name="&lt;img src=x onerror=alert(2)&gt;" number="0">
    <angen:elevation>0</angen:elevation><angen:height>2.7</angen:height></angen:storey>
  <angen:room name="kitchen0"><angen:use>kitchen</angen:use>
    <angen:polygon>-4 0  4 0  4 6  -4 6</angen:polygon></angen:room>
  <angen:room name="hall0"><angen:use>hall</angen:use>
    <angen:polygon>-4 -4  4 -4  4 0  -4 0</angen:polygon></angen:room>
  <angen:room name="&lt;img src=x onerror=alert(1)&gt;">
    <angen:polygon>-4 -5  -1 -5  -1 -4  -4 -4</angen:polygon></angen:room>
  <angen:room name="__proto__">
    <angen:polygon>-1 -5  2 -5  2 -4  -1 -4</angen:polygon></angen:room>
  <angen:room name="a/b 'c' &quot;d&quot; \u53a8\u623f $x^2${LONG}">
    <angen:polygon>2 -5  4 -5  4 -4  2 -4</angen:polygon></angen:room>
  <model name="ground"><static>true</static><link name="link">
    <collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
    <visual name="v"><geometry><plane><normal>0 0 1</normal></plane></geometry></visual>
  </link></model>
  <include><uri>model://bathroom_door</uri><name>bathroom_door0</name>
    <pose>0 0 0.02 0 0 0</pose></include>
  <include><uri>model://ceiling_lamp</uri><name>kitchen_lamp0</name>
    <pose>0 3 2.5 0 0 0</pose></include>
  <include><uri>model://luminosity_sensor</uri><name>kitchen_lux0</name>
    <pose>0 3 1 0 -1.5708 0</pose></include>
  <include><uri>model://turtlebot</uri><pose>-2 -3 0.01 0 0 0</pose></include>
  <plugin name="doors" filename="libdoor_world_plugin.so"/>
  <plugin name="robots" filename="librobot_controller.so"><wheelSeparation>0.23</wheelSeparation>
    <wheelDiameter>0.0704</wheelDiameter></plugin>
</world></sdf>
'''
HOSTILE = '<img src=x onerror=alert(1)>'
DOOR, LAMP = 'bathroom0', 'kitchen0'


@pytest.fixture(scope='module')
def home(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
         ) -> Iterator[Angen]:
    """A node with two rooms."""
    folder = tmp_path_factory.mktemp('home')
    (folder / 'home.world').write_text(WORLD)
    node = Angen(master, master.node(folder / 'home.world', folder / 'log'), folder / 'log')
    yield node
    end(node.process)


@pytest.fixture(scope='module')
def server(home: Angen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    with Server(home.master, tmp_path_factory.mktemp('web')) as started:
        yield started


@pytest.fixture(scope='module')
def page(server: Server, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with Page(tmp_path_factory.mktemp('browser'), 900, 600) as opened:
        opened.open(server.url)
        yield opened


def place(page: Page, model: str) -> list[float]:
    """The middle of the largest moving part of a model on the screen."""
    page.first_view()
    return page.until('''const {home, view} = angen, links = home.linksOf(arguments[0]);
        const parts = home.scene.shapes.filter((s) => links.includes(s.link));
        parts.sort((a, b) => b.size[0] * b.size[2] - a.size[0] * a.size[2]);
        const p = home.pose(parts[0].link), l = parts[0].pose;
        const yaw = 2 * Math.atan2(p[5], p[6]), c = Math.cos(yaw), s = Math.sin(yaw);
        return view.viewpoint.screen(
            [p[0] + c * l[0] - s * l[1], p[1] + s * l[0] + c * l[1], p[2] + l[2]])''', model)


def test_a_door_that_is_clicked_in_3d_opens(home: Angen, page: Page) -> None:
    page.until('return document.querySelector("#panel").textContent.includes("Door bathroom0")')
    assert page.run('return !!angen.view && angen.view.renderer.getContext().isContextLost()'
                    ) is False
    page.click(*place(page, 'bathroom_door0'))
    page.until('return document.querySelector("#card h2")?.textContent === arguments[0]', DOOR)
    assert 'CLOSED' in page.text('#card .state')
    with Inbox(f'/angen/door/{DOOR}', DoorState) as states:
        page.press('#card [data-verb="Open"]')
        states.wait(lambda state: state.mode == DoorState.OPEN, 'an open door', LIMIT)
    page.until('return document.querySelector("#card .state").textContent.startsWith("OPEN")')
    leaf = page.run('''return angen.home.linksOf("bathroom_door0").map((l) => angen.home.pose(l))
        .some((p) => Math.abs(2 * Math.atan2(p[5], p[6])) > 1.4)''')
    assert leaf  # its leaf is seen open


def test_light_is_seen_in_its_sensors_plot(home: Angen, page: Page) -> None:
    page.run('angen.panels.open("sensors"); angen.panels.plots.add("luminosity", "kitchen_lux0")')
    page.until('return document.querySelectorAll(".plot canvas").length === 1')
    page.run('angen.show(angen.home.entities.find((e) => e.kind === "lamp"))')
    page.press('#card [data-verb="On"]')
    rise = page.until('''const all = [...angen.home.series].find(
        ([key]) => key.startsWith("luminosity/kitchen_lux0/illuminance"));
        const v = all?.[1].v ?? []; return v.length > 1 && v[v.length - 1] - v[0] > 5 && v''')
    page.until('''const shown = angen.panels.plots.shown[0].plot.data[1].at(-1);
        return Math.abs(shown - arguments[0]) < 0.2 * arguments[0]''', rise[-1])
    assert page.until('return angen.view.glows.meshes.get("kitchen0").visible')
    assert not page.run('return angen.view.glows.meshes.get("hall0").visible')


def test_an_order_waits_for_a_connection_that_comes_back(home: Angen, page: Page) -> None:
    answer = page.driver.execute_async_script('''angen.home.connection.socket.close();
        angen.home.order({do: "command", target: "lamp/kitchen0", text: "On"}).then(
            arguments[0])''')
    assert answer['ok'], answer


def test_hostile_names_are_text(home: Angen, page: Page) -> None:
    home.spawn(HOSTILE, 'model://pir', 1.0, -1.0, 2.0)
    page.until('return angen.home.entities.some((e) => e.name === arguments[0])', HOSTILE)
    page.run('angen.panels.open("sensors")')
    page.until('return document.querySelector("#panel").textContent.includes(arguments[0])',
               HOSTILE)
    page.run('angen.show(angen.home.entities.find((e) => e.name === arguments[0]))', HOSTILE)
    assert page.text('#card h2') == HOSTILE
    page.run('angen.panels.open("rooms")')
    shown = page.text('#panel')
    for room in page.run('return angen.home.rooms.map((room) => room.name)'):
        assert room.rstrip('0').replace('_', ' ').strip().lower() in shown.replace('_', ' ').lower()
    assert page.run('return document.querySelectorAll("img[src=x]").length') == 0
    home.delete(HOSTILE)


def test_robot_is_driven_and_stops_without_the_page(home: Angen, page: Page) -> None:
    before = page.until('''const e = angen.home.entities.find((e) => e.kind === "drive");
        return Array.from(angen.home.place(e)).slice(0, 2)''')
    page.run('''angen.panels.open("robot");
        angen.panels.robot.steer(0.3, 0)''')
    page.until('''const e = angen.home.entities.find((e) => e.kind === "drive");
        const p = angen.home.place(e); return Math.hypot(p[0] - arguments[0], p[1] - arguments[1])
        > 0.05''', *before)
    page.run('clearInterval(angen.panels.robot.timer)')  # it sends no more, as a page that ended
    page.until('return /\\b0\\.00 m\\/s/.test(angen.home.rows.get("drive/turtlebot").text)')
    page.run('angen.panels.open("rooms")')


def test_a_phone_shows_a_plan_to_tap(home: Angen, server: Server, page: Page) -> None:
    page.driver.set_window_size(390, 844)
    page.open(server.url)
    assert page.run('return document.querySelector("#scene").hidden')
    box = page.until('''const e = document.querySelector("#plan > svg g.lamp .face")
        ?.getBoundingClientRect(); return e && [e.x + e.width / 2, e.y + e.height / 2]''')
    names = page.run('return [...document.querySelectorAll("#plan svg > text")].map('
                     '(e) => e.textContent)')
    assert 'Kitchen' in names and max(map(len, names)) < 40  # of a name of 200 letters
    near = page.run('return angen.plan.hit(arguments[0] + 12, arguments[1]).entity.name', *box)
    assert near == LAMP  # a target of 24 px, the least of WCAG 2.2
    leaf = page.run('return document.querySelector("#plan > svg .door .leaf").getTotalLength()')
    assert leaf == pytest.approx(0.99, abs=0.02)  # m, as wide as its door
    page.click(*box)
    with Inbox(f'/angen/lamp/{LAMP}', LampState) as states:
        page.press('#card [data-verb="Off"]')
        states.wait(lambda state: not state.on, 'a dark lamp', LIMIT)
    page.until('return !document.querySelector("#plan > svg g.lamp").classList.contains("on")')
    page.press('#view-3d')
    page.first_view()
    across = page.run('''return angen.home.rooms.flatMap((r) => r.polygon.map(
        ([x, y]) => angen.view.viewpoint.screen([x, y, r.floor])[0]))''')
    assert 0 <= min(across) and max(across) <= 390  # the whole home, on the narrow screen
    page.press('#view-plan')


def test_a_sensor_is_added_where_one_taps_and_deleted(home: Angen, page: Page) -> None:
    page.press('#card [aria-label="Close"]')
    at = page.until('''const r = document.querySelector("#plan svg path").getBoundingClientRect();
        return [r.x + 0.3 * r.width, r.y + 0.6 * r.height]''')
    page.click(*at)
    page.press('#add')
    found = page.until('return angen.home.entities.find((e) => e.kind === "pir")')
    assert found['name'] == 'kitchen0_pir_1' and found['pose'][2] == pytest.approx(1.2, abs=0.1)
    page.run('angen.show(angen.home.entities.find((e) => e.kind === "pir"))')
    page.press('#card button', 'Delete')
    page.until('return !angen.home.entities.some((e) => e.kind === "pir")')


def test_a_browser_without_webgl_has_the_plan(server: Server, page: Page) -> None:
    script = page.driver.execute_cdp_cmd('Page.addScriptToEvaluateOnNewDocument', {'source': '''
        const get = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
            return kind.startsWith("webgl") ? null : get.call(this, kind, ...more); };'''})
    page.open(server.url)
    page.until('return document.querySelectorAll("#plan g.item").length > 0')
    assert 'WebGL' in page.run('''const e = document.querySelector("#view-3d");
        return e.disabled && e.title''')
    ActionChains(page.driver, duration=0).send_keys('v').perform()  # the key of 3D or plan
    assert page.run('return document.querySelector("#scene").hidden && !angen.plan.hidden')
    page.driver.execute_cdp_cmd('Page.removeScriptToEvaluateOnNewDocument', script)
    page.errors()  # of three.js
    page.open(server.url)


def status(url: str, **headers: str) -> int:
    try:
        request = urllib.request.Request(url, headers=headers)
        with urllib.request.urlopen(request, timeout=LIMIT) as answer:
            return int(answer.status)
    except urllib.error.HTTPError as error:
        return error.code


def test_the_running_building_is_filmed(home: Angen, tmp_path: Path) -> None:
    path, cli = tmp_path / 'now.mp4', Cli(home.master)
    with concurrent.futures.ThreadPoolExecutor() as pool:
        film = pool.submit(cli.run, 'web', '--video', str(path), '--seconds', '1', '--speed', '4',
                           '--size', '320x240', '--view', 'plan')
        turn = Twist(linear=Vector3(x=0.1), angular=Vector3(z=0.5))
        while not film.done():
            publisher_of('/turtlebot/cmd_vel', Twist).publish(turn)
            time.sleep(0.1)
        publisher_of('/turtlebot/cmd_vel', Twist).publish(Twist())
        done = film.result()
    assert done.returncode == 0, done.stderr
    assert 'records the running building' in done.stderr and '4 times as fast' in done.stdout
    raw = subprocess.run(['ffmpeg', '-loglevel', 'error', '-i', str(path), '-f', 'rawvideo',
                          '-pix_fmt', 'gray', '-'], check=True, stdout=subprocess.PIPE).stdout
    frames = np.frombuffer(raw, np.uint8).reshape(-1, 240, 320).astype(int)
    assert len(frames) == 25
    assert np.abs(frames[0, 40:] - frames[-1, 40:]).max() > 50  # below the clock: the robot drives


def test_a_film_needs_a_building_that_runs(home: Angen, tmp_path: Path) -> None:
    path = str(tmp_path / 'a.mp4')
    with Master(tmp_path) as alone:
        assert 'no simulator runs' in Cli(alone).fails('web', '--video', path)
    with home.paused():
        assert 'paused' in Cli(home.master).fails('web', '--video', path)


def test_strangers_are_rejected(home: Angen, server: Server, tmp_path: Path) -> None:
    assert status(server.url) == 200
    assert status(server.url, Origin='http://evil.example') == 403
    assert status(server.url, Host='evil.example') == 403
    with Server(home.master, tmp_path, '--host', '0.0.0.0') as away:
        assert status(f'http://127.0.0.1:{away.port}/?token=wrong') == 401


def test_the_page_survives_its_node(home: Angen, page: Page, tmp_path: Path) -> None:
    end(home.process)
    page.until('return document.querySelector("#status").textContent'
               ' === "Waiting for the simulator"')
    (tmp_path / 'home.world').write_text(WORLD)
    home.process = home.master.node(tmp_path / 'home.world', tmp_path / 'log')
    page.until('return document.querySelector("#status").textContent === "Live"')
    page.until('return [...angen.home.rows.values()].some((row) => row.kind === "door")')
    with home.paused():
        page.until('return angen.home.stats.paused')
