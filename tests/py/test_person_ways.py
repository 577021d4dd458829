"""Ways of a commanded person: through rooms and doors, or an event where there is none."""
from math import hypot
from typing import Callable, Iterator

import numpy as np
import pytest

import angen
from sdf_text import DOORS, box, include, person

# A wall along x with an opening from 0 to 0.99 m.
WALL = (box('wall_west', '-5.05 0.06 1.2 0 0 0', '9.9 0.12 2.4', True)
        + box('wall_east', '5.55 0.06 1.2 0 0 0', '8.9 0.12 2.4', True))
DOOR = include('kitchen_door', 'kitchen_door0')

World = Callable[..., angen.World]


def state(w: angen.World) -> dict:
    return w.device('person', 'ann')


def place(w: angen.World) -> np.ndarray:
    return np.array([state(w)['x'], state(w)['y']])


def watch(w: angen.World, seconds: float, period: float = 0.1) -> Iterator[dict]:
    """The person's state, once a period."""
    for _ in range(round(seconds / period)):
        w.run(period)
        yield state(w)


def events_of(w: angen.World) -> dict[str, list[str]]:
    """Details of the person's events since the last call, by event."""
    events: dict[str, list[str]] = {}
    for _, source, _, event, detail in w.events():
        if source == 'ann':
            events.setdefault(event, []).append(detail)
    return events


