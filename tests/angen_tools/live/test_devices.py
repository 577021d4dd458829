"""Devices that come and go, with a simulator that is a dictionary."""
from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
import rospy
from angen_msgs.msg import DoorState, DoorStateArray
from angen_tools.live import devices
from angen_tools.live.devices import Devices


class Simulator:
    """Answers /angen/list, and counts who subscribes to what."""

    def __init__(self) -> None:
        self.entities: list[Any] = []
        self.topics: dict[str, Any] = {}
        self.ends = False

    def proxy(self, name: str, _: type) -> Any:
        assert name == '/angen/list'
        self.wait_for_service = lambda: None
        return self

    def __call__(self, kind: str) -> Any:
        if self.ends:
            raise rospy.ServiceException('it ends')
        return SimpleNamespace(entities=[e for e in self.entities if e.kind == kind])

    def subscribe(self, topic: str, kind: type, handle: Any, *given: Any) -> Any:
        self.topics[topic] = lambda message: handle(*given, message)
        return SimpleNamespace(unregister=lambda: self.topics.pop(topic))

    def add(self, kind: str, name: str, x: float = 0.0, topic: str = '',
            message: str = 'DoorState') -> None:
        pose = SimpleNamespace(position=SimpleNamespace(x=x, y=0.0, z=0.0))
        self.entities.append(SimpleNamespace(kind=kind, name=name, topic=topic or f'/{name}',
                                             type=f'angen_msgs/{message}', pose=pose))


@pytest.fixture
def simulator(monkeypatch: pytest.MonkeyPatch) -> Simulator:
    simulator = Simulator()
    monkeypatch.setattr(devices.rospy, 'ServiceProxy', simulator.proxy)
    simulator.add('door', 'a')
    simulator.add('lamp', 'l')
    return simulator


def followed(simulator: Simulator) -> Devices[Any]:
    return Devices(['door'], lambda entity: {'name': entity.name},
                   lambda thing, state: thing.update(mode=state.mode),
                   simulator.subscribe, lambda thing, entity: thing.update(
                       x=entity.pose.position.x))


def states(**modes: int) -> DoorStateArray:
    """The states of doors, as with topics:=kind."""
    return DoorStateArray(names=list(modes), readings=[
        DoorState(name=name, mode=mode) for name, mode in modes.items()])


def test_states_reach_the_thing_of_their_device(simulator: Simulator) -> None:
    doors = followed(simulator)
    assert list(doors.of('door')) == ['a'] and doors.of('lamp') == {}
    simulator.topics['/a'](DoorState(name='a', mode=3))
    assert doors.of('door')['a'] == {'name': 'a', 'mode': 3}


def test_added_removed_and_moved_models_are_followed(simulator: Simulator) -> None:
    doors = followed(simulator)
    simulator.add('door', 'b')
    assert not doors.changed
    simulator.topics['/angen/events'](SimpleNamespace(event='opened'))
    assert not doors.changed
    simulator.topics['/angen/events'](SimpleNamespace(event='spawned'))
    assert doors.changed
    kept = doors.of('door')['a']
    doors.survey()
    assert not doors.changed and list(doors.of('door')) == ['a', 'b']
    assert doors.of('door')['a'] is kept
    del simulator.entities[0]
    simulator.add('door', 'b', 2.0)
    del simulator.entities[1]
    doors.survey()
    assert list(doors.of('door')) == ['b'] and doors.of('door')['b']['x'] == 2.0
    assert '/a' not in simulator.topics


def test_a_simulator_that_ends_is_asked_again(simulator: Simulator) -> None:
    doors = followed(simulator)
    simulator.ends = True
    doors.survey()
    assert doors.changed and list(doors.of('door')) == ['a']


def test_devices_may_share_a_topic(simulator: Simulator) -> None:
    del simulator.entities[0]
    for name in 'ab':
        simulator.add('door', name, topic='/doors', message='DoorStateArray')
    doors = followed(simulator)
    simulator.topics['/doors'](states(a=1, b=2))
    assert [door['mode'] for door in doors.of('door').values()] == [1, 2]
    simulator.topics['/doors'](states(b=3, c=4))  # before c is known
    simulator.add('door', 'c', topic='/doors', message='DoorStateArray')
    doors.survey()
    assert [door['mode'] for door in doors.of('door').values()] == [1, 3, 4]
    simulator.entities = [e for e in simulator.entities if e.name != 'b']
    doors.survey()
    assert list(doors.of('door')) == ['a', 'c'] and '/doors' in simulator.topics
    simulator.entities.clear()
    doors.survey()
    assert doors.of('door') == {} and '/doors' not in simulator.topics
