"""The table of angen bench core, from a report as google-benchmark writes it."""
import json

import pytest

from angen_bench import core as bench_core
from angen_tools.common.failure import Failure


def report(*runs: tuple[str, float, str]) -> str:
    return json.dumps({'benchmarks': [
        {'name': name, 'cpu_time': time, 'time_unit': unit, 'iterations': 3, 'bytes': 12.0}
        for name, time, unit in runs]})


def test_times_are_reported_in_ns_whatever_their_unit() -> None:
    cases = bench_core.cases_of(report(('a', 2.0, 'us'), ('b/iterations:5', 3.0, 'ms')))
    assert [(case.name, case.cpu_ns) for case in cases] == [('a', 2e3), ('b', 3e6)]
    assert cases[0].counters == {'bytes': 12.0}


TWO, TWENTY = 'storeys/floors:2/noise:0', 'storeys/floors:20/noise:0'


def test_ratios_stand_in_front() -> None:
    cases = bench_core.cases_of(report(
        ('other', 1.0, 'ns'), (TWO, 4.0, 'ms'), (TWENTY, 5.0, 'ms')))
    rows = bench_core.rows_of(cases, 'abc')
    assert [row['case'] for row in rows] == [TWENTY, 'other', TWO]
    assert (rows[0]['ratio'], rows[0]['against']) == ('1.25', TWO)
    assert {row['commit'] for row in rows} == {'abc'}


def test_a_case_whose_rival_was_not_run_has_no_ratio() -> None:
    cases = bench_core.cases_of(report((TWENTY, 5.0, 'ms')))
    assert bench_core.rows_of(cases, 'abc')[0]['ratio'] == ''


def test_a_missing_program_is_reported_with_its_build(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('CMAKE_PREFIX_PATH', '/nowhere')
    with pytest.raises(Failure, match='benches'):
        bench_core.program('core_bench')
