"""The plan of the page of angen web, touched as people do: real events at real places."""
import io
import random
import re
from collections import Counter
from typing import Any

import numpy as np
import pytest
from actionlib_msgs.msg import GoalID, GoalStatus, GoalStatusArray
from browser import LIMIT, Page
from gazebo_msgs.srv import GetModelState
from geometry_msgs.msg import PoseStamped
from harness import Angen, Inbox, publisher_of, until
from PIL import Image
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.interaction import POINTER_MOUSE, POINTER_TOUCH
from selenium.webdriver.common.actions.pointer_input import PointerInput
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select
from std_srvs.srv import Empty

from angen_apps.plan.symbols import SYMBOLS

TAPS = 200
SIZES = {POINTER_MOUSE: (1100, 800), POINTER_TOUCH: (390, 844)}
AT = '''const m = angen.plan.root.getScreenCTM(), at = (x, y) => {
    const p = new DOMPoint(x, -y).matrixTransform(m); return [p.x, p.y]; };'''
NOBODY_IN_A_DOORWAY = '''const {home} = angen, place = (e) => home.place(e).slice(0, 2);
    const people = home.entities.filter((e) => e.kind === "person").map(place);
    const doors = home.entities.filter((e) => e.kind === "door").map(place);
    return people.every(([x, y]) => doors.every(([u, v]) => Math.hypot(x - u, y - v) > 1));'''


@pytest.fixture(scope='module', autouse=True)
def first(page: Page) -> dict[str, Any]:
    """The first view; then the plan."""
    page.run('localStorage.clear()')
    page.driver.refresh()
    page.until('return window.angen?.begun && angen.view.frames > 2')
    seen: dict[str, Any] = page.run('''const view = angen.view; return {
        storey: angen.storey, says: document.querySelector("#welcome").textContent,
        ratio: view.renderer.getPixelRatio(),
        people: angen.home.movers.filter((e) => e.kind === "person").length}''')
    ActionChains(page.driver, duration=0).send_keys(Keys.TAB, Keys.ENTER, Keys.TAB).perform()
    seen['skips'] = page.run('return !!document.activeElement.closest("#panel")')
    page.press('#view-plan')
    page.run('angen.setStorey(0)')
    return seen


def resize(page: Page, kind: str) -> None:
    """The window of a kind of pointer, once the page is laid out for it."""
    page.driver.set_window_size(*SIZES[kind])
    page.driver.execute_async_script(
        'requestAnimationFrame(() => requestAnimationFrame(arguments[0]))')


def tap(page: Page, kind: str, places: list[list[float]]) -> None:
    """Presses and releases at places of the window, by mouse or touch."""
    pointer = PointerInput(kind, kind)
    builder = ActionBuilder(page.driver, mouse=pointer, duration=0)
    for x, y in places:
        pointer.create_pointer_move(0, round(x), round(y))
        pointer.create_pointer_down(button=0)
        pointer.create_pointer_up(0)
    builder.perform()


def drag(page: Page, kind: str, begin: list[float], end: list[float]) -> None:
    """Drags from a place of the window to another, by mouse or touch."""
    pointer = PointerInput(kind, kind)
    builder = ActionBuilder(page.driver, mouse=pointer, duration=20)
    pointer.create_pointer_move(0, *map(round, begin))
    pointer.create_pointer_down(button=0)
    for part in (0.3, 0.6, 1.0):
        pointer.create_pointer_move(20, *(round(a + part * (b - a)) for a, b in zip(begin, end)))
    pointer.create_pointer_up(0)
    builder.perform()


def picture(page: Page) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(page.driver.get_screenshot_as_png())).convert('L'))


def test_the_first_view_is_sharp_and_on_the_floor_with_people(first: dict[str, Any]) -> None:
    assert first['people'] == 1 and first['storey'] == 0
    assert first['ratio'] == 1  # all pixels, while the person walks
    assert 'lamp' in first['says'] and 'drag the robot to another room' in first['says']


