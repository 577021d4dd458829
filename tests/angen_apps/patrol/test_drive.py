"""The states of doors as the robot of a patrol knows them."""
from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from angen_msgs.msg import DoorState

from angen_apps.patrol.drive import Patrol, RosRobot
from angen_apps.robot.interface import Event
from angen_apps.robot.planner import Door

TICK, CYCLE = 0.001, 0.1


def state(mode: int) -> Any:
    message = DoorState()
    message.mode = mode
    return message


class Lockstep:
    """A door that is shut at 0.1 s, the end of the first cycle: its state says so a tick later."""

    def __init__(self) -> None:
        self.now, self.tick = 0.0, TICK
        self.events: list[Event] = []
        self.states = [(0.1, DoorState.CLOSING), (0.101, DoorState.CLOSED)]

    def send(self, topic: str, message: Any) -> None:
        pass

    def run(self) -> None:
        self.now += CYCLE
        if len(self.events) == 0:
            self.events.append(Event(0.1, 'hall0', 'door', 'closed', ''))

    def latest(self, topic: str, since: float = -1.0) -> Any:
        time, mode = [state for state in self.states if state[0] <= self.now + 1e-9][-1]
        assert time >= since - 1e-6, 'it would wait for ever'
        return state(mode)


def test_the_state_after_an_event_at_the_end_of_a_cycle_is_read_in_the_next() -> None:
    lockstep = Lockstep()
    scene = SimpleNamespace(doors={0: [Door('hall0', (0.0, 0.0), 0.0, 1.5, 0.9)]},
                            start=SimpleNamespace(robot=SimpleNamespace(topic='/odom'),
                                                  laser=SimpleNamespace(topic='/scan')))
    route: Any = SimpleNamespace(robot='turtlebot', elevator=None)
    robot = RosRobot(route, scene, lockstep)  # type: ignore[arg-type]
    robot._states['door', 'hall0'] = state(DoorState.CLOSING)
    robot.cycle(0.0, 0.0)
    assert robot.door('hall0').mode == 'CLOSING'
    robot.cycle(0.0, 0.0)
    assert robot.door('hall0').mode == 'CLOSED'


def test_the_progress_names_the_items_of_the_table() -> None:
    patrol: Any = SimpleNamespace(
        _noted_events=0, _scene=SimpleNamespace(
            rooms=dict.fromkeys(('eye', 'beam', 'lux'), 'hall0')),
        _robot=SimpleNamespace(events=[
            Event(time, source, kind, event, '') for time, source, kind, event in (
                (1.0, 'eye', 'pir', 'motion'), (2.0, 'eye', 'pir', 'clear'),
                (3.0, 'beam', 'switch', 'closed'), (4.0, 'lux', 'luminosity', 'changed'))]))
    assert Patrol._detections(patrol, 'hall0 east').endswith(': eye, beam')
