"""A person who is sent to a room, a thing or a floor by its name."""
from pathlib import Path
from typing import Any

import pytest

import angen
from sdf_text import box

WORLD = Path(__file__).resolve().parents[2] / 'worlds/angen.world'


@pytest.fixture
def w() -> angen.World:
    world = angen.World(str(WORLD), seed=1)
    world.run(0.5)
    return world


def state(w: angen.World) -> dict[str, Any]:
    return w.device('person', 'person')


def room(w: angen.World) -> str:
    s = state(w)
    return w.room_at(s['x'], s['y'], s['z'] + 0.5) or ''


def arrive(w: angen.World, limit: float) -> None:
    end = w.time + limit
    w.run(1.0)
    while w.time < end and state(w)['mode'] != 'STANDING':
        w.run(0.5)


def test_it_goes_to_a_room(w: angen.World) -> None:
    for name in ('kitchen0', 'Bathroom0', '"bedroom0"'):
        w.command('person', 'person', f'GoTo {name}')
        arrive(w, 90)
        assert room(w) == name.strip('"').lower() and not state(w)['unreachable']


def test_it_goes_to_each_thing_and_can_reach_it(w: angen.World) -> None:
    things = [t for t in w.home['things'] if t['pose'][2] < 2.5][:4]
    for thing in things:
        w.command('person', 'person', f'GoTo {thing["name"]}')
        arrive(w, 90)
        x, y = (thing['places'][0]['pose'] if thing['places'] else thing['pose'])[:2]
        s = state(w)
        assert ((s['x'] - x) ** 2 + (s['y'] - y) ** 2) ** 0.5 < 1.4, thing['name']


def test_it_takes_the_elevator_to_another_floor_and_back(w: angen.World) -> None:
    w.command('person', 'person', 'GoTo kitchen1')
    heights = []
    for _ in range(240):
        w.run(0.5)
        heights.append(state(w)['z'])
    storeys = {s['number']: s['elevation'] for s in w.home['storeys']}
    assert room(w) == 'kitchen1' and state(w)['mode'] == 'STANDING'
    assert min(heights) > storeys[0] - 0.05 and abs(heights[-1] - storeys[1]) < 0.05
    w.command('person', 'person', 'GoTo livingroom0')
    w.run(120.0)
    assert room(w) == 'livingroom0' and abs(state(w)['z'] - storeys[0]) < 0.05


def test_a_saved_ride_goes_on(w: angen.World) -> None:
    w.command('person', 'person', 'GoTo bedroom1')
    w.run(20.0)
    assert 'go_floor' in w.save()
    again = angen.World.from_text(w.save(), seed=1)
    again.run(100.0)
    assert room(again) == 'bedroom1'


def test_what_is_no_place_is_refused(w: angen.World) -> None:
    for order, why in (('GoTo nowhere', "no room or thing is named 'nowhere'; rooms are "),
                       ('GoTo 1 2 7', 'there is no floor 7; floors are 0, 1'),
                       ('GoTo 1 2 0.5', '0.5 is not the number of a floor'),
                       ('GoTo 1 x', "'x' is not a number of x y"),
                       ('GoTo', 'GoTo without x y')):
        before = state(w)
        with pytest.raises(angen.Error, match=why):
            w.command('person', 'person', order)
        assert state(w) == before


def test_an_elevator_that_is_out_of_order_is_given_up(w: angen.World) -> None:
    w.command('elevator', 'elevator', 'Floor1')
    w.run(30.0)
    lift = next(e for e in w.home['elevators'] if e['name'] == 'elevator')
    x, y = ((a + b) / 2 for a, b in zip(lift['pose'][:2], lift['landings'][1]['pose'][:2]))
    crate = box('crate', '0 0 0 0 0 0', '0.5 0.5 0.5', mass=60.0)
    w.spawn(f'<sdf version="1.6">{crate}</sdf>', 'crate',
            (x, y, lift['landings'][1]['pose'][2] + 0.3, 0.0, 0.0, 0.0))
    w.command('person', 'person', 'GoTo kitchen1')
    end = w.time + 180.0
    while w.time < end and not state(w)['unreachable']:
        w.run(1.0)
    assert state(w)['why'].startswith('elevator elevator has not come within 120 s; it is ')
    assert state(w)['mode'] == 'STANDING'


def test_without_the_elevator_it_stays_and_says_so(w: angen.World) -> None:
    w.delete('elevator')
    with pytest.raises(angen.Error, match='no elevator goes from floor 0 to floor 1'):
        w.command('person', 'person', 'GoTo kitchen1')