def test_the_lists_are_two_tabs_away(first: dict[str, Any]) -> None:
    assert first['skips']


def test_sensors_are_listed_and_small_changes_are_not(page: Page) -> None:
    page.press('#tab-sensors')
    kinds = page.until('''return [...document.querySelectorAll("#panel tbody tr")].length
        && [...new Set([...angen.panels.lines.keys()].map((key) => angen.home.kinds[
            key.split("/")[0]].role))]''')
    assert kinds == ['sensor']
    page.press('#tab-events')
    page.run('angen.home.take({events: [[1, "luminosity", "lux0", "changed", "5 lx"], '
             '[2, "pir", "eye", "motion", ""]]}); angen.panels.refreshEvents()')
    assert 'eye' in page.text('.events') and 'lux0' not in page.text('.events')
    page.press('#panel .tools input[type=checkbox]')
    assert 'lux0' in page.text('.events')


def test_the_plan_has_the_symbols_of_angen_plan_and_a_legend(page: Page) -> None:
    drawn = page.run('''
        const at = (name) => angen.home.described.things.find((t) => t.type === name);
        return ["bed", "sofa", "stove"].map((name) => at(name)
            && angen.plan.thing(at(name))[1].getAttribute("d").split("M").length - 1)''')
    assert drawn == [len(SYMBOLS[name]) for name in ('bed', 'sofa', 'stove')]
    legend = page.text('#plan .legend')
    assert all(word in legend for word in ('Door', 'Lamp', 'Cabinet', 'Person', 'Robot', 'Sensor'))
    shapes = page.run('''return ["lamp", "cabinet", "sensor"].map((name) =>
        document.querySelector(`#plan > svg g.${name} .face`).tagName)''')
    assert len(set(shapes)) == 3


def test_a_click_leaves_the_rest_of_the_plan_as_it_was(home: Angen, page: Page) -> None:
    home.call('/gazebo/pause_physics', Empty)
    page.until('return angen.home.stats.paused')
    x, y = page.run(f'''{AT} const e = angen.home.entities.find((e) => e.kind === "lamp"
        && e.name === "livingroom0"); return at(...angen.home.place(e).slice(0, 2))''')
    before = picture(page)
    tap(page, POINTER_MOUSE, [[x, y]])
    page.until('return document.querySelector("#card h2")?.textContent === "livingroom0"')
    assert page.run('const e = document.activeElement; return [e.getAttribute("class"), '
                    'getComputedStyle(e).outlineStyle]') == ['item lamp', 'none']
    left, right, top, bottom = page.run('''const p = angen.plan.element.getBoundingClientRect();
        const c = document.querySelector("#card").getBoundingClientRect();
        return [p.left, c.left, p.top, p.bottom].map(Math.round)''')
    changed = np.abs(picture(page).astype(int) - before) > 40
    around = changed[top:bottom, left:right].copy()
    around[max(0, round(y) - top - 30):round(y) - top + 30, round(x) - left - 30:round(x) - left
           + 30] = False
    assert around.mean() < 0.02  # but for the mark itself, and a field that fades
    home.call('/gazebo/unpause_physics', Empty)
    page.run('angen.card.close()')


