"""The tables of docs/ are what docs/tables.py makes of the catalog, and no kind is left out."""
from __future__ import annotations

import importlib.util
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
spec = importlib.util.spec_from_file_location('tables', ROOT / 'docs/tables.py')
tables = importlib.util.module_from_spec(spec)
spec.loader.exec_module(tables)

PAGES = sorted((ROOT / 'docs').rglob('*.md'))
CATALOG = tables.read_catalog()
TEXT = '\n'.join(page.read_text() for page in PAGES)


@pytest.mark.parametrize('page', PAGES, ids=lambda page: page.name)
def test_the_tables_are_those_of_the_catalog(page: Path) -> None:
    text = page.read_text()
    assert text == tables.with_tables(text, CATALOG), 'run python3 docs/tables.py'


@pytest.mark.parametrize('kind', CATALOG)
def test_each_kind_has_its_tables(kind: str) -> None:
    assert re.search(rf'<!-- table {kind} parameters( beside \w+)? -->', TEXT)
    assert f'<!-- table {kind} fields -->' in TEXT
    if CATALOG[kind]['verbs']:
        assert f'<!-- table {kind} commands -->' in TEXT


@pytest.mark.parametrize('kind', CATALOG)
def test_each_parameter_is_in_a_table(kind: str) -> None:
    variants = {match.group(1) for param in CATALOG[kind]['params']
                if (match := re.fullmatch(r'with (\w+ \w+): .*', param['doc']))}
    for variant in variants:
        assert f'<!-- table {kind} parameters {variant} -->' in TEXT


def test_a_table_beside_another_has_what_that_lacks() -> None:
    param = {'type': 'number', 'default': '1', 'unit': 'm', 'doc': 'of it', 'choices': []}
    catalog = {'drive': {'params': [{**param, 'path': 'wheel'}]},
               'odometry': {'params': [{**param, 'path': 'wheel'}, {**param, 'path': 'rate'}]}}
    marker = '<!-- table odometry parameters beside drive -->\n<!-- end -->'
    made = tables.with_tables(marker, catalog)
    assert '`rate`' in made
    assert '`wheel`' not in made


def test_a_wrong_marker_is_an_error() -> None:
    with pytest.raises(SystemExit, match='kinds are'):
        tables.with_tables('<!-- table nope fields -->\n<!-- end -->', CATALOG)


def test_a_table_has_what_the_kind_describes() -> None:
    kind = {'params': [{'path': 'ray/range/max', 'type': 'number', 'default': '3.12413936106985',
                        'unit': 'm^2', 'doc': 'farther is not seen', 'choices': []}],
            'verbs': [{'name': 'Dim', 'doc': 'of it', 'argument': 'percent', 'unit': '%', 'min': 0,
                       'max': 100}],
            'fields': [{'name': 'mode', 'type': 'choice', 'unit': '', 'doc': 'of it',
                        'words': ['A', 'B']}]}
    page = '\n'.join(f'<!-- table lamp {what} -->\nold\n<!-- end -->'
                     for what in ('parameters', 'commands', 'fields'))
    made = tables.with_tables(page, {'lamp': kind})
    assert '| `ray/range/max` | 3.1241 | m² | farther is not seen |\n<!-- end -->' in made
    assert '| `Dim PERCENT` | 0 to 100 % | of it |' in made
    assert '| `mode` | choice |  | `A`, `B`; of it |' in made
    assert 'old' not in made
