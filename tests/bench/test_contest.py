"""The contest continues where Gazebo fails."""
from contextlib import suppress

import pytest

from angen_bench import contest as bench_contest
from angen_bench.contest_report import ANGEN, EACH, ONE_LINK, Row, Session
from angen_bench.sensors import Case
from angen_tools.cli import main as cli
from angen_tools.common.failure import Failure
from angen_tools.common.progress import Steps


def row(simulator: str, count: int, **figures: float) -> Row:
    return Row(kind='pir', count=count, simulator=simulator, **figures)


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
        bench_contest.measure_case(contest, Case('added', 'pir', 5, 2), 2, Steps(6), rows)
    return [(row.simulator, row.repeats) for row in rows]


def test_the_bench_continues_where_gazebo_stops(capsys: pytest.CaptureFixture[str]) -> None:
    assert play(Played(2, Failure('Gazebo has stopped'))) == [(ANGEN, 2), (EACH, 1), (ONE_LINK, 2)]
    assert 'angen: pir 5: Gazebo has stopped\n' in capsys.readouterr().err
    with pytest.raises(Failure, match='the node ended'):
        play(Played(4, Failure('the node ended')))


def test_ctrl_c_keeps_the_measurements() -> None:
    assert play(Played(5, KeyboardInterrupt())) == [(ANGEN, 2), (EACH, 1), (ONE_LINK, 1)]
    assert play(Played(1, KeyboardInterrupt())) == []


def test_contact_sensors_have_no_common_link() -> None:
    assert bench_contest.simulators('contact') == (ANGEN, EACH)
    assert bench_contest.simulators('pir') == (ANGEN, EACH, ONE_LINK)


def test_sensors_that_are_spawned_are_not_compared(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(['bench', 'sensors', '--vs', 'gazebo', '--mode', 'deployed']) == 1
    assert 'give --mode added' in capsys.readouterr().err
