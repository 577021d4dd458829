"""The rows that angen watch shows, from messages of /angen/summary."""
from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
import rospy

from angen_msgs.msg import Stats, Summary, SummaryEntry
from angen_tools.live import summary
from angen_tools.live.summary import Board, Filter


class Mail:
    """A mailbox that is given its first message."""

    def __init__(self, client: object) -> None:
        pass

    def subscribe(self, topic: str, kind: object) -> None:
        pass

    def until(self, done: Any, limit: float) -> bool:
        return bool(done(summary.TOPIC, message(
            entry('pir', 'kitchen_pir0', 'still', period=0.1),
            entry('pir', 'bath_pir0', 'MOTION', alarm=True, period=0.1),
            entry('lamp', 'kitchen0', 'off'), entry('camera', 'eye', ''),
            entry('reed', 'kitchen_reed', '', period=1.0), complete=True)))


def entry(kind: str, name: str, text: str, **fields: Any) -> SummaryEntry:
    return SummaryEntry(kind=kind, name=name, text=text, **fields)


def message(*entries: SummaryEntry, at: float = 1.0, complete: bool = False) -> Summary:
    made = Summary(complete=complete, entries=list(entries))
    made.header.stamp = rospy.Time(at)
    return made


@pytest.fixture
def board(monkeypatch: pytest.MonkeyPatch) -> Board:
    monkeypatch.setattr(summary, 'Mailbox', Mail)
    listed = [SimpleNamespace(kind='camera', name='eye', room='cellar0')]
    return Board(SimpleNamespace(entities=lambda: listed))


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


def test_what_changes_is_active(board: Board) -> None:
    board.take(summary.TOPIC, message(entry('lamp', 'kitchen0', 'on'),
                                      entry('pir', 'kitchen_pir0', 'still 0.2'), at=2.0))
    assert names(board, active=True) == ['kitchen0', 'bath_pir0']  # a PIR has alarms
    assert board.time == 2.0


def test_a_complete_message_removes_deleted_entries(board: Board) -> None:
    board.take(summary.TOPIC, message(entry('lamp', 'kitchen0', 'off'), complete=True))
    assert names(board) == ['kitchen0']


def test_only_a_sensor_that_publishes_by_itself_is_waited_for(board: Board) -> None:
    assert [row.name for row in board.rows.values() if row.waits] == ['kitchen_reed']


def test_the_statistics_say_whether_time_passes(board: Board) -> None:
    board.take(summary.STATS, Stats(paused=True, sim_time=rospy.Time(9)))
    assert board.paused and board.time == 9
