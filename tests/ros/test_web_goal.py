"""The goal of a robot, set in 3D and by keys in a real browser; sensors added and deleted in 3D."""
import math
from typing import Iterator

import pytest
from browser import LIMIT, Page
from geometry_msgs.msg import PoseStamped
from harness import Angen, Inbox, until
from selenium.webdriver.common.action_chains import ActionChains


@pytest.fixture(scope='module', autouse=True)
def lower_floor(page: Page) -> None:
    page.run('angen.setStorey(0)')
    page.first_view()


@pytest.fixture(scope='module')
def goals(home: Angen, page: Page) -> Iterator[Inbox]:
    with Inbox('/move_base_simple/goal', PoseStamped) as inbox:
        yield inbox


def drag(page: Page, begin: list[float], to: list[float]) -> None:
    """Drags from a place of the home to another, as a mouse does."""
    points = [[round(v) for v in page.run('return angen.view.viewpoint.screen(arguments[0])', at)]
              for at in (begin, to)]
    actions = ActionChains(page.driver, duration=50)
    pointer = actions.w3c_actions.pointer_action
    pointer.move_to_location(*points[0])
    pointer.pointer_down()
    pointer.move_to_location(*[(a + b) // 2 for a, b in zip(*points)])
    pointer.move_to_location(*points[1])
    pointer.pointer_up()
    actions.perform()


def published(goals: Inbox, act: object) -> tuple[float, float, float]:
    """Place and heading of the goal that an action publishes."""
    before = len(goals.messages)
    assert callable(act)
    act()
    pose = until(lambda: goals.messages[before:], 'a goal', LIMIT)[-1].pose
    return (pose.position.x, pose.position.y, 2 * math.atan2(pose.orientation.z,
                                                             pose.orientation.w))


def near(x: float, y: float, yaw: float) -> object:
    return pytest.approx((x, y, yaw), abs=0.15)


def seen(page: Page) -> list[float]:
    """The camera's place."""
    return page.run('return angen.view.viewpoint.camera.position.toArray()')


def begin(page: Page) -> None:
    page.press('#tab-robot')
    page.run('''const goals = document.querySelector("#panel .goals");
        goals.value = ""; goals.dispatchEvent(new Event("change"))''')  # a place …
    assert page.run('return !document.querySelector("#hint").hidden')


@pytest.mark.parametrize('above', [True, False])
def test_a_goal_is_dragged_on_the_floor_in_3d(page: Page, goals: Inbox, above: bool) -> None:
    page.run('angen.view.look(arguments[0])', above)
    page.first_view()
    camera = seen(page)
    begin(page)
    goal = published(goals, lambda: drag(page, [1.5, 4.5, 0.0], [1.5, 6.0, 0.0]))
    assert goal == near(1.5, 4.5, math.pi / 2)
    assert seen(page) == pytest.approx(camera, abs=1e-6)  # the view does not turn with it
    assert page.run('return document.querySelector("#hint").hidden')
    assert page.run('return document.querySelector("#welcome").hidden')  # one has done something
    shown = page.run('''return angen.view.scene.children.filter((e) => e.visible).some((e) =>
        Math.hypot(e.position.x - arguments[0], e.position.y - arguments[1]) < 0.01
        && Math.abs(e.rotation.z - arguments[2]) < 0.01)''', *goal)
    assert shown  # its arrow
    drag(page, [1.5, 4.5, 0.0], [2.5, 4.5, 0.0])
    assert seen(page) != pytest.approx(camera, abs=0.05)  # without the tool it turns as ever


def test_a_robot_is_dragged_to_its_goal(page: Page, goals: Inbox) -> None:
    page.run('angen.card.close(); angen.view.look(true)')
    page.first_view()
    at = page.run('''const e = angen.home.entities.find((e) => e.kind === "drive");
        return Array.from(angen.home.place(e)).slice(0, 2)''')
    top = [*at, 0.3]
    goal = published(goals, lambda: drag(page, top, [at[0] + 1.0, at[1] + 1.0, 0.0]))
    assert goal == pytest.approx((at[0] + 1.0, at[1] + 1.0, math.pi / 4), abs=0.2)
    page.click(*page.run('return angen.view.viewpoint.screen(arguments[0])', top))
    page.until('return document.querySelector("#card h2")?.textContent === "turtlebot"')
    page.run('angen.card.close()')


@pytest.mark.parametrize('view', ['3d', 'plan'])
def test_a_goal_is_set_by_keys(page: Page, goals: Inbox, view: str) -> None:
    page.press(f'#view-{view}')
    before = page.run('''const e = angen.home.entities.find((e) => e.kind === "drive");
        return Array.from(angen.home.place(e))''')
    yaw = 2 * math.atan2(before[5], before[6])
    begin(page)
    keys = ActionChains(page.driver, duration=0)
    for key in ('\ue014', '\ue014', '\ue013'):  # right, right, up
        keys.send_keys(key)
    keys.key_down('\ue008').send_keys('\ue012').key_up('\ue008').send_keys('\ue007')
    goal = published(goals, keys.perform)
    turn = math.remainder(goal[2] - yaw - math.radians(15), math.tau)
    assert goal[:2] == pytest.approx((before[0] + 0.5, before[1] + 0.25), abs=0.05)
    assert turn == pytest.approx(0.0, abs=0.05)
    begin(page)
    ActionChains(page.driver, duration=0).send_keys('\ue00c').perform()  # Esc
    assert page.run('return document.querySelector("#hint").hidden && angen.goal.pose === null')


def test_a_goal_is_dragged_on_the_plan(page: Page, goals: Inbox) -> None:
    page.press('#view-plan')
    begin(page)
    places = page.run('''const m = angen.plan.root.getScreenCTM();
        return [[1.5, 4.5], [0, 4.5]].map(([x, y]) => {
            const p = new DOMPoint(x, -y).matrixTransform(m); return [p.x, p.y]; })''')
    actions = ActionChains(page.driver, duration=50)
    pointer = actions.w3c_actions.pointer_action
    pointer.move_to_location(*map(round, places[0]))
    pointer.pointer_down()
    pointer.move_to_location(*map(round, places[1]))
    pointer.pointer_up()
    x, y, yaw = published(goals, actions.perform)
    assert (x, y) == pytest.approx((1.5, 4.5), abs=0.1)
    assert abs(yaw) == pytest.approx(math.pi, abs=0.1)
    assert page.text('#card h2') == 'turtlebot'  # no room is opened by it
    page.press('#view-3d')


def test_a_sensor_is_added_in_3d_saved_and_deleted(page: Page, tmp_path_factory:
                                                   pytest.TempPathFactory) -> None:
    page.run('angen.setStorey(0); angen.view.look(true)')
    page.first_view()
    name = page.until('''const room = angen.home.roomAt(1.5, 4.5, 0.1);
        return `${room.name}_pir_1`''')
    page.click(*page.run('return angen.view.viewpoint.screen([1.5, 4.5, 0.01])'))
    page.press('#add')
    found = page.until('return angen.home.entities.find((e) => e.name === arguments[0])', name)
    assert found['pose'][:3] == pytest.approx([1.5, 4.5, 1.2], abs=0.2)
    page.press('#tab-sensors')
    page.press('#panel button', 'Save world')
    folder = tmp_path_factory.getbasetemp()
    saved = until(lambda: next((path for path in folder.glob('saved*.world')
                                if path.stat().st_size), None), 'a saved world', LIMIT)
    assert name in saved.read_text()
    page.run('angen.card.close()')
    place = page.until('''const links = angen.home.linksOf(arguments[0]);
        return links.length && Array.from(angen.home.pose(links[0])).slice(0, 3)''',
                       found['model'])
    page.click(*page.run('return angen.view.viewpoint.screen(arguments[0])', place))
    page.until('return document.querySelector("#card h2")?.textContent === arguments[0]', name)
    page.press('#card button', 'Delete')
    page.until('return !angen.home.entities.some((e) => e.name === arguments[0])', name)
