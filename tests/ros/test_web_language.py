"""The page of angen web in German: all that it says by itself, on a phone too."""
import json
from typing import Iterator

import pytest
from browser import ROOT, Page, Server
from harness import Angen
from selenium.webdriver.support.select import Select

GERMAN = json.loads((ROOT / 'src/angen_apps/page/lang/de.json').read_text())
SAID = '''const found = [];
    for (const e of document.querySelectorAll("body *")) {
        for (const name of ["title", "aria-label", "alt", "placeholder"]) {
            if (e.hasAttribute(name)) found.push(e.getAttribute(name));
        }
        for (const n of e.childNodes) if (n.nodeType === 3) found.push(n.nodeValue.trim());
    }
    return [...new Set(found)].filter(Boolean)'''
WIDTH = '''return [document.documentElement.scrollWidth, innerWidth,
    ...[...document.querySelectorAll("#tabs, #bar, #panel, #card, #floors")].filter(
        (e) => e.getBoundingClientRect().width && e.scrollWidth > e.clientWidth + 1).map(
            (e) => e.id)]'''


@pytest.fixture(scope='module')
def german(home: Angen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """A page for someone who reads German and then English."""
    with Server(home.master, tmp_path_factory.mktemp('web')) as server, \
            Page(tmp_path_factory.mktemp('browser'), 1100, 800, 'de-AT,de,en') as opened:
        opened.open(server.url)
        opened.until('return angen.begun')
        yield opened


def english(page: Page) -> set[str]:
    """What it says in English, though there is a German text."""
    return {text for text in page.run(SAID) if GERMAN.get(text, text) != text}


def test_all_is_german(german: Page) -> None:
    assert german.run('return document.documentElement.lang') == 'de'
    for tab, word in (('sensors', 'Messwert'), ('events', 'Kleine Änderungen'),
                      ('costs', 'Rechenzeit'), ('robot', 'Kamera'), ('rooms', 'Schlafzimmer')):
        german.press(f'#tab-{tab}')
        german.until('return document.querySelector("#panel").textContent.includes('
                     'arguments[0])', word)
        assert english(german) == set(), tab
    german.press('#view-plan')
    legend = german.until('return document.querySelector("#plan .legend")?.textContent')
    assert all(word in legend for word in ('Legende', 'Tür', 'Lampe', 'Aufzug', 'Roboter',
                                           'Sensor'))
    assert german.text('#floors') == 'Etage 1Etage 0'
    german.press('#help')
    assert 'Leertaste' in german.text('#dialog')
    assert german.run('return document.activeElement.textContent') == 'Schließen'
    assert english(german) == set()
    german.press('#dialog .main')


def test_events_are_german(german: Page) -> None:
    german.press('#tab-events')
    german.run('angen.home.take({events: [[1, "door", "hall", "opened", "signal 0.5 m"], '
               '[2, "accelerometer", "tag", "put_down", ""]]})')
    search = 'document.querySelector("#panel input[type=search]")'
    for word, text in (('tür geöffnet', 'hall Tür geöffnet Signal 0,5 m'),
                       ('put_down', 'tag Beschleunigung abgesetzt')):
        german.run(f'{search}.value = arguments[0]; {search}.dispatchEvent(new Event("input"))',
                   word)
        german.until('return [...document.querySelectorAll("#panel .events li")].some('
                     '(one) => one.textContent.includes(arguments[0]))', text)
    german.press('#tab-rooms')


def test_a_lamp_is_switched_and_read_in_german(german: Page) -> None:
    german.run('angen.show(angen.home.entities.find((e) => e.kind === "lamp"))')
    german.press('#card [data-verb="On"]')
    german.until('return document.querySelector("#card .state").textContent.startsWith("an ")')
    german.press('#card [data-verb="Off"]')
    german.until('return document.querySelector("#card .state").textContent.startsWith("aus ")')
    assert 'Lampe' in german.text('#card') and 'volle Helligkeit' in german.run(
        'return document.querySelector("#card [data-verb=On]").title')
    german.run('angen.showRoom(angen.home.rooms[0])')
    area: str = german.run('return document.querySelector("#card .soft").textContent')
    assert area.split(' m²')[0].rpartition(',')[0][-1].isdigit()  # 12,3


def test_a_word_has_the_meaning_of_its_kind(german: Page) -> None:
    said = german.driver.execute_async_script('''const done = arguments[0];
        import("/page/js/lang.js").then(({state}) => done(["person", "door"].map(
            (kind) => state("BLOCKED  0.50", angen.home.kinds[kind]))))''')
    assert said == ['KOMMT NICHT WEITER  0,50', 'BLOCKIERT  0,50']


def test_a_switch_of_a_list_sends_the_verb(german: Page) -> None:
    find = '''const row = [...document.querySelectorAll("#panel .thing")].find(
        (one) => one.textContent.includes("Lampe")); return row.'''
    assert german.run(f'{find}lastChild.textContent') == 'Ein'
    german.run(f'{find}lastChild.click()')
    german.until(f'{find}lastChild.textContent === "Aus"')
    assert german.run(f'{find}querySelector(".state").textContent').startswith('an')


def test_nothing_overflows_on_a_phone(german: Page) -> None:
    german.driver.set_window_size(390, 844)
    german.until('return innerWidth < 600')
    german.run('document.querySelector("#card").hidden = true')
    for tab in ('sensors', 'events', 'costs', 'robot', 'rooms'):
        german.press(f'#tab-{tab}')
        width, window, *wide = german.run(WIDTH)
        assert width <= window and not wide, tab
    german.press('#help')
    assert german.driver.find_element('id', 'language').is_displayed()
    assert german.run(WIDTH)[0] <= window
    theme = german.run('return document.documentElement.dataset.theme')
    german.press('#dialog button', 'Hell oder dunkel')
    assert german.run('return document.documentElement.dataset.theme') != theme
    german.press('#dialog .main')
    german.driver.set_window_size(1100, 800)
    german.until('return innerWidth > 1000')


def test_a_language_is_chosen_and_remembered(german: Page) -> None:
    german.press('#help')
    Select(german.driver.find_element('id', 'language')).select_by_value('en')
    german.until('return document.documentElement.lang === "en" && window.angen?.begun')
    assert german.text('#tab-rooms') == 'Rooms'
    german.driver.refresh()
    german.until('return window.angen?.begun')
    assert german.text('#tab-rooms') == 'Rooms'
    german.open(f'{german.run("return location.origin")}/?lang=de')
    assert german.text('#tab-rooms') == 'Räume'
