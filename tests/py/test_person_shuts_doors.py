"""Doors that a person shuts: those that it is told to, and those whose leaves are in the way."""
from math import hypot
from pathlib import Path
from typing import Any, Callable

import pytest

import angen
from sdf_text import box
from test_person_other_doors import DOORS, WALL, door

BUILDING = Path(__file__).resolve().parents[2] / 'worlds/angen.world'
Make = Callable[..., angen.World]


def person(name: str, x: float, y: float) -> str:
    return f'<actor name="{name}"><pose>{x} {y} 0 0 0 0</pose></actor>'


def corridor(width: float) -> str:
    """The other walls of a closed corridor that the door opens into."""
    return box('opposite', f'0 {-0.1 - width} 1.2 0 0 0', '12 0.1 2.4', True) + ''.join(
        box(f'end{x}', f'{x} {-0.05 - width / 2} 1.2 0 0 0', f'0.1 {width} 2.4', True)
        for x in (-5.5, 5.5))


def walk(w: angen.World, x: float, y: float, seconds: float, *orders: str) -> dict[str, Any]:
    """Sends her there; the state of the door afterwards."""
    for order in (*orders, f'GoTo {x} {y}'):
        w.command('person', 'ann', order)
    w.run(seconds)
    state = w.device('person', 'ann')
    assert hypot(state['x'] - x, state['y'] - y) < 0.1 and not state['going']
    return w.device('door', 'hall0')


@pytest.mark.parametrize('order, mode', [('CloseDoors', 'CLOSED'), ('LeaveDoors', 'OPEN')])
@pytest.mark.parametrize('start', [-2.0, 2.0])
def test_an_open_door_behind_it_is_shut_if_it_is_told_so(world: Make, start: float, order: str,
                                                         mode: str) -> None:
    w = world(WALL + door() + person('ann', 0.45, start), DOORS)
    w.run(0.3)
    w.command('door', 'hall0', 'Open')
    w.run(6.0)
    assert walk(w, 0.45, -start, 15.0, order)['mode'] == mode
    assert ('<closes_doors>true' in w.save()) == (order == 'CloseDoors')


def test_no_leaf_is_shut_against_another_person(world: Make) -> None:
    w = world(WALL + door() + person('ann', 0.45, -2.0) + person('bob', 1.1, -0.45), DOORS)
    w.run(0.3)
    w.command('door', 'hall0', 'Open')
    w.run(6.0)
    assert walk(w, 0.45, 2.0, 15.0, 'CloseDoors')['mode'] == 'OPEN'


@pytest.mark.parametrize('width, mode', [(1.3, 'CLOSED'), (2.0, 'OPEN')])
@pytest.mark.parametrize('goal', [-4.0, 4.0])
def test_a_leaf_that_closes_off_a_corridor_is_always_shut(world: Make, goal: float, width: float,
                                                          mode: str) -> None:
    w = world(WALL + door() + corridor(width) + person('ann', 0.45, 2.0), DOORS)
    w.run(0.3)
    assert walk(w, goal, -0.1 - width / 2, 25.0)['mode'] == mode


@pytest.mark.parametrize('ahead', [1, -1])
def test_an_open_leaf_in_its_way_is_shut_at_once(world: Make, ahead: int) -> None:
    """She comes along the corridor, across which the leaf of a door to a room stands open."""
    w = world(WALL + door() + corridor(1.3) + person('ann', 0.45 - 4.5 * ahead, -0.75), DOORS)
    w.run(0.3)
    w.command('door', 'hall0', 'Open')
    w.run(6.0)
    w.events()
    assert walk(w, 0.45 + 4.5 * ahead, -0.75, 20.0)['mode'] == 'CLOSED'  # 9 m at 1 m/s
    assert [e for _, source, _, e, _ in w.events() if source == 'ann'].count('blocked') <= 1


def sent(w: angen.World, order: str, seconds: float) -> dict[str, Any]:
    """The state of the person of the building, when it has ended what it was sent for."""
    w.command('person', 'person', order)
    end = w.time + seconds
    w.run(0.5)
    while w.time < end and w.device('person', 'person')['going']:
        w.run(0.5)
    return w.device('person', 'person')


@pytest.mark.parametrize('goal, order', [('kitchen0', 'LeaveDoors'), ('3.5 5', 'LeaveDoors'),
                                         ('kitchen0', 'CloseDoors')])
def test_who_went_out_comes_in_past_a_robot_and_the_leaf(goal: str, order: str) -> None:
    """The robot at its start and the open leaf of the entrance leave 0.5 m, too little to pass."""
    w = angen.World(str(BUILDING), seed=1)
    w.run(1.0)
    assert not sent(w, 'GoTo -1.5 5', 40.0)['why']
    w.command('person', 'person', order)
    state = sent(w, f'GoTo {goal}', 30.0)
    assert not state['going'] and not state['unreachable']
    assert w.room_at(state['x'], state['y'], 0.5) == ('kitchen0' if goal == 'kitchen0'
                                                      else 'entrance0')
    assert w.device('door', 'entrance0')['mode'] == 'CLOSED'


def test_a_person_goes_out_past_a_robot_and_a_leaf_that_stood_open() -> None:
    w = angen.World(str(BUILDING), seed=1)
    w.run(1.0)
    w.command('door', 'entrance0', 'Open')
    w.run(4.0)
    state = sent(w, 'GoTo -1.5 5', 45.0)
    assert not state['going'] and not state['unreachable'] and state['x'] < -1.4


def test_what_is_named_is_what_leaves_no_way() -> None:
    """The robot is in the swing of the leaf, which cannot be shut, and a cabinet is beside them."""
    w = angen.World(str(BUILDING))
    w.run(0.5)
    w.set_state('turtlebot', (8.0, 1.0, 0.0, 0.0, 0.0, 0.0))
    w.command('person', 'person', 'GoTo -1.5 5')
    w.run(20.0)
    w.set_state('turtlebot', (1.35, 5.0, 0.0, 0.0, 0.0, 3.14))
    w.run(0.5)
    state = sent(w, 'GoTo kitchen0', 60.0)
    assert state['unreachable']
    assert state['why'] in ('entrance_door0 is in its way', 'turtlebot is in its way')


def test_it_says_that_it_goes_and_has_arrived(world: Make) -> None:
    w = world(person('ann', 0.0, 0.0))
    w.run(0.3)
    w.events()
    w.command('person', 'ann', 'GoTo 2 0')
    w.run(0.1)
    assert w.device('person', 'ann')['going']
    w.run(5.0)
    assert not w.device('person', 'ann')['going']
    assert [(event, detail) for _, source, _, event, detail in w.events() if source == 'ann'] == [
        ('walks', ''), ('arrived', '2 0'), ('stands', '')]
