"""A cup, a weighing table and a potted plant, against closed forms."""
from math import exp, tan

import numpy as np
import pytest

from sdf_text import air, box, include

AMBIENT = 22.0     # °C, of a world without a climate
CUP_HEAT, WATER_HEAT, HEAT_LOSS = 300.0, 4.186, 0.7   # J/K, J/(ml K), W/K
RADIUS, HEIGHT = 0.037, 0.085


# cup

def test_a_cup_cools_by_newtons_law(world):
    w = world(include('cup', 'c', '0 0 0 0 0 0'))
    w.run(1)
    assert w.device('cup', 'c')['temperature'] == pytest.approx(AMBIENT)
    w.command('cup', 'c', 'Fill 250')
    w.run(0.1)
    capacity = CUP_HEAT + 250 * WATER_HEAT
    hot = (CUP_HEAT * AMBIENT + 250 * WATER_HEAT * 85) / capacity
    assert w.device('cup', 'c')['temperature'] == pytest.approx(hot, abs=0.01)
    start = w.time
    for _ in range(3):
        w.run(600)
        expected = AMBIENT + (hot - AMBIENT) * exp(-(w.time - start) * HEAT_LOSS / capacity)
        assert w.device('cup', 'c')['temperature'] == pytest.approx(expected, abs=0.3)


@pytest.mark.parametrize('first', ['flat', 'cup'])
def test_an_empty_cup_starts_as_warm_as_its_room(world, first):
    flat = air('-2 -2 0 2 2 2.5', extra='<temperature>27</temperature>')
    cup = include('cup', 'c', '0 0 0 0 0 0')
    w = world(flat + cup if first == 'flat' else cup + flat)
    w.run(0.1)
    assert w.device('cup', 'c')['temperature'] == pytest.approx(27.0, abs=0.05)


def held(tilt: float) -> float:
    """ml that fit into the tilted cylinder, by adding up columns of its bottom."""
    x = np.linspace(-RADIUS, RADIUS, 20001)
    depth = np.clip(HEIGHT - (RADIUS + x) * tan(tilt), 0.0, None)
    return 1e6 * float(np.sum(2 * np.sqrt(RADIUS ** 2 - x ** 2) * depth) * (x[1] - x[0]))


@pytest.mark.parametrize('tilt', [0.3, 0.8, 1.0, 1.3])
def test_a_tilted_cup_keeps_the_drink_under_its_lip(world, tilt):
    w = world(include('cup', 'c', '0 0 0 0 0 0'))
    w.command('cup', 'c', 'Fill 350')
    w.command('cup', 'c', 'Lift 0.3')
    w.run(2)
    assert w.device('cup', 'c')['content'] == pytest.approx(350, abs=0.5)
    w.command('cup', 'c', f'Tilt {tilt}')
    w.run(4)
    state = w.device('cup', 'c')
    assert state['tilt'] == pytest.approx(tilt, abs=0.02)
    assert state['content'] == pytest.approx(min(350.0, held(state['tilt'])), rel=0.02)
    assert state['content'] + state['poured'] == pytest.approx(350)


def test_a_cup_that_is_knocked_over_runs_out(world):
    w = world(include('cup', 'c', '0 0 0.03 0 0.8 0'))   # on its edge
    w.command('cup', 'c', 'Fill 200')
    w.run(3)
    assert w.device('cup', 'c')['content'] < 5


def test_a_cup_says_why_it_does_not(world):
    import angen
    w = world(include('cup', 'c', '0 0 0 0 0 0'))
    with pytest.raises(angen.Error, match='it takes 365.6 ml and has 0 ml in it'):
        w.command('cup', 'c', 'Fill 400')
    with pytest.raises(angen.Error, match='lift it first'):
        w.command('cup', 'c', 'Tilt 1')


def test_a_pour_is_reported_once_when_it_begins_and_once_when_it_has_ended(world):
    w = world(include('cup', 'c', '0 0 0 0 0 0'))
    w.command('cup', 'c', 'Fill 250')
    w.command('cup', 'c', 'Lift 0.3')
    w.run(2)
    w.events()
    w.command('cup', 'c', 'Tilt 1.2')
    w.run(4)
    state = w.device('cup', 'c')
    reported = [(event, detail) for _, _, kind, event, detail in w.events() if kind == 'cup']
    assert reported == [('pours', ''), ('poured', f"{state['poured']:.1f} ml in all")]


@pytest.mark.parametrize('height', [0.3, 0.5, 1.0, 2.0])
def test_an_even_lift_is_one_movement(world, height):
    """Between its start and its end nothing is felt of it."""
    w = world(include('cup', 'c', '0 0 0 0 0 0'))
    w.run(1)
    w.events()
    for text, said, lifted in ((f'Lift {height}', 'lifted', True), ('Put', 'put_down', False)):
        w.command('cup', 'c', text)
        w.run(8)
        reported = [event for _, _, kind, event, _ in w.events() if kind == 'accelerometer']
        assert reported == ['moved', said]
        reading = w.sensor('accelerometer', 'c')
        assert reading['lifted'] == lifted and not reading['moving']
        assert reading['height'] == pytest.approx(height if lifted else 0.0, abs=0.03)


