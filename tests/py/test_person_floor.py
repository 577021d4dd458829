"""What is not floor is not walked on: holes, edges and open shafts."""
from math import hypot
from typing import Callable

import pytest

import angen
from sdf_text import box, person

UP = 3.0  # m above the ground
# A floor of 14 m x 6 m with a hole of 1.5 m x 2 m for stairs in its middle.
HOLE = ''.join(box(name, f'{x} {y} {UP - 0.1} 0 0 0', f'{dx} {dy} 0.2', True)
               for name, x, y, dx, dy in (
                   ('west', -3.875, 0, 6.25, 6), ('east', 3.875, 0, 6.25, 6),
                   ('north', 0, 2, 1.5, 2), ('south', 0, -2, 1.5, 2)))
FLOOR = box('slab', f'0 0 {UP - 0.1} 0 0 0', '8 6 0.2', True)


def walk(w: angen.World, seconds: float) -> list[tuple[float, float, float]]:
    """Where the person was, ten times a second."""
    places = []
    for _ in range(round(10 * seconds)):
        w.run(0.1)
        state = w.device('person', 'ann')
        places.append((state['x'], state['y'], state['z']))
    return places


@pytest.mark.parametrize('y', [0.0, 0.4, -0.9])
def test_a_person_walks_round_a_hole(world: Callable[..., angen.World], y: float) -> None:
    w = world(HOLE + person(f'-5 {y} {UP} 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', f'GoTo 5 {y}')
    places = walk(w, 25)
    assert min(z for _, _, z in places) > UP - 0.05
    assert hypot(places[-1][0] - 5, places[-1][1] - y) < 0.1
    assert not any(abs(x) < 0.74 and abs(y) < 0.99 for x, y, _ in places)


@pytest.mark.parametrize('goal', ['7 0', '0 0.2', '-3 5'])
def test_a_goal_without_floor_is_given_up(world: Callable[..., angen.World], goal: str) -> None:
    w = world((HOLE if goal == '0 0.2' else FLOOR) + person(f'-3 0 {UP} 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', f'GoTo {goal}')
    assert min(z for _, _, z in walk(w, 20)) > UP - 0.05
    state = w.device('person', 'ann')
    assert state['unreachable'] and state['mode'] == 'STANDING'
    assert state['why'] == 'there is no floor'


@pytest.mark.parametrize('speed', [0.5, 1.0, 1.5])
def test_a_path_over_an_edge_ends_before_it(world: Callable[..., angen.World], speed: float
                                            ) -> None:
    path = (f'<waypoint>0 -3 0 {UP} 0</waypoint><waypoint>{9 / speed} 6 0 {UP} 0</waypoint>'
            '<loop>false</loop>')
    w = world(FLOOR + person(f'-3 0 {UP} 0 0 0', path))
    places = walk(w, 25)
    assert min(z for _, _, z in places) > UP - 0.05
    assert 3.3 < max(x for x, _, _ in places) < 4.0
    assert w.device('person', 'ann')['mode'] == 'BLOCKED'


@pytest.mark.parametrize('avoid', ['true', 'false'])
@pytest.mark.parametrize('speed', [0.5, 1.0, 1.5])
def test_a_path_over_a_hole_ends_before_it_for_who_pushes_too(
        world: Callable[..., angen.World], speed: float, avoid: str) -> None:
    path = (f'<waypoint>0 -3 0 {UP} 0</waypoint><waypoint>{6 / speed} 3 0 {UP} 0</waypoint>'
            f'<loop>false</loop><avoid>{avoid}</avoid>')
    w = world(HOLE + person(f'-3 0 {UP} 0 0 0', path))
    assert min(z for _, _, z in walk(w, 40)) > UP - 0.05


@pytest.mark.parametrize('order, why', [
    ('PushTo 0 0', 'there is no floor'), ('PushTo 7.5 0', 'there is no floor'),
    ('PushTo 5 0', 'no way leads there'), ('GoTo 6.9 2.9', 'there is no room for a person')])
def test_a_way_without_floor_is_given_up_at_once(world: Callable[..., angen.World], order: str,
                                                 why: str) -> None:
    w = world(HOLE + person(f'-5 0 {UP} 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', order)
    w.run(0.2)
    state = w.device('person', 'ann')
    assert state['unreachable'] and state['why'] == why
    assert all(hypot(x + 5, y) < 0.05 and z > UP - 0.05 for x, y, z in walk(w, 10))


@pytest.mark.parametrize('depth', [0.3, 0.6, 1.9])
def test_what_is_pushed_falls_over_an_edge_and_who_pushes_does_not(
        world: Callable[..., angen.World], depth: float) -> None:
    """The deepest reaches over the hole, and hides it all the way."""
    crate = box('crate', f'-3 0 {UP + 0.31} 0 0 0', f'{depth} 0.6 0.6', mass=10.0)
    path = (f'<waypoint>0 -5 0 {UP} 0</waypoint><waypoint>20 5 0 {UP} 0</waypoint>'
            '<loop>false</loop><avoid>false</avoid>')
    w = world(HOLE + crate + person(f'-5 0 {UP} 0 0 0', path))
    places = walk(w, 40)
    assert min(z for _, _, z in places) > UP - 0.05
    assert -2.5 < max(x for x, _, _ in places) < -0.75


def test_who_walks_on_floor_pushes_as_before(world: Callable[..., angen.World]) -> None:
    crate = box('crate', f'-3 0 {UP + 0.31} 0 0 0', '0.6 0.6 0.6', mass=10.0)
    w = world(FLOOR + crate + person(f'-3.7 0 {UP} 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', 'PushTo 2 0')
    walk(w, 30)
    assert w.device('person', 'ann')['x'] > 1.9 and w.motion('crate')[0][0] > 2.0


def test_nobody_arrives_a_storey_below(world: Callable[..., angen.World]) -> None:
    w = world(FLOOR + person(f'3 0 {UP} 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', 'GoTo 3 2.4')
    w.run(0.5)
    w.set_state('ann', (4.8, 0.5, UP, 0.0, 0.0, 0.0))
    w.run(20.0)
    state = w.device('person', 'ann')
    assert state['z'] < 0.1 and state['why'] == 'it has fallen from its floor'
    assert not [e for _, _, _, e, _ in w.events() if e == 'arrived']
