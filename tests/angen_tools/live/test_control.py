"""When a command waits for others."""
from __future__ import annotations

from typing import Any

import pytest

from angen_msgs.msg import ElevatorState, ElevatorStateArray, Entity
from angen_tools.common.catalog import kind_of
from angen_tools.common.verbs import parse
from angen_tools.live import control

LIFT = Entity(name='lift', topic='/angen/elevator/lift', type='angen_msgs/ElevatorState')


class Mail:
    """The messages of a topic."""

    sent: list[Any] = []

    def __init__(self, client: object) -> None:
        pass

    def subscribe(self, topic: str, kind: str) -> None:
        assert topic == LIFT.topic

    def until(self, done: Any, limit: float) -> bool:
        return any(done(LIFT.topic, message) for message in self.sent)


@pytest.mark.parametrize('targets, later', [([1], False), ([0, 1], False), ([0, 0], True)])
@pytest.mark.parametrize('together', [False, True])
def test_an_elevator_with_another_target_comes_later(
        targets: list[int], later: bool, together: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(control, 'Mailbox', Mail)
    states = [ElevatorState(name='lift', target_floor=floor) for floor in targets]
    if together:  # with topics:=kind
        other = ElevatorState(name='other', target_floor=1)
        states = [ElevatorStateArray(names=['other', 'lift'], readings=[other, state])
                  for state in states]
    monkeypatch.setattr(Mail, 'sent', states)
    kind = kind_of('elevator')
    assert control.comes_later(object(), kind, parse(kind, ['1']), LIFT) is later


def test_a_lamp_never_comes_later(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(control, 'Mailbox', Mail)
    kind = kind_of('lamp')
    assert not control.comes_later(object(), kind, parse(kind, ['on']), LIFT)
