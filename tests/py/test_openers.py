"""The windows and fronts of angen.world open and shut by command, and their reeds say so."""
import pytest

import angen


def reed_of(kind, name):
    """The reed contact of a leaf, by the name that commands use: kitchen0 -> kitchen_window0."""
    return f'{name[:-1]}_{kind}{name[-1]}'


@pytest.fixture(scope='module')
def opened(building):
    w = angen.World(building)
    w.command('person', 'person', 'Stop')
    w.run(4)
    idle = w.awake_bodies
    leaves = [(kind, name) for kind in ('window', 'cabinet') for name in w.devices(kind)]
    for kind, name in leaves:
        w.command(kind, name, 'Open')
    w.run(6)
    states = {leaf: w.device(*leaf) for leaf in leaves}
    reeds = {key: w.sensor('reed', reed_of(*key)) for key in states}
    return w, idle, states, reeds


def test_all_of_them_open_and_their_reeds_say_so(opened):
    _, _, states, reeds = opened
    assert {key for key, state in states.items() if state['mode'] != 'OPEN'} == set()
    assert {key for key, reed in reeds.items() if reed['closed']} == set()


def test_a_window_tells_the_climate_its_own_height(opened):
    _, _, states, _ = opened
    assert states['window', 'bathroom0']['height'] == pytest.approx(0.56)
    assert 'height' not in states['cabinet', 'kitchen_fridge0']


def test_they_shut_again_and_then_sleep(opened):
    w, idle, states, _ = opened
    for kind, name in states:
        w.command(kind, name, 'Close')
    w.run(7)
    assert {key for key in states if w.device(*key)['mode'] != 'CLOSED'} == set()
    assert all(w.sensor('reed', reed_of(*key))['closed'] for key in states)
    assert w.awake_bodies <= idle
