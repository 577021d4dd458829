"""The rows that angen watch shows, from the summaries of a world."""
from typing import Any, Callable

import pytest
import rospy

from angen_msgs.msg import Stats
from angen_tools.live.summary import Board, Filter
from angen_tools.live.watch import _cells
from angen_tools.session import Entity, Summary


class Simulator:
    """Has summaries and statistics."""

    def __init__(self) -> None:
        self.robots: list[Entity] = []
        self.stats = Stats(sim_time=rospy.Time(1))
        self.rows = [summary('pir', 'kitchen_pir0', 'still', period=0.1),
                     summary('pir', 'bath_pir0', 'MOTION', alarm=True, period=0.1),
                     summary('lamp', 'kitchen0', 'off'), summary('camera', 'eye', ''),
                     summary('reed', 'kitchen_reed', '', period=1.0)]

    def entities(self) -> list[Entity]:
        return [Entity('camera', 'eye', 'eye', (0.0,) * 7, 'cellar0'), *self.robots]

    def summaries(self) -> dict[tuple[str, str], Summary]:
        return {(row.kind, row.name): row for row in self.rows}

    def until(self, condition: Callable[[], Any], limit: float) -> bool:
        return bool(condition())


def summary(kind: str, name: str, text: str, alarm: bool = False, at: float = 1.0,
            period: float = 0.0) -> Summary:
    return Summary(kind, name, text, alarm, at, (), period)


@pytest.fixture
def simulator() -> Simulator:
    return Simulator()


@pytest.fixture
def board(simulator: Simulator) -> Board:
    return Board(simulator)


def names(board: Board, **words: Any) -> list[str]:
    return [row.name for row in board.chosen(Filter(**words))]


def test_rows_come_by_kind_and_name(board: Board) -> None:
    assert names(board) == ['eye', 'kitchen0', 'bath_pir0', 'kitchen_pir0', 'kitchen_reed']


@pytest.mark.parametrize('words, rows', [
    ({'kinds': ['pir']}, ['bath_pir0', 'kitchen_pir0']),
    ({'kinds': ['pir', 'lamp'], 'room': 'Kitchen'}, ['kitchen0', 'kitchen_pir0']),
    ({'names': ['eye', 'kitchen0']}, ['eye', 'kitchen0']),
    ({'room': 'attic'}, []), ({'room': 'cellar'}, ['eye']), ({'active': True}, ['bath_pir0'])])
def test_filters(board: Board, words: Any, rows: list[str]) -> None:
    assert names(board, **words) == rows


def test_what_changes_is_active(board: Board, simulator: Simulator) -> None:
    assert not board.receive(0.1)
    simulator.rows[0] = summary('pir', 'kitchen_pir0', 'still 0.2', at=2.0)  # a PIR has alarms
    simulator.rows[2] = summary('lamp', 'kitchen0', 'on', at=2.0)
    assert board.receive(0.1)
    assert names(board, active=True) == ['kitchen0', 'bath_pir0']
    assert board.time == 2.0


def test_a_robot_is_where_people_are_by_the_same_coordinates(simulator: Simulator) -> None:
    simulator.rows.append(summary('drive', 'bot', '0.50 m  0.00 m  0.00 rad'))
    simulator.robots = [Entity('drive', 'bot', 'bot', (2.0, 5.0, *(0.0,) * 5), 'hall0')]
    row, = Board(simulator).chosen(Filter(kinds=['drive']))
    assert _cells(row)[2] == ('2.00 m  5.00 m in the world, by its wheels '
                              '0.50 m  0.00 m  0.00 rad')


def test_deleted_entries_are_removed(board: Board, simulator: Simulator) -> None:
    simulator.rows = simulator.rows[2:3]
    assert board.receive(0.1)
    assert names(board) == ['kitchen0']


def test_only_a_sensor_that_publishes_by_itself_is_waited_for(board: Board) -> None:
    assert [row.name for row in board.rows.values() if row.waits] == ['kitchen_reed']


def test_the_statistics_say_whether_time_passes(board: Board, simulator: Simulator) -> None:
    simulator.stats = Stats(paused=True, sim_time=rospy.Time(9))
    board.receive(0.1)
    assert board.paused and board.time == 9
