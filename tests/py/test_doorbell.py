"""The doorbell: how long it rings, and how loud it is elsewhere."""
from math import log10, pi

import pytest

import angen
from sdf_text import device, holder, sensor

MICROPHONE = holder('m', sensor('libmicrophone.so', '<background>-40</background>'),
                    '4 0 1 0 0 0')


def bell(extra: str = '') -> str:
    return device('hall0', 'libdoorbell.so', extra, '0 0 1 0 0 0')


def ringing(world: angen.World) -> bool:
    return world.device('doorbell', 'hall0')['ringing']


def test_a_ring_sounds_for_its_duration(world):
    w = world(bell('<duration>1.5</duration>'))
    w.run(0.5)
    assert not ringing(w)
    w.command('doorbell', 'hall0', 'Ring')
    w.run(1.4)
    assert ringing(w) and w.device('doorbell', 'hall0')['rings'] == 1
    w.run(0.3)
    assert not ringing(w)


def test_a_second_press_begins_it_again(world):
    w = world(bell())
    w.command('doorbell', 'hall0', 'Ring')
    w.run(1.5)
    w.command('doorbell', 'hall0', 'ring')
    w.run(1.5)
    assert ringing(w) and w.device('doorbell', 'hall0')['rings'] == 2
    w.run(0.7)
    assert not ringing(w)


def test_a_microphone_hears_it_by_the_law_of_distance(world):
    w = world(bell('<sound_power_level>90</sound_power_level><directivity>2</directivity>')
              + MICROPHONE)
    w.run(0.3)
    assert w.sensor('microphone', 'm')['level'] == pytest.approx(-40, abs=0.01)
    w.command('doorbell', 'hall0', 'Ring')
    w.run(0.5)
    expected = 90 + 10 * log10(2 / (4 * pi * 4 ** 2))
    assert w.sensor('microphone', 'm')['level'] == pytest.approx(expected, abs=0.01)
    w.run(2)
    assert w.sensor('microphone', 'm')['level'] == pytest.approx(-40, abs=0.01)


def test_a_saved_world_rings_on(world):
    w = world(bell())
    w.command('doorbell', 'hall0', 'Ring')
    w.run(0.8)
    again = angen.World.from_text(w.save())
    again.run(1.1)
    assert ringing(again)
    again.run(0.3)
    assert not ringing(again)
