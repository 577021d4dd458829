"""People who sit and lie: on things, on the floor, and up again."""
from math import hypot
from typing import Any, Callable

import pytest

import angen
from sdf_text import air, box, include, person

World = Callable[..., angen.World]


def thing(name: str, kind: str, pose: str, size: str, posture: str, height: float) -> str:
    """A box of a thing, on whose middle people sit or lie."""
    return (box(name, pose, size, True)
            .replace('<model', '<model xmlns:angen="angen"')
            .replace('</model>', f'<angen:thing>{kind}</angen:thing><angen:place '
                                 f'posture="{posture}">0 0 {height} 1.5708</angen:place></model>'))


SOFA = thing('sofa0', 'sofa', '0 0 0.2 0 0 0', '0.8 0.8 0.4', 'sit', 0.2)
BED = thing('bed0', 'bed', '4 0 0.25 0 0 0', '0.9 2 0.5', 'lie', 0.25)


def state(w: angen.World, name: str = 'ann') -> dict[str, Any]:
    return w.device('person', name)


def made(world: World, *people: str) -> angen.World:
    w = world(SOFA + BED + ''.join(people))
    w.run(0.3)
    return w


@pytest.mark.parametrize('order, start, mode, x, z', [
    ('Sit', (0.0, -0.8), 'SITTING', 0.0, 0.4), ('Sit SOFA0', (0.0, -0.8), 'SITTING', 0.0, 0.4),
    ('Sit 0.1 0', (0.7, 0.4), 'SITTING', 0.0, 0.4), ('Lie', (3.1, 0.0), 'LYING', 4.0, 0.5),
    ('Lie bed0', (3.1, 0.0), 'LYING', 4.0, 0.5), ('Lie', (-5.0, 0.0), 'LYING', -5.0, 0.0)])
def test_it_takes_a_place_and_gets_up_to_go_on(world: World, order: str, start: tuple[float, float],
                                               mode: str, x: float, z: float) -> None:
    w = made(world, person(f'{start[0]} {start[1]} 0 0 0 0'))
    w.events()
    w.command('person', 'ann', order)
    w.run(60.0)
    now = state(w)
    assert (now['mode'], now['x'], now['z']) == (mode, pytest.approx(x, abs=0.02),
                                                 pytest.approx(z, abs=0.02))
    assert now['heat'] < 80.0  # W; 86 standing
    assert [event for _, source, _, event, _ in w.events() if source == 'ann'] == [
        'sits' if mode == 'SITTING' else 'lies']
    again = angen.World.from_text(w.save())
    for each in (w, again):
        each.run(0.1)
        each.command('person', 'ann', f'GoTo {start[0]} -3')
        each.run(10.0)
        assert hypot(state(each)['x'] - start[0], state(each)['y'] + 3) < 0.1
        assert state(each)['mode'] == 'STANDING' and abs(state(each)['z']) < 0.01


def test_who_appears_can_sit_at_once(world: World) -> None:
    w = world(SOFA + person('0 -0.8 0 0 0 0'))
    w.command('person', 'ann', 'Sit')
    w.run(1.0)
    assert state(w)['z'] == pytest.approx(0.4, abs=0.02)


@pytest.mark.parametrize('order', ['', 'Lie', 'Lie 4 0'])
@pytest.mark.parametrize('side', [-1, 1])
def test_who_appears_in_bed_gets_up_to_the_floor_beside_it(world: World, side: int, order: str
                                                           ) -> None:
    """The bed is at a wall, behind which a place on the floor is nearer than before it."""
    wall = box('wall', f'{4 + 0.5 * side} 0 1.2 0 0 0', '0.1 6 2.4', True)
    w = world(BED + wall + person(f'{4 + 0.3 * side} 0 0.5 0 0 1.57', '<posture>lie</posture>'))
    if order:  # before its first step
        w.command('person', 'ann', order)
    w.run(1.0)
    assert state(w)['mode'] == 'LYING' and state(w)['z'] == pytest.approx(0.5, abs=0.02)
    w.command('person', 'ann', 'Stand')
    w.run(0.3)
    assert (state(w)['x'] - 4) * side < -0.6 and abs(state(w)['z']) < 0.01
    w.command('person', 'ann', f'GoTo {4 - 3 * side} 0')
    w.run(6.0)
    assert abs(state(w)['x'] - 4 + 3 * side) < 0.1 and not state(w)['unreachable']


