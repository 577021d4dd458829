"""Surfaces whose temperature changes: a pyroelectric PIR's reports of them, and their heating.

The oracle is the filter's differential equation in continuous time, by Runge-Kutta in numpy; the
simulator has it as a recursion at 100 Hz.
"""
from math import exp, pi

import numpy as np
import pytest

import angen
from sdf_text import include

AIR = 295.15    # K
PIR = {'thermal_time_constant': 0.1, 'electrical_time_constant': 1.6, 'low_cutoff': 0.4,
       'high_cutoff': 10.0, 'responsivity': 3300.0}


def pir(**extra: object) -> str:
    """At 2.2 m, without noise, with the filter of PIR."""
    values = {'model': 'pyroelectric', 'warm_up': 0, 'noise_stddev': 0, **PIR, **extra}
    plugin = ''.join(f'<{key}>{value}</{key}>' for key, value in values.items())
    return f'''<model name="eye"><static>true</static><pose>0 0 2.2 0 0 0</pose><link name="l">
      <sensor name="pir" type="ray"><update_rate>100</update_rate><plugin name="pir"
      filename="libpir_controller.so">{plugin}</plugin></sensor></link></model>'''


def plate(extra: str = '', name: str = 'plate', pose: str = '2 0.15 1.2 0 0 0') -> str:
    box = '<geometry><box><size>0.02 0.2 0.5</size></box></geometry>'
    return f'''<model name="{name}"><static>true</static><pose>{pose}</pose><link name="l">
      <collision name="face">{box}</collision><visual name="face">{box}</visual></link>
      <plugin name="warm" filename="libwarm_surface.so">{extra}</plugin></model>'''


def excess(kelvin: float) -> float:
    """A surface that radiates more than the air, but for a factor."""
    return kelvin ** 4 - AIR ** 4


def eye(world: angen.World) -> dict:
    return world.sensor('pir', 'eye')


def analog_gain(frequency: float) -> float:
    """|volts per watt| of the chain without its scale."""
    s = 2j * pi * frequency
    low, high = 2 * pi * PIR['low_cutoff'], 2 * pi * PIR['high_cutoff']
    return abs(1 / (1 + s * PIR['thermal_time_constant'])
               * s * PIR['electrical_time_constant'] / (1 + s * PIR['electrical_time_constant'])
               * s / (s + low) * high / (s + high))


def response(flux, seconds: float, step: float = 0.001) -> np.ndarray:
    """The voltage at each step, of a flux in W that is 0 before the time 0."""
    rates = np.array([1 / PIR['thermal_time_constant'], 1 / PIR['electrical_time_constant'],
                      2 * pi * PIR['low_cutoff'], 2 * pi * PIR['high_cutoff']])
    scale = PIR['responsivity'] / analog_gain(1.0)

    def derivative(state: np.ndarray, time: float) -> np.ndarray:
        warm, charge, low, high = state
        kept = warm - charge            # of a high pass: the rest of its low pass
        passed = kept - low
        return rates * np.array([flux(time) - warm, kept, passed, passed - high])

    state, values = np.zeros(4), []
    for i in range(round(seconds / step)):
        values.append(scale * state[3])
        t = i * step
        a = derivative(state, t)
        b = derivative(state + step / 2 * a, t + step / 2)
        c = derivative(state + step / 2 * b, t + step / 2)
        d = derivative(state + step * c, t + step)
        state = state + step / 6 * (a + 2 * b + 2 * c + d)
    return np.array(values)


@pytest.mark.parametrize('time_constant, target', [(0.5, 310.0), (4.0, 360.0), (3.0, 270.0)])
def test_a_plate_that_warms_gives_the_response_of_the_band_pass(world, time_constant, target):
    w = world(pir() + plate(f'<time_constant>{time_constant}</time_constant>'))
    w.run(2.0)
    assert eye(w)['signal'] == 0.0 and eye(w)['flux'] == 0.0
    w.command('warm_surface', 'plate', f'Temperature {target}')
    begins, fluxes, volts = w.time, [], []
    for _ in range(800):
        w.run(0.01)
        fluxes.append(eye(w)['flux'])
        volts.append(eye(w)['signal'])
    w.run(12 * time_constant)
    final = eye(w)['flux']
    assert abs(final) > 1e-8
    times = np.arange(1, 801) * 0.01

    def flux(time: float) -> float:
        kelvin = target + (AIR - target) * exp(-time / time_constant)
        return final * excess(kelvin) / excess(target)

    assert begins == pytest.approx(2.0)
    assert fluxes == pytest.approx([flux(t) for t in times], abs=0.002 * abs(final))
    expected = response(flux, 8.1)[np.round(times * 1000).astype(int)]
    peak = np.abs(expected).max()
    assert peak > 2e-5
    assert np.abs(np.array(volts) - expected).max() < 0.02 * peak


def test_a_resting_pir_wakes_and_rests_again(world):
    w = world(pir() + plate('<time_constant>2</time_constant>'))
    w.run(30)
    for target in (330, 300):
        w.command('warm_surface', 'plate', f'Temperature {target}')
        w.run(1.0)
        assert eye(w)['signal'] != 0.0
        w.run(60)
        assert eye(w)['signal'] == 0.0
        state = w.device('warm_surface', 'plate')
        assert state['temperature'] == state['target'] == target and not state['changes']


