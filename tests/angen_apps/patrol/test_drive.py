"""The states of doors as the robot of a patrol knows them."""
from types import SimpleNamespace
from typing import Any

from angen_apps.patrol.drive import Patrol, RosRobot
from angen_apps.robot.planner import Door
from angen_tools.session import Event, State

TICK = 0.001


class Node:
    """A door that is shut at 0.1 s, the end of the first cycle: its state says so a tick later."""

    def __init__(self) -> None:
        self.now, self.tick = 0.0, TICK
        self.happened = [Event(0.1, 'hall0', 'door', 'closed', '')]

    def send(self, topic: str, message: object) -> None:
        pass

    def run(self, seconds: float) -> None:
        self.now += seconds

    def events(self) -> list[Event]:
        happened, self.happened = self.happened, []
        return happened

    def states(self, kind: str) -> list[State]:
        return [state(self.now, 'CLOSING'), State('door', 'other', self.now, {'position': 1.0})]

    def state(self, kind: str, name: str, since: float = -1.0) -> State:
        found = [state(0.1, 'CLOSING'), state(0.101, 'CLOSED')]
        latest = [each for each in found if each.time <= self.now + 1e-9][-1]
        assert latest.time >= since - 1e-6, 'it would wait for ever'
        return latest


def state(time: float, mode: str) -> State:
    return State('door', 'hall0', time, {'mode': mode, 'position': 0.5})


def test_the_state_after_an_event_at_the_end_of_a_cycle_is_read_in_the_next() -> None:
    scene = SimpleNamespace(doors={0: [Door('hall0', (0.0, 0.0), 0.0, 1.5, 0.9)]},
                            start=SimpleNamespace(laser=SimpleNamespace(name='scan')))
    route: Any = SimpleNamespace(robot='turtlebot', elevator=None)
    robot = RosRobot(route, scene, Node())  # type: ignore[arg-type]
    robot._states['door', 'hall0'] = state(0.0, 'CLOSING')
    robot.cycle(0.0, 0.0)
    assert robot.door('hall0').mode == 'CLOSING'
    robot.cycle(0.0, 0.0)
    assert robot.door('hall0').mode == 'CLOSED'
    assert robot.door_angles == {'hall0': [(0.1, 0.5), (0.2, 0.5)]}


def test_the_progress_names_the_items_of_the_table() -> None:
    patrol: Any = SimpleNamespace(
        _noted_events=0, _scene=SimpleNamespace(
            rooms=dict.fromkeys(('eye', 'beam', 'lux'), 'hall0')),
        _robot=SimpleNamespace(events=[
            Event(time, source, kind, event, '') for time, source, kind, event in (
                (1.0, 'eye', 'pir', 'motion'), (2.0, 'eye', 'pir', 'clear'),
                (3.0, 'beam', 'switch', 'closed'), (4.0, 'lux', 'luminosity', 'changed'))]))
    assert Patrol._detections(patrol, 'hall0 east').endswith(': eye, beam')
