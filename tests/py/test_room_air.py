"""Surfaces that devices warm, in a room whose climate differs from the world's air."""
from math import exp

import pytest

from sdf_text import air

BOX = '<geometry><box><size>0.02 0.5 0.5</size></box></geometry>'
SURFACE = f'<collision name="face">{BOX}</collision><visual name="face">{BOX}</visual>'
EYE = '''<model name="eye"><static>true</static><pose>0 0 1.2 0 0 0</pose><link name="l">
  <sensor name="pir" type="ray"><update_rate>100</update_rate><plugin name="pir"
  filename="libpir_controller.so"><model>pyroelectric</model><warm_up>0</warm_up>
  <noise_stddev>0</noise_stddev></plugin></sensor></link></model>'''
DEVICES = {'heater': '<plugin name="p" filename="libheater.so">{}</plugin>',
           'warm_surface': '<plugin name="p" filename="libwarm_surface.so">{}</plugin>',
           'stove': '<plugin name="p" filename="libstove.so"><plate>1000 900 3</plate>'
                    '<plate_visual>face</plate_visual>{}</plugin>'}


def flat(celsius: float, capacity: float = 1000) -> str:
    """A room whose air stays, unless its heat capacity is small."""
    return air('-4 -4 0 4 4 2.5', extra=f'<temperature>{celsius}</temperature><heat_capacity>'
               f'{capacity}</heat_capacity><outside_temperature>5</outside_temperature>')


def thing(kind: str, extra: str = '') -> str:
    """Before the PIR, to one side, so that it is not in both halves of a zone alike."""
    return (f'<model name="kitchen_{kind}0"><static>true</static><pose>2 0.3 1.2 0 0 0</pose>'
            f'<link name="l">{SURFACE}</link>' + DEVICES[kind].format(extra) + '</model>')


def flux(world) -> float:
    return world.sensor('pir', 'eye')['flux']


@pytest.mark.parametrize('kind', DEVICES)
@pytest.mark.parametrize('celsius', [10.0, 30.0])
def test_what_is_off_is_as_warm_as_its_room(world, kind, celsius):
    for parts in ([flat(celsius), thing(kind), EYE], [EYE, thing(kind), flat(celsius)]):
        w = world(''.join(parts))
        w.run(2.0)
        assert flux(w) == pytest.approx(0.0, abs=1e-9)
    # 2 K of the world's air over the room's would be seen
    warmer = f'<temperature>{celsius + 275.15}</temperature>'
    w = world(flat(celsius) + thing('warm_surface', warmer) + EYE)
    w.run(2.0)
    assert abs(flux(w)) > 1e-8


def kelvin_of(w, reference: float, air: float) -> float:
    """The temperature of what the PIR sees, by Stefan and Boltzmann; 320 K give `reference`."""
    return (flux(w) / reference * (320.0 ** 4 - air ** 4) + air ** 4) ** 0.25


@pytest.mark.parametrize('kind, extra, name, text, most, time_constant', [
    ('heater', '<surface_rise>40</surface_rise><surface_time_constant>100</surface_time_constant>',
     'kitchen_heater0', 'On', 40.0, 100.0),
    ('stove', '', 'kitchen0', 'Set 60', 600.0 / 3.0, 900.0 / 3.0)])
def test_it_is_seen_as_hot_as_it_is_over_the_air_of_its_room(world, kind, extra, name, text, most,
                                                             time_constant):
    air = 273.15 + 12.0
    w = world(flat(12.0) + thing('warm_surface', '<temperature>320</temperature>') + EYE)
    w.run(1.0)
    reference = flux(w)
    w = world(flat(12.0) + thing(kind, extra) + EYE)
    w.run(1.0)
    w.command(kind, name, text)
    start = w.time
    for _ in range(3):
        w.run(60.0)
        rise = most * (1.0 - exp(-(w.time - start) / time_constant))
        assert kelvin_of(w, reference, air) == pytest.approx(air + rise, abs=0.2)


@pytest.mark.parametrize('kind', ['heater', 'stove'])
def test_what_is_off_cools_with_its_room(world, kind):
    """The room loses 5 K in some minutes; what is in it follows with its own time constant."""
    w = world(flat(20.0, 1.0) + thing(kind) + EYE)
    w.run(1.0)
    w.run(3600.0)
    air = w.device('climate', 'flat')['temperatures'][0]
    assert air < 15.0
    seen = world(flat(air) + thing('warm_surface', f'<temperature>{air + 274.15}</temperature>')
                 + EYE)
    seen.run(1.0)
    assert abs(flux(w)) < 0.5 * abs(flux(seen)), 'half a kelvin'
