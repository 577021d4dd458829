"""The catalog, which is read from files beside the plug-in libraries."""
import json
import os
from pathlib import Path
from typing import Any, Iterator

import angen
import pytest

from angen_tools.common import catalog
from angen_tools.common.failure import Failure


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder of a user's plug-ins."""
    monkeypatch.setenv('ANGEN_PLUGIN_PATH', str(tmp_path))
    catalog.forget()
    yield tmp_path
    catalog.forget()


def put(folder: Path, library: str, kind: str, **changes: Any) -> None:
    """A library and its description."""
    (folder / f'{library}.so').touch()
    entry = {**catalog.kind_of('lamp'), 'library': f'{library}.so', 'kind': kind, **changes}
    (folder / f'{library}.json').write_text(json.dumps([entry]))
    catalog.forget()


def test_the_files_equal_the_catalogs_of_the_libraries() -> None:
    on_path = {file.name for folder in catalog.directories() for file in folder.glob('lib*.so')}
    assert len(catalog.plugins()) > 20
    assert catalog.plugins() == [p for p in angen.plugins() if p['library'] in on_path]


def test_a_kind_of_the_users_own(folder: Path) -> None:
    put(folder, 'libfoo', 'foo', role='sensor')
    assert catalog.kind_of('foo')['library'] == 'libfoo.so'
    assert 'foo' in catalog.kinds('sensor') and 'foo' not in catalog.kinds('device')
    assert 'on' in {verb['name'].lower() for verb in catalog.kind_of('foo')['verbs']}


def test_a_workspace_that_is_sourced_is_enough(tmp_path: Path, monkeypatch: pytest.MonkeyPatch
                                               ) -> None:
    (tmp_path / 'lib').mkdir()
    monkeypatch.setenv('CMAKE_PREFIX_PATH', f'{tmp_path}:{os.environ["CMAKE_PREFIX_PATH"]}')
    put(tmp_path / 'lib', 'libfoo', 'foo')
    assert 'foo' in catalog.kinds('device') and 'lamp' in catalog.kinds('device')
    monkeypatch.undo()
    catalog.forget()


def test_the_first_library_of_a_name_counts(folder: Path) -> None:
    put(folder, 'libpir_controller', 'own_pir')
    assert 'own_pir' in catalog.kinds() and 'pir' not in catalog.kinds()


@pytest.mark.parametrize('content', ['', '{', '{}', '[{"kind": "foo"}]', '[3]'])
def test_a_file_that_is_not_a_catalog_is_passed_over(folder: Path, content: str) -> None:
    (folder / 'libfoo.so').touch()
    (folder / 'libfoo.json').write_text(content)
    assert 'foo' not in catalog.kinds() and 'lamp' in catalog.kinds()


def test_a_file_without_its_library_is_passed_over(folder: Path) -> None:
    put(folder, 'libfoo', 'foo')
    (folder / 'libfoo.so').unlink()
    catalog.forget()
    assert 'foo' not in catalog.kinds()


@pytest.mark.parametrize('stale', [True, False])
def test_a_library_whose_description_is_old_or_missing_is_loaded(folder: Path, stale: bool) -> None:
    """A copy of a library of Angen's, whose JSON file is wrong."""
    library, = [d / 'libheater.so' for d in catalog.directories() if (d / 'libheater.so').exists()]
    (folder / 'libheater.so').write_bytes(library.read_bytes())
    if stale:
        (folder / 'libheater.json').write_text('[]')
        os.utime(folder / 'libheater.json', (1, 1))
    assert catalog.kind_of('heater')['verbs'] == [
        v for p in angen.plugins() if p['kind'] == 'heater' for v in p['verbs']]


def test_an_unknown_kind_has_suggestions() -> None:
    with pytest.raises(Failure, match='no kind .dor.; did you mean door, .*`angen plugins`'):
        catalog.kind_of('dor')
