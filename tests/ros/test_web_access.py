"""The page for everybody: contrast as WCAG AA asks, in light and dark, and all by keys alone."""
from pathlib import Path
from typing import Any, Iterator

import pytest
from angen_msgs.msg import DoorState
from browser import LIMIT, Page, Server
from harness import Angen, Inbox
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

CONTRAST = Path(__file__).with_name('contrast.js').read_text()
FOCUSED = '''const e = document.activeElement, style = getComputedStyle(e);
    const face = e.querySelector?.(".face"), box = e.getBoundingClientRect();
    const reach = parseFloat(style.outlineOffset) + parseFloat(style.outlineWidth) - 0.5;
    let clipped = false;
    for (let p = e.parentElement; p && !face; p = p.parentElement) {
        const r = p.getBoundingClientRect();
        clipped ||= getComputedStyle(p).overflow !== "visible" && (box.left - reach < r.left
            || box.right + reach > r.right || box.top - reach < r.top
            || box.bottom + reach > r.bottom);
    }
    return {clipped,
            on: e.id || e.dataset?.verb || e.textContent.trim().slice(0, 40) || e.ariaLabel,
            tag: e.tagName, inCard: !!e.closest("#card"), open: e.matches("#card [data-verb=Open]"),
            door: e.matches("#panel .thing > button.name") && e.textContent.includes("bathroom0"),
            ring: (style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2)
                  || (!!face && getComputedStyle(face).strokeWidth !== "0px")}'''
REACHABLE = '''return [...document.querySelectorAll("button, input, select, a[href]")]
    .filter((e) => e.checkVisibility({visibilityProperty: true}) && !e.disabled
            && e.tabIndex >= 0 && e.getClientRects().length)
    .map((e) => e.id || e.dataset.verb || e.textContent.trim().slice(0, 40) || e.ariaLabel)'''
MOST_KEYS = 120


@pytest.fixture(scope='module')
def page(angen: Angen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with Server(angen.master, tmp_path_factory.mktemp('web')) as server, \
            Page(tmp_path_factory.mktemp('browser'), 1100, 750) as opened:
        opened.open(server.url)
        opened.until('return angen.view.frames > 0')
        yield opened


def press(page: Page, key: str) -> None:
    ActionChains(page.driver, duration=0).send_keys(key).perform()


def low(page: Page) -> tuple[int, list[dict[str, Any]]]:
    """The number of texts and controls, and those with too little contrast."""
    found = page.run(CONTRAST)
    return len(found), [one for one in found if one['ratio'] < one['needed']]


@pytest.mark.parametrize('theme', ['light', 'dark'])
def test_texts_and_controls_have_the_contrast_of_wcag_aa(page: Page, theme: str) -> None:
    page.run('angen.setTheme(arguments[0]); angen.panels.plots.add("pir", "eye")', theme)
    wrong: dict[str, list[dict[str, Any]]] = {}
    for view in ('3d', 'plan'):
        page.run('angen.setView(arguments[0])', view)
        for tab in ('rooms', 'sensors', 'events', 'robot', 'costs'):
            page.run('''angen.panels.open(arguments[0]);
                angen.show(angen.home.entities.find((e) => e.kind === "lamp"));
                document.querySelector("#notices").replaceChildren();
                angen.say("a notice"); document.querySelector("#hint").hidden = false''', tab)
            count, wrong[f'{view} {tab}'] = low(page)
            assert count > 20
    page.run('document.querySelector("#hint").hidden = true; angen.help()')
    count, wrong['help'] = low(page)
    page.run('document.querySelector("#dialog").close(); angen.card.close()')
    assert not any(wrong.values()), wrong
    page.run('document.documentElement.style.setProperty("--soft", "#7a7a7a")')
    assert low(page)[1]  # a gray in the middle is noticed
    page.run('''document.documentElement.style.removeProperty("--soft");
        document.documentElement.style.setProperty("--edge", "#808080a0")''')
    assert low(page)[1]  # a pale border is noticed
    page.run('document.documentElement.style.removeProperty("--edge")')


def test_a_door_is_opened_by_keys_alone(page: Page) -> None:
    page.run('angen.setView("3d"); angen.panels.open("rooms"); document.activeElement.blur()')
    seen: list[str] = []
    for _ in range(MOST_KEYS):
        press(page, Keys.TAB)
        at = page.run(FOCUSED)
        assert at['ring'] or at['tag'] == 'BODY', f'{at} shows no focus'
        assert not at['clipped'], f'the ring around {at} is cut'
        seen.append(at['on'])
        if at['door']:
            break
    assert at['door'], seen
    missed = [name for name in page.run(REACHABLE) if name not in seen]
    after = page.run('''const all = [...document.querySelectorAll("#panel button")];
        return all.slice(all.indexOf(document.activeElement)).map((e) => e.textContent.trim())''')
    assert set(missed) <= set(after), missed  # all before the door were reached
    press(page, Keys.ENTER)
    page.until('return document.querySelector("#card h2")?.textContent === "bathroom0"')
    for _ in range(MOST_KEYS):
        press(page, Keys.TAB)
        at = page.run(FOCUSED)
        assert at['inCard'], f'the keys leave the card at {at}'
        if at['open']:
            break
    with Inbox('/angen/door/bathroom0', DoorState) as states:
        press(page, Keys.ENTER)
        states.wait(lambda state: state.mode == DoorState.OPEN, 'an open door', LIMIT)
    press(page, Keys.ESCAPE)
    assert page.run('return document.querySelector("#card").hidden')
    assert page.run(FOCUSED)['door']  # the focus is where it was
