"""Long steps of people who walk free of contact, and of leaves: the same readings, to a sample, as
by 1 ms."""
import math
from typing import Callable

import pytest

import angen
from sdf_text import WORLDS, box, include, person, sdf_world

World = Callable[..., angen.World]

SAMPLE = 0.02  # s
SENSORS = (include('pir_casas', 'cell', f'2 0 2.4 0 {math.pi / 2} 0')
           + include('pir_casas', 'corner', f'4 3 2.4 0 {math.pi / 2} 0')
           + include('pir_pyroelectric', 'area', '6 -3 2.2 0 0 2.4'))
ANN = person('0 0 0 0 0 0')
WALL = box('wall', '0 4 1.2 0 0 0', '12 0.2 2.4', True)


def walk(world: angen.World, long_steps: bool) -> tuple[list[tuple[float, str, str]], list[float]]:
    """Events of the sensors, and where the walk ended."""
    world.run(70.0, long_steps=long_steps)
    for goal in ('4 0.4', '4 3', '-1 1'):
        world.command('person', 'ann', f'GoTo {goal}')
        world.run(8.0, long_steps=long_steps)
    state = world.device('person', 'ann')
    events = [(at, source, event) for at, source, _, event, _ in world.events() if source != 'ann']
    return events, [state['x'], state['y']]


def test_events_are_equal_to_a_sample_and_places_to_a_centimeter(world: World) -> None:
    content = SENSORS + ANN + WALL
    (fast, at), (exact, there) = walk(world(content), True), walk(world(content), False)
    assert math.dist(at, there) < 0.01
    assert len(exact) >= 6 and {source for _, source, _ in exact} == {'cell', 'corner', 'area'}
    assert sorted(e[1:] for e in fast) == sorted(e[1:] for e in exact)
    for name in ('cell', 'corner', 'area'):
        pairs = zip(*([at for at, source, _ in events if source == name]
                      for events in (fast, exact)))
        assert all(abs(a - b) <= SAMPLE + 1e-6 for a, b in pairs)


def test_a_sensor_that_sees_someone_move_samples_within_a_long_step(world: World) -> None:
    """A rangefinder at 100 Hz: each second of its samples ends no step of 20 ms."""
    eye = (WORLDS / 'models/proximity/model.sdf').read_text()
    eye = eye[eye.index('<model'):eye.index('</sdf>')]
    eye = eye.replace('<update_rate>10<', '<update_rate>100<')
    eye = eye.replace('<stddev>0.002<', '<stddev>0<')
    eye = eye.replace('</static>', f'</static><pose>3.5 0 1 0 0 {math.pi}</pose>')
    runs = []
    for long_steps in (True, False):
        w = world(ANN + eye)
        w.command('person', 'ann', 'GoTo 3 0')
        w.run(1.2155, long_steps=long_steps)  # the last sample was at 1.21
        runs.append(w.sensor('proximity', 'proximity')['range'])
    assert 1.0 < runs[1] < 3.0
    assert runs[0] == pytest.approx(runs[1], abs=2e-3)


def test_the_same_walk_has_the_same_bytes(world: World) -> None:
    worlds = [world(SENSORS + ANN) for _ in range(2)]
    assert walk(worlds[0], True) == walk(worlds[1], True)
    assert worlds[0].fingerprint == worlds[1].fingerprint


def test_what_else_moves_takes_each_tick(world: World) -> None:
    """A ball rolls while a person walks: both end at the same places as without long steps."""
    ball = '''<model name="ball"><pose>-3 -3 0.1 0 0 0</pose><link name="link">
        <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
        </link></model>'''
    ends = []
    for long_steps in (True, False):
        w = world(ANN + ball)
        w.command('person', 'ann', 'GoTo 3 0')
        w.set_state('ball', [-3, -3, 0.1, 0, 0, 0], [1.0, 0.0, 0.0], [0.0, 10.0, 0.0])
        w.run(2.0, long_steps=long_steps)
        ends.append((w.motion('ball')[0].tolist(), w.motion('ann')[0].tolist()))
    assert ends[0] == ends[1]


def test_who_walks_against_a_wall_stops_there(world: World) -> None:
    ends = []
    for long_steps in (True, False):
        w = world(ANN + box('wall', '2 0 1.2 0 0 0', '0.2 3 2.4', True))
        w.command('person', 'ann', 'PushTo 4 0')
        farthest = 0.0
        for _ in range(30):
            w.run(0.2, long_steps=long_steps)
            farthest = max(farthest, float(w.motion('ann')[0][0]))
        ends.append(farthest)
    assert ends[0] == pytest.approx(ends[1], abs=5e-3)
    assert 1.6 < ends[0] < 1.66  # the wall's face is at 1.9 m, a person is 0.25 m deep


@pytest.mark.parametrize('model', ['kitchen_door', 'fridge_door', 'freezer_door', 'wardrobe_door',
                                   'shoe_flap', 'oven_door', 'window'])
@pytest.mark.parametrize('in_way', ['', 'a post'])
def test_a_leaf_swings_and_stops_as_by_short_steps(world: World, model: str, in_way: str) -> None:
    """Opened by hand, and shut by its drive; a post stops it half way."""
    runs = []
    for long_steps in (True, False):
        w = world(include(model, 'leaf_0', '0 0 0.5 0 0 0')
                  + (box('post', '0.25 -0.25 1 0 0 0', '0.1 0.1 2', True) if in_way else ''),
                  '<plugin name="door_controller" filename="libdoor_world_plugin.so"/>')
        w.run(1.0)
        (kind, name), = ((kind, name) for kind, name, _, _ in w.entities()
                         if kind in ('door', 'cabinet', 'window'))
        w.events()
        places = []
        for text in ('OpenByHand', 'Close'):
            w.command(kind, name, text)
            for _ in range(60):
                w.run(0.1, long_steps=long_steps)
                places.append(w.device(kind, name)['position'])
        runs.append((places, [(at, event) for at, _, _, event, _ in w.events()]))
    (fast, events), (exact, exact_events) = runs
    assert fast == pytest.approx(exact, abs=0.012) and min(fast) < -0.2
    assert [event for _, event in events] == [event for _, event in exact_events]
    assert [at for at, _ in events] == pytest.approx([at for at, _ in exact_events], abs=0.1)


def test_long_steps_are_not_recorded(tmp_path) -> None:
    path = tmp_path / 'ann.world'
    path.write_text(sdf_world(ANN, ''))
    w = angen.World(str(path), record=str(tmp_path / 'ann.log'))
    with pytest.raises(angen.Error, match='long steps cannot be recorded'):
        w.run(1.0, long_steps=True)
    assert w.time == 0.0


def test_a_run_can_end_with_each_event(world: World) -> None:
    """It stops in the tick of an event, goes on from there, and all is as in one run."""
    whole, parts = world(SENSORS + ANN), world(SENSORS + ANN)
    for each in (whole, parts):
        each.run(1.0)
        each.events()
        each.command('person', 'ann', 'GoTo 4 0.4')
    whole.run(8.0)
    end, found, stops = whole.time, parts.events(), 0
    while parts.time < end - 1e-9:
        parts.run(end - parts.time, until_event=True)
        new = parts.events()
        assert all(-1e-6 < parts.time - at < 0.001 + 1e-6 for at, *_ in new)
        stops, found = stops + bool(new), found + new
    assert found == whole.events() and stops >= 5
    assert whole.device('person', 'ann') == parts.device('person', 'ann')
