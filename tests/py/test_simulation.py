"""The tick: time, commands, spawn and delete, reset, and the same bytes for the same input."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

import angen
from sdf_text import box, pir, sdf_world


def test_a_summary_has_the_words_of_the_dict(world):
    w = world(pir('p1', '0 0 1 0 0 0'))
    assert w.summary('pir', 'p1') == ''
    w.run(1.0)
    assert w.summary('pir', 'p1').split()[0] == 'still' and not w.sensor('pir', 'p1')['motion']
    with pytest.raises(angen.Error, match="no door named 'p1'"):
        w.summary('door', 'p1')


def test_deleted_name_is_free_at_once(world):
    w = world('')
    for _ in range(3):
        w.spawn(pir('p1', '0 0 1 0 0 0'))
        w.step(101)
        assert w.sensor('pir', 'p1')['motion'] is False
        w.delete('p1')
    assert w.sensors() == []


def test_an_unknown_name_is_answered_with_the_nearest(world):
    w = world(box('crate', '0 0 0.5 0 0 0', '1 1 1'))
    with pytest.raises(angen.Error, match="named .x.; did you mean crate or floor"):
        w.delete('x')
    with pytest.raises(angen.Error, match="no door named 'nowhere'; there are none"):
        w.command('door', 'nowhere', 'Open')
    assert [e[3] for e in w.events()] == ['rejected', 'rejected']


def test_sensor_on_a_link_sees_from_where_the_link_is(world):
    w = world(box('cart', '0 0 0.25 0 0 0', '0.5 0.5 0.5')
              + box('wall', '3 0 1 0 0 0', '0.1 4 2', True))
    sensor = pir('', '0 0 0 0 0 0').split('<link name="link">')[1].split('</link>')[0]
    w.spawn(sensor, 'eye', [0.3, 0, 0, 0, 0, 0], on='cart::link')
    w.step(2)
    assert w.sensors('pir') == ['eye']
    w.delete('eye')
    assert w.sensors('pir') == []


def test_sensor_on_an_unknown_link_is_rejected(world):
    w = world('')
    sensor = pir('', '0 0 0 0 0 0').split('<link name="link">')[1].split('</link>')[0]
    with pytest.raises(angen.Error, match="no link 'roof'; known are link"):
        w.spawn(sensor, 'eye', on='floor::roof')


RESETS = """import angen
w = angen.World.from_text(TEXT)
for _ in range(3):
    w.run(0.3)
    w.reset()
"""


def test_reset_uses_no_memory_that_it_has_freed():
    """The pyroelectric PIR watches the shapes around it. malloc overwrites freed memory here."""
    text = sdf_world('<include><uri>model://pir_pyroelectric</uri></include>')
    subprocess.run([sys.executable, '-c', RESETS.replace('TEXT', repr(text))], check=True,
                   env={**os.environ, 'MALLOC_PERTURB_': '165'})


NOISY = pir('eye', '0 0 1 0 0 0').replace(
    '</ray>', '<noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise></ray>')


def differences(w: angen.World, n: int) -> list:
    found = []
    for _ in range(n):
        w.step(100)
        found.append(w.sensor('pir', 'eye')['difference'])
    return found


def test_spawning_one_sensor_changes_no_others_noise(world):
    wall = box('wall', '3 0 1 0 0 0', '0.1 6 2', True)
    alone, with_other = world(wall + NOISY), world(wall + NOISY)
    with_other.spawn(pir('other', '0 1 1 0 0 0'))
    first = differences(alone, 10)
    assert first == differences(with_other, 10)
    assert len(set(first)) > 5


def run_building(path: str, seed: int) -> str:
    w = angen.World(path, seed=seed)
    return drive_about(w)


def drive_about(w: angen.World) -> str:
    w.run(0.5)
    w.command('door', 'bathroom1', 'Open')
    w.command('lamp', 'bathroom1', 'On')
    w.command('elevator', 'elevator', 'Floor1')
    w.spawn(pir('extra', '0 0 0 0 0 0'), pose=[0.5, 0.5, 2, 0, 0, 0])
    w.run(2)
    w.delete('extra')
    w.run(0.5)
    return w.fingerprint


def test_same_seed_and_commands_give_the_same_bytes(building):
    w = angen.World(building, seed=3)
    first = drive_about(w)
    w.reset()
    assert drive_about(w) == first, 'after reset'
    assert run_building(building, 3) == first, 'a second world in one process'
    by_seed = [angen.World(building, seed=seed) for seed in (3, 4)]
    for each in by_seed:
        each.run(0.5)
    assert by_seed[0].fingerprint != by_seed[1].fingerprint
    script = f'import test_simulation as t; print(t.run_building({building!r}, 3))'
    other = subprocess.run([sys.executable, '-c', script], capture_output=True, text=True,
                           check=True, cwd=Path(__file__).parent)
    assert other.stdout.strip() == first, 'another process'


def test_its_repr_says_world_time_and_counts(world):
    w = world(box('crate', '0 0 1 0 0 0', '1 1 1') + pir('eye', '0 0 1 0 0 0'))
    w.run(0.5)
    assert repr(w) == "<angen.World 'test' at 0.5 s: 3 models, 0 devices, 1 sensor>"


def test_a_closed_world_is_read_and_does_not_advance(building, tmp_path):
    log = tmp_path / 'run.log'
    with angen.World(building, record=str(log)) as w:
        w.run(0.5)
    assert w.time == 0.5 and w.sensor('pir', 'kitchen_pir0_a') and repr(w).endswith('closed>')
    for change in (w.step, w.reset, lambda: w.run(1.0), lambda: w.delete('c1'),
                   lambda: w.request('camera', 'turtlebot', True)):
        with pytest.raises(angen.Error, match='closed'):
            change()
    replay = angen.Replay(str(log))  # its last fingerprint is there while w exists
    assert not replay.advance(1.0) and replay.truncated == replay.mismatch == ''
    assert replay.compared == 1


def test_an_exception_ends_a_world_and_passes(world):
    with pytest.raises(KeyError):
        with world('') as w:
            raise KeyError('mine')
    assert repr(w).endswith('closed>')