def test_an_accelerometer_tells_lifting_from_tilting(world):
    w = world(include('cup', 'c', '0 0 0 0 0 0'))
    w.run(1)
    felt = w.sensor('accelerometer', 'c')['acceleration']
    assert np.linalg.norm(felt) == pytest.approx(9.81, abs=0.15)
    w.events()
    heard = []
    for text, seconds in (('Lift 0.25', 3), ('Tilt 0.9', 3), ('Put', 5)):
        w.command('cup', 'c', text)
        w.run(seconds)
        heard.append({event for _, _, kind, event, _ in w.events() if kind == 'accelerometer'})
        if text.startswith('Lift'):
            assert w.sensor('accelerometer', 'c')['height'] == pytest.approx(0.25, abs=0.02)
    assert {'moved', 'lifted'} <= heard[0] and not {'tilted', 'put_down'} & heard[0]
    assert 'tilted' in heard[1] and 'lifted' not in heard[1]
    assert {'upright', 'put_down'} <= heard[2]
    reading = w.sensor('accelerometer', 'c')
    assert not reading['lifted'] and not reading['moving'] and not reading['tilted']
    w.run(2)
    assert w.awake_bodies == 0


# weighing table

@pytest.mark.parametrize('x,y,mass', [(0.0, 0.0, 2.0), (0.12, -0.07, 1.3), (-0.15, 0.15, 8.0)])
def test_load_cells_tell_weight_and_place(world, x, y, mass):
    w = world(include('weighing_table', 't', '1 2 0.001 0 0 0'))
    w.run(2)
    assert w.sensor('load_cells', 't')['weight'] == pytest.approx(0.0, abs=0.05)
    assert np.isnan(w.sensor('load_cells', 't')['x'])
    w.spawn(f'''<sdf version="1.6">{box('crate', '0 0 0 0 0 0', '0.1 0.1 0.1', mass=mass)}</sdf>''',
            'crate', [1 + x, 2 + y, 0.555, 0, 0, 0])
    w.run(2)
    reading = w.sensor('load_cells', 't')
    assert reading['weight'] == pytest.approx(mass, abs=0.05)
    assert (reading['x'], reading['y']) == pytest.approx((x, y), abs=0.01 + 0.01 / mass)
    assert sum(reading['cells']) == pytest.approx(mass + 6.0, abs=0.05)
    assert [event for _, _, kind, event, _ in w.events() if kind == 'load_cells'] == ['placed']


def test_a_drink_weighs_until_it_is_poured(world):
    w = world(include('weighing_table', 't', '0 0 0.001 0 0 0')
              + include('cup', 'c', '0.05 0.05 0.503 0 0 0'))
    w.run(2)
    assert w.sensor('load_cells', 't')['weight'] == pytest.approx(0.35, abs=0.04)
    w.command('cup', 'c', 'Fill 300')
    w.run(2)
    assert w.sensor('load_cells', 't')['weight'] == pytest.approx(0.65, abs=0.04)
    assert w.awake_bodies == 0
    w.command('cup', 'c', 'Lift 0.2')
    w.run(3)
    assert w.sensor('load_cells', 't')['weight'] == pytest.approx(0.0, abs=0.04)
    w.command('cup', 'c', 'Tilt 1.57')
    w.run(3)
    w.command('cup', 'c', 'Put')
    w.run(6)
    assert w.device('cup', 'c')['content'] == pytest.approx(0.0, abs=1.0)
    assert w.sensor('load_cells', 't')['weight'] == pytest.approx(0.35, abs=0.04)


# plant

def penman(temperature: float, humidity: float) -> float:
    """mm a day in still air and darkness."""
    saturated = 6.112 * exp(17.62 * temperature / (243.12 + temperature))
    slope = saturated * 17.62 * 243.12 / (243.12 + temperature) ** 2
    return 0.66 * 0.35 / 1.333 * saturated * (1 - humidity / 100) / (slope + 0.66)


def test_soil_dries_evenly_and_then_as_it_has_less(world):
    w = world(include('plant', 'p', '0 0 0 0 0 0'))
    day = penman(AMBIENT, 50) * 0.06 / 8.0 * 100     # % of moisture: mm x m2 / l
    easy = 9.0 / day                                 # days from 30 % to 21 %
    w.run(86400 * 0.5 * easy)
    assert w.device('plant', 'p')['moisture'] == pytest.approx(30 - 4.5, abs=0.02)
    w.run(86400 * 1.5 * easy)
    assert w.device('plant', 'p')['moisture'] == pytest.approx(12 + 9 * exp(-1), abs=0.02)
    assert w.device('plant', 'p')['dry']
    assert w.sensor('soil_moisture', 'p')['moisture'] == pytest.approx(12 + 9 * exp(-1), abs=1.5)
    assert w.sensor('soil_moisture', 'p')['dry']


def test_water_that_the_soil_does_not_hold_runs_through(world):
    w = world(include('plant', 'p', '0 0 0 0 0 0',
                      '<plugin name="p" filename="libplant.so"><moisture>20</moisture></plugin>'))
    w.run(1)
    w.command('plant', 'p', 'Water 400')      # 5 % of 8 l
    w.run(1)
    assert w.device('plant', 'p')['moisture'] == pytest.approx(25, abs=0.01)
    w.command('plant', 'p', 'Water 500')
    w.run(1)
    state = w.device('plant', 'p')
    assert state['moisture'] == pytest.approx(30, abs=0.01)
    assert state['drained'] == pytest.approx(100, abs=1)
