"""docs/reference/ has the output of docs/tables.py, and pages lead to each kind."""
import importlib.util
from pathlib import Path
from typing import Any

import pytest

from tests.docs.pages import ROOT

spec = importlib.util.spec_from_file_location('tables', ROOT / 'docs/tables.py')
tables = importlib.util.module_from_spec(spec)
spec.loader.exec_module(tables)

CATALOG = tables.read_catalog()
MADE = tables.pages(CATALOG)
PARAM = {'path': 'wheel', 'type': 'number', 'default': '1', 'unit': 'm', 'doc': 'of it',
         'choices': []}


def kind(name: str, **values: Any) -> dict[str, Any]:
    return {'kind': name, 'doc': 'One.', 'role': 'device', 'library': 'libx.so', 'params': [],
            'verbs': [], 'fields': [], **values}


@pytest.mark.parametrize('page', MADE, ids=lambda page: page.name)
def test_a_page_is_that_of_the_catalog(page: Path) -> None:
    assert page.read_text() == MADE[page], 'run python3 docs/tables.py'


def test_there_is_no_page_of_a_kind_that_does_not_exist() -> None:
    assert tables.written() == set(MADE) - {tables.README}


@pytest.mark.parametrize('name', CATALOG)
def test_a_page_describes_each_kind(name: str) -> None:
    assert name in tables.described_in()


def test_what_shares_a_plugin_element_lists_only_its_own_parameters() -> None:
    drive = kind('drive', params=[PARAM])
    odometry = kind('odometry', role='sensor', params=[PARAM, {**PARAM, 'path': 'rate'}])
    made = tables.page(odometry, {'drive': drive, 'odometry': odometry}, '')
    assert '`rate`' in made and '[drive](drive.md)' in made
    assert '`wheel`' not in made


def test_parameters_of_a_variant_have_a_table_of_their_own() -> None:
    special = {**PARAM, 'path': 'lens', 'doc': 'with model hot: of its eye'}
    made = tables.page(kind('pir', params=[special, PARAM]), {}, 'sensors/pir.md')
    assert '[sensors/pir.md](../sensors/pir.md)' in made
    assert '`lens`' not in made.split('## Parameters with `model hot`')[0]
    assert '| `lens` | 1 | m | of its eye |' in made


def test_a_page_has_the_description_of_the_kind() -> None:
    made = tables.page(kind('lamp', params=[
        {**PARAM, 'path': 'ray/range/max', 'default': '3.12413936106985', 'unit': 'm^2',
         'doc': 'farther is not seen'}],
        verbs=[{'name': 'Dim', 'doc': 'of it', 'argument': 'percent', 'unit': '%', 'min': 0,
                'max': 100}],
        fields=[{'name': 'mode', 'type': 'choice', 'unit': '', 'doc': 'of it',
                 'words': ['A', 'B'], 'with': 'model new'}]), {}, '')
    assert '| `ray/range/max` | 3.1241 | m² | farther is not seen |\n' in made
    assert '| `Dim PERCENT` | 0 to 100 % | of it |' in made
    assert '| `mode` | choice |  | `A`, `B`; of it; with `model new` |' in made
