"""A door's commands by requests, and its reports."""
import pytest
from angen_apps.rmf.doors import Door
from angen_tools.session import State
from genpy import Time
from rmf_door_msgs.msg import DoorMode

OPEN, CLOSED = DoorMode.MODE_OPEN, DoorMode.MODE_CLOSED


def state(mode: str) -> State:
    return State('door', 'bathroom0', 0.0, {'mode': mode})


def door_in(mode: str) -> Door:
    door = Door('bathroom0')
    door.take(state(mode))
    return door


@pytest.mark.parametrize('mode, shown', [
    ('CLOSED', CLOSED), ('OPEN', OPEN), ('OPENING', DoorMode.MODE_MOVING),
    ('CLOSING', DoorMode.MODE_MOVING), ('BLOCKED', DoorMode.MODE_MOVING),
    ('AJAR', DoorMode.MODE_MOVING)])
def test_a_report_has_the_real_mode(mode: str, shown: int) -> None:
    message = door_in(mode).report(Time(3, 5))
    assert (message.door_name, message.door_time) == ('bathroom0', Time(3, 5))
    assert message.current_mode.value == shown


def test_it_reports_nothing_before_it_is_known() -> None:
    assert Door('bathroom0').report(Time(1)) is None


def test_only_another_mode_is_a_change() -> None:
    door = Door('bathroom0')
    assert door.take(state('CLOSED'))
    assert door.take(state('OPENING'))
    assert not door.take(state('OPENING'))
    assert not door.take(state('BLOCKED'))
    assert door.take(state('OPEN'))


def test_a_repeated_request_is_one_command() -> None:
    door = door_in('CLOSED')
    assert door.request(OPEN) == 'Open'
    door.take(state('OPENING'))
    assert door.request(OPEN) == ''
    door.take(state('OPEN'))
    assert door.request(OPEN) == ''
    door.take(state('CLOSING'))  # another client's command
    assert door.request(OPEN) == 'Open'


def test_a_request_does_not_wait_for_the_state_of_the_one_before() -> None:
    door = door_in('CLOSED')
    assert door.request(OPEN) == 'Open'
    assert door.request(CLOSED) == 'Close'


@pytest.mark.parametrize('mode', [1, 3, 4, 2**32 - 1])
def test_other_modes_cannot_be_requested(mode: int) -> None:
    with pytest.raises(ValueError, match=f'bathroom0: requested_mode {mode} is neither'):
        door_in('CLOSED').request(mode)
