"""The page of angen edit in a real browser: a home is drawn, kept, saved, opened and simulated."""
import json
import subprocess
from pathlib import Path
from typing import Iterator

import angen
import pytest
from browser import LIMIT, Page
from angen_apps.residents.profiles import read
from hand import ROOMS, Hand, draw_flat
from harness import end, free_port, until
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.interaction import POINTER_TOUCH
from selenium.webdriver.common.keys import Keys
from test_web_language import WIDTH, english

MOST = 120  # gestures
NOW = 'return JSON.stringify(angen.history.now)'


class Editor:
    """angen edit of a file, and its page."""

    def __init__(self, path: Path, browser: Path, width: int = 1280, height: int = 800,
                 language: str = 'en') -> None:
        self.path, self._log = path, path.with_suffix('.log')
        self.port = free_port()
        self.start()
        self.page = Page(browser, width, height, language)
        self.open()

    def start(self) -> None:
        with self._log.open('w') as out:
            self.process = subprocess.Popen(
                ['angen', 'edit', str(self.path), '--port', str(self.port)], stdout=out,
                stderr=out)
        until(lambda: self.process.poll() is not None or f':{self.port}/' in self.log(),
              'the address', LIMIT)
        assert self.process.poll() is None, self.log()

    def open(self) -> None:
        self.page.driver.get(f'http://127.0.0.1:{self.port}/')
        self.page.until('return !!window.angen?.history && angen.connected')

    def log(self) -> str:
        return self._log.read_text()

    def storey(self) -> dict[str, list[dict[str, object]]]:
        storey: dict[str, list[dict[str, object]]] = json.loads(
            self.page.run('return JSON.stringify(angen.storey)'))
        return storey

    def close(self) -> None:
        self.page.close()
        assert end(self.process, LIMIT) == 0, self.log()


@pytest.fixture(scope='module')
def editor(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Editor]:
    made = Editor(tmp_path_factory.mktemp('edit') / 'home.world',
                  tmp_path_factory.mktemp('browser'))
    yield made
    made.close()


