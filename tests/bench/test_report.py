"""Reports of the bench: lines, medians, CSV, a figure."""
import csv
import math
from pathlib import Path

import pytest

from angen_bench import report as bench_report
from angen_bench.report import Row, Session


def row(count: int, server: float, client: float | None = None, **more: object) -> Row:
    return Row(mode='added', kind='pir', count=count, sensors=count, server_cpu=server,
               client_cpu=client, **{'rtf': 1.0, **more})


def test_a_line_is_fitted_exactly() -> None:
    line = bench_report.fit([0, 10, 100], [2.0, 2.5, 7.0])
    assert line and line.base == pytest.approx(2.0) and line.slope == pytest.approx(0.05)


def test_a_line_has_least_squares() -> None:
    line = bench_report.fit([0, 1, 2], [0.0, 3.0, 3.0])
    assert line and line.base == pytest.approx(0.5) and line.slope == pytest.approx(1.5)
    # residuals -0.5, 1, -0.5 about a mean count of 1: sqrt(1.5 / (3 - 2) / 2)
    assert line.error == pytest.approx(math.sqrt(0.75))


@pytest.mark.parametrize('values', [[1.0, None], [None, None]])
def test_one_count_has_no_line(values: list[float | None]) -> None:
    assert bench_report.fit([0, 10], values) is None
    assert bench_report.fit([5, 5], [1.0, 2.0]) is None


def test_a_row_has_the_median_of_the_measurements() -> None:
    made = bench_report.combine([Session(server_cpu=1.0, client_cpu=9.0), Session(server_cpu=7.0),
                                 Session(server_cpu=2.0)], mode='added', kind='pir', count=3)
    assert (made.server_cpu, made.client_cpu, made.rtf) == (2.0, 9.0, None)
    assert (made.count, made.repeats) == (3, 3)


def test_extremes_are_of_the_repeats_that_measured() -> None:
    found = bench_report.extremes([Session(server_cpu=1.0, client_cpu=9.0),
                                   Session(server_cpu=7.0), Session(server_cpu=2.0)])
    assert found == {'server_cpu': (1.0, 7.0), 'client_cpu': (9.0, 9.0)}


@pytest.mark.parametrize('rtf,delivered,verdict',
                         [(1.0, 1.0, True), (0.9, 1.0, False), (1.0, 0.9, False),
                          (1.0, None, True), (None, 1.0, False)])
def test_real_time_needs_time_and_readings(rtf: float | None, delivered: float | None,
                                           verdict: bool) -> None:
    assert row(1, 1.0, rtf=rtf, delivered=delivered).real_time is verdict


def test_csv_has_a_line_a_count_and_blanks_for_missing_values(tmp_path: Path) -> None:
    path = tmp_path / 'new/a.csv'
    bench_report.write_csv(path, [row(0, 1.23456), row(10, 2.0, 50.0)])
    with path.open() as file:
        read = list(csv.DictReader(file))
    assert [r['count'] for r in read] == ['0', '10']
    assert tuple(read[0]) == bench_report.COLUMNS
    assert (read[0]['server_cpu'], read[0]['client_cpu'], read[1]['client_cpu']) == (
        '1.235', '', '50')


def test_the_cost_of_one_more_is_described() -> None:
    said = bench_report.describe_fit([row(0, 2.0), row(100, 12.0)])
    assert said == ['server: one more sensor costs 0.1 % of a core (2.0 % without)']


def test_what_is_not_in_real_time_is_not_fitted() -> None:
    rows = [row(0, 2.0), row(100, 12.0), row(500, 99.0, rtf=0.14)]
    assert bench_report.describe_fit(rows) == [
        'not fitted, as not in real time: 500',
        'server: one more sensor costs 0.1 % of a core (2.0 % without)']
    assert bench_report.describe_fit([row(n, 99.0, rtf=0.3) for n in (1, 2)]) == [
        'not fitted, as not in real time: 1, 2']


@pytest.mark.parametrize('client', [None, 80.0])
def test_a_figure_is_small(tmp_path: Path, client: float | None) -> None:
    path = tmp_path / 'a.png'
    bench_report.draw(path, [row(0, 2.0, client), row(10, 3.0, client)])
    assert path.read_bytes().startswith(b'\x89PNG') and path.stat().st_size < 150_000


def test_figures_of_kinds_and_modes_are_drawn_together(tmp_path: Path) -> None:
    path = tmp_path / 'b.png'
    deployed = [Row(mode='deployed', kind='pir', count=n, server_cpu=2.0 + n,
                    deploy_server_cpu=60.0) for n in (0, 5)]
    bench_report.draw_together(path, [[row(0, 2.0), row(5, 3.0)], deployed])
    assert path.read_bytes().startswith(b'\x89PNG') and path.stat().st_size < 150_000
