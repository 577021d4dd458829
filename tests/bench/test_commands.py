"""The words of angen bench."""
from __future__ import annotations

import pytest

from angen_tools.cli import main as cli


@pytest.mark.parametrize('words', [['--counts', '1,x'], ['--counts', '-1'], ['--repeats', '0'],
                                   ['--window', 'nan'], ['--window', '0.1'], ['--kind', 'nose']])
def test_wrong_words_are_rejected_in_one_line(words: list[str],
                                              capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as error:
        cli.run(['bench', 'sensors', *words])
    assert error.value.code == 2 and len(capsys.readouterr().err.splitlines()) == 1
