"""Fans, televisions and stereos: power, sound and light against the laws that they follow."""
from math import inf, log10

import pytest

import angen
from sdf_text import air, device, holder, include, sensor


def plug(extra: str, rate: float = 10) -> str:
    """A smart plug `p` of the television."""
    return holder('p', sensor('libsmart_plug.so', f'<load>appliance/tv</load>{extra}', rate))


def state(world: angen.World, name: str) -> dict:
    world.run(0.1)
    return world.device('appliance', name)


def test_a_fan_takes_power_as_the_cube_of_its_speed(world):
    w = world(include('fan', 'fan'))
    assert state(w, 'fan')['power'] == 0 and state(w, 'fan')['sound_power_level'] == -inf
    w.command('appliance', 'fan', 'On')
    for speed in (100, 50, 20):
        w.command('appliance', 'fan', f'Speed {speed}')
        now = state(w, 'fan')
        assert now['power'] == pytest.approx(50 * (speed / 100) ** 3)
        assert now['sound_power_level'] == pytest.approx(60 + 50 * log10(speed / 100))
    w.command('appliance', 'fan', 'Speed 0')
    assert state(w, 'fan')['sound_power_level'] == -inf


def test_a_stereos_power_and_sound_are_as_the_square_of_its_volume(world):
    w = world(include('stereo', 'stereo'))
    assert state(w, 'stereo')['power'] == 0.5       # standby
    w.command('appliance', 'stereo', 'Volume 50')
    assert state(w, 'stereo')['power'] == 0.5       # still off
    w.command('appliance', 'stereo', 'On')
    now = state(w, 'stereo')
    assert now['power'] == pytest.approx(12 + 48 / 4)
    assert now['sound_power_level'] == pytest.approx(95 - 20 * log10(2))
    w.command('appliance', 'stereo', 'Off')
    assert state(w, 'stereo')['level'] == 50 and not state(w, 'stereo')['on']


def test_a_plug_measures_a_television_and_its_energy(world):
    w = world(include('tv', 'tv') + plug('', 1))
    w.run(10)
    w.command('appliance', 'tv', 'Volume 100')
    w.command('appliance', 'tv', 'On')
    w.run(20)
    reading = w.sensor('plug', 'p')
    assert reading['power'] == 90
    assert reading['energy'] == pytest.approx(0.5 * 10 + 90 * 20, rel=0.01)


@pytest.mark.parametrize('standby, reported', [
    ('', ['on']), ('<standby>5</standby>', ['on', 'off'])])
def test_a_plug_reports_a_load_above_its_standby(world, standby, reported):
    w = world(include('tv', 'tv') + plug(standby))
    w.run(1)
    for text in ('On', 'Off'):  # 90 W, then 0.5 W
        w.command('appliance', 'tv', text)
        w.run(1)
    assert [event for _, _, kind, event, _ in w.events() if kind == 'plug'] == reported


def test_a_television_lights_the_things_before_it(world):
    """A screen of 200 lm and area A seen from 2 m, small against that: E = 200 / (pi r^2)."""
    w = world('<model name="tv"><static>true</static><link name="l"><light name="screen" '
              'type="point"><direction>1 0 0</direction>'
              '<angen:rectangle xmlns:angen="angen">'
              '0.3 0.3</angen:rectangle></light></link>'
              '<plugin name="tv" filename="libappliance.so">'
              '<luminous_flux>200</luminous_flux></plugin><pose>0 0 5 0 0 0</pose></model>'
              + include('luminosity_sensor', 'lux', '2 0 5 0 0 3.141593'))
    w.run(1.1)
    assert w.sensor('luminosity', 'lux')['illuminance'] == 0
    w.command('appliance', 'tv', 'On')
    w.run(1.1)
    expected = 200 / 3.14159 / 2 ** 2
    assert w.sensor('luminosity', 'lux')['illuminance'] == pytest.approx(expected, rel=0.05)
    w.command('appliance', 'tv', 'Off')
    w.run(1.1)
    assert w.sensor('luminosity', 'lux')['illuminance'] == 0


def test_it_heats_its_room_by_its_power(world):
    w = world(air('-2 -2 0 2 2 2.5', extra='<heat_loss>0</heat_loss><air_change>0</air_change>')
              + include('stereo', 'stereo'))
    w.command('appliance', 'stereo', 'On')
    w.run(601)
    heat = (12 + 48 * 0.04) * w.time
    warmer = w.device('climate', 'flat')['temperatures'][0] - 20
    assert warmer == pytest.approx(heat / (1.204 * 1006 * 40), rel=0.01)


def test_commands_that_do_not_fit_are_rejected(world):
    w = world(include('fan', 'fan') + include('tv', 'tv')
              + device('radio', 'libappliance.so'))
    with pytest.raises(angen.Error, match='this appliance has no volume, but a speed'):
        w.command('appliance', 'fan', 'Volume 10')
    with pytest.raises(angen.Error, match='this appliance has no speed, but a volume'):
        w.command('appliance', 'tv', 'Speed 10')
    with pytest.raises(angen.Error, match='this appliance has no volume; it takes On and Off'):
        w.command('appliance', 'radio', 'Volume 10')
    with pytest.raises(angen.Error, match='110 is out of range'):
        w.command('appliance', 'tv', 'Volume 110')


def test_idle_power_is_a_part_of_power(world):
    with pytest.raises(angen.Error, match='idle_power is above power'):
        world(device('radio', 'libappliance.so', '<idle_power>60</idle_power>'))


def test_a_saved_appliance_stays_on(world):
    w = world(include('tv', 'tv'))
    w.command('appliance', 'tv', 'On')
    w.command('appliance', 'tv', 'Volume 70')
    w.run(0.1)
    again = state(angen.World.from_text(w.save()), 'tv')
    assert again['on'] and again['level'] == 70
