"""bench/history.csv, from rows as angen bench core makes them."""
from __future__ import annotations

from pathlib import Path

from angen_bench import core, history

LEAST = [core.Case('start/cached:0', 4e9, {}), core.Case('start/cached:1', 1e9, {}),
         core.Case('rest', 1.0, {})]


def test_each_ratio_of_a_release_has_a_line(tmp_path: Path) -> None:
    file = tmp_path / 'history.csv'
    assert history.add(file, '0.1.0', core.rows_of(LEAST, 'abc')) == 1
    faster = [LEAST[0], core.Case('start/cached:1', 0.5e9, {})]
    history.add(file, '0.2.0', core.rows_of(faster, 'def'))
    assert file.read_text() == ('release,case,against,ratio,commit\n'
                                '0.1.0,start/cached:1,start/cached:0,0.25,abc\n'
                                '0.2.0,start/cached:1,start/cached:0,0.125,def\n')


def test_a_release_that_is_measured_again_has_its_new_ratios(tmp_path: Path) -> None:
    file = tmp_path / 'history.csv'
    for cached in (1e9, 2e9):
        history.add(file, '0.2.0', core.rows_of(
            [LEAST[0], core.Case('start/cached:1', cached, {})], 'abc'))
    assert file.read_text().splitlines()[1:] == ['0.2.0,start/cached:1,start/cached:0,0.5,abc']
