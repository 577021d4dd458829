"""A door's commands by requests, and its reports."""
from __future__ import annotations

import pytest
from angen_apps.rmf.doors import Door
from angen_msgs.msg import DoorState as State
from genpy import Time
from rmf_door_msgs.msg import DoorMode

OPEN, CLOSED = DoorMode.MODE_OPEN, DoorMode.MODE_CLOSED


def door_in(mode: int) -> Door:
    door = Door('bathroom0')
    door.take(State(mode=mode))
    return door


@pytest.mark.parametrize('mode, shown', [
    (State.CLOSED, CLOSED), (State.OPEN, OPEN), (State.OPENING, DoorMode.MODE_MOVING),
    (State.CLOSING, DoorMode.MODE_MOVING), (State.BLOCKED, DoorMode.MODE_MOVING),
    (State.AJAR, DoorMode.MODE_MOVING)])
def test_a_report_has_the_real_mode(mode: int, shown: int) -> None:
    message = door_in(mode).report(Time(3, 5))
    assert (message.door_name, message.door_time) == ('bathroom0', Time(3, 5))
    assert message.current_mode.value == shown


def test_it_reports_nothing_before_it_is_known() -> None:
    assert Door('bathroom0').report(Time(1)) is None


def test_only_another_mode_is_a_change() -> None:
    door = Door('bathroom0')
    assert door.take(State(mode=State.CLOSED))
    assert door.take(State(mode=State.OPENING, position=-0.1))
    assert not door.take(State(mode=State.OPENING, position=-0.2))
    assert not door.take(State(mode=State.BLOCKED))
    assert door.take(State(mode=State.OPEN))


def test_a_repeated_request_is_one_command() -> None:
    door = door_in(State.CLOSED)
    assert door.request(OPEN) == 'Open'
    door.take(State(mode=State.OPENING))
    assert door.request(OPEN) == ''
    door.take(State(mode=State.OPEN))
    assert door.request(OPEN) == ''
    door.take(State(mode=State.CLOSING))  # another client's command
    assert door.request(OPEN) == 'Open'


def test_a_request_does_not_wait_for_the_state_of_the_one_before() -> None:
    door = door_in(State.CLOSED)
    assert door.request(OPEN) == 'Open'
    assert door.request(CLOSED) == 'Close'


@pytest.mark.parametrize('mode', [1, 3, 4, 2**32 - 1])
def test_other_modes_cannot_be_requested(mode: int) -> None:
    with pytest.raises(ValueError, match=f'bathroom0: requested_mode {mode} is neither'):
        door_in(State.CLOSED).request(mode)