def test_the_tutorials_flat_is_drawn_and_saved(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    page.until('return document.querySelector("#findings").textContent.includes("Draw a room")')
    draw_flat(hand)
    hand.button('#save')
    page.until('return !angen.dirty && document.querySelector("#status").textContent === "Saved"')
    assert hand.gestures < MOST
    page.until('return !angen.asking && !angen.stale')
    assert 'Nothing is wrong' in page.text('#findings')
    assert page.errors() == []
    world = angen.World(str(editor.path))
    names = {(kind, name) for kind, name, *_ in world.entities()}
    assert {('door', 'bedroom0'), ('lamp', 'kitchen0'), ('pir', 'kitchen_pir0'),
            ('stove', 'kitchen0'),
            ('person', 'person_b'), ('drive', 'robot')} <= names
    rooms = {room['name'] for room in world.home['rooms']}
    assert rooms == {f'{name}0' for name, _ in ROOMS}
    for word in ('check', 'home'):
        subprocess.run(['angen', word, str(editor.path)], check=True, capture_output=True)


def test_all_steps_are_undone_and_done_again(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    last, steps = page.run(NOW), page.run('return angen.history.at')
    page.run('document.querySelector("#board").focus()')
    hand.control(*['z'] * steps)
    assert page.run(NOW) == page.run('return JSON.stringify(angen.history.all[0])')
    assert 'walls' not in editor.storey()
    hand.control(*['y'] * steps)
    assert page.run(NOW) == last


def test_things_are_moved_turned_copied_and_removed_by_keys(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    hand.keys(Keys.ESCAPE)
    before = editor.storey()['pieces']
    hand.press((6.9, 1.2))
    assert page.run('return angen.selection') == ['pieces/3']
    hand.keys(Keys.ARROW_LEFT, Keys.ARROW_UP, 'r')
    bed, old = editor.storey()['pieces'][3], before[3]
    assert (bed['x'], bed['y']) == (pytest.approx(old['x'] - 0.1), pytest.approx(old['y'] + 0.1))
    assert abs(bed['yaw'] - old['yaw']) % 3.1416 == pytest.approx(1.5708, abs=1e-3)
    hand.control('c', 'v')
    assert len(editor.storey()['pieces']) == len(before) + 1
    hand.keys(Keys.DELETE)
    assert len(editor.storey()['pieces']) == len(before)
    hand.control('a')
    hand.keys(Keys.DELETE)
    assert sorted(editor.storey()) == ['elevation', 'height', 'name', 'number']
    hand.control(*'zzzzzz')
    assert editor.storey()['pieces'] == before


def test_a_wall_is_drawn_by_keys_with_its_length(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    count = len(editor.storey()['walls'])
    hand.keys('w')
    page.run('angen.board.at = [10, 0]')
    hand.keys(Keys.ENTER, Keys.ARROW_RIGHT, '2', '.', '3', '5', Keys.ENTER, Keys.ESCAPE, 'v')
    assert editor.storey()['walls'][count:] == [
        {'start': [10, 0], 'end': [12.35, 0], 'thickness': 0.1, 'bottom': 0, 'top': 2.5}]
    hand.control('z')


def test_a_door_goes_to_another_wall_and_turns(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    hand.drag((6, 3), (5, 3.4), (4.02, 1.5))
    door = editor.storey()['openings'][1]
    assert (door['x'], door['y']) == (4, 1.5)
    page.press('#card .verbs button', 'Other hinge')
    page.press('#card .verbs button', 'Other side')
    leaf, old = editor.storey()['openings'][1]['leaves'][0], door['leaves'][0]
    assert leaf['hinge'] == [-old['hinge'][0], -old['hinge'][1]] and leaf['turn'] == old['turn']
    page.run('document.querySelector("#board").focus()')
    hand.control(*'zzz')


def test_a_sensor_is_aimed_with_its_field(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    hand.put('motion sensor', (3, 4), (3, 5))
    sensor = editor.storey()['sensors'][-1]
    assert (sensor['x'], sensor['y'], sensor['yaw']) == (3, 4, pytest.approx(1.5708))
    assert page.run('return document.querySelectorAll("#board .field.chosen").length') == 1
    page.run('document.querySelector("#board").focus()')
    hand.control('z')


def test_what_motion_sensors_see_is_shown_while_one_is_aimed(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    covers = 'return document.querySelectorAll("#board .cover").length'
    hand.keys(Keys.ESCAPE)
    page.run('angen.survey()')
    page.until('return !!angen.told.coverage && !angen.asking && !angen.stale')
    assert page.run(covers) == 0
    before = page.run('return angen.told.coverage.share')
    assert f'{before:.0%}'.replace('%', ' %') in page.text('#findings .seen')
    hand.button('[data-name="motion sensor"]')
    ActionChains(page.driver, duration=0).move_to_element_with_offset(
        page.driver.find_element('id', 'board'), 0, 0).perform()
    page.until('return angen.tried && !angen.asking && !angen.stale')
    assert page.run(covers) == 3
    assert page.run('return angen.told.coverage.share') >= before
    assert page.run('return angen.told.coverage.sensors.length') == 1 + len(
        [sensor for sensor in editor.storey()['sensors'] if 'sensor' not in str(sensor['model'])
         and sensor['model'] != 'camera'])
    hand.keys(Keys.ESCAPE)
    page.until('return !angen.tried && !angen.asking && !angen.stale')
    assert page.run('return angen.told.coverage.share') == before
    hand.keys('c')
    assert page.run(covers) == 3
    hand.keys('c')
    hand.press((7.2, 5.5))  # in sight of the sensor in that corner
    seen = page.text('#card')
    assert 'livingroom_pir0' in seen.partition('fallen')[0]
    hand.keys(Keys.ESCAPE)


def test_a_second_floor_with_an_elevator_is_drawn(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    before = page.run(NOW)
    hand.put('elevator', (-1.2, 4.5))
    assert 'add one first' in page.text('#hint')
    hand.keys(Keys.ESCAPE)
    gestures = hand.gestures
    hand.button('#floor-add')
    page.press('#dialog button', 'the walls of the one below')
    hand.put('elevator', (-1.2, 4.5))
    assert hand.gestures - gestures == 3  # with the answer one more
    assert page.run('return angen.floor') == 1
    assert len(editor.storey()['walls']) == 6
    lift, = editor.storey()['lifts']
    assert (lift['x'], lift['y'], lift['stops']) == (-1.1, 4.5, [0, 1])
    assert page.run('return document.querySelectorAll("#board .wall.below").length') == 6
    page.until('return angen.rooms.length === 3 && !angen.asking && !angen.stale')
    hand.drag((-1.2, 4.5), (-1.2, 4.3), (-1.2, 4.0))
    lift, = editor.storey()['lifts']
    assert (lift['x'], lift['y']) == (-1.1, 4.0)
    last = page.run(NOW)
    page.press('#floors button', 'Ground floor')
    assert page.run('return angen.floor') == 0
    page.run('document.querySelector("#board").focus()')
    hand.control('z')
    assert page.run('return angen.floor') == 1  # where that was done
    hand.control('y')
    assert page.run(NOW) == last
    hand.button('#save')
    page.until('return !angen.dirty')
    world = angen.World(str(editor.path))
    assert [landing['room'] for landing in world.home['elevators'][0]['landings']] == [
        'livingroom0', 'room_c1']
    subprocess.run(['angen', 'check', str(editor.path)], check=True, capture_output=True)
    hand.button('#floor-remove')
    assert 'lifts' not in editor.storey() and page.run('return angen.floor') == 0
    hand.control('zzzz')
    assert page.run(NOW) == before
    hand.button('#save')
    page.until('return !angen.dirty')


def test_the_day_of_a_person_is_changed_and_lived(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    before = page.run(NOW)
    hand.press((5, 4.2))
    hand.button('#day-open')
    block = '#day .block[aria-label^="Cook, eat"]'
    assert page.text(block).startswith('07:07')
    page.run('document.querySelector(arguments[0]).focus()', block)
    hand.keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    assert page.text(block).startswith('07:37')
    element = page.driver.find_element('css selector', block)
    hour = page.run('return document.querySelector("#day .track").clientWidth') / 24
    ActionChains(page.driver, duration=0).drag_and_drop_by_offset(
        element, round(2 * hour), 0).perform()
    movers = editor.storey()['movers']
    who = next(one for one in movers if one.get('day'))
    cook = next(part for part in who['day'] if part['do'][0] == 'cook')
    assert cook['low'] == pytest.approx(6 * 3600 + 55 * 60 + 1800 + 7200, abs=301)
    assert cook['high'] - cook['low'] == 25 * 60
    assert page.run('return document.querySelectorAll("#day .block").length') > 4
    page.run('document.querySelector(arguments[0]).focus()', '#day .block[aria-label*="18:45"]')
    hand.keys(Keys.DELETE)
    dinners = [part['days'] for one in editor.storey()['movers'] for part in one.get('day', ())
               if part['do'][0] == 'cook' and part['low'] == 18.25 * 3600]
    assert dinners == ['weekend']  # those of the days that are not shown stay
    hand.button('#save')
    page.until('return !angen.dirty')
    own, = editor.path.parent.glob('home_person*.yaml')
    assert read(str(own)).scheduled[0].at.low == cook['low']
    listed = editor.path.with_name('home_residents.yaml').read_text()
    assert own.name in listed and 'worker' in listed
    page.run('document.querySelector("#board").focus()')
    hand.control('zzzz')
    assert page.run(NOW) == before
    hand.button('#save')
    page.until('return !angen.dirty')


def test_a_draft_outlives_server_and_page(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page)
    draft = editor.path.with_name('home.world.draft')
    hand.put('plant', (7.5, 3.6))
    page.until('return angen.kept && document.querySelector("#status").textContent'
               '.startsWith("Draft")')
    assert draft.exists()
    hand.control('z')
    page.until('return !angen.kept && document.querySelector("#status").textContent === "Saved"')
    assert not draft.exists()
    hand.put('plant', (7.5, 3.6))
    page.until('return angen.kept')
    assert end(editor.process, LIMIT) == 0
    page.until('return !angen.connected')
    hand.put('plant', (7, 3.6))  # without a server
    last = page.run(NOW)
    editor.start()
    page.until('return angen.connected')
    editor.open()
    assert page.run(NOW) == last
    assert 'not saved' in page.text('#dialog')
    page.press('#dialog button', 'Continue')
    until(lambda: json.loads(draft.read_text())['drawing'] == json.loads(last), 'the draft', LIMIT)


def test_two_windows_are_told(editor: Editor) -> None:
    page = editor.page
    first = page.driver.current_window_handle
    page.driver.switch_to.new_window('window')
    editor.open()
    page.until('return !document.querySelector("#hint").hidden')
    assert 'open in 2 windows' in page.text('#hint')
    version = page.run('document.querySelector("#dialog").close();'
                       'angen.do({home: {sensors: "casas"}}); return angen.version')
    page.until('return angen.version > arguments[0]', version)
    page.driver.close()
    page.driver.switch_to.window(first)
    page.run('angen.do({home: {sensors: "seed"}})')
    page.until('return document.querySelector("#dialog").open')
    assert 'Another window' in page.text('#dialog')
    page.press('#dialog button', 'Keep mine')
    page.until('return angen.kept && !angen.conflict')


@pytest.mark.parametrize('button, ready, script, shown', [
    ('#simulate', '!!angen.home.scene', 'angen.home.rooms.map((room) => room.name).sort()',
     ['bedroom0', 'kitchen0', 'livingroom0']),
    ('#a-day', '!!angen.home.status?.replay',
     'angen.home.entities.filter((e) => e.kind === "person").length', 2)])
def test_the_home_is_shown_live_or_for_a_day(editor: Editor, button: str, ready: str, script: str,
                                             shown: object) -> None:
    """A day is that of angen generate in the home."""
    page = editor.page
    drawing = page.driver.current_window_handle
    page.press(button)
    until(lambda: len(page.driver.window_handles) == 2, 'another window', LIMIT)
    page.driver.switch_to.window(next(
        each for each in page.driver.window_handles if each != drawing))
    page.until(f'return window.angen?.home?.entities?.length > 0 && {ready}')
    assert page.run(f'return {script}') == shown
    page.driver.close()
    page.driver.switch_to.window(drawing)


def test_touch_draws_too(editor: Editor) -> None:
    page, hand = editor.page, Hand(editor.page, POINTER_TOUCH)
    count = len(editor.storey()['walls'])
    hand.button('#tool-wall')
    hand.drag((5, 3.6), (7, 3.6))
    assert len(editor.storey()['walls']) == count + 1
    small = page.run('''return [...document.querySelectorAll("#tools button")].filter(
        (e) => Math.min(e.clientWidth, e.clientHeight) < 42).length''')
    assert small == 0
    assert [error for error in page.errors() if '/do/' not in error] == []  # while it was away


def test_all_of_it_is_german_on_a_phone_too(tmp_path: Path) -> None:
    editor = Editor(tmp_path / 'home.world', tmp_path / 'browser', 1280, 800, 'de')
    page, hand = editor.page, Hand(editor.page)
    try:
        hand.button('#tool-room')
        hand.drag((0, 0), (4, 3))
        hand.put('person', (2, 2))
        hand.put('motion sensor', (0.15, 0.15))
        page.until('return !angen.asking && !angen.stale && angen.kept')
        for show in ('angen.selectRoom([3, 1])', 'angen.select(["walls/0"])',
                     'angen.select(["sensors/0"])',
                     'angen.select(["movers/0"]); angen.dayPlan.open("movers/0")'):
            page.run(show)
            assert english(page) <= {'Kind'}, show  # a child, in German
        assert '06:37 Aufstehen' in page.text('#day') and 'Berufstätig' in page.text('#card')
        page.run('angen.select([])')
        page.run('angen.shelf.search("Kühl")')
        assert page.run('''return [...document.querySelectorAll("#panel .shelf button")].filter(
            (one) => !one.hidden).map((one) => one.dataset.name)''') == ['fridge']
        page.driver.set_window_size(390, 844)
        page.until('return innerWidth < 600')
        page.press('#help')
        assert page.driver.find_element('id', 'language').is_displayed()
        assert english(page) <= {'Kind'}
        width, window, *wide = page.run(WIDTH)
        assert width <= window and not wide
        assert page.errors() == []
    finally:
        editor.close()
