"""Commands to devices, and when they are done."""
from __future__ import annotations

import pytest

from angen_msgs.msg import DoorState, ElevatorState, LampState
from angen_tools.live import control


@pytest.mark.parametrize('kind, value, text', [
    ('door', 'Open', 'Open, NAME'), ('door', 'close', 'Close, NAME'),
    ('door', '-1.2', 'Set, NAME, -1.2'), ('elevator', '01', 'Floor1, NAME'),
    ('lamp', 'on', 'On, NAME'), ('lamp', 'off', 'Off, NAME'), ('lamp', '40%', 'Dim, NAME, 40.0')])
def test_commands_are_those_of_the_topics(kind: str, value: str, text: str) -> None:
    assert control.make_order(kind, value).text == text


@pytest.mark.parametrize('kind, value, yes, no', [
    ('door', 'open', DoorState(mode=DoorState.OPENING), DoorState(mode=DoorState.CLOSED)),
    ('door', 'close', DoorState(mode=DoorState.CLOSED), DoorState(mode=DoorState.BLOCKED)),
    ('door', '-1.2', DoorState(target=-1.2), DoorState(target=-1.57)),
    ('elevator', '1', ElevatorState(target_floor=1), ElevatorState(floor=1)),
    ('lamp', 'on', LampState(on=True, level=100), LampState(on=True, level=40)),
    ('lamp', '40', LampState(on=True, level=40), LampState())])
def test_a_command_is_taken_when_its_state_follows(kind: str, value: str, yes: object, no: object
                                                   ) -> None:
    taken = control.make_order(kind, value).taken
    assert taken(yes) and not taken(no)


def test_what_a_command_may_wait_for() -> None:
    standing = ElevatorState(door_mode=ElevatorState.DOOR_OPEN)
    going = ElevatorState(mode=ElevatorState.UP)
    assert control.waits_for('elevator', [standing], False) == ''
    assert control.waits_for('elevator', [going], False) == 'next'
    assert control.waits_for('elevator', [ElevatorState()], False) == 'next'
    assert control.waits_for('door', [DoorState(mode=DoorState.BLOCKED)], False) == ''
    assert 'paused' in control.waits_for('door', [DoorState()], True)