@pytest.mark.parametrize('goal, told_within, why', [
    ('3 0', 0.2, 'pillar is there'),
    ('-4 4', 0.2, 'no way leads there'),  # in a closet without a door
    ('5 5', 0.2, 'bar is there'),  # in its top
    ('8 -8', 60.0, 'wardrobe is in its way'),  # which could be moved
])
def test_a_person_stops_and_reports_why_it_does_not_get_there(world, goal, told_within, why):
    closet = (box('c1', '-4 3 1.2 0 0 0', '2.1 0.1 2.4', True)
              + box('c2', '-4 5 1.2 0 0 0', '2.1 0.1 2.4', True)
              + box('c3', '-5 4 1.2 0 0 0', '0.1 2.1 2.4', True)
              + box('c4', '-3 4 1.2 0 0 0', '0.1 2.1 2.4', True))
    wardrobe = box('wardrobe', '8 -8 1.001 0 0 0', '1.6 1.6 2', mass=120.0)
    bar = box('bar', '5 5 0.93 0 0 0', '1.6 1.6 0.04', True)
    w = world(bar + closet + wardrobe + box('pillar', '3 0 1.2 0 0 0', '0.8 0.8 2.4', True)
              + person('0 0 0 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', f'GoTo {goal}')
    start = w.time
    while not state(w)['unreachable'] and w.time < start + 90:
        w.run(0.1)
    assert w.time - start < told_within
    here = place(w)
    walked = 0.0
    for now in watch(w, 30.0, 1.0):
        assert now['mode'] == 'STANDING' and now['unreachable']
        walked = max(walked, float(np.linalg.norm(place(w) - here)))
    assert walked < 0.1
    assert events_of(w)['unreachable'] == [f'{goal}: {why}'] and state(w)['why'] == why
    w.command('person', 'ann', 'GoTo -1 -1')
    for now in watch(w, 20.0):
        assert not now['unreachable'] and not now['why']
    assert np.linalg.norm(place(w) - (-1, -1)) < 0.1


def slab_table(top: float, static: bool) -> str:
    """A table at x = 3, 2 m wide, whose top of 4 cm is on one thin leg."""
    return f'''<model name="table"><static>{str(static).lower()}</static><pose>3 0 0 0 0 0</pose>
  <link name="link"><inertial><pose>0 0 0.1 0 0 0</pose><mass>600</mass><inertia><ixx>90</ixx>
  <iyy>90</iyy><izz>90</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
  <collision name="top"><pose>0 0 {top - 0.02} 0 0 0</pose><geometry><box>
  <size>1 2 0.04</size></box></geometry></collision><collision name="leg">
  <pose>0 0 {top / 2 - 0.02} 0 0 0</pose><geometry><box><size>0.05 0.05 {top - 0.04}</size></box>
  </geometry></collision></link></model>'''


@pytest.mark.parametrize('top, static', [(0.75, False), (0.75, True), (0.95, True), (0.35, True)])
def test_a_person_walks_round_the_top_of_a_table(world, top, static):
    w = world(slab_table(top, static) + person('0 0.5 0 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', 'GoTo 6 0.5')
    before = w.motion('table')[0][:2]
    for now in watch(w, 20.0):
        assert now['mode'] != 'BLOCKED'
    assert np.linalg.norm(place(w) - (6, 0.5)) < 0.1
    assert np.linalg.norm(w.motion('table')[0][:2] - before) < 0.01


def test_a_person_finds_the_way_through_other_rooms(world):
    # From one room to the next, through the only opening, 8 m away from both.
    walls = (box('between', '-1 0 1.2 0 0 0', '18 0.1 2.4', True)
             + box('west', '-10 0 1.2 0 0 0', '0.1 20 2.4', True))
    w = world(walls + person('0 -2 0 0 0 0'))
    w.run(0.5)
    w.command('person', 'ann', 'GoTo 0 2')
    walked, last = 0.0, place(w)
    for now in watch(w, 40.0):
        assert now['mode'] != 'BLOCKED'
        walked += float(np.linalg.norm(place(w) - last))
        last = place(w)
    assert np.linalg.norm(last - (0, 2)) < 0.1
    shortest = 2 * hypot(8.25, 2.0)  # round the end of the wall, with room for a body
    assert walked < 1.15 * shortest


@pytest.mark.parametrize('start, goal', [('0.5 -2', (0.5, 2.0)), ('0.5 2', (0.5, -2.0)),
                                         ('-3 -1', (2.0, 3.0))])
@pytest.mark.parametrize('closes', [False, True])
def test_a_person_opens_a_shut_door_by_hand(world, start, goal, closes):
    w = world(WALL + DOOR + person(f'{start} 0 0 0 0',
                                   f'<closes_doors>{str(closes).lower()}</closes_doors>'), DOORS)
    w.run(0.5)
    w.command('person', 'ann', f'GoTo {goal[0]} {goal[1]}')
    far = 0.0
    for now in watch(w, 25.0, 0.05):
        door = w.device('door', 'kitchen0')
        if door['mode'] in ('OPENING', 'CLOSING'):  # its hand is on it
            handle = 0.93 * np.array([np.cos(door['position']), np.sin(door['position'])])
            if door['mode'] == 'OPENING' and door['position'] > -0.1:
                far = max(far, float(np.linalg.norm(place(w) - handle)))
        assert now['mode'] != 'BLOCKED'
    assert np.linalg.norm(place(w) - goal) < 0.1
    assert 0.0 < far < 1.15  # an arm's length
    assert w.device('door', 'kitchen0')['mode'] == ('CLOSED' if closes else 'OPEN')
    events = events_of(w)
    assert events['opens'] == ['kitchen0']
    assert events.get('closes', []) == (['kitchen0'] if closes else [])


@pytest.mark.parametrize('side', [-1, 1])
def test_a_person_walks_straight_up_to_a_shut_door(world, side):
    """From 3 m, where it sees the leaf, to 2 m, where it uses the door, the leaf is no obstacle."""
    w = world(WALL + DOOR + person(f'0.5 {4 * side} 0 0 0 0'), DOORS)
    w.run(0.5)
    w.command('person', 'ann', f'GoTo 0.5 {-4 * side}')
    aside = [abs(now['x'] - 0.5) for now in watch(w, 16.0) if now['y'] * side > 2.0]
    assert len(aside) > 15 and max(aside) < 0.05
    assert np.linalg.norm(place(w) - (0.5, -4 * side)) < 0.1


def test_a_person_in_a_narrow_corridor_is_not_in_the_way_of_the_door_that_it_pulls(world):
    corridor = box('corridor', '0 -1.1 1.2 0 0 0', '12 0.1 2.4', True)  # 1.05 m wide
    w = world(WALL + DOOR + corridor + person('2.5 -0.6 0 0 0 0'), DOORS)
    w.run(0.1)
    w.command('person', 'ann', 'GoTo 0.5 2')
    w.run(20)
    assert np.hypot(*(place(w) - (0.5, 2.0))) < 0.1
    assert w.device('door', 'kitchen0')['mode'] == 'CLOSED'  # it would close off the corridor


def test_a_person_who_opens_no_doors_waits_and_reports_it_once(world):
    w = world(WALL + DOOR + person('0.5 -2 0 0 0 0', '<opens_doors>false</opens_doors>'), DOORS)
    w.run(0.5)
    w.command('person', 'ann', 'GoTo 0.5 2')
    w.run(3600.0)
    assert state(w)['mode'] == 'BLOCKED' and not state(w)['unreachable']
    assert place(w)[1] < 0
    events = events_of(w)
    assert len(events['blocked']) == len(events['walks']) == 1
    w.command('door', 'kitchen0', 'Open')
    w.run(15.0)
    assert np.linalg.norm(place(w) - (0.5, 2.0)) < 0.1


def test_a_person_on_a_path_behind_a_shut_door_does_not_pace(world):
    path = ''.join(f'<waypoint>{t} 0.5 {y} 0 0</waypoint>' for t, y in ((0, -3), (6, 3), (12, -3)))
    w = world(WALL + DOOR + person('0.5 -3 0 0 0 0', f'<opens_doors>false</opens_doors>{path}'),
              DOORS)
    w.run(3600.0)
    assert len(events_of(w)['blocked']) == 1
    w.command('door', 'kitchen0', 'Open')
    w.run(60.0)
    assert state(w)['mode'] == 'WALKING'


@pytest.mark.parametrize('holder', [
    box('crate', '0.5 -0.32 0.601 0 0 0', '0.9 0.5 1.2', mass=400.0),
    person('0.6 -0.35 0 0 0 0', '<force_max>1000</force_max>', 'crate')])
def test_a_door_that_another_holds_shut_is_given_up(world, holder):
    # Walls to both sides: there is no other way.
    ends = ''.join(box(f'end{x}', f'{x} 0 1.2 0 0 0', '0.1 19 2.4', True) for x in (-9.9, 9.9))
    w = world(WALL + DOOR + ends + holder + person('0.5 2 0 0 0 0'), DOORS)
    w.run(0.5)
    w.command('person', 'ann', 'GoTo 0.5 -3')
    start = w.time
    while not state(w)['unreachable'] and w.time < start + 120:
        w.run(0.5)
    assert state(w)['unreachable'] and state(w)['mode'] == 'STANDING'
    assert state(w)['why'] == ('door kitchen0 does not open: crate holds it, and it knows no other '
                               'way')


ROOM = '''<model name="hall" xmlns:angen="angen"><static>true</static><link name="l"/>
<angen:room name="hall"><angen:polygon>0 0 8 0 8 6 0 6</angen:polygon>
<angen:ceiling>2.8</angen:ceiling></angen:room></model>'''


@pytest.mark.parametrize('order, right', [
    ('GoTo 6 3', True), ('GoTo -9 9', True), ('GoTo 500 3', False), ('PushTo 6 -21', False)])
def test_no_person_is_sent_out_of_the_world(world: World, order: str, right: bool) -> None:
    w = world(ROOM + person('1 1 0 0 0 0'))
    w.run(0.1)
    if right:
        w.command('person', 'ann', order)
    else:
        with pytest.raises(angen.Error, match='outside of the world; x is -20 to 28, y -20 to 26'):
            w.command('person', 'ann', order)
    w.run(1.0)
    assert (state(w)['mode'] == 'WALKING') == right


def test_where_no_room_is_known_every_place_is_one(world: World) -> None:
    w = world(person('1 1 0 0 0 0'))
    w.run(0.1)
    w.command('person', 'ann', 'GoTo 500 3')
    w.run(1.0)
    assert state(w)['mode'] == 'WALKING'
