"""Angen's own worlds and models have no element that Angen ignores: typing errors show."""
from pathlib import Path

import pytest

from angen_tools.offline.check import check

WORLDS = Path(__file__).resolve().parents[2] / 'worlds'
OURS = [*sorted(WORLDS.rglob('*.world')),
        *sorted(file.parent for file in (WORLDS / 'models').glob('*/model.sdf')
                if '<model' in file.read_text())]


@pytest.mark.parametrize('path', OURS, ids=lambda path: path.name)
def test_nothing_of_it_is_ignored(path: Path) -> None:
    found = check(str(path))
    assert (found.wrong, found.ignored) == ([], [])
