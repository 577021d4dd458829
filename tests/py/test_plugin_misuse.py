"""Plug-ins in Python, and threads, that misuse what they get: an error, and the world goes on."""
import itertools
import os
import signal
import threading
import time

import numpy as np
import pytest

import angen

MODEL = '''<model name="eye"><static>true</static><link name="link">
  <sensor name="s" type="ray"><plugin name="p" filename="misused.py"/></sensor></link></model>'''
FILES = itertools.count()
KEPT = 'can be used until the method returns'
BUSY = 'a call is in progress'


class Quiet(angen.Sensor):
    rate = 20.0

    def read(self, view, ranges, rng):
        return {'x': 1.0}


def made(world, **members):
    """A world with a sensor of these members, of a file of its own."""
    file = f'misused{next(FILES)}.py'
    angen.register(file, 'misused', type('Misused', (Quiet,), members))
    return world(MODEL.replace('misused.py', file))


@pytest.mark.parametrize('use', [
    lambda kept: kept['params'].number('x', 1.0), lambda kept: kept['wiring'].name,
    lambda kept: kept['view'].time, lambda kept: kept['rng'].uniform(),
    lambda kept: kept['kind'].flag('x', 'y')])
def test_a_kept_argument_is_an_error(world, use):
    kept = {}

    def read(self, view, ranges, rng):
        kept.update(view=view, rng=rng)
        return {}

    w = made(world, describe=staticmethod(lambda kind: kept.update(kind=kind)), read=read,
             configure=lambda self, params, wiring: kept.update(params=params, wiring=wiring))
    w.run(0.1)
    with pytest.raises(angen.Error, match=KEPT):
        use(kept)


@pytest.mark.parametrize('use', [
    lambda w: w.run(1.0), lambda w: w.step(), lambda w: w.delete('eye'), lambda w: w.reset(),
    lambda w: w.spawn('model://pir', 'p'), lambda w: w.save(), lambda w: w.link_poses])
def test_a_plug_in_that_uses_its_world_fails_alone(world, use):
    worlds = []
    w = made(world, read=lambda self, view, ranges, rng: use(worlds[0]) or {})
    worlds.append(w)
    with pytest.raises(angen.Error, match=f"misused 'eye' has failed: .*{BUSY}"):
        w.run(0.1)
    w.run(1.0)
    assert w.time == pytest.approx(1.1) and w.models == ['floor', 'eye']


@pytest.mark.parametrize('use', [
    lambda w: w.step(), lambda w: w.command('door', 'd', 'Open'), lambda w: w.link_poses,
    lambda w: w.summaries(), lambda w: w.cast(np.zeros((1, 3)), np.ones((1, 3)), 1.0)])
def test_a_second_thread_gets_an_error(world, use):
    inside, leave, said = threading.Event(), threading.Event(), []

    def read(self, view, ranges, rng):
        inside.set()
        leave.wait(20)
        return {}

    w = made(world, read=read)

    def other():
        inside.wait(20)
        try:
            use(w)
        except angen.Error as error:
            said.append(str(error))
        leave.set()

    thread = threading.Thread(target=other)
    thread.start()
    w.run(0.01)
    thread.join()
    assert len(said) == 1 and BUSY in said[0]
    assert w.time == pytest.approx(0.01)


def interrupt():
    os.kill(os.getpid(), signal.SIGINT)


def test_ctrl_c_in_a_plug_in_ends_the_run_and_not_the_call(world):
    def read(self, view, ranges, rng):
        value = rng.gaussian()
        if view.time > 0.5 and not sent:
            sent.append(view.time)
            interrupt()
            for _ in range(1000):
                time.sleep(0.0001)
        calls.append(view.time)
        return {'x': value}

    sent, calls = [], []
    w = made(world, read=read)
    with pytest.raises(KeyboardInterrupt):
        w.run(100.0)
    assert 0.5 < w.time == pytest.approx(sent[0]) == pytest.approx(calls[-1])
    w.run(1.0)
    assert 'error' not in w.sensor('misused', 'eye') and len(calls) == len(set(calls))
    calm = made(world, read=lambda self, view, ranges, rng: {'x': rng.gaussian()})
    calm.run(w.time)
    assert calm.sensor('misused', 'eye')['x'] == w.sensor('misused', 'eye')['x']


def test_a_second_ctrl_c_ends_a_call_that_does_not_end(world):
    def read(self, view, ranges, rng):
        while True:
            interrupt()
            time.sleep(0.001)

    w = made(world, read=read)
    with pytest.raises(KeyboardInterrupt):
        try:
            w.run(0.1)
        except angen.Error:
            time.sleep(1.0)
    w.run(1.0)
    assert 'KeyboardInterrupt' in w.sensor('misused', 'eye')['error']


