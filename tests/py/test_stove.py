"""The stove: its plates against the closed form, its heat in the room, and its commands."""
from math import exp

import pytest

import angen
from sdf_text import air, device, holder, sensor

AIR = air('-2 -2 0 2 2 2.5', extra='<heat_loss>0</heat_loss><air_change>0</air_change>'
          '<heat_capacity>{}</heat_capacity>')
STEADY_AIR = AIR.format(1000)


def stove(extra: str = '') -> str:
    return device('kitchen_stove0', 'libstove.so', extra)


def state(world: angen.World) -> dict:
    return world.device('stove', 'kitchen0')


def test_a_plate_warms_and_cools_by_the_closed_form(world):
    """T = T_air + P/G (1 - exp(-t G/C)), and back with the same time constant."""
    w = world(stove('<plate>1200 800 4</plate>') + STEADY_AIR)
    w.run(2)
    assert state(w)['plate_temperatures'] == pytest.approx([20.0])
    w.command('stove', 'kitchen0', 'FrontLeft 50')
    started = w.time
    for _ in range(3):
        w.run(100)
        rise = 600 / 4 * (1 - exp(-(w.time - started) * 4 / 800))
        assert state(w)['hottest'] - 20 == pytest.approx(rise, rel=0.01, abs=0.8)
    w.command('stove', 'kitchen0', 'Off')
    off, hottest = w.time, state(w)['hottest'] - 20
    w.run(200)
    assert state(w)['hottest'] - 20 == pytest.approx(hottest * exp(-(w.time - off) * 4 / 800),
                                                     rel=0.02)


def test_between_two_updates_a_command_counts_from_its_tick(world):
    w = world(stove('<plate>1000 1000 1</plate>') + STEADY_AIR)
    w.run(1.0)
    w.run(0.25)
    w.command('stove', 'kitchen0', 'Set 100')
    w.run(0.5)
    w.command('stove', 'kitchen0', 'Off')
    w.run(1.3)
    assert state(w)['hottest'] - 20 == pytest.approx(0.5, rel=0.01)     # 1 K/s


def test_each_plate_has_its_own_level_and_the_rest_stay_cold(world):
    w = world(stove() + STEADY_AIR)
    w.command('stove', 'kitchen0', 'RearLeft 100')
    w.run(60)
    one = state(w)
    assert one['levels'] == [0, 0, 100, 0] and one['power'] == 1000 and one['on']
    assert one['plate_temperatures'][2] > 90
    assert one['plate_temperatures'][0] == pytest.approx(20, abs=0.5)


def test_energy_in_is_energy_in_the_plates_and_in_the_air(world):
    """In a closed room nothing is lost: the energy that the plug counts is in iron and air."""
    w = world(stove() + AIR.format(1)
              + holder('p', sensor('libsmart_plug.so', '<load>stove/kitchen0</load>', 1)))
    w.run(1)
    w.command('stove', 'kitchen0', 'Set 100')
    w.run(300)
    w.command('stove', 'kitchen0', 'Off')
    w.run(300)
    plates = state(w)['plate_temperatures']
    stored = sum(c * (t - 20) for c, t in zip((960, 620, 620, 960), plates))
    in_air = 1.204 * 1006 * 40 * (w.device('climate', 'flat')['temperatures'][0] - 20)
    energy = w.sensor('plug', 'p')['energy']
    assert energy == pytest.approx(5000 * 300, rel=0.002)
    assert stored + in_air == pytest.approx(energy, rel=0.01)
    assert in_air > 0.5 * energy


def test_it_says_when_it_is_hot(world):
    w = world(stove('<plate>1500 900 3</plate>') + STEADY_AIR)
    w.run(0.2)
    w.command('stove', 'kitchen0', 'Set 100')
    w.run(40)
    assert state(w)['hot']
    w.command('stove', 'kitchen0', 'Off')
    w.run(900)
    assert not state(w)['hot'] and not state(w)['on']
    words = [event for _, source, _, event, _ in w.events() if source == 'kitchen0']
    assert words == ['on', 'hot', 'off', 'cool']


def test_without_a_climate_the_air_is_the_worlds(world):
    w = world(stove())
    w.run(1.1)
    assert state(w)['plate_temperatures'] == pytest.approx([295.15 - 273.15] * 4)


@pytest.mark.parametrize('extra, problem', [
    ('<plate>1000 0 1</plate>', 'three numbers above 0'),
    ('<plate>1 1 1</plate>' * 5, 'four plates at most'),
    ('<plate>1 1 1</plate><start>10 20</start><start>10 20</start>', 'one <start> for each plate'),
    ('<plate>1 1 1</plate><start>110 20</start>', 'outside 0 to 100 %')])
def test_bad_plates_are_rejected(world, extra, problem):
    with pytest.raises(angen.Error, match=problem):
        world(stove(extra))


def test_a_plate_that_it_has_not_is_rejected(world):
    w = world(stove('<plate>1000 600 2</plate>'))
    with pytest.raises(angen.Error, match='this stove has 1 plates only, and no RearLeft'):
        w.command('stove', 'kitchen0', 'RearLeft 10')
    with pytest.raises(angen.Error, match='a stove takes FrontLeft <0 to 100 percent>'):
        w.command('stove', 'kitchen0', 'Ignite')


def test_a_saved_stove_continues_to_warm(world):
    w = world(stove() + STEADY_AIR)
    w.command('stove', 'kitchen0', 'FrontRight 100')
    w.run(100)
    again = angen.World.from_text(w.save())
    for each in (w, again):
        each.run(50)
    assert state(again)['levels'] == [0, 100, 0, 0]
    assert state(again)['hottest'] == pytest.approx(state(w)['hottest'], abs=2)
