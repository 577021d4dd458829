"""What angen bench makes of its measurements; no simulator."""
from __future__ import annotations

import csv
from pathlib import Path

import pytest
from angen_tools import bench, bench_report, bench_words, cli
from angen_tools.bench_measure import due, spread
from angen_tools.bench_report import Row, Session
from angen_tools.failure import Failure


def row(count: int, server: float, client: float | None = None, **more: object) -> Row:
    return Row(mode='added', kind='pir', count=count, sensors=count, server_cpu=server,
               client_cpu=client, **more)


def test_a_line_is_fitted_exactly() -> None:
    line = bench_report.fit([0, 10, 100], [2.0, 2.5, 7.0])
    assert line and line.base == pytest.approx(2.0) and line.slope == pytest.approx(0.05)


def test_a_line_has_least_squares() -> None:
    line = bench_report.fit([0, 1, 2], [0.0, 3.0, 3.0])
    assert line and line.base == pytest.approx(0.5) and line.slope == pytest.approx(1.5)


@pytest.mark.parametrize('values', [[1.0, None], [None, None]])
def test_one_count_has_no_line(values: list[float | None]) -> None:
    assert bench_report.fit([0, 10], values) is None
    assert bench_report.fit([5, 5], [1.0, 2.0]) is None


def test_a_row_has_the_median_of_what_was_measured() -> None:
    made = bench_report.combine([Session(server_cpu=1.0, client_cpu=9.0), Session(server_cpu=7.0),
                                 Session(server_cpu=2.0)], mode='added', kind='pir', count=3)
    assert (made.server_cpu, made.client_cpu, made.rtf) == (2.0, 9.0, None)
    assert (made.count, made.repeats) == (3, 3)


@pytest.mark.parametrize('rtf,delivered,verdict',
                         [(1.0, 1.0, True), (0.9, 1.0, False), (1.0, 0.9, False),
                          (1.0, None, True), (None, 1.0, False)])
def test_real_time_needs_time_and_readings(rtf: float | None, delivered: float | None,
                                           verdict: bool) -> None:
    assert row(1, 1.0, rtf=rtf, delivered=delivered).real_time is verdict


def test_csv_has_a_line_a_count_and_blanks_for_what_is_missing(tmp_path: Path) -> None:
    path = tmp_path / 'new/a.csv'
    bench_report.write_csv(path, [row(0, 1.23456), row(10, 2.0, 50.0)])
    with path.open() as file:
        read = list(csv.DictReader(file))
    assert [r['count'] for r in read] == ['0', '10']
    assert tuple(read[0]) == bench_report.COLUMNS
    assert (read[0]['server_cpu'], read[0]['client_cpu'], read[1]['client_cpu']) == (
        '1.235', '', '50')


def test_the_cost_of_one_more_is_said() -> None:
    said = bench_report.say_fit([row(0, 2.0), row(100, 12.0)])
    assert said == ['server: one more sensor costs 0.1 % of a core (2.0 % without)']


@pytest.mark.parametrize('client', [None, 80.0])
def test_a_figure_is_small(tmp_path: Path, client: float | None) -> None:
    path = tmp_path / 'a.png'
    bench_report.draw(path, [row(0, 2.0, client), row(10, 3.0, client)])
    assert path.read_bytes().startswith(b'\x89PNG') and path.stat().st_size < 150_000


@pytest.mark.parametrize('rate,begin,end,expected',
                         [(10, 0.0, 1.0, 10), (10, 0.95, 2.05, 11), (1, 0.999, 1.0, 1),
                          (1, 1.0, 1.999, 0), (10, 3.0, 3.0, 0), (10, 0.3, 0.6, 3)])
def test_readings_due_are_counted(rate: float, begin: float, end: float, expected: int) -> None:
    assert due(rate, begin, end) == expected


def test_listeners_are_spread() -> None:
    sensors = list(range(95))
    assert spread(sensors, 10) == list(range(0, 95, 10))
    assert spread(sensors[:4], 10) == sensors[:4] and spread([], 10) == []


def test_all_kinds_are_benched_one_after_the_other() -> None:
    groups = bench.cases('added', 'all', [10, 0, 10])
    assert [g[0].kind for g in groups] == list(bench_words.KINDS)
    assert all([c.count for c in g] == [0, 10] for g in groups)


def test_desired_asks_for_all_that_the_building_needs() -> None:
    case, = bench.cases('desired', 'all', [2])[0]
    assert case.counts == {'pir': 24, 'luminosity': 12, 'switch': 12, 'contact': 19}
    models = [s.model for s in case.sensors()]
    assert models.count('chair') == 12 and models.count('elevator') == 1
    assert sum('table' in m or m == 'desk' for m in models) == 6
    with pytest.raises(Failure, match='1 or more'):
        bench.cases('desired', 'all', [0, 1])


@pytest.mark.parametrize('words', [['--counts', '1,x'], ['--counts', '-1'], ['--repeats', '0'],
                                   ['--window', 'nan'], ['--window', '0.1'], ['--kind', 'nose']])
def test_wrong_words_are_refused_in_one_line(words: list[str],
                                             capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as refused:
        cli.run(['bench', 'sensors', *words])
    assert refused.value.code == 2 and len(capsys.readouterr().err.splitlines()) == 1
