#!/usr/bin/env python3
"""Draws the pictures of docs/web.md and docs/edit.md that show the pages in chromium.

    ./angen shell
    python3 docs/web_pictures.py [NAME ...]

NAME is live, replay, tower, edit or film; without one it draws all.
"""
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any, Callable, Iterator

import rospy
from geometry_msgs.msg import PoseStamped
from PIL import Image

from angen_apps.web.film import Film, encoder
from angen_tools.common.wait import wait
from angen_tools.live.sandbox import Sandbox

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'tests/ros'))

from browser import Page, free_port  # noqa: E402
from hand import Hand, Place, draw_flat  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402

WIDTH, HEIGHT = 1280, 800
PHONE = 390, 844
LIT = ('kitchen0', 'livingroom0', 'bedroom0')
PLACE, AHEAD = (7.6, 3.2, 0.0), (8.6, 3.2, 0.0)  # of the goal, and where the drag ends
CARRIED = (9.0, 1.2), (7.2, 2.6)  # an armchair, and to where it goes
LIMIT = 180.0  # s; the processor draws
REST = 5.0  # s until changes are drawn
PLAIN = '''if (!angen.view) return;
    angen.view.plain = arguments[0]; angen.view.resize(); angen.view.dirty = true;'''
FILM = 960, 640
STEPS, HOLD = 3, 20  # pictures of a way of the pointer, and of the end
POINTER = '''window.pointer = document.createElement("div");
    pointer.style = `position: fixed; left: -9px; top: -9px; width: 18px; height: 18px; z-index: 9;
        border-radius: 50%; background: #d9480f99; border: 2px solid #fff; pointer-events: none`;
    document.body.append(pointer)'''
HAPPENS = 20.0  # s of the day's plot


@contextmanager
def served(sandbox: Sandbox, size: tuple[int, int], command: str, *words: str
           ) -> Iterator[tuple[Page, str]]:
    """A browser's page of that size, and the address that angen web or angen edit serves."""
    port = free_port()
    sandbox.start(['angen', command, '--port', str(port), *words], command)
    log = sandbox.folder / f'{command}.log'
    wait(lambda: f':{port}/' in log.read_text(), f'angen {command} does not serve', LIMIT)
    with tempfile.TemporaryDirectory() as folder:
        page = Page(Path(folder), *size)
        try:
            resize(page, *size)
            yield page, f'http://127.0.0.1:{port}/'
        finally:
            page.close()


@contextmanager
def page_of(sandbox: Sandbox, size: tuple[int, int], *words: str) -> Iterator[Page]:
    """The page that angen web serves, open."""
    with served(sandbox, size, 'web', *words) as (page, address):
        page.open(address)
        page.run('document.querySelector("#welcome").hidden = true')
        yield page


def save(page: Page, name: str) -> None:
    """A picture of the page at rest, with all pixels."""
    order(page, do='pause')
    time.sleep(REST)
    page.run(PLAIN, False)
    shoot(page, name, REST)
    page.run(PLAIN, True)
    order(page, do='resume')


def order(page: Page, **what: Any) -> None:
    page.driver.execute_async_script('angen.home.order(arguments[0]).then(arguments[1])', what)


def show(page: Page, kind: str, name: str) -> None:
    """The card of a device."""
    page.run('''angen.show(angen.home.entities.find(
        (e) => e.kind === arguments[0] && e.name === arguments[1]))''', kind, name)


def drag_goal(page: Page) -> None:
    """Sets the robot's goal, as a mouse does."""
    page.press('#tab-robot')
    page.run('''const goals = document.querySelector("#panel .goals");
        goals.value = ""; goals.dispatchEvent(new Event("change"))''')  # a place …
    begin, end = (page.run('return angen.view.viewpoint.screen(arguments[0])', at)
                  for at in (PLACE, AHEAD))
    actions = ActionChains(page.driver, duration=200)
    pointer = actions.w3c_actions.pointer_action
    pointer.move_to_location(*map(round, begin))
    pointer.pointer_down()
    pointer.move_to_location(*map(round, end))
    pointer.pointer_up()
    actions.perform()
    page.until('return document.querySelector("#hint").hidden')


def carry(page: Page) -> None:
    """Takes a piece of furniture, and does not put it down."""
    page.press('#carry')
    begin, end = page.run('''const to = angen.plan.root.getScreenCTM();
        return arguments[0].map(([x, y]) => new DOMPoint(x, -y).matrixTransform(to)).map(
            (at) => [at.x, at.y])''', CARRIED)
    mouse(page, 'Pressed', *begin, True)
    mouse(page, 'Moved', *end, True)


