"""Tables of two simulators, from figures made up here."""
import csv
from pathlib import Path

import pytest

from angen_bench import contest_report as bench_vs
from angen_bench import report as bench_report
from angen_bench.contest_report import ANGEN, EACH, ONE_LINK, Row, Session


def row(simulator: str, count: int, **figures: float) -> Row:
    return Row(kind='pir', count=count, simulator=simulator, **figures)


def test_a_row_has_the_median_of_the_measurements() -> None:
    made = bench_report.combine([Session(cpu=1.0), Session(cpu=5.0, gone_ms=7.0), Session(cpu=2.0)],
                                Row, kind='pir', count=3, simulator=EACH)
    assert (made.cpu, made.gone_ms, made.rtf, made.repeats) == (2.0, 7.0, None, 3)


def cells(rows: list[Row], title: str) -> dict[str, list[str]]:
    """The cells of a question's lines, by count."""
    lines = [[cell.strip() for cell in line.strip('|').split('|')]
             for line in bench_vs.table(rows) if line.startswith(f'| {title} |')]
    return {line[1]: line[2:] for line in lines}


ROWS = [row(ANGEN, 0, cpu=2.0, rtf=1.0, sim_per_cpu=100.0, rss_mb=50.0),
        row(EACH, 0, cpu=16.0, rtf=1.0, sim_per_cpu=10.0, rss_mb=500.0),
        row(ONE_LINK, 0, cpu=16.0, rtf=1.0, sim_per_cpu=12.0, rss_mb=500.0),
        row(ANGEN, 100, cpu=3.0, rtf=1.0, sim_per_cpu=50.0, delivered_fast=1.0, rss_mb=60.0),
        row(EACH, 100, cpu=33.0, rtf=0.5, sim_per_cpu=2.0, delivered_fast=0.5, rss_mb=1500.0),
        row(ONE_LINK, 100, cpu=36.0, rtf=1.0, sim_per_cpu=4.0, delivered_fast=0.995, rss_mb=1000.0)]


def test_less_processor_time_a_simulated_second_is_better() -> None:
    found = cells(ROWS, 'CPU of a simulated second at rate 1, %')
    assert found['0'] == ['8', '8', '2', '16', '16']
    assert found['100'] == ['22', '12', '3', '66', '36']


def test_the_cost_of_sensors_is_separated_from_that_of_the_world() -> None:
    assert cells(ROWS, 'the same, above 0 sensors') == {'100': ['50', '20', '1', '50', '20']}
    assert cells(ROWS, 'memory a sensor, MB') == {'100': ['100', '50', '0.1', '10', '5']}


def test_readings_that_were_not_made_count_against_the_speed() -> None:
    assert cells(ROWS, 'simulated s a CPU second, rate 0')['100'][:2] == ['25', '12']
    assert cells(ROWS, 'the same, times the share of readings made')['100'][0] == '50'
    assert [line for line in bench_vs.table(ROWS) if 'only part of' in line] == [
        'Gazebo, a model a sensor made only part of its readings at rate 0: 100: 50 %']


@pytest.mark.parametrize('angen,peer', [(None, 1.0), (1.0, None), (0.0, 1.0), (1.0, -1.0)])
def test_no_ratio_of_missing_values_or_of_noise(angen: float | None, peer: float | None
                                                ) -> None:
    assert bench_vs.ratio(bench_vs.QUESTIONS[0], angen, peer) is None


def test_a_run_that_was_cut_short_has_a_table_too(tmp_path: Path) -> None:
    assert cells(ROWS[:1], 'CPU of a simulated second at rate 1, %') == {'0': ['2']}
    found = cells(ROWS[:5], 'CPU of a simulated second at rate 1, %')
    assert found['100'] == ['22', '', '3', '66', '']
    bench_vs.draw(tmp_path / 'a.png', ROWS[:5])
    assert (tmp_path / 'a.png').read_bytes().startswith(b'\x89PNG')


def test_csv_has_a_line_a_count_and_simulator(tmp_path: Path) -> None:
    bench_vs.write_csv(tmp_path / 'new/a.csv', ROWS)
    with (tmp_path / 'new/a.csv').open() as file:
        read = list(csv.DictReader(file))
    assert tuple(read[0]) == bench_vs.COLUMNS
    assert [(r['count'], r['simulator']) for r in read[:2]] == [('0', 'angen'), ('0', 'gazebo')]
    assert (read[3]['cpu'], read[3]['gone_ms']) == ('3', '')
