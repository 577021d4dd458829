"""Several people who are sent through one door or corridor at the same time, from both sides."""
from math import hypot
from random import Random
from typing import Callable

import pytest

import angen
from sdf_text import DOORS, box, include, person

# Two rooms of 7 m x 4 m, and a door between them, from 0 to 0.99 m.
ROOMS = ''.join(box(name, pose, size, True) for name, pose, size in (
    ('wall_west', '-1.55 0.06 1.3 0 0 0', '2.9 0.12 2.6'),
    ('wall_east', '2.55 0.06 1.3 0 0 0', '2.9 0.12 2.6'),
    ('north', '0.5 4 1.3 0 0 0', '8 0.1 2.6'), ('south', '0.5 -4 1.3 0 0 0', '8 0.1 2.6'),
    ('west', '-3 0 1.3 0 0 0', '0.1 8 2.6'), ('east', '4 0 1.3 0 0 0', '0.1 8 2.6')))
DOOR = include('kitchen_door', 'kitchen_door0')


@pytest.mark.parametrize('closes', ['false', 'true'])
@pytest.mark.parametrize('count', [2, 3, 4])
def test_people_from_both_sides_get_through_a_door(world: Callable[..., angen.World], count: int,
                                                   closes: str) -> None:
    people, goals = '', []
    for i in range(count):
        side, pair = 1 - 2 * (i % 2), i // 2
        people += person(f'{-1.2 + 0.8 * pair + 0.1 * i} {side * (1.6 + 0.5 * pair)} 0 0 0 0',
                         f'<closes_doors>{closes}</closes_doors>', f'p{i}')
        goals.append((-1.0 + 0.9 * pair + 0.2 * i, -side * (2.6 - 0.5 * pair)))
    w = world(ROOMS + DOOR + people, DOORS)
    w.run(1.0)
    for i, goal in enumerate(goals):
        w.command('person', f'p{i}', f'GoTo {goal[0]} {goal[1]}')
    w.run(90.0)
    for i, goal in enumerate(goals):
        state = w.device('person', f'p{i}')
        assert hypot(state['x'] - goal[0], state['y'] - goal[1]) < 0.1, f'p{i} of {count}'


def crowd(world: Callable[..., angen.World], walls: str, starts: list[tuple[float, float]],
          goals: list[tuple[float, float]]) -> angen.World:
    people = ''.join(person(f'{x} {y} 0 0 0 0', name=f'p{i}') for i, (x, y) in enumerate(starts))
    w = world(walls + people)
    w.run(1.0)
    for i, (x, y) in enumerate(goals):
        w.command('person', f'p{i}', f'GoTo {x} {y}')
    return w


def arrive(w: angen.World, goals: list[tuple[float, float]], limit: float) -> None:
    """All of them, within `limit` s."""
    def left() -> list[str]:
        states = [w.device('person', f'p{i}') for i in range(len(goals))]
        return [f'p{i}' for i, (s, (x, y)) in enumerate(zip(states, goals))
                if hypot(s['x'] - x, s['y'] - y) > 0.25]
    while left() and w.time < limit:
        w.run(2.0)
    assert not left()


def between_rooms(width: float, deep: float) -> str:
    """The walls of two rooms, and of what is between them."""
    middle, far = width / 2 + 2.5, 5 + deep / 2 - 0.06
    return ''.join(box(f'wall{side}', f'{side * middle} 0 1.3 0 0 0', f'5 {deep} 2.6', True)
                   + box(f'far{side}', f'0 {side * far} 1.3 0 0 0', '11 0.1 2.6', True)
                   + box(f'end{side}', f'{5.4 * side} 0 1.3 0 0 0', '0.1 16 2.6', True)
                   for side in (-1, 1))


@pytest.mark.parametrize('width, deep, limit', [(0.8, 0.12, 60.0), (0.95, 0.12, 60.0),
                                                (0.8, 6.0, 90.0), (1.0, 6.0, 90.0)])
def test_ten_people_from_both_sides_get_through_what_is_too_narrow_for_two(
        world: Callable[..., angen.World], width: float, deep: float, limit: float) -> None:
    """A doorway, and a corridor between two rooms."""
    more, starts, goals = deep / 2 - 0.06, [], []
    for i in range(10):
        side, k = 1 - 2 * (i % 2), i // 2
        starts.append((-2.0 + k + 0.05 * i, side * (1.6 + more + 0.4 * (k % 3))))
        goals.append((-2.0 + k, -side * (2.0 + more + 0.5 * (k % 3))))
    arrive(crowd(world, between_rooms(width, deep), starts, goals), goals, limit)


@pytest.mark.parametrize('ahead', [1.0, -1.0])
def test_one_of_two_who_meet_where_only_one_fits_walks_back(world: Callable[..., angen.World],
                                                            ahead: float) -> None:
    goals = [(0.0, 4.5 * ahead), (0.0, -4.5 * ahead)]
    w = crowd(world, between_rooms(1.0, 6.0), [(0.0, -1.5 * ahead), (0.0, 1.0 * ahead)], goals)
    arrive(w, goals, 40.0)


@pytest.mark.parametrize('width, each, bends', [(1.2, 5, False), (1.2, 5, True), (1.2, 8, False),
                                                (1.5, 5, False)])
@pytest.mark.parametrize('seed', [1, 2])
def test_two_rows_of_people_pass_each_other_in_a_corridor(
        world: Callable[..., angen.World], width: float, each: int, bends: bool, seed: int) -> None:
    """They begin in the middle, one behind the other, and keep to the right."""
    half, numbers = width / 2, Random(seed)

    def place(on: float, aside: float) -> tuple[float, float]:
        """`on` m along the corridor, from the middle of it, and to the left of that."""
        return (-aside, on) if bends and on > 0 else (on, aside)
    walls = ''.join(box(f'wall{side}', f'0 {side * (half + 0.1)} 1.3 0 0 0', '20 0.2 2.6', True)
                    for side in (-1, 1))
    if bends:
        walls = (box('south', f'-4 {-half - 0.1} 1.3 0 0 0', '12 0.2 2.6', True)
                 + box('east', f'{half + 0.1} 4 1.3 0 0 0', '0.2 12 2.6', True)
                 + box('inner', f'{-half - 4} {half + 4} 1.3 0 0 0', '8 8 2.6', True))
    starts, goals = [], []
    for i in range(2 * each):
        ahead, k = 1 - 2 * (i % 2), i // 2
        starts.append(place(-ahead * (1.6 + 0.8 * k), numbers.uniform(-0.15, 0.15)))
        goals.append(place(ahead * (1.6 + 0.8 * (each - 1 - k)), -ahead * (half - 0.27)))
    arrive(crowd(world, walls, starts, goals), goals, 40.0)
