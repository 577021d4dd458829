"""Links that may do less: the page says so, and the server refuses the rest, on a running node."""
import json
import time
from pathlib import Path
from typing import Any, Iterator
from urllib.parse import urlsplit

import pytest
from angen_msgs.msg import DoorState
from browser import LIMIT, Page, Server
from harness import Angen, Inbox

CONTROLS = '''return [...document.querySelectorAll("[data-order]")].map(
    (e) => [e.dataset.order, e.disabled, e.title])'''
BUILDING = {'spawn', 'delete', 'move', 'save', 'pause', 'step', 'reset', 'rate'}
CHANGES = [{'do': 'pause'}, {'do': 'reset'}, {'do': 'rate', 'rate': 3.0}, {'do': 'step'},
           {'do': 'spawn', 'kind': 'pir', 'name': 'spy', 'pose': {'x': 0.0}},
           {'do': 'delete', 'name': 'eye'}, {'do': 'save'},
           {'do': 'move', 'model': 'table0', 'x': 1.0, 'y': 1.0, 'turn': 0.0}]
SENDS = [{'do': 'command', 'target': 'door/bathroom0', 'text': 'Open'},
         {'do': 'drive', 'name': 'turtlebot', 'speed': 0.1}, {'do': 'halt', 'name': 'turtlebot'},
         {'do': 'goal', 'name': 'turtlebot', 'x': 1.0, 'y': 1.0}]


@pytest.fixture(scope='module')
def links(angen: Angen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """The printed addresses, on this machine."""
    with Server(angen.master, tmp_path_factory.mktemp('web'), '--host', '0.0.0.0', '--json'
                ) as server:
        printed = json.loads(server.log().splitlines()[-1])
        yield {role: f'{server.url}?{urlsplit(address).query}'
               for role, address in printed.items()}


@pytest.fixture
def page(tmp_path: Path) -> Iterator[Page]:
    with Page(tmp_path, 1100, 750) as opened:
        yield opened


def order(page: Page, what: dict[str, Any]) -> dict[str, Any]:
    """As a page that ignores what it is told; the answer."""
    answer: dict[str, Any] = page.driver.execute_async_script(
        'angen.home.connection.ask(arguments[0]).then(arguments[1])', what)
    return answer


def controls(page: Page) -> dict[str, set[tuple[bool, str]]]:
    """Those of all lists and cards: whether they are disabled, and why, by their order."""
    found: dict[str, set[tuple[bool, str]]] = {}
    for kind in ('door', 'lamp', 'pir', 'drive'):
        for tab in ('rooms', 'sensors', 'robot'):
            page.run('''angen.panels.open(arguments[1]);
                const e = angen.home.entities.find((e) => e.kind === arguments[0]);
                if (e) angen.show(e)''', kind, tab)
            for name, off, why in page.run(CONTROLS):
                found.setdefault(name, set()).add((off, why if off else ''))
    return found


def test_who_may_look_changes_nothing(angen: Angen, links: dict[str, str], page: Page) -> None:
    page.open(links['look'])
    assert page.until('return document.querySelector("#status").textContent.startsWith("Live") '
                      '&& document.querySelector("#status").textContent') == 'Live, to look only'
    assert 'only shows the home' in page.text('#limits')
    found = controls(page)
    assert {'command', 'goal', 'halt', 'drive'} <= found.keys()
    assert BUILDING - {'spawn', 'step'} <= found.keys() | {'rate', 'pause'}
    for name, states in found.items():
        assert states == {(True, 'This link only shows the home.')}, name
    before = angen.names()
    with Inbox('/angen/door/bathroom0', DoorState) as states:
        for what in (*SENDS, *CHANGES):
            answer = order(page, what)
            assert (answer['ok'], answer['text']) == (False, 'this link only shows the home'), what
        time.sleep(1.0)  # for an order that were executed after all
        assert states.wait(lambda _: True, 'the door', LIMIT).mode == DoorState.CLOSED
    assert angen.names() == before
    page.until('return !angen.home.stats.paused && angen.home.stats.time > 0')
    page.run('angen.setView("plan")')
    page.until('return angen.home.rows.size > 3')  # it shows what happens


def test_who_may_switch_builds_nothing(angen: Angen, links: dict[str, str], page: Page) -> None:
    page.open(links['switch'])
    page.until('return document.querySelector("#status").textContent === "Live, to switch only"')
    for name, states in controls(page).items():
        assert (name in BUILDING) == all(off for off, _ in states), name
        assert name not in BUILDING or all('does not build' in why for _, why in states)
    for what in CHANGES:
        answer = order(page, what)
        assert not answer['ok'] and 'this link switches' in answer['text'], what
    page.run('angen.show(angen.home.entities.find((e) => e.kind === "door"))')
    with Inbox('/angen/door/bathroom0', DoorState) as states:
        page.press('#card [data-verb="Open"]')
        states.wait(lambda state: state.mode == DoorState.OPEN, 'an open door', LIMIT)


def test_the_owner_gives_links_away(links: dict[str, str], page: Page) -> None:
    page.open(links['address'])
    page.until('return document.querySelector("#status").textContent === "Live"')
    page.press('#share')
    shown = page.run('''return [...document.querySelectorAll("#dialog input")]
        .map((e) => e.value)''')
    assert [urlsplit(address).query for address in shown] == [
        urlsplit(links[role]).query for role in ('look', 'switch', 'address')]
    page.open(links['look'])
    page.until('return document.querySelector("#status").textContent === "Live, to look only"')
    assert page.run('return document.querySelector("#share").hidden')
    tokens = page.run('''return (await import("/page/js/access.js")).accessed().tokens''')
    assert list(tokens) == ['look']