def mouse(page: Page, kind: str, x: float, y: float, down: bool = False) -> None:
    """An event of the mouse: Moved, Pressed or Released, while the button is down or not."""
    page.driver.execute_cdp_cmd('Input.dispatchMouseEvent', {
        'type': f'mouse{kind}', 'x': x, 'y': y, 'clickCount': int(kind != 'Moved'),
        'button': 'left' if down or kind != 'Moved' else 'none', 'buttons': int(down)})


def live(sandbox: Sandbox) -> None:
    """The lower floor with a goal; both floors in the dark, with a plot; the plan on a phone."""
    sandbox.node(ROOT / 'worlds/angen.world', 1.0)
    rospy.init_node('pictures')
    rospy.Subscriber('/move_base_simple/goal', PoseStamped, lambda _: None)
    with page_of(sandbox, (WIDTH, HEIGHT)) as page:
        page.run('angen.setTheme("light"); angen.setStorey(0)')
        for lamp in LIT:
            order(page, do='command', target=f'lamp/{lamp}', text='On')
        page.first_view()
        drag_goal(page)
        page.press('#tab-rooms')
        show(page, 'lamp', 'kitchen0')
        page.until('return angen.home.rows.get("luminosity/livingroom_lux0").values[0] > 20')
        save(page, 'web')
        page.run('angen.card.close(); angen.goal.put(null); angen.setTheme("dark");'
                 'angen.setStorey(null)')
        page.press('#tab-sensors')
        order(page, do='command', target='lamp/kitchen0', text='Off')
        page.run('angen.panels.plots.add("luminosity", "kitchen_lux0")')
        time.sleep(HAPPENS / 2)
        for lamp in ('kitchen0', 'kitchen1', 'entrance1', 'workroom1'):
            order(page, do='command', target=f'lamp/{lamp}', text='On')
        time.sleep(HAPPENS / 2)
        save(page, 'web_dark')
    with page_of(sandbox, (WIDTH, HEIGHT)) as page:
        page.run('angen.setTheme("light"); angen.setStorey(0); angen.setView("plan")')
        carry(page)
        save(page, 'web_move')
    with page_of(sandbox, PHONE) as page:
        page.run('angen.setTheme("light"); angen.setStorey(0)')
        show(page, 'lamp', 'kitchen0')
        save(page, 'web_phone')


def replay(sandbox: Sandbox) -> None:
    """A generated day."""
    day = sandbox.folder / 'day'
    subprocess.run(['angen', 'generate', '--days', '1', '--seed', '7', '--out', str(day)],
                   check=True, stdout=subprocess.DEVNULL)
    with page_of(sandbox, (WIDTH, HEIGHT), '--replay', str(day)) as page:
        page.run('angen.setTheme("light")')
        page.until('return angen.player.loaded >= 86400')
        page.run('angen.player.playing = false; angen.player.seek(9.6361 * 3600)')
        page.first_view()
        save(page, 'web_replay')


def tower(sandbox: Sandbox) -> None:
    """Ten floors."""
    world = sandbox.folder / 'tower.world'
    subprocess.run(['angen', 'world', 'home', '--floors', '10', '--apartments', '5', '--rooms',
                    '5', '--sensors', 'seed', '-o', str(world)], check=True,
                   stdout=subprocess.DEVNULL)
    sandbox.node(world, 1.0)
    with page_of(sandbox, (WIDTH, HEIGHT)) as page:
        page.run('angen.setTheme("light")')
        page.first_view()
        save(page, 'web_tower')


def resize(page: Page, wide: int, high: int) -> None:
    page.driver.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {
        'width': wide, 'height': high, 'deviceScaleFactor': 1, 'mobile': False})


@contextmanager
def empty_lot(sandbox: Sandbox, wide: int, high: int) -> Iterator[Page]:
    """The page that angen edit serves, open."""
    with served(sandbox, (wide, high), 'edit', str(sandbox.folder / 'home.world')
                ) as (page, address):
        page.driver.get(address)
        page.until('return !!window.angen?.history')
        page.run('document.documentElement.dataset.theme = "light"')
        yield page


