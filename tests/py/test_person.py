"""The person of the whole building, and a door that opens towards it."""
from pathlib import Path

import pytest

import angen
from sdf_text import person

WAITS = '''<plugin name="person_controller" filename="libperson_controller.so">
<opens_doors>false</opens_doors></plugin>'''


def until(world: angen.World, seconds: float, done) -> bool:
    """Runs until done(), at most `seconds` of simulated time."""
    end = world.time + seconds
    while not done() and world.time < end:
        world.run(0.1)
    return done()


def test_person_waits_at_a_shut_door_and_makes_room_for_it_to_open(building):
    world = angen.World.from_text(Path(building).read_text().replace(
        '<actor name="person">', f'<actor name="person">{WAITS}'))
    world.step()

    def state():
        return world.device('person', 'person')

    assert until(world, 60, lambda: 6 < state()['x'] < 8 and state()['y'] < 3.5)
    world.command('door', 'livingroom0', 'Close')
    assert until(world, 30, lambda: state()['mode'] == 'BLOCKED')
    assert state()['y'] < 4  # inside the livingroom, into which its door opens
    world.command('door', 'livingroom0', 'Open')
    assert until(world, 20, lambda: state()['y'] > 4.5)
    assert world.device('door', 'livingroom0')['mode'] == 'OPEN'


@pytest.mark.parametrize('rate, period', [(20, 0.04), (50, 0.02), (7, 0.14), (30, 0.02)])
def test_a_state_is_published_at_equal_distances_and_is_of_its_tick(world, rate, period):
    w = world(person('0 0 0 0 0 0', f'<update_rate>{rate}</update_rate>'))
    w.run(1.0)
    w.command('person', 'ann', 'GoTo 4 0')
    w.run(1.0)
    stamps, before = [], w.device('person', 'ann')['x']
    for _ in range(1000):
        w.run(0.001)
        shown = w.device('person', 'ann')['x']
        if shown != before:
            stamps.append(w.time)
            assert abs(shown - w.motion('ann')[0][0]) < 0.0015  # it walks 1 mm in a tick
        before = shown
    assert len(stamps) == pytest.approx(1 / period, abs=1)
    assert [b - a for a, b in zip(stamps, stamps[1:])] == pytest.approx(
        [period] * (len(stamps) - 1))