def test_a_hot_plate_that_stays_hot_is_not_motion_and_a_fast_one_is(world):
    slow = world(pir() + plate('<time_constant>600</time_constant>'))
    fast = world(pir() + plate('<time_constant>0.3</time_constant>'))
    for w in (slow, fast):
        w.run(2)
        w.command('warm_surface', 'plate', 'Temperature 340')
        w.run(30)
    words = [[event for _, source, _, event, _ in w.events() if source == 'eye']
             for w in (slow, fast)]
    assert words[0] == [] and 'motion' in words[1]


def test_a_leaping_run_has_the_readings_of_one_that_takes_every_tick(world):
    """Readings, states and events of two worlds, of which one leaps."""
    text = (pir() + plate('<time_constant>2</time_constant>')
            + plate('<time_constant>0</time_constant>', 'other', '3 -0.4 1 0 0 0')
            + include('heater', 'heater', '2.5 -1 0 0 0 3.14')
            + include('stove', 'kitchen_stove0', '3 1 0 0 0 3.14'))
    walks, leaps = world(text), world(text)
    script = {0: None, 5: ('warm_surface', 'plate', 'Temperature 320'),
              9: ('warm_surface', 'other', 'Temperature 300'), 12: ('heater', 'heater', 'On'),
              20: ('stove', 'kitchen0', 'FrontLeft 100'), 25: ('warm_surface', 'plate', 'Air'),
              31: ('stove', 'kitchen0', 'Off')}
    for second in range(40):
        for w in (walks, leaps):
            if script.get(second):
                w.command(*script[second])
        walks.step(1000)
        leaps.run(1.0)
        assert eye(walks) == eye(leaps), second
        for kind, name in (('warm_surface', 'plate'), ('heater', 'heater'), ('stove', 'kitchen0')):
            assert walks.device(kind, name) == leaps.device(kind, name), (second, kind)
        assert walks.events() == leaps.events()


def test_a_saved_world_continues(world):
    w = world(pir() + plate('<time_constant>10</time_constant>')
              + include('heater', 'heater', '2.5 -1 0 0 0 3.14'))
    w.command('warm_surface', 'plate', 'Temperature 340')
    w.command('heater', 'heater', 'On')
    w.run(7)
    again = angen.World.from_text(w.save())
    again.run(4)
    w.run(4)
    assert again.device('warm_surface', 'plate')['temperature'] == pytest.approx(
        w.device('warm_surface', 'plate')['temperature'], abs=0.02)
    assert eye(again)['flux'] == pytest.approx(eye(w)['flux'], rel=2e-3)


def test_a_pir_sees_the_warmth_of_a_heater_and_a_stove(world):
    """The flux follows the temperatures that the devices have by their own closed forms."""
    wide = pir(zone_row='1 -0.8 0.8 -1.2 0.2')  # not a lens, whose zones might miss them
    w = world(wide + include('heater', 'heater', '2.5 -0.9 0 0 0 3.14159')
              + include('stove', 'kitchen_stove0', '2.5 1.2 0 0 0 3.14159'))
    w.run(3)
    assert eye(w)['flux'] == 0.0
    w.command('heater', 'heater', 'Set 50')
    rises = []
    for _ in range(3):
        w.run(150)
        rises.append((w.time - 3, eye(w)['flux']))
    w.run(5000)
    final = eye(w)['flux']
    assert abs(final) > 1e-8
    for time, flux in rises:
        rise = 20.0 * (1 - exp(-time / 300.0))
        assert flux / final == pytest.approx(excess(AIR + rise) / excess(AIR + 20.0), rel=0.002)
    w.command('stove', 'kitchen0', 'RearLeft 100')
    w.run(200)
    assert abs(eye(w)['flux'] - final) > 1e-8


def test_heat_that_is_over_leaves_no_trace(world):
    w = world(pir() + include('stove', 'kitchen_stove0', '2.5 0.3 0 0 0 3.14159'))
    w.command('stove', 'kitchen0', 'Set 100')
    w.run(60)
    assert eye(w)['flux'] != 0.0
    w.command('stove', 'kitchen0', 'Off')
    w.run(1.3 * 3600)
    assert eye(w)['flux'] == 0.0


def test_a_device_in_python_warms_a_surface(world):
    class Kettle(angen.Device):
        @staticmethod
        def serves(model, joints, lights):
            return model == 'kettle'

        def configure(self, params, wiring):
            self.surfaces = wiring.surfaces('face')
            with pytest.raises(angen.Error, match="no visual with a collision of its name 'lid'"):
                wiring.surfaces('lid')

        def command(self, text, values, view):
            self.boils = True

        def update(self, view, outputs):
            if getattr(self, 'boils', False):
                self.boils = False
                for surface in self.surfaces:
                    outputs.temperature(surface, 295.15, 373.0, 1.0)

        def report(self, view):
            return {}
    angen.register('kettle.py', 'kettle', Kettle)
    text = plate(name='kettle').replace('libwarm_surface.so', 'kettle.py')
    w = world(pir() + text)
    w.run(1)
    w.command('kettle', 'kettle', 'boil')
    w.run(20)
    assert eye(w)['flux'] != 0.0


@pytest.mark.parametrize('extra, problem', [
    ('<surface>lid</surface>', "no visual with a collision of its name 'lid'; known are face"),
    ('<temperature>0</temperature>', '<temperature>'),
    ('<time_constant>-1</time_constant>', '<time_constant>')])
def test_bad_parameters_are_rejected(world, extra, problem):
    with pytest.raises(angen.Error, match=problem):
        world(plate(extra))


def test_bad_commands_are_rejected(world):
    w = world(plate())
    for text in ('Temperature', 'Temperature 0', 'Temperature warm', 'Melt'):
        with pytest.raises(angen.Error, match='a warm_surface takes'):
            w.command('warm_surface', 'plate', text)
