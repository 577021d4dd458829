"""A person who is sent to places that it reaches only nearly, or not at all: it does not try for
ever."""
import numpy as np
import pytest

from sdf_text import box, person


@pytest.mark.parametrize('beside', [0.2, 0.225, 0.24, 0.252, 0.26, 0.27])
def test_a_goal_beside_a_wall_is_reached_nearly(world, beside):
    w = world(box('wall', f'0 {beside + 0.05} 1.2 0 0 0', '19 0.1 2.4', True)
              + person('-5 -1 0 0 0 0'))
    w.run(0.3)
    w.command('person', 'ann', 'GoTo 5 0')
    w.run(90.0)
    state = w.device('person', 'ann')
    assert state['mode'] == 'STANDING'
    assert np.hypot(state['x'] - 5.0, state['y']) < 0.25


def corridor(world, aside: float):
    """Ann in a closed corridor of 1.2 m, and Bob beside its middle."""
    walls = ''.join(box(f'side{y}', f'0 {0.65 * y} 1.2 0 0 0', '12.4 0.1 2.4', True)
                    + box(f'end{y}', f'{6.05 * y} 0 1.2 0 0 0', '0.1 1.4 2.4', True)
                    for y in (-1, 1))
    w = world(walls + person('-5 0 0 0 0 0') + person(f'0 {aside} 0 0 0 0', name='bob'))
    w.run(0.3)
    w.command('person', 'ann', 'GoTo 5 0')
    w.run(120.0)
    return w


@pytest.mark.parametrize('aside', [0.1, 0.13])
def test_a_person_who_cannot_pass_another_gives_up(world, aside):
    """He leaves less than the width of a body, 0.5 m."""
    state = corridor(world, aside).device('person', 'ann')
    assert state['mode'] == 'STANDING' and state['why'] == 'bob is in its way'


@pytest.mark.parametrize('aside', [0.2, 0.25])
def test_a_person_squeezes_past_another(world, aside):
    """He leaves 0.05 and 0.1 m more than a body is wide."""
    w = corridor(world, aside)
    ann, bob = (w.device('person', name) for name in ('ann', 'bob'))
    assert ann['x'] > 4.8 and not ann['unreachable']
    assert np.hypot(bob['x'], bob['y'] - aside) < 0.01


@pytest.mark.parametrize('goal', ['5.9 0', '5.95 0', '1.4 1', '5.85 3.85'])
def test_a_goal_too_near_to_a_wall_is_known_at_once(world, goal):
    """No place with room is so near to it that one who stands there has arrived."""
    w = world(box('wall', '6.05 0 1.2 0 0 0', '0.1 10 2.4', True)
              + box('north', '0 4.05 1.2 0 0 0', '12 0.1 2.4', True)
              + box('pillar', '2 1 1.2 0 0 0', '1 1 2.4', True) + person('-2 0 0 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', f'GoTo {goal}')
    w.run(0.2)
    state = w.device('person', 'ann')
    assert state['unreachable'] and state['why'] == 'there is no room for a person'


@pytest.mark.parametrize('goal', ['5.85 0', '1.35 1', '5.8 3.8'])
def test_a_goal_near_enough_to_a_place_with_room_is_reached(world, goal):
    w = world(box('wall', '6.05 0 1.2 0 0 0', '0.1 10 2.4', True)
              + box('north', '0 4.05 1.2 0 0 0', '12 0.1 2.4', True)
              + box('pillar', '2 1 1.2 0 0 0', '1 1 2.4', True) + person('-2 0 0 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', f'GoTo {goal}')
    w.run(15.0)
    assert [e for _, source, _, e, _ in w.events() if source == 'ann' and e == 'arrived']
