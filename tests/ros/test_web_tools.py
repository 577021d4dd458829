"""The tools of the page of angen web in a real browser, on the built-in building."""
import csv
import math
import subprocess
from io import BytesIO
from pathlib import Path

import pytest
from angen_msgs.msg import Stats
from browser import LIMIT, Page
from gazebo_msgs.srv import GetPhysicsProperties
from geometry_msgs.msg import PoseStamped, Twist
from harness import Angen, Inbox, publisher_of, until
from PIL import Image
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from sensor_msgs.msg import CameraInfo
from std_msgs.msg import String


def test_a_field_flashes_where_the_person_walks(home: Angen, page: Page) -> None:
    page.until('''return [...angen.view.fields.flashes.keys()].some((key) => key.startsWith("pir/"))
        && angen.view.fields.group.children[0].geometry.index.count > 0''')
    page.until('''return [...angen.view.people.all.values()].some(
        ({figure}) => figure.speed > 0.3 && Math.abs(figure.thighs[0].rotation.y) > 0.05)''')


def test_fields_show_beams_and_what_the_lidar_measures(home: Angen, page: Page) -> None:
    page.run('angen.setStorey(null)')
    firing = page.run('return angen.view.fields.state.replaceAll("0", "").length')
    page.press('#layers button', 'Sensor fields')
    page.until('return angen.view.fields.state.replaceAll("0", "").length > arguments[0] + 20',
               firing)
    beam = page.run('return angen.view.fields.all.find((f) => f.kind === "switch")?.count')
    assert beam >= 3  # a triangle at least
    points = page.until('''const cloud = [...angen.view.scans.clouds.values()][0];
        return cloud?.geometry.getAttribute("position").count''')
    assert points > 20
    page.press('#layers button', 'Sensor fields')
    page.until('return angen.view.scans.clouds.size === 0')


@pytest.mark.parametrize('floor', [0, 1])
def test_the_plan_of_each_floor_has_the_elevator_in_its_shaft(page: Page, floor: int) -> None:
    page.run('angen.setView("plan"); angen.setStorey(arguments[0])', floor)
    inside = page.run('''const mark = angen.plan.items.get("elevator/elevator");
        const box = (e) => e.getBoundingClientRect(), plan = box(angen.plan.element);
        const shaft = box(angen.plan.root.querySelector(".shaft")), at = box(mark);
        return shaft.left > plan.left && shaft.right < plan.right && at.left > shaft.left
            && at.right < shaft.right && at.top > shaft.top && at.bottom < shaft.bottom''')
    page.run('angen.setView("3d"); angen.setStorey(null)')
    assert inside


def test_cards_have_the_verbs_of_their_kinds(page: Page) -> None:
    missing = page.run('''const wrong = [], seen = new Set();
        for (const e of angen.home.entities) {
            const verbs = angen.home.kinds[e.kind]?.verbs ?? [];
            if (seen.has(e.kind) || !verbs.length) continue;
            seen.add(e.kind);
            angen.show(e);
            const text = document.querySelector("#card").textContent.toLowerCase();
            for (const verb of verbs) {
                const shown = verb.argument === "floor" ? "floor 0" :
                    verb.name.replace(/([a-z])([A-Z])/g, "$1 $2").toLowerCase();
                if (!text.includes(shown)) wrong.push(`${e.kind} ${verb.name}`);
            }
        }
        angen.card.close();
        return [seen.size, wrong]''')
    assert missing[0] >= 8 and missing[1] == [], missing


EYE = '''const camera = angen.view.viewpoint.camera, way = camera.getWorldDirection(
    camera.position.clone()); return [camera.position.toArray(), way.toArray()]'''


