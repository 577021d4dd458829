"""A world out of the cache runs as the one that was read from its files."""
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
    assert len(list((tmp_path / 'cache' / 'angen').iterdir())) == 1
    cached = run(path)
    assert cached.fingerprint == read.fingerprint
    assert cached.save() == read.save()
