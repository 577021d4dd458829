"""bench/history.csv, from rows as angen bench core makes them."""
from pathlib import Path

from angen_bench import core, history

LEAST = [core.Case('people/people:1', 4e9, {}), core.Case('people/people:10', 1e9, {}),
         core.Case('rest', 1.0, {})]


def test_each_ratio_of_a_release_has_a_line(tmp_path: Path) -> None:
    file = tmp_path / 'history.csv'
    assert history.add(file, '0.1.0', core.rows_of(LEAST, 'abc')) == 1
    faster = [LEAST[0], core.Case('people/people:10', 0.5e9, {})]
    history.add(file, '0.2.0', core.rows_of(faster, 'def'))
    assert file.read_text() == ('release,case,against,ratio,commit\n'
                                '0.1.0,people/people:10,people/people:1,0.25,abc\n'
                                '0.2.0,people/people:10,people/people:1,0.125,def\n')


def test_a_release_that_is_measured_again_has_its_new_ratios(tmp_path: Path) -> None:
    file = tmp_path / 'history.csv'
    for ten in (1e9, 2e9):
        history.add(file, '0.2.0', core.rows_of(
            [LEAST[0], core.Case('people/people:10', ten, {})], 'abc'))
    assert file.read_text().splitlines()[1:] == ['0.2.0,people/people:10,people/people:1,0.5,abc']