def test_one_sees_what_a_person_and_the_robots_camera_see(page: Page) -> None:
    page.run('angen.setView("3d"); angen.setStorey(null)')
    page.first_view()
    before = page.run(EYE)
    for kind, text, low, high in (('person', 'Through the eyes', 1.4, 1.9),
                                  ('drive', 'Its view', 0.02, 1.0)):
        page.run('angen.show(angen.home.entities.find((e) => e.kind === arguments[0]))', kind)
        page.press('#card button', text)
        frames = page.run('return angen.view.frames')
        page.until('return angen.view.frames > arguments[0]', frames)
        (x, y, z), ahead = page.run(EYE)
        at, floor, yaw = page.run('''const e = angen.view.eyes.entity, home = angen.home;
            const p = Array.from(angen.view.drawn.get(home.linksOf(e.model)[0]) ?? home.place(e));
            return [p, home.roomAt(...p.slice(0, 3)).floor, 2 * Math.atan2(p[5], p[6])]''')
        assert math.dist((x, y), at[:2]) < 0.6 and low < z - floor < high, kind
        assert math.cos(yaw) * ahead[0] + math.sin(yaw) * ahead[1] > 0.8, kind
        if kind == 'drive':
            with Inbox('/turtlebot/camera/rgb/camera_info', CameraInfo) as infos:
                info = infos.wait(lambda _: True, 'the camera')
            high, wide = (math.atan(side / 2 / info.K[0]) for side in (info.height, info.width))
            fov, aspect = page.run('const {camera} = angen.view.viewpoint;'
                                   'return [camera.fov, camera.aspect]')
            assert math.tan(math.radians(fov) / 2) == pytest.approx(
                max(math.tan(high), math.tan(wide) / aspect), rel=0.01)  # all of its picture
        assert page.run('return angen.view.people.seen().length') == (0 if kind == 'person' else 1)
        shown = Image.open(BytesIO(page.driver.get_screenshot_as_png())).convert('RGB')
        assert len(set(shown.crop((50, 150, 650, 650)).resize((60, 50)).getdata())) > 30
        ActionChains(page.driver, duration=0).send_keys(Keys.ESCAPE).perform()
        assert page.run('return document.querySelector("#hint").hidden && '
                        'angen.view.eyes.entity === null && angen.view.walls === "cut"')
        assert page.run(EYE)[0] == pytest.approx(before[0], abs=0.01)
    page.run('angen.show(angen.home.entities.find((e) => e.kind === "person"))')
    page.press('#card button', 'Through the eyes')
    page.press('#leave')
    assert page.run('return angen.view.viewpoint.camera.fov') == 38


def downloaded(folder: Path, pattern: str) -> Path:
    """A new file that is complete."""
    return Path(until(lambda: next((path for path in folder.glob(pattern) if path.stat().st_size
                                    and not [*folder.glob('*.crdownload')]), None), pattern, LIMIT))


def test_pictures_and_videos_are_saved(page: Page, tmp_path_factory: pytest.TempPathFactory
                                       ) -> None:
    folder, size = tmp_path_factory.getbasetemp(), page.run('''const s = document.querySelector(
        "#stage"); return [s.clientWidth, s.clientHeight]''')
    for view in ('3d', 'plan'):
        page.run('angen.setTheme("light"); angen.setView(arguments[0])', view)
        page.press('#picture')
        path = downloaded(folder, 'angen_*.png')
        with Image.open(path) as picture:
            assert list(picture.size) == size
            middle = picture.convert('RGB').crop((150, 60, size[0] - 60, size[1] - 90))
            assert len(set(middle.getdata())) > 30, view
            colors = middle.getcolors(1 << 24) or []
            assert max(count for count, _ in colors) < 0.8 * middle.width * middle.height, view
        path.rename(folder / f'picture_{view}.png')
        page.press('#record')
        page.until('return document.querySelector("#record").ariaPressed === "true"')
        page.until('return angen.recording.bytes > 0')
        page.press('#record')
        page.until('return document.querySelector("#record").ariaPressed === "false"')
        path = downloaded(folder, 'angen_*.webm')
        counted = subprocess.run(
            ['ffprobe', '-v', 'error', '-count_frames', '-show_entries', 'stream=nb_read_frames',
             '-of', 'csv=p=0', str(path)], check=True, stdout=subprocess.PIPE, text=True)
        assert int(counted.stdout.strip(',\n')) > 0, view
        path.unlink()
    page.run('angen.setView("3d")')


def test_a_switch_knows_its_state_by_the_words_of_the_kind(home: Angen, page: Page) -> None:
    home.spawn('beacon', 'model://radio_beacon', 3.5, 4.5, 1.0)
    toggle = '''return [...document.querySelectorAll("#panel .thing, #card .thing")].find(
        (e) => e.textContent.includes("beacon_transmitter"))?.lastChild'''
    page.press('#tab-rooms')
    for word in ('Off', 'On'):  # it sends at first
        button = page.until(f'{toggle}?.textContent === "{word}" && ({toggle[7:]})')
        page.run('arguments[0].click()', button)
    home.delete('beacon')


def test_a_person_is_sent_where_one_clicks(home: Angen, page: Page) -> None:
    page.run('angen.setStorey(0); angen.view.look(true)')
    page.first_view()
    page.run('angen.show(angen.home.entities.find((e) => e.kind === "person"))')
    page.press('#card [data-verb="Stop"]')
    page.press('#card [data-verb="GoTo"]')
    page.run('''const send = angen.home.order.bind(angen.home);
        angen.home.order = async (order) => {
            const answer = await send(order);
            angen.sent = [order.text, answer.ok];
            return answer;
        };''')
    at = page.run('return angen.view.viewpoint.screen([1.5, 4.5, 0.02])')
    page.click(*at)
    page.until('return document.querySelector("#hint").hidden')
    words, accepted = page.until('return angen.sent')
    verb, x, y, floor = words.split()
    assert verb == 'GoTo' and floor == '0' and accepted
    assert (float(x), float(y)) == pytest.approx((1.5, 4.5), abs=0.3)
    page.run('angen.card.close(); angen.setStorey(null)')


