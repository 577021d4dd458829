"""Progress where stderr is not a terminal: lines for a log."""
import pytest

from angen_tools.common import progress as module
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


def test_otherwise_a_line_each_ten_seconds(capsys: pytest.CaptureFixture[str],
                                           monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0
    monkeypatch.setattr(module.time, 'monotonic', lambda: now)
    with Progress('work') as progress:
        for now in (100.1, 109.0, 110.5, 120.0, 121.0):
            progress.update(now / 1000)
        progress.note('a room')
    assert lines(capsys) == ['angen: work  11 %', 'angen: work  12 %', 'angen: a room']


def test_a_line_for_each_step(capsys: pytest.CaptureFixture[str]) -> None:
    steps = Steps(2)
    steps.next('one')
    steps.next('two')
    steps.close()
    assert lines(capsys) == ['angen: bench   0 %  1/2  one', 'angen: bench  50 %  2/2  two']
