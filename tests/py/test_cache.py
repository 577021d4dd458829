"""A world out of the cache runs as the one that was read from its files."""
import os
import random
import resource
import subprocess
import sys
import time
from pathlib import Path

import pytest

import angen
from angen_tools.world.apartment import write_apartment
from sdf_text import WORLDS

COUNTS = {'pir': 20, 'switch': 4, 'luminosity': 4, 'contact': 4}


def run(path: Path) -> angen.World:
    """The world after half a second in which a door opens."""
    world = angen.World(str(path), seed=3)
    world.command('door', 'bathroom0', 'Open')
    world.step(500)
    return world


@pytest.fixture(params=['angen', 'apartment'])
def path(request, tmp_path: Path) -> Path:
    """The file of a world."""
    if request.param == 'angen':
        return WORLDS / 'angen.world'
    write_apartment(tmp_path / 'flats.world', floors=3, counts=COUNTS, seed=1, elevator=True)
    return tmp_path / 'flats.world'


def test_cached_world_runs_the_same(path, tmp_path, monkeypatch):
    monkeypatch.setenv('ANGEN_NO_CACHE', '1')
    read = run(path)
    monkeypatch.delenv('ANGEN_NO_CACHE')
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / 'cache'))
    run(path)
    assert len(list((tmp_path / 'cache' / 'angen').glob('*.world'))) == 1
    cached = run(path)
    assert cached.fingerprint == read.fingerprint
    assert cached.save() == read.save()


def test_a_pipe_in_place_of_a_cached_file_is_not_opened(tmp_path, monkeypatch):
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / 'cache'))
    world = WORLDS / 'angen.world'
    angen.World(str(world))
    cached = list((tmp_path / 'cache' / 'angen').iterdir())
    assert cached
    for file in cached:
        file.unlink()
        os.mkfifo(file)
    subprocess.run([sys.executable, '-c', f'import angen; angen.World({str(world)!r})'],
                   check=True, timeout=120)
    assert all(file.is_file() for file in cached)


LOADER = '''
import sys, angen
while True:
    open(sys.argv[1], "a").write("\\n")  # so that it is not in the cache
    angen.World(sys.argv[1])
    print(end=".", flush=True)
'''


def test_a_kill_while_it_is_written_does_no_harm(tmp_path, monkeypatch):
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / 'cache'))
    path, chance = tmp_path / 'flats.world', random.Random(13)
    write_apartment(path, floors=3, counts=COUNTS, seed=1, elevator=True)
    fingerprint = run(path).fingerprint
    for _ in range(8):
        loader = subprocess.Popen([sys.executable, '-c', LOADER, str(path)],
                                  stdout=subprocess.PIPE, bufsize=0)
        for _ in range(chance.randrange(1, 4)):
            assert loader.stdout.read(1) == b'.'
        time.sleep(chance.uniform(0.0, 0.3))
        loader.kill()
        loader.communicate()
        assert run(path).fingerprint == fingerprint  # read, and kept
        assert run(path).fingerprint == fingerprint  # out of the cache


def test_a_full_disk_leaves_nothing_in_the_cache(tmp_path, monkeypatch):
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / 'cache'))
    path = tmp_path / 'flats.world'
    write_apartment(path, floors=1, counts=COUNTS, seed=1)
    load = [sys.executable, '-c', 'import sys, angen; angen.World(sys.argv[1])', str(path)]
    subprocess.run(load, check=True, preexec_fn=lambda: resource.setrlimit(
        resource.RLIMIT_FSIZE, (1000, 1000)))
    assert list((tmp_path / 'cache/angen').iterdir()) == []
    subprocess.run(load, check=True)
    assert len(list((tmp_path / 'cache/angen').glob('*.world'))) == 1


def test_a_cache_that_may_not_be_written_is_not_used(tmp_path, monkeypatch):
    (tmp_path / 'file').touch()
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / 'file'))
    assert angen.World(str(WORLDS / 'empty.world')).models
