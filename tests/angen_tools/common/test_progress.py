"""Progress where stderr is not a terminal: lines for a log."""
from __future__ import annotations

import pytest

from angen_tools.common.progress import Progress, Steps


def lines(capsys: pytest.CaptureFixture[str]) -> list[str]:
    captured = capsys.readouterr()
    assert captured.out == ''
    return captured.err.splitlines()


def test_a_line_for_each_tenth(capsys: pytest.CaptureFixture[str]) -> None:
    with Progress('work', 0.1) as progress:
        for share in (0.0, 0.05, 0.1, 0.1, 0.35, 0.3, 1.0):
            progress.update(share, 'now')
    assert lines(capsys) == ['angen: work   0 %  now', 'angen: work  10 %  now',
                             'angen: work  35 %  now', 'angen: work 100 %  now']


def test_no_line_where_none_is_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    with Progress('work') as progress:
        progress.update(0.5)
        progress.note('a room')
    assert lines(capsys) == ['angen: a room']


def test_a_line_for_each_step(capsys: pytest.CaptureFixture[str]) -> None:
    steps = Steps(2)
    steps.next('one')
    steps.next('two')
    steps.close()
    assert lines(capsys) == ['angen: bench   0 %  1/2  one', 'angen: bench  50 %  2/2  two']
