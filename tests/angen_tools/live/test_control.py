"""When a command waits for others."""
from typing import Any, Callable

import pytest

from angen_tools.common.catalog import kind_of
from angen_tools.common.verbs import parse
from angen_tools.live import control
from angen_tools.session import Entity, State

LIFT = Entity('elevator', 'lift', 'lift', (0.0,) * 7, '', '/angen/elevator/lift',
              'angen_msgs/ElevatorState')


class Simulator:
    """Has some states of the lift, one after the other."""

    def __init__(self, *floors: int) -> None:
        self._floors = list(floors)

    def until(self, condition: Callable[[], Any], limit: float) -> bool:
        return any(condition() for _ in list(self._floors))

    def state(self, kind: str, name: str) -> State:
        return State(kind, name, 0.0, {'target_floor': self._floors.pop(0)})


@pytest.mark.parametrize('floors, later', [([1], False), ([0, 1], False), ([0, 0], True)])
def test_an_elevator_with_another_target_comes_later(floors: list[int], later: bool) -> None:
    kind = kind_of('elevator')
    assert control.comes_later(Simulator(*floors), kind, parse(kind, ['1']), LIFT) is later


def test_a_lamp_never_comes_later() -> None:
    kind = kind_of('lamp')
    assert not control.comes_later(Simulator(), kind, parse(kind, ['on']), LIFT)