def test_the_robot_is_driven_by_keys_and_by_the_stick(home: Angen, page: Page) -> None:
    page.press('#tab-robot')
    with Inbox('/turtlebot/cmd_vel', Twist) as orders:
        ActionChains(page.driver, duration=0).key_down('w').perform()
        orders.wait(lambda twist: twist.linear.x > 0.3, 'an order by a key', LIMIT)
        ActionChains(page.driver, duration=0).key_up('w').perform()
        orders.wait(lambda twist: not twist.linear.x, 'a stop', LIMIT)
        stick = page.driver.find_element('css selector', '.stick')
        page.run('arguments[0].scrollIntoView({block: "center"})', stick)
        drag = ActionChains(page.driver, duration=50)
        drag.move_to_element(stick).click_and_hold().move_by_offset(60, 0).perform()
        orders.wait(lambda twist: twist.angular.z < -1.0, 'an order by the stick', LIMIT)
        ActionChains(page.driver, duration=0).release().perform()
    page.until('return angen.panels.robot.timer === undefined')


def test_a_goal_is_dragged_on_the_robots_map(home: Angen, page: Page) -> None:
    page.press('#tab-robot')
    page.until('return angen.panels.robot.map.scan.length > 20')  # its lidar's

    def drag() -> None:
        canvas = page.driver.find_element('css selector', '.map')
        page.run('arguments[0].scrollIntoView({block: "center"})', canvas)
        actions = ActionChains(page.driver, duration=50)
        actions.move_to_element_with_offset(canvas, 60, 0).click_and_hold()
        actions.move_by_offset(0, -50).release().perform()

    with Inbox('/move_base_simple/goal', PoseStamped) as goals:
        drag()
        goal = goals.wait(lambda goal: True, 'a goal', LIMIT).pose
    assert goal.orientation.z == pytest.approx(0.707, abs=0.1)  # to the north, as it was dragged
    page.until('return angen.goal.pose !== null')


def test_the_robots_camera_is_shown(page: Page) -> None:
    page.press('#tab-robot')
    page.press('#panel button', 'Camera')
    width = page.until('''const image = document.querySelector("img.picture");
        return image?.complete && image.naturalWidth''')
    assert width >= 160
    page.press('#panel button', 'Camera')


def test_plots_of_several_sensors_pause_and_zoom(page: Page) -> None:
    page.press('#tab-sensors')
    for kind, name in (('luminosity', 'kitchen_lux0'), ('temperature', 'kitchen_temperature0')):
        page.run('angen.panels.plots.add(...arguments)', kind, name)
    names = page.run('return angen.panels.plots.shown.map((one) => one.key)')
    if len(names) < 2:
        names = page.run('''for (const row of angen.home.rows.values())
            if (angen.panels.plots.shown.length < 3) angen.panels.plots.add(row.kind, row.name);
            return angen.panels.plots.shown.map((one) => one.key)''')
    assert len(set(names)) >= 2
    page.until('return angen.panels.plots.shown.every((one) => one.plot.data[0].length > 1)')
    last = 'return angen.panels.plots.shown[0].plot.data[0].at(-1)'
    page.press('#panel button', 'Pause plots')
    seen = page.run(last)
    now = page.run('return angen.home.stats.time')
    page.until('return angen.home.stats.time > arguments[0] + 1', now)
    assert page.run(last) == seen
    page.press('#panel button', 'Pause plots')
    page.until(f'{last} > arguments[0]', seen)
    over = page.driver.find_element('css selector', '.plot .u-over')
    page.run('arguments[0].scrollIntoView({block: "center"})', over)
    whole = page.run('const s = angen.panels.plots.shown[0].plot.scales.x; return s.max - s.min')
    drag = ActionChains(page.driver, duration=50)
    drag.move_to_element_with_offset(over, -40, 0).click_and_hold().move_by_offset(60, 0)
    drag.release().perform()
    page.until('const s = angen.panels.plots.shown[0].plot.scales.x; '
               'return s.max - s.min < 0.7 * arguments[0]', whole)


def first_reading(page: Page) -> float:
    """The time of the first reading of a sensor that the server has."""
    return float(page.driver.execute_async_script('''const done = arguments[0];
        fetch("/history.json?kind=luminosity&name=livingroom_lux0&field=illuminance")
            .then((answer) => answer.json()).then(({t}) => done(t[0]))'''))


