"""The page in other languages: every text of it has one there, and nothing else has."""
import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from angen_apps.data.checks.places import PHASES
from angen_apps.edit.catalog import MORE, SENSORS
from angen_apps.plan.furnished import PIECES
from angen_apps.plan.names import USES
from angen_apps.residents.activities import activities
from angen_apps.residents.profiles import names
from angen_apps.web.command import described_kinds
from angen_apps.web.day import HAPPENED, WORDS
from angen_apps.web.guard import REASONS

PAGE = Path(__file__).resolve().parents[2] / 'src/angen_apps/page'
PAGES = {'index.html': 'main.js', 'edit.html': 'edit.js'}  # and their first modules
LANGUAGES = sorted((PAGE / 'lang').glob('*.json'))
CALL = re.compile(r"(?<![\w.])t\('((?:[^'\\]|\\.)*)'")
ANY_CALL = re.compile(r'(?<![\w.])t\((?:[`"]|\w+ \?)')  # of a text that this test does not find
PLAIN = re.compile(r"(?:\}, |(?:title|alt|placeholder|'aria-label'): |textContent = |notice\()"
                   r"(?:'[A-Za-z]+ ?[a-z]{2}[^']*'|`[A-Za-z]+ [a-z]{2}[^`]*`)")
IMPORT = re.compile(r"(?:from|import\() ?'\./(\w+\.js)'")
SORT = re.compile(r"^  '?([a-z ]+)'?: \{ kind:", re.MULTILINE)  # of a door or window
DRAWING = PAGE / 'js/drawing.js'
HOLE = re.compile(r'\{\w+\}')
NAMES = {'Angen', '?', '↶', '↷', '◷', '▶'}
ROOMS = ('hall', 'entrance', 'livingroom', 'bedroom', 'workroom', 'stairs')  # of homes made here
COSTS = ('process', 'physics', 'devices', 'sensors', 'commands', 'snapshots', 'publishing')
NONE = 'none'  # an empty list
MARKS = ('robot', 'sensor')  # of a plan
OF_DAYS = ('door', 'item', 'power')  # sensors of a day that have events
SOURCES = ('world', 'bell', 'resident', *OF_DAYS)  # of events, beside kinds


class Texts(HTMLParser):
    """Those of a page that a user reads."""

    def __init__(self) -> None:
        super().__init__()
        self.found: set[str] = set()
        self.languages: list[str] = []
        self._tag = ''

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._tag = tag
        self.found.update(value for name, value in attrs
                          if name in ('title', 'aria-label', 'alt') and value)
        given = dict(attrs)
        if given.get('name') == 'languages':
            self.languages = (given['content'] or '').split()

    def handle_data(self, data: str) -> None:
        if self._tag not in ('title', 'noscript') and data.strip():
            self.found.add(data.strip())


def words(name: str) -> str:
    return name[:1].upper() + name[1:].replace('_', ' ')


def catalog() -> set[str]:
    """Names and descriptions that the page has of the simulator."""
    found = {words(name) for name in (*ROOMS, *COSTS, *MARKS, 'other', *(use for use, _ in USES))}
    found |= {f'{reason[0].upper()}{reason[1:]}.' for reason in REASONS.values()}
    found |= {words(name) for name in (*PIECES, *MORE, *(sensor.name for sensor in SENSORS),
                                       *names(), *SORT.findall(DRAWING.read_text()))}
    found |= {name.replace('_', ' ') for name in (*activities(), 'wake')} | {'Ground floor', NONE}
    for name, kind in described_kinds().items():
        found |= {words(name), kind['doc']}
        for verb in kind['verbs']:
            found |= {words(re.sub(r'(?<=[a-z])(?=[A-Z])', ' ', verb['name']).lower()),
                      verb['doc']}
        for field in kind['fields']:
            if field['type'] in ('flag', 'integer', 'number'):
                found.add(field['name'].replace('_', ' '))
            found |= {word.lower() for word in field['words']}
    return found - {''}


def events() -> set[str]:
    """Words of all events of the simulator, by its source, and of a generated day."""
    sources = ''.join(path.read_text() for path in (PAGE.parents[1] / 'angen_sim').rglob('*.[ch]*'))
    # the first argument of each call
    said = re.findall(r'\b(?:event(?: = |\()|announce\()((?:(?!, "|;)[\s\S])*)|'
                      r'(?:\.events\(|IdChanges \w+\{|Events\[\] = )([^;)}]*)|'
                      r'(?:"world", )+("[^"]*")|world_event\(([^;)]*)|'
                      r'\bsay\(([^;]*), reading\)', sources)
    found = {word for texts in said for text in texts
             for word in re.findall(r'"([a-z_]+(?: [a-z]+)*)"', text)} - {'world'}
    assert len(found) > 50
    found |= {HAPPENED.get(word, word) for kind in OF_DAYS for word in WORDS[kind]}
    return found | set(PHASES) | {'rang'}


def in_context() -> set[str]:
    """Words of states, each with its kind: texts that a language may have."""
    return {f'{name}: {word.lower()}' for name, kind in described_kinds().items()
            for field in kind['fields'] for word in field['words'] if word}


@pytest.fixture(scope='module')
def texts() -> set[str]:
    page = Texts()
    for name in PAGES:
        page.feed((PAGE / name).read_text())
    found = (page.found - NAMES) | catalog() | {words(name) for name in SOURCES} | {
        f'event: {word}' for word in events()}
    for path in (PAGE / 'js').glob('*.js'):
        found.update(CALL.findall(path.read_text()))
    return found


@pytest.mark.parametrize('name', PAGES)
def test_a_page_names_its_languages(name: str) -> None:
    page = Texts()
    page.feed((PAGE / name).read_text())
    assert page.languages == ['en', *(path.stem for path in LANGUAGES)] and LANGUAGES


def modules(name: str) -> set[str]:
    """A module of the page, and those that it imports."""
    found: set[str] = set()
    due = [name]
    while due:
        if (name := due.pop()) not in found:
            found.add(name)
            due += IMPORT.findall((PAGE / 'js' / name).read_text())
    return found


def test_the_code_says_nothing_else() -> None:
    for name in sorted(set.union(*map(modules, PAGES.values()))):
        text = (PAGE / 'js' / name).read_text()
        assert not ANY_CALL.findall(text) and not PLAIN.findall(text), name


@pytest.mark.parametrize('path', LANGUAGES, ids=lambda path: str(path.stem))
def test_each_text_is_in_each_language(path: Path, texts: set[str]) -> None:
    def once(pairs: list[tuple[str, str]]) -> dict[str, str]:
        assert len(dict(pairs)) == len(pairs)
        return dict(pairs)
    table: dict[str, Any] = json.loads(path.read_text(), object_pairs_hook=once)
    assert sorted(texts - set(table)) == []
    assert sorted(set(table) - texts - in_context()) == []  # what nothing uses
    assert all(table.values())
    holes = {text for text, other in table.items()
             if sorted(HOLE.findall(text)) != sorted(HOLE.findall(other))}
    assert not holes
