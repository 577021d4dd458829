"""People in air and in narrow places: their heat and breath, and who gives way to whom."""
from math import cos, exp, hypot, pi, sin

import pytest

from sdf_text import air, box, person, walker

AIR_HEAT = 1.204 * 1006  # J/(m^3 K)
EVAPORATION = 2430.0     # J/g of water


def flat(celsius: float, humidity: float = 50.0) -> str:
    """A tight room of 100 m^3."""
    return air('-5 -5 0 5 5 1', extra=f'<temperature>{celsius}</temperature><humidity>{humidity}'
               '</humidity><heat_loss>0</heat_loss><air_change>0</air_change>')


def pressure(celsius: float) -> float:
    """Pa over water, by Magnus."""
    return 611.2 * exp(17.62 * celsius / (243.12 + celsius))


def test_a_standing_person_heats_and_moistens_as_tables_say(world):
    """VDI 2078, activity I to II in air of 22 °C: 85 W of dry heat and 60 g/h of vapor."""
    w = world(flat(22.0) + person('0 0 0 0 0 0'))
    w.run(11.0)
    state = w.device('person', 'ann')
    assert state['heat'] == pytest.approx(85, abs=3)
    assert state['vapor'] == pytest.approx(60, abs=3)


def test_what_a_person_gives_is_in_the_air_of_the_room(world):
    """All heat, dry and with the vapor, is 70 W/m^2 of 1.8 m^2 (ISO 7730, who stands relaxed)."""
    w = world(flat(22.0) + person('0 0 0 0 0 0'))
    seconds = 600.0
    w.run(seconds)
    air = w.device('climate', 'flat')
    warm, humid = air['temperatures'][0], air['humidities'][0]
    before, after = (0.622 * p / (101325 - p) for p in (0.5 * pressure(22.0),
                                                        humid / 100 * pressure(warm)))
    grams = 1000 * 1.204 * 100 * (after - before)
    given = AIR_HEAT * 100 * (warm - 22.0) + EVAPORATION * grams
    assert grams > 5.0
    assert given == pytest.approx(70 * 1.8 * seconds, rel=0.02)


def test_a_walking_person_gives_the_heat_of_iso_7730(world):
    """At 4 km/h 165 W/m^2."""
    w = world(flat(20.0) + walker('ann', '0 -4 0', '7.2 4 0'))
    w.run(4.0)
    state = w.device('person', 'ann')
    assert state['mode'] == 'WALKING'
    assert state['heat'] + EVAPORATION * state['vapor'] / 3600 == pytest.approx(165 * 1.8, rel=0.05)


def corridor(width: float) -> str:
    return ''.join(box(f'wall{side}', f'0 {side * (width / 2 + 0.05)} 1 0 0 0', '14 0.1 2', True)
                   for side in (-1, 1))


@pytest.mark.parametrize('width', [1.2, 1.4])
def test_two_sent_people_pass_each_other_in_a_corridor(world, width):
    w = world(corridor(width) + person('-4 0 0 0 0 0') + person('4 0 0 0 0 3.14', name='bob'))
    w.command('person', 'ann', 'GoTo 4 0')
    w.command('person', 'bob', 'GoTo -4 0')
    nearest = 9.0
    for _ in range(200):
        w.run(0.1)
        ann, bob = (w.device('person', name) for name in ('ann', 'bob'))
        nearest = min(nearest, hypot(ann['x'] - bob['x'], ann['y'] - bob['y']))
    assert ann['x'] == pytest.approx(4, abs=0.1) and bob['x'] == pytest.approx(-4, abs=0.1)
    assert nearest > 0.5


RAMP, LENGTH = 6 * pi / 180, 6.0


def ramp(landing: float = LENGTH * sin(RAMP)) -> str:
    """A ramp from x = 0 up to a landing, so thick (m), at 6 m cos 6 degrees."""
    thick = 0.2
    middle = (LENGTH / 2 * cos(RAMP) + thick / 2 * sin(RAMP),
              LENGTH / 2 * sin(RAMP) - thick / 2 * cos(RAMP))
    top = LENGTH * sin(RAMP)
    return (box('ramp', f'{middle[0]} 0 {middle[1]} 0 {-RAMP} 0', f'{LENGTH} 2 {thick}', True)
            + box('landing', f'{LENGTH * cos(RAMP) + 1} 0 {top - landing / 2} 0 0 0',
                  f'2 2 {landing}', True))


@pytest.mark.parametrize('sent', [True, False])
def test_a_ramp_of_6_degrees_is_walked_up(world, sent):
    up = (person('-1 0 0 0 0 0') if sent else walker('ann', '0 -1 0', '8 7 0'))
    w = world(ramp() + up)
    if sent:
        w.command('person', 'ann', 'GoTo 7 0')
    w.run(20.0)
    state = w.device('person', 'ann')
    assert state['x'] == pytest.approx(7, abs=0.1)
    assert state['z'] == pytest.approx(LENGTH * sin(RAMP), abs=0.02)
    w.command('person', 'ann', 'GoTo -1 0')
    w.run(20.0)
    assert w.device('person', 'ann')['x'] == pytest.approx(-1, abs=0.1)


def test_a_landing_with_room_below_is_reached_by_its_ramp(world):
    w = world(ramp(0.1) + person('-1 0 0 0 0 0'))
    w.command('person', 'ann', 'GoTo 7 0')
    w.run(20.0)
    state = w.device('person', 'ann')
    assert state['x'] == pytest.approx(7, abs=0.1)
    assert state['z'] == pytest.approx(LENGTH * sin(RAMP), abs=0.02)