def test_readings_of_the_whole_run_are_kept(page: Page, tmp_path_factory: pytest.TempPathFactory
                                            ) -> None:
    """The server has them; the page forgets what is older than its plots."""
    kept = page.run('''const { home } = angen, row = (stamp, value) => home.remember({
            kind: "luminosity", name: "old, one", text: "x", stamp, values: [value]});
        for (let i = 0; i < 9000; i++) row(i / 10, i % 7);
        const kept = home.series.get("luminosity/old, one/illuminance");
        home.series.delete("luminosity/old, one/illuminance");
        return kept''')
    assert 3000 <= len(kept['t']) <= 3502 and kept['t'][-1] == 899.9
    page.press('#tab-sensors')
    page.run('angen.panels.plots.add("luminosity", "livingroom_lux0")')
    first = """angen.panels.plots.shown.at(-1).plot.data[0][0]"""
    page.until(f'return {first} > 0')
    page.run('''const s = angen.home.series.get("luminosity/livingroom_lux0/illuminance");
        s.t.splice(0, s.t.length - 1); s.v.splice(0, s.v.length - 1)''')  # as if just opened
    recent = page.until(f'return {first} > arguments[0] && {first}', first_reading(page))
    page.press('#panel button', 'Whole run')
    assert page.until(f'return {first} < arguments[0] && {first}', recent) < recent
    page.press('#panel button', 'Whole run')
    page.until(f'return {first} >= arguments[0]', recent)
    page.press('#panel button', 'CSV')
    folder = tmp_path_factory.getbasetemp()
    path = until(lambda: next((path for path in folder.glob('readings*.csv')
                               if path.stat().st_size), None), 'a table', LIMIT)
    rows = list(csv.DictReader(path.open(newline='')))
    assert min(float(row['time']) for row in rows if row['name'] == 'livingroom_lux0') < recent
    assert len({row['kind'] for row in rows}) > 3
    assert {row['unit'] for row in rows if row['field'] == 'illuminance'} == {'lx'}


def test_costs_are_listed(page: Page) -> None:
    page.press('#tab-costs')
    page.until('''const text = document.querySelector("#panel").textContent;
        return /Physics/.test(text) && /µs|ms/.test(text)
            && document.querySelectorAll("#panel .bar").length > 5''')


def test_events_are_filtered(home: Angen, page: Page) -> None:
    page.press('#tab-events')
    publisher_of('/angen/command', String).publish('lamp/kitchen0 Off')
    page.until('return document.querySelectorAll("#panel .events li").length > 3')
    page.run('''const input = document.querySelector("#panel input");
        input.value = "pir"; input.dispatchEvent(new Event("input"))''')
    assert page.until('''const all = [...document.querySelectorAll("#panel .events li")];
        return all.length > 0 && all.every((e) => e.textContent.includes("pir"))''')


def test_another_scene_leaves_the_clock_and_the_events(home: Angen, page: Page) -> None:
    page.press('#play', '❚❚')
    page.until('return angen.home.stats.paused && angen.home.events.length > 0')
    before = page.run('return [angen.home.scene.number, angen.home.stats.time, '
                      'angen.home.events.length]')
    home.spawn('new_beacon', 'model://radio_beacon', 3.5, 4.5, 1.0)
    page.until('return angen.home.scene.number > arguments[0]', before[0])
    assert page.run('return angen.home.stats.time') == before[1]
    assert page.run('return angen.home.events.length') >= before[2]
    page.press('#play', '▶')
    page.until('return !angen.home.stats.paused')
    home.delete('new_beacon')


def test_the_clock_steps_changes_its_rate_and_resets(home: Angen, page: Page) -> None:
    assert 'seed 1' in page.text('#clock') and '× real time' in page.text('#clock')
    with Inbox('/angen/stats', Stats) as stats:
        page.press('#play', '❚❚')
        stats.wait(lambda message: message.paused, 'a pause', LIMIT)
        before = stats.messages[-1].sim_time.to_sec()
        page.press('#clock button', '+1 s')
        stats.wait(lambda message: message.sim_time.to_sec() == pytest.approx(before + 1.0),
                   'a second more', LIMIT)
        assert home.call('/gazebo/get_physics_properties',
                         GetPhysicsProperties).max_update_rate == 1000.0
        page.run('''const rate = document.querySelector("#rate");
            rate.value = "0"; rate.dispatchEvent(new Event("change"))''')
        until(lambda: home.call('/gazebo/get_physics_properties',
                                GetPhysicsProperties).max_update_rate == 0.0,
              'as fast as possible', LIMIT)
        page.press('#play', '▶')
        stats.wait(lambda message: message.sim_time.to_sec() > before + 2.0,
                   'a running clock', LIMIT)
        late = stats.messages[-1].sim_time.to_sec()
        page.press('#clock button', 'Reset')
        stats.wait(lambda message: message.sim_time.to_sec() < late, 'a reset', LIMIT)