def test_ctrl_c_reaches_a_command_at_once(world):
    members = {'serves': staticmethod(lambda *_: True), 'command': lambda *_: interrupt()}
    angen.register('asked.py', 'asked', type('Asked', (angen.Device,), members))
    w = world('<model name="m"><static>true</static><link name="l"/>'
              '<plugin name="p" filename="asked.py"/></model>')
    with pytest.raises(KeyboardInterrupt):
        try:
            w.command('asked', 'm', 'Go')
        except angen.Error:
            time.sleep(1.0)
    w.run(1.0)
    assert w.time == pytest.approx(1.0)


def test_ctrl_c_of_one_world_ends_no_other_thread(world):
    def read(self, view, ranges, rng):
        if view.time > 0.5 and not sent:
            sent.append(view.time)
            interrupt()
        return {}

    sent, other = [], world('')
    thread = threading.Thread(target=other.run, args=(5.0,))
    w = made(world, read=read)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        w.run(100.0)
    thread.join()
    assert other.time == pytest.approx(5.0)


@pytest.mark.parametrize('members, says', [
    ({'read': lambda *_: None}, r'read\(\) must return a dict; it is None'),
    ({'read': lambda *_: {1: 2.0}}, 'keys are str; 1 is not'),
    ({'read': lambda *_: {'x': 2**100}}, "'x' is a whole number of more than 64 bits"),
    ({'aim': lambda *_: np.zeros((1, 7))}, r'aim\(\) must return None or \(n, 8\) numbers; it is'),
    ({'aim': lambda *_: np.full((1, 8), np.nan)}, r'aim\(\) returned a row with NaN'),
    ({'idle_until': lambda *_: None}, r'idle_until\(\) must return a time, s; it is None')])
def test_a_wrong_result_is_named(world, members, says):
    w = made(world, **members)
    with pytest.raises(angen.Error, match=says):
        w.run(0.1)


@pytest.mark.parametrize('members, says', [
    ({'rate': 'x'}, "rate must be a number, Hz; it is 'x'"),
    ({'fields': {'stamp': 'number s'}}, "a field is called 'stamp', which each reading has"),
    ({'fields': ['x']}, r"fields must be a dict such as .*; it is \['x'\]"),
    ({'rate': 0.0}, 'the rate of its kind is 0 Hz, must be from 1e-06 to 1e.06'),
    ({'rate': -1.0}, 'the rate of its kind is -1 Hz'),
    ({'rate': float('nan')}, 'the rate of its kind is nan Hz'),
    ({'rate': 1e300}, r'the rate of its kind is 1e\+300 Hz'),
    ({'sample_period': -1.0}, 'sample_period must be s from 0 to 1e9; it is -1'),
    ({'sample_period': float('nan')}, 'sample_period must be s from 0 to 1e9; it is nan')])
def test_a_class_with_a_wrong_value_is_rejected(world, members, says):
    with pytest.raises(angen.Error, match=says):
        made(world, **members)


def test_a_command_that_returns_no_text_is_rejected(world):
    members = {'serves': staticmethod(lambda *_: True), 'command': lambda *_: True}
    angen.register('forced.py', 'forced', type('Forced', (angen.Device,), members))
    w = world('<model name="m"><static>true</static><link name="l"/>'
              '<plugin name="p" filename="forced.py"/></model>')
    with pytest.raises(angen.Error, match=r'command\(\) must return None or a str; it is True'):
        w.command('forced', 'm', 'Go')


def test_a_model_is_not_put_on_a_link(world):
    w = made(world)
    with pytest.raises(angen.Error, match="only a <sensor> can be put on a link"):
        w.spawn('model://pir', 'p', on='eye::link')
    assert w.models == ['floor', 'eye']


@pytest.mark.parametrize('origin, direction, reach, says', [
    ([np.nan, 0, 0], [1, 0, 0], 1.0, 'finite'), ([0, 0, 0], [0, 0, 0], 1.0, 'no direction is 0'),
    ([0, 0, 0], [1, 0, 0], -1.0, 'a reach is 0 m or more'),
    ([0, 0, 0], [1, 0, 0], np.nan, 'a reach is 0 m or more')])
def test_a_ray_without_a_line_is_an_error(world, origin, direction, reach, says):
    with pytest.raises(angen.Error, match=says):
        made(world).cast(np.array([origin], float), np.array([direction], float), reach)


def test_an_object_that_its_class_did_not_make_is_an_error():
    with pytest.raises(TypeError):
        angen.World.__new__(angen.World).time  # noqa: B018
    with pytest.raises(angen.Error, match='cannot be read'):
        angen.World('')
    with pytest.raises(angen.Error, match='finite'):
        angen.Grid(np.zeros((2, 2), np.int32), (0.0, 0.0), 1.0, 0).cell(float('nan'), 0.0)
