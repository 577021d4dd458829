"""A person who is sent to places that it reaches only nearly, or not at all: it does not try for
ever."""
from __future__ import annotations

import numpy as np
import pytest

from sdf_text import box


def person(pose: str, name: str = 'ann') -> str:
    return f'<actor name="{name}"><pose>{pose}</pose></actor>'


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


@pytest.mark.parametrize('aside', [0.1, 0.2, 0.25])
def test_a_person_who_cannot_pass_another_gives_up(world, aside):
    """In a closed corridor of 1.2 m, where the other one leaves less than a body's width."""
    walls = ''.join(box(f'side{y}', f'0 {0.65 * y} 1.2 0 0 0', '12.4 0.1 2.4', True)
                    + box(f'end{y}', f'{6.05 * y} 0 1.2 0 0 0', '0.1 1.4 2.4', True)
                    for y in (-1, 1))
    w = world(walls + person('-5 0 0 0 0 0') + person(f'0 {aside} 0 0 0 0', 'bob'))
    w.run(0.3)
    w.command('person', 'ann', 'GoTo 5 0')
    w.run(120.0)
    state = w.device('person', 'ann')
    assert state['mode'] == 'STANDING' and state['unreachable']
