"""Errors of angen spawn, without a simulator."""
from __future__ import annotations

from pathlib import Path

import pytest

from angen_tools.cli import main as cli


@pytest.mark.parametrize('source, part', [
    ('http://a/b', 'model://NAME'), ('nowhere', 'neither a file nor a model'), ('', 'give a path')])
def test_a_wrong_model_is_reported(source: str, part: str, tmp_path: Path,
                                   monkeypatch: pytest.MonkeyPatch,
                                   capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    assert cli.run(['spawn', 'model', source, 'm1', '--pose', '0 0 0']) == 1
    line, = capsys.readouterr().err.splitlines()
    assert part in line


def test_an_unknown_parameter_has_suggestions(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(['spawn', 'pir', 'p1', '--pose', '0 0 1', '--set', 'range=3']) == 1
    line, = capsys.readouterr().err.splitlines()
    assert "'range'; did you mean ray/range/max" in line and 'angen spawn pir --help' in line