@pytest.mark.parametrize('posture', ['stand', 'sit', 'lie'])
def test_no_pir_sees_who_appears_come_to_the_warmth_of_the_room(world: World, posture: str) -> None:
    """The climate says only after the first step that its air is not as warm as the world's."""
    w = world(air('-4 -4 0 4 4 2.5', extra='<temperature>18</temperature>'
                  '<heat_capacity>1000</heat_capacity>')
              + include('pir_pyroelectric', 'eye', '0 0 2.2 0 0 0')
              + person('3 0.4 0 0 0 0', f'<posture>{posture}</posture>'))
    w.run(1.0)
    first = state(w)['heat']
    w.run(300.0)
    assert abs(state(w)['heat'] - first) > 0.5  # W: it feels the room
    assert [event for _, source, _, event, _ in w.events() if source == 'eye'] == []


def test_the_body_of_its_posture_is_what_rays_hit(world: World) -> None:
    w = made(world, person('3.1 0 0 0 0 0'))
    heights = []
    for order in ('Lie', 'Stand'):
        w.command('person', 'ann', order)
        w.run(1.0)
        down = w.cast([[4.0, 0.24, 3.0], [3.1, 0.0, 3.0]], [[0.0, 0.0, -1.0]] * 2, 5.0)
        heights.append([3.0 - float(way) for way in down])
    assert heights == [[pytest.approx(0.68, abs=0.02), pytest.approx(0.0, abs=0.02)],
                       [pytest.approx(0.5, abs=0.02), pytest.approx(1.75, abs=0.02)]]


@pytest.mark.parametrize('order, why', [
    ('Sit', 'no seat is within 1.4 m of it; send it there by GoTo first'),
    ('Sit bed0', 'no seat of bed0 is within 1.4 m'), ('Sit 7 7', 'no seat at 7 7 is within'),
    ('Lie 4 0', 'no bed at 4 0 is within 2.2 m'), ('Lie bed0', 'no bed of bed0 is within')])
def test_what_is_no_place_is_refused(world: World, order: str, why: str) -> None:
    w = made(world, person('-5 0 0 0 0 0'))
    with pytest.raises(angen.Error, match=why):
        w.command('person', 'ann', order)
    assert state(w)['mode'] == 'STANDING'


def test_a_place_is_for_one_and_who_gets_up_waits_for_room(world: World) -> None:
    walls = ''.join(box(f'wall{i}', pose, size, True) for i, (pose, size) in enumerate((
        ('-0.5 -0.7 1 0 0 0', '0.1 1.4 2'), ('0.5 -0.7 1 0 0 0', '0.1 1.4 2'))))
    w = made(world, walls, person('0 -0.8 0 0 0 0'), person('0 -3 0 0 0 0', name='bob'))
    w.command('person', 'ann', 'Sit')
    w.run(1.0)
    w.command('person', 'bob', 'GoTo 0 -0.8')
    w.run(6.0)
    with pytest.raises(angen.Error, match='ann is on sofa0'):
        w.command('person', 'bob', 'Sit')
    plug = box('plug', '0 0 0 0 0 0', '1 0.1 2', True)
    w.spawn(f'<sdf version="1.6">{plug}</sdf>', 'plug', (0.0, -1.3, 1.0, 0.0, 0.0, 0.0))
    with pytest.raises(angen.Error, match='others leave it no room to get up'):
        w.command('person', 'ann', 'Stand')
    w.command('person', 'ann', 'GoTo 0 -4')
    w.run(3.0)
    assert state(w)['mode'] == 'SITTING'
    w.delete('plug')
    w.command('person', 'bob', 'GoTo 3 -3')
    w.run(12.0)
    assert hypot(state(w)['x'], state(w)['y'] + 4) < 0.1


def test_follow_returns_to_the_path_and_leaves_where_it_was_sent(world: World) -> None:
    w = made(world, person('-2 -3 0 0 0 0'))
    w.command('person', 'ann', 'GoTo 8 -3')
    w.run(1.0)
    w.command('person', 'ann', 'Follow')
    w.run(6.0)
    assert hypot(state(w)['x'] + 2, state(w)['y'] + 3) < 0.1 and not state(w)['going']
