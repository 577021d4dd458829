"""C++ tests are named after their sources, or CONTRIBUTING.md names them as tests across files."""
from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.docs.pages import ROOT

TESTS = sorted((ROOT / 'tests/angen_sim').glob('*/*_test.cpp'))
ACROSS = set(re.findall(r'`(\w+/\w+)_test`', (ROOT / 'CONTRIBUTING.md').read_text()))


@pytest.mark.parametrize('test', TESTS, ids=lambda path: f'{path.parent.name}/{path.stem}')
def test_a_test_has_the_name_of_its_source(test: Path) -> None:
    name = test.stem.removesuffix('_test')
    sources = (ROOT / 'src/angen_sim' / test.parent.name).rglob(f'{name}.*')
    assert any(sources) != (f'{test.parent.name}/{name}' in ACROSS)


def test_the_tests_across_files_exist() -> None:
    assert len(ACROSS) > 3
    assert ACROSS <= {f'{test.parent.name}/{test.stem.removesuffix("_test")}' for test in TESTS}
