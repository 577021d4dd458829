"""A run of the whole building that is recorded, and run again."""
from pathlib import Path

import angen
import pytest

ACTOR = '''<actor name="guest"><script><loop>true</loop><trajectory id="0" type="walk">
<waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint>
<waypoint><time>3</time><pose>1.1 0.3 0 0 0 0.3</pose></waypoint></trajectory></script></actor>'''


@pytest.fixture(scope='module')
def log(building: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The log of half a minute in the building."""
    path = tmp_path_factory.mktemp('replay') / 'run.log'
    world = angen.World(building, seed=3, record=str(path))
    world.run(1.5)
    world.command('door', 'bathroom0', 'Open')
    world.command('elevator', 'elevator', 'Floor1')
    world.run(2.0)
    world.command('lamp', 'bathroom1', 'Dim 40')
    world.spawn('model://chair', 'c1', [1, 1, 1, 0, 0, 1 / 3])
    world.spawn('model://pir', 'p9', [1, 1, 2, 0.1, 0, 1 / 3])
    world.spawn(ACTOR, 'guest', [0.3, 0.1, 0, 0, 0, 0.37])
    with pytest.raises(angen.Error):
        world.command('lamp', 'nobody0', 'On')
    world.step(300)
    world.run(8.0)
    world.delete('c1')
    world.reset()
    world.run(4.0)
    return path


@pytest.mark.parametrize('leap', [True, False])
def test_its_fingerprints_are_equal(log: Path, leap: bool) -> None:
    replay = angen.Replay(str(log), leap=leap)
    while replay.advance(1.0):
        pass
    assert replay.mismatch == replay.truncated == ''
    assert replay.compared == 11 + 1 + 4 + 1  # before the reset, the reset, after it, the end
    assert replay.time == replay.end == 4.0
    assert replay.seed == 3 and replay.path.endswith('angen.world')


def test_its_world_continues(log: Path) -> None:
    replay = angen.Replay(str(log))
    while replay.advance(1.0) and replay.time < 5.0:
        pass
    world = replay.world()
    assert world.time == pytest.approx(5.0, abs=0.002)
    assert world.device('lamp', 'bathroom1')['level'] == 40.0
    world.command('lamp', 'bathroom1', 'Dim 20')
    world.run(1.0)
    assert world.device('lamp', 'bathroom1')['level'] == 20.0
    with pytest.raises(angen.Error, match='was taken'):
        replay.advance(1.0)


def test_what_is_not_a_log_is_an_error(building: str, tmp_path: Path) -> None:
    with pytest.raises(angen.Error, match='angen.world:1: is not a log of angen'):
        angen.Replay(building)
    with pytest.raises(angen.Error, match='exists already'):
        angen.World(building, record=building)
