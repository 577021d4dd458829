"""angen bench sensors --vs gazebo, as far as it goes without Gazebo: parsing, ratios, refusals."""
from __future__ import annotations

import csv
import os
import subprocess
from contextlib import suppress
from pathlib import Path

import pytest
from angen_tools import bench_contest, bench_report, bench_vs, cli
from angen_tools.bench import Bar, Case
from angen_tools.bench_gazebo import parse
from angen_tools.bench_vs import ANGEN, EACH, ONE_LINK, Row, Session
from angen_tools.failure import Failure

SCRIPT = Path(__file__).resolve().parents[2] / 'bench/gazebo/make_chroot'


def row(simulator: str, count: int, **figures: float) -> Row:
    return Row(kind='pir', count=count, simulator=simulator, **figures)


@pytest.mark.parametrize('line,said', [
    ('probe sample 12.5 3.25 40 4\n', ('sample', [12.5, 3.25, 40.0, 4.0])),
    ('probe first 12.5', ('first', [12.5])),
    ('[Wrn] a probe of something', None), ('probe', None), ('probe gone', None),
    ('probe first soon', None), ('', None)])
def test_lines_of_the_probe_are_told_from_others(line: str, said: tuple[str, list[float]] | None
                                                 ) -> None:
    assert parse(line) == said


def test_a_row_has_the_median_of_what_was_measured() -> None:
    made = bench_report.combine([Session(cpu=1.0), Session(cpu=5.0, gone_ms=7.0), Session(cpu=2.0)],
                                Row, kind='pir', count=3, simulator=EACH)
    assert (made.cpu, made.gone_ms, made.rtf, made.repeats) == (2.0, 7.0, None, 3)


def cells(rows: list[Row], title: str) -> dict[str, list[str]]:
    """What the table's lines of a question say, by count."""
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


def test_what_sensors_add_is_told_apart_from_the_world() -> None:
    assert cells(ROWS, 'the same, above 0 sensors') == {'100': ['50', '20', '1', '50', '20']}
    assert cells(ROWS, 'memory a sensor, MB') == {'100': ['100', '50', '0.1', '10', '5']}


def test_readings_that_were_not_made_count_against_the_speed() -> None:
    assert cells(ROWS, 'simulated s a CPU second, rate 0')['100'][:2] == ['25', '12']
    assert cells(ROWS, 'the same, times the share of readings made')['100'][0] == '50'
    assert [line for line in bench_vs.table(ROWS) if 'only so many' in line] == [
        'Gazebo, a model a sensor made only so many of its readings at rate 0: 100: 50 %']


@pytest.mark.parametrize('angen,peer', [(None, 1.0), (1.0, None), (0.0, 1.0), (1.0, -1.0)])
def test_no_ratio_of_what_is_missing_or_lost_in_noise(angen: float | None, peer: float | None
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


class Played:
    """A contest whose Gazebo, or whose user, stops at a session of that number."""

    def __init__(self, stops: int, error: BaseException) -> None:
        self._left, self._error = stops, error

    def session(self, simulator: str, case: Case) -> Session:
        self._left -= 1
        if self._left == 0:
            raise self._error
        return Session(cpu=1.0)


def play(contest: Played) -> list[tuple[str, int]]:
    """(simulator, repeats) of each row of two repeats."""
    rows: list[Row] = []
    with suppress(KeyboardInterrupt):
        bench_contest.measure_case(contest, Case('added', 'pir', 5, 2), 2, Bar(6), rows)
    return [(row.simulator, row.repeats) for row in rows]


def test_where_gazebo_stops_the_bench_goes_on(capsys: pytest.CaptureFixture[str]) -> None:
    assert play(Played(2, Failure('Gazebo has stopped'))) == [(ANGEN, 2), (EACH, 1), (ONE_LINK, 2)]
    assert 'angen: pir 5: Gazebo has stopped\n' in capsys.readouterr().err
    with pytest.raises(Failure, match='the node ended'):
        play(Played(4, Failure('the node ended')))


def test_ctrl_c_keeps_what_is_measured() -> None:
    assert play(Played(5, KeyboardInterrupt())) == [(ANGEN, 2), (EACH, 1), (ONE_LINK, 1)]
    assert play(Played(1, KeyboardInterrupt())) == []


def test_contact_sensors_have_no_common_link() -> None:
    assert bench_contest.simulators('contact') == (ANGEN, EACH)
    assert bench_contest.simulators('pir') == (ANGEN, EACH, ONE_LINK)


def test_the_chroot_is_made_by_root_alone() -> None:
    nobody = ['setpriv', '--reuid=65534', '--clear-groups'] if os.geteuid() == 0 else []
    made = subprocess.run([*nobody, 'bash', '-s', '/nowhere'], input=SCRIPT.read_text(),
                          capture_output=True, text=True, check=False)
    assert (made.returncode, made.stderr) == (1, '')
    assert made.stdout == ('Gazebo runs in a chroot, which root alone can make: run it as root, '
                           'with sudo\n')


def make_chroot(folder: Path, debootstrap: str) -> subprocess.CompletedProcess[str]:
    """Runs the script where the only debootstrap is one that does that, or none."""
    for program in ('bash', 'dirname', 'readlink', 'mkdir', 'rm'):
        (folder / program).symlink_to(f'/usr/bin/{program}')
    if debootstrap:
        (folder / 'debootstrap').write_text(f'#!/bin/sh\n{debootstrap}\n')
        (folder / 'debootstrap').chmod(0o755)
    return subprocess.run(['/usr/bin/bash', str(SCRIPT), str(folder / 'chroot')],
                          env={'PATH': str(folder)}, capture_output=True, text=True, check=False)


as_root = pytest.mark.skipif(os.geteuid() != 0, reason='needs root')


@as_root
def test_a_missing_debootstrap_is_named(tmp_path: Path) -> None:
    made = make_chroot(tmp_path, '')
    assert made.returncode == 1
    assert made.stdout == 'Gazebo needs debootstrap: apt-get install debootstrap\n'


@as_root
def test_without_a_mirror_nothing_is_left_but_the_log(tmp_path: Path) -> None:
    made = make_chroot(tmp_path, 'echo "no net for $4"; exit 1')
    assert made.returncode == 1
    assert made.stdout.splitlines() == [
        f'debootstrap has not reached a mirror of Debian 11; see {tmp_path}/chroot.log']
    assert not (tmp_path / 'chroot').exists() and not (tmp_path / 'chroot.part').exists()
    assert 'no net for http://archive.debian.org' in (tmp_path / 'chroot.log').read_text()


def test_the_bench_says_the_refusal_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                                capsys: pytest.CaptureFixture[str]) -> None:
    script = tmp_path / 'make_chroot'
    script.write_text('#!/bin/sh\necho "it cannot be made"\nexit 1\n')
    script.chmod(0o755)
    monkeypatch.setattr('angen_tools.bench_gazebo.script', lambda: script)
    words = ['bench', 'sensors', '--kind', 'pir', '--vs', 'gazebo', '-o', str(tmp_path / 'out')]
    assert cli.run(words) == 1
    assert capsys.readouterr().err == 'angen: it cannot be made\n'
    assert not (tmp_path / 'out').exists()


def test_sensors_that_are_spawned_are_not_compared(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(['bench', 'sensors', '--vs', 'gazebo', '--mode', 'deployed']) == 1
    assert 'give --mode added' in capsys.readouterr().err
