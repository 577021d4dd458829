"""angen edit on the command line: the file that it writes, and the plan that it reads."""
import argparse
from pathlib import Path

import pytest
from angen_apps.edit import command
from angen_tools.common.failure import Failure


def given(file: Path | None, output: Path | None = None) -> argparse.Namespace:
    return argparse.Namespace(file=file, output=output)


def test_the_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert command._files(given(None)) == (Path('home.world'), None)
    for name in ('home.world', 'home2.world', 'plan.building.yaml'):
        Path(name).touch()
    assert command._files(given(None)) == (Path('home3.world'), None)
    assert command._files(given(Path('new.world'))) == (Path('new.world'), None)
    plan = Path('plan.building.yaml')
    assert command._files(given(plan)) == (Path('plan.world'), plan)
    assert command._files(given(plan, Path('a.world'))) == (Path('a.world'), plan)


@pytest.mark.parametrize('file, output, why', [
    ('home.world', 'b.world', '-o is for a plan'), ('flat', None, 'ends in .world'),
    ('plan.png', None, 'plan.world: exists'), ('plan.png', 'home.world', 'home.world: exists')])
def test_files_that_do_not_fit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, file: str,
                               output: str | None, why: str) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ('home.world', 'plan.world', 'plan.png'):
        Path(name).touch()
    with pytest.raises(Failure, match=why):
        command._files(given(Path(file), Path(output) if output else None))