@pytest.mark.parametrize('kind', SIZES)
def test_taps_on_doors_hit_doors(home: Angen, page: Page, kind: str) -> None:
    resize(page, kind)
    rng = random.Random(kind)
    hits: Counter[str] = Counter()
    for state in ('Close', 'Open'):
        home.command('door/all', state)
        page.until('''return angen.home.entities.filter((e) => e.kind === "door"
            && angen.home.row(e).text.startsWith(arguments[0])).length > 7''', state.upper())
        page.until(NOBODY_IN_A_DOORWAY)  # who stands on a leaf is what a tap there means
        home.call('/gazebo/pause_physics', Empty)
        page.until('return angen.home.stats.paused')
        page.run('angen.plan.update()')
        for floor in (0, 1):
            page.run('angen.setStorey(arguments[0])', floor)
            places = page.run('''
                const all = [...document.querySelectorAll("#plan > svg .door .leaf")];
                return arguments[0].map(([i, part]) => {
                    const l = all[Math.floor(i * all.length)];
                    const p = l.getPointAtLength(part * l.getTotalLength());
                    const at = p.matrixTransform(l.getScreenCTM()); return [at.x, at.y]; })''',
                              [[rng.random(), rng.random()] for _ in range(TAPS // 4)])
            page.run('angen.hits = []; angen.show = (e) => angen.hits.push(e.kind); '
                     'angen.place = () => angen.hits.push("floor")')
            tap(page, kind, places)
            hits.update(page.run('return angen.hits'))
            page.run('delete angen.show; delete angen.place')
        home.call('/gazebo/unpause_physics', Empty)
    assert hits == {'door': TAPS}


@pytest.mark.parametrize('kind', SIZES)
def test_what_is_near_a_tap_is_found_and_a_room_in_the_open(home: Angen, page: Page, kind: str
                                                            ) -> None:
    home.call('/gazebo/pause_physics', Empty)  # the person would walk to where nobody was
    page.until('return angen.home.stats.paused')
    resize(page, kind)
    page.run('angen.setStorey(0); angen.card.close()')
    lamp, (x, y) = page.run(f'''{AT} const {{home}} = angen;
        const place = (e) => home.place(e).slice(0, 2);
        const away = ([x, y], [u, v]) => Math.hypot(x - u, y - v);
        const lamp = home.entities.find((e) => e.kind === "lamp" && e.name.endsWith("room0")
            && home.movers.every((one) => away(place(one), place(e)) > 2));
        return [lamp.name, at(...place(lamp))]''')
    found = []
    for away in (0, 15):
        tap(page, kind, [[x + away, y]])
        found.append(page.until('return document.querySelector("#card h2")?.textContent'))
        page.run('angen.card.close()')
    assert found == [lamp, lamp]
    free = page.run(f'''{AT} const pixel = (x, y) => at(x, y).map(Math.round);
        for (const r of angen.home.rooms.filter((r) => r.storey === 0))
        for (let x = r.polygon[0][0] - 6; x < r.polygon[0][0] + 6; x += 0.1)
            for (let y = r.polygon[0][1] - 6; y < r.polygon[0][1] + 6; y += 0.1)
                if ([-0.1, 0.1].every((d) => angen.home.roomAt(x + d, y + d, 0.1) === r)
                    && !angen.plan.hit(...pixel(x, y)).entity)
                    return [r.name, ...pixel(x, y)]''')
    tap(page, kind, [free[1:]])
    assert page.until('return angen.card.shown?.room?.name') == free[0]
    page.run('angen.card.close()')
    home.call('/gazebo/unpause_physics', Empty)


PLACE = 'return [...angen.carry.pose(arguments[0])].slice(0, 2)'


def place(home: Angen, model: str) -> tuple[float, float]:
    at = home.call('/gazebo/get_model_state', GetModelState, model_name=model).pose.position
    return at.x, at.y


def pinch(page: Page, *steps: list[list[float]]) -> None:
    """Two fingers, at these places one after the other."""
    for i, places in enumerate([*steps, []]):
        page.driver.execute_cdp_cmd('Input.dispatchTouchEvent', {
            'type': 'touchMove' if 0 < i < len(steps) else 'touchEnd' if i else 'touchStart',
            'touchPoints': [{'x': x, 'y': y, 'id': n} for n, (x, y) in enumerate(places)]})


@pytest.mark.parametrize('kind', SIZES)
def test_the_plan_is_zoomed_and_moved(page: Page, kind: str) -> None:
    resize(page, kind)
    page.run('angen.setStorey(0); angen.card.close()')
    names = 'return [...document.querySelectorAll("#plan svg > text")].length'
    count = page.run(names)
    x, y = map(round, page.run(f'{AT} return at(8.4, 6.4)'))  # far from the robot
    place = page.run('return angen.plan.ground(...arguments).slice(0, 2)', x, y)
    where = f'{AT} return at({place[0]}, {place[1]})'
    if kind == POINTER_MOUSE:
        for _ in range(3):
            page.driver.execute_cdp_cmd('Input.dispatchMouseEvent', {
                'type': 'mouseWheel', 'x': x, 'y': y, 'deltaX': 0, 'deltaY': -200})
    else:
        pinch(page, *([[x, y - far], [x, y + far]] for far in (20, 40, 60, 90)))
    page.until('return angen.plan.zoom.times > 4 && !angen.plan.stale')
    assert page.run(where) == pytest.approx([x, y], abs=1.0)
    drag(page, kind, [x, y], [x - 60, y + 40])
    assert page.run(where) == pytest.approx([x - 60, y + 40], abs=1.0)
    assert page.run('return document.querySelector("#card").hidden')
    tap(page, kind, [page.run(where)])
    page.until('return angen.card.shown?.room?.name === "workroom0"')
    page.run('angen.card.close(); document.activeElement.blur()')
    ActionChains(page.driver, duration=0).send_keys('h').perform()
    page.until('return angen.plan.zoom.times === 1 && !angen.plan.stale')
    assert page.run(where) == pytest.approx([x, y], abs=1.0) and page.run(names) == count


@pytest.mark.parametrize('kind, by', [(POINTER_MOUSE, (1.0, 0.8)), (POINTER_TOUCH, (-0.6, 0.4))])
def test_sensors_and_furniture_are_carried_elsewhere(home: Angen, page: Page, kind: str,
                                                     by: tuple[float, float]) -> None:
    resize(page, kind)
    page.run('angen.setStorey(0)')
    page.press('#carry')
    for model, far in (('kitchen_pir0_a', by), ('kitchen_chair0_a', (0.4, -0.3))):
        x, y = page.run(PLACE, model)
        begin, end = page.run(f'{AT} const [x, y, dx, dy] = arguments;'
                              'return [at(x, y), at(x + dx, y + dy)]', x, y, *far)
        drag(page, kind, begin, end)
        page.until('const [x, y] = angen.carry.pose(arguments[0]);'
                   'return Math.hypot(x - arguments[1], y - arguments[2]) < 0.15', model,
                   x + far[0], y + far[1])
        until(lambda: place(home, model) == pytest.approx(page.run(PLACE, model), abs=0.02),
              f'{model} where the page shows it')
    told = home.call('/gazebo/get_model_state', GetModelState, model_name='kitchen_pir0_a').pose
    page.until('const e = angen.home.entities.find((e) => e.name === "kitchen_pir0_a");'
               'return Math.abs(e.pose[0] - arguments[0]) < 0.01', told.position.x)
    mark = page.run('''return angen.plan.items.get("pir/kitchen_pir0_a").getAttribute(
        "transform")''')
    drawn = re.findall(r'-?[\d.]+', mark)
    assert float(drawn[0]) == pytest.approx(told.position.x, abs=0.01)  # it is drawn there
    saved = page.run('return angen.home.order({do: "save"}).then((answer) => answer.xml)')
    pose = re.search(r'kitchen_pir0_a.*?<pose[^>]*>\s*(\S+) (\S+) ', saved, re.DOTALL)
    assert pose is not None
    assert [float(word) for word in pose.groups()] == pytest.approx(
        [told.position.x, told.position.y], abs=0.01)
    page.press('#carry')


def test_a_thing_is_carried_by_keys(page: Page) -> None:
    resize(page, POINTER_MOUSE)
    page.run('document.activeElement.blur()')
    ActionChains(page.driver, duration=0).send_keys('m', '.').perform()
    model, (x, y) = page.run('return [angen.carry.held.model, '
                             '[...angen.carry.held.pose].slice(0, 2)]')
    assert model.replace('_', ' ') in page.text('#hint')
    ActionChains(page.driver, duration=0).send_keys(
        *[Keys.ARROW_RIGHT] * 3, Keys.ARROW_UP, 'r', Keys.ENTER).perform()
    page.until('const [x, y] = angen.carry.pose(arguments[0]);'
               'return Math.hypot(x - arguments[1], y - arguments[2]) < 0.02', model, x + 0.3,
               y + 0.1)
    ActionChains(page.driver, duration=0).send_keys('m').perform()
    assert page.run('return [angen.carry.on, document.querySelector("#hint").hidden]') == [
        False, True]


@pytest.mark.parametrize('kind', SIZES)
def test_a_robot_is_dragged_to_its_goal_on_the_plan(page: Page, kind: str) -> None:
    resize(page, kind)
    page.run('angen.setStorey(0); angen.card.close()')
    begin, end = page.run(f'''{AT} const e = angen.home.entities.find((e) => e.kind === "drive");
        const [x, y] = angen.home.place(e); return [at(x, y), at(x + 1, y)]''')
    to = page.run('return angen.plan.ground(...arguments)', *map(round, end))
    with Inbox('/move_base_simple/goal', PoseStamped) as goals:
        page.until('return angen.home.entities.length > 0')
        drag(page, kind, begin, end)
        goal = goals.wait(lambda goal: True, 'a goal', LIMIT).pose
    assert (goal.position.x, goal.position.y) == pytest.approx(to[:2], abs=0.1)
    page.until('return document.querySelector("#card h2")?.textContent === "turtlebot"')
    page.until('return document.querySelector(".trip [role=status]")'
               '?.textContent.startsWith("To ")')
    page.run('angen.card.close()')


def test_move_base_says_what_becomes_of_a_goal(page: Page) -> None:
    status = publisher_of('/move_base/status', GoalStatusArray)

    def told(goal: str, state: int, text: str = '') -> str:
        """What the card says once a status of the goal has come."""
        before = page.text('.trip [role=status]')
        message = GoalStatusArray(status_list=[
            GoalStatus(goal_id=GoalID(id=goal), status=state, text=text)])
        return str(until(lambda: (status.publish(message), page.text('.trip [role=status]'))[1]
                         != before and page.text('.trip [role=status]'), 'another text', LIMIT))

    with Inbox('/move_base_simple/goal', PoseStamped) as goals:
        page.run('angen.show(angen.home.entities.find((e) => e.kind === "drive"));'
                 'angen.home.order({do: "goal", name: "turtlebot", x: 2, y: 5, floor: 0, yaw: 0})')
        goals.wait(lambda goal: goal.pose.position.x == 2, 'a goal', LIMIT)
        page.until('return angen.home.trips.turtlebot.goal === "2.00, 5.00"')
        assert told('first', GoalStatus.ACTIVE) == 'To 2.00, 5.00: drives'
        with Inbox('/move_base/cancel', GoalID) as cancels:
            page.press('#card .trip button', 'Stop')
            cancels.wait(lambda goal: True, 'a cancel', LIMIT)
        page.until('return !angen.home.trips.turtlebot.drives')
        page.run('angen.home.order({do: "goal", name: "turtlebot", room: "kitchen0"})')
        goal = goals.wait(lambda goal: goal.pose.position.x != 2, 'a goal in the room', LIMIT)
        assert page.run('return angen.home.roomAt(...arguments, 0.5).name', goal.pose.position.x,
                        goal.pose.position.y) == 'kitchen0'
        page.until('return angen.home.trips.turtlebot.goal === "kitchen0"')
        said = told('second', GoalStatus.ABORTED, 'no valid plan')
        assert said == 'To kitchen0: gave up: no valid plan'
    page.run('angen.card.close()')


def ended(page: Page) -> str:
    """What became of a drive."""
    page.until('return !angen.home.trips.turtlebot.drives')
    return page.text('.trip [role=status]')


def test_a_robot_is_dragged_and_arrives_or_says_why_not(page: Page) -> None:
    page.driver.set_window_size(*SIZES[POINTER_MOUSE])
    begin, end = page.run(f'''{AT} const e = angen.home.entities.find((e) => e.kind === "drive");
        const [x, y] = angen.home.place(e); angen.card.close(); return [at(x, y), at(2.5, 5)]''')
    drag(page, POINTER_MOUSE, begin, end)
    goal = page.until('return angen.home.trips.turtlebot?.goal.includes(",") '
                      '&& angen.home.trips.turtlebot.goal')
    assert ended(page).startswith(f'To {goal}: turtlebot is in ')
    x, y = page.run('return [...angen.home.place(angen.card.shown.entity)].slice(0, 2)')
    assert (x, y) == pytest.approx([float(word) for word in goal.split(',')], abs=0.2)
    page.run('angen.home.order({do: "goal", name: "turtlebot", x: 50, y: 50, floor: 0, yaw: 0})')
    page.until('return angen.home.trips.turtlebot.goal.startsWith("50")')
    assert 'no floor there' in ended(page)


def test_a_robot_is_sent_to_a_room_and_stopped(page: Page) -> None:
    page.run('angen.show(angen.home.entities.find((e) => e.kind === "drive"))')
    menu = Select(page.driver.find_element('css selector', '#card .goals'))
    menu.select_by_value('kitchen0')
    page.until('return angen.home.trips.turtlebot?.share > 0')
    assert page.run('return document.querySelector("#card .bar i").getBoundingClientRect().width')
    page.press('#card .trip button', 'Stop')
    assert ended(page) == 'To kitchen0: stopped'
    page.until('return Math.abs(angen.home.row(angen.card.shown.entity).values[3]) < 0.02')
    assert page.run('return document.querySelector("#card .trip button").hidden')


COVERED = '''const find = (what) => [...document.querySelectorAll(what)].filter(
        (e) => e.checkVisibility()).map((e) => [e.id || e.textContent || e.getAttribute("class"),
            e.getBoundingClientRect()]);
    const controls = find("#floors button, #layers > *, #plan .legend, #hint, #welcome");
    const within = document.querySelector("#stage").getBoundingClientRect();
    const beyond = ([, a]) => a.left < within.left || a.right > within.right;
    const cover = ([, a], [, b]) => a.left < b.right - 1 && b.left < a.right - 1
        && a.top < b.bottom - 1 && b.top < a.bottom - 1;
    const drawn = find("#plan :is(.item:not(.person, .robot), .room-shape)");
    return controls.filter(beyond).concat(controls.flatMap((one, i) => controls.slice(i + 1)
        .concat(drawn).filter((other) => cover(one, other)).map((other) => [one[0], other[0]])))'''


@pytest.mark.parametrize('language', ['en', 'de'])
def test_nothing_covers_the_controls_of_a_phone_across(page: Page, language: str) -> None:
    try:
        page.driver.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {
            'width': 844, 'height': 390, 'deviceScaleFactor': 1, 'mobile': True})
        page.driver.get(f'{page.run("return location.origin")}/?lang={language}')
        page.until('return window.angen?.begun && angen.view.frames > 0')
        page.press('#view-plan')
        page.run('angen.setStorey(0)')
        page.until('return document.querySelectorAll("#plan .legend").length === 1')
        assert page.run('return document.querySelectorAll("#floors button").length') > 1
        assert page.run('return document.documentElement.lang') == language
        assert page.run(COVERED) == []
    finally:
        page.driver.execute_cdp_cmd('Emulation.clearDeviceMetricsOverride', {})