def edit(sandbox: Sandbox) -> None:
    """The tutorial's apartment, drawn by hand; then on a phone."""
    with empty_lot(sandbox, WIDTH, HEIGHT) as page:
        draw_flat(Hand(page))
        for name, (wide, high) in (('edit', (WIDTH, HEIGHT)), ('edit_phone', PHONE)):
            resize(page, wide, high)
            page.run('angen.select(["sensors/1"]); angen.board.whole()')
            page.until('return angen.kept && !angen.asking && !angen.stale')
            time.sleep(1.0)
            shoot(page, name)
            if name == 'edit':
                edit_more(page)


class Filmed(Hand):
    """A hand whose ways are seen: a picture at each step of its pointer."""

    def __init__(self, page: Page, put: Callable[[bytes], None]) -> None:
        super().__init__(page)
        self._put, self._at = put, (0.0, 0.0)
        page.run(POINTER)

    def _go(self, to: Place, down: bool = False) -> None:
        (x, y), (u, v) = self._at, to
        for step in range(1, STEPS + 1):
            self._at = x + (u - x) * step / STEPS, y + (v - y) * step / STEPS
            mouse(self.page, 'Moved', *self._at, down)
            self._take()

    def _take(self) -> None:
        self.page.run('pointer.style.translate = `${arguments[0]}px ${arguments[1]}px`', *self._at)
        self._put(self.page.driver.get_screenshot_as_png())

    def drag(self, *places: Place) -> None:
        first, *others = self.page.run(
            'return arguments[0].map((at) => angen.board.screen(at))', places)
        self._go(first)
        mouse(self.page, 'Pressed', *first, True)
        for place in others:
            self._go(place, True)
        mouse(self.page, 'Released', *self._at)
        self._take()

    press = drag

    def button(self, selector: str) -> None:
        self._go(self.page.run('''const shown = document.querySelector(arguments[0]);
            shown.scrollIntoView({block: "nearest"});
            const {left, top, width, height} = shown.getBoundingClientRect();
            return [left + width / 2, top + height / 2]''', selector))
        super().button(selector)

    def keys(self, *keys: str) -> None:
        for key in keys:
            super().keys(key)
            self._take()


def film(sandbox: Sandbox) -> None:
    """The tutorial's apartment while it is drawn."""
    path, wide, high = ROOT / 'docs/images/edit.gif', *FILM
    with empty_lot(sandbox, wide, high) as page:
        with encoder(Film(path, None, 0.0, None, FILM, 'plan')) as put:
            hand = Filmed(page, put)
            draw_flat(hand)
            hand.button('[title^="The whole home"]')
            for _ in range(HOLD):
                hand._take()
    print(path, f'{path.stat().st_size / 1e6:.2f} MB', flush=True)


def edit_more(page: Page) -> None:
    """What sensors see while one is aimed, the day of a person, and a second floor."""
    page.run('angen.select([]); angen.board.use({name: "put", list: "sensors", of: '
             'angen.catalog.sensors[0]}); angen.board.inside = true; angen.board.at = [7.8, 3.2];'
             'angen.board.draw()')
    page.until('return angen.tried && !angen.asking && !angen.stale')
    shoot(page, 'edit_coverage')
    page.run('angen.board.use({name: "select"}); angen.select(["movers/0"]);'
             'angen.dayPlan.open("movers/0")')
    shoot(page, 'edit_day')
    page.run('angen.dayPlan.open(""); angen.select([])')
    page.press('#floor-add')
    page.press('#dialog button', 'the walls of the one below')
    page.run('angen.board.zoom(0.7)')
    Hand(page).put('elevator', (-1.2, 4.5))
    page.run('angen.board.whole()')
    page.until('return angen.kept && !angen.asking && !angen.stale')
    shoot(page, 'edit_floors')
    page.run('angen.undo(); angen.undo()')


def shoot(page: Page, name: str, rest: float = 0.5) -> None:
    """A picture of the page as it is in `rest` s."""
    time.sleep(rest)
    shown = Image.open(BytesIO(page.driver.get_screenshot_as_png())).convert('RGB')
    path = ROOT / f'docs/images/{name}.png'
    shown.save(path, optimize=True)
    print(path, flush=True)


def main(names: list[str]) -> None:
    for make in (live, replay, tower, edit, film):
        if not names or make.__name__ in names:
            with tempfile.TemporaryDirectory() as folder, Sandbox(Path(folder)) as sandbox:
                make(sandbox)


if __name__ == '__main__':
    main(sys.argv[1:])
