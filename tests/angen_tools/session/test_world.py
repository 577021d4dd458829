"""The contract of a World, which both of its back ends keep."""
import math
from pathlib import Path
from typing import Iterator

import pytest
from harness import WORLD, Master, world_file

from angen_tools.common.failure import Failure
from angen_tools.session import Event, World, open_world

pytestmark = pytest.mark.ros
DOOR = ('door', 'bathroom0')
LIMIT = 60.0  # simulated s


@pytest.fixture(scope='module')
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return world_file(WORLD, tmp_path_factory.mktemp('session'))


@pytest.fixture(scope='module', params=['in process', 'live'])
def world(request: pytest.FixtureRequest, file: Path) -> Iterator[World]:
    if request.param == 'in process':
        yield open_world(str(file), seed=7)
        return
    master: Master = request.getfixturevalue('master')
    request.getfixturevalue('rospy_node')
    with master.serving(file, file.parent, seed=7, rate=4):
        yield open_world()


@pytest.fixture
def happened(world: World) -> Iterator[list[Event]]:
    """The events since the test began, as far as it has asked for them."""
    world.events()
    found: list[Event] = []
    yield found


def saw(world: World, happened: list[Event], key: str, event: str) -> bool:
    happened += world.events()
    return any((each.key, each.event) == (key, event) for each in happened)


def test_time_passes(world: World) -> None:
    began = world.now
    world.run(0.5)
    assert world.now >= began + 0.5 - 1e-9
    assert world.complete_until <= world.now


def test_waiting_ends_at_the_limit(world: World) -> None:
    began = world.now
    assert not world.wait(lambda: False, 0.3)
    assert world.now >= began + 0.3 - 1e-9
    assert world.wait(lambda: world.now > began + 0.4, LIMIT)


def test_the_contents_are_those_of_the_file(world: World, file: Path) -> None:
    reference = open_world(str(file))
    reference.run(1.0)
    assert world.home == reference.home
    found = {(e.kind, e.name): e for e in world.entities()}
    expected = {(e.kind, e.name): e for e in reference.entities()}
    assert list(found) == list(expected)
    for key, entity in expected.items():
        assert (found[key].model, found[key].room) == (entity.model, entity.room)
        assert found[key].pose == pytest.approx(entity.pose, abs=1e-3)
    assert [e.name for e in world.entities('pir')] == ['eye']
    assert [e.name for e in world.entities('model')] == [
        e.name for e in reference.entities() if e.kind == 'model']


def test_a_command_changes_state_summary_and_events(world: World, happened: list[Event]) -> None:
    world.states('door')
    before = world.now
    assert 'CLOSED' in world.summaries()[DOOR].text
    assert world.command(*DOOR, 'Open')
    assert world.wait(lambda: world.state(*DOOR)['mode'] == 'OPEN', LIMIT)
    assert world.state(*DOOR)['position'] == pytest.approx(-math.pi / 2, abs=0.05)
    assert world.wait(lambda: saw(world, happened, 'door/bathroom0', 'opened'), LIMIT)
    opened = next(each for each in happened if each.event == 'opened')
    assert before < opened.time <= world.now
    assert world.states('door')[-1]['mode'] == 'OPEN'
    assert world.wait(lambda: world.states('door') == [], LIMIT)  # it is at rest
    assert world.wait(lambda: 'OPEN' in world.summaries()[DOOR].text, LIMIT)
    world.command('door', 'all', 'Close')
    assert world.wait(lambda: world.state(*DOOR)['mode'] == 'CLOSED', LIMIT)


@pytest.mark.parametrize('kind, name, text, why', [
    ('door', 'bathroom0', 'Melt', 'melt'), ('door', 'cellar', 'Open', 'cellar'),
    ('dor', 'bathroom0', 'Open', 'dor'), ('lamp', 'kitchen0', 'Dim 400', '400')])
def test_a_wrong_command_fails(world: World, kind: str, name: str, text: str, why: str) -> None:
    with pytest.raises(Failure, match=why):
        world.command(kind, name, text)


def test_a_spawned_sensor_measures_until_it_is_deleted(world: World, happened: list[Event]) -> None:
    world.states('pir')
    world.spawn('second', 'model://pir', (0.0, 4.0, 1.5, 0.0, 0.0, 0.1))
    assert [e.name for e in world.entities('pir')] == ['eye', 'second']
    assert world.pose('second')[:3] == pytest.approx((0.0, 4.0, 1.5), abs=1e-6)
    assert world.wait(lambda: ('pir', 'second') in world.summaries()
                      and world.summaries()['pir', 'second'].text != '', LIMIT)
    state = world.state('pir', 'second', world.now)
    assert not state['motion'] and state.time > 0.0
    names: set[str] = set()
    assert world.wait(lambda: names.update(s.name for s in world.states('pir'))
                      or names == {'eye', 'second'}, LIMIT)
    world.delete('second')
    assert world.wait(lambda: saw(world, happened, 'world/second', 'deleted'), LIMIT)
    assert world.wait(lambda: ('pir', 'second') not in world.summaries(), LIMIT)


def test_wrong_spawns_and_deletions_fail_and_change_nothing(world: World) -> None:
    before = [e.name for e in world.entities()]
    with pytest.raises(Failure, match='model://nothing'):
        world.spawn('x', 'model://nothing')
    with pytest.raises(Failure, match="'eye' exists already"):
        world.spawn('eye', 'model://pir')
    with pytest.raises(Failure, match='nobody'):
        world.delete('nobody')
    with pytest.raises(Failure, match='nobody'):
        world.pose('nobody')
    with pytest.raises(Failure, match='nobody'):
        world.state('pir', 'nobody')
    assert [e.name for e in world.entities()] == before


def test_a_model_is_placed(world: World) -> None:
    world.place('turtlebot', (6.0, 5.0, 0.01, 0.0, 0.0, 1.0))
    world.run(0.5)
    assert world.pose('turtlebot')[:2] == pytest.approx((6.0, 5.0), abs=0.02)
    assert world.pose('turtlebot::base_footprint')[:2] == pytest.approx((6.0, 5.0), abs=0.02)
    world.place('turtlebot', (5.0, 5.0, 0.01, 0.0, 0.0, 0.0))


def test_a_sensor_on_demand_measures_while_it_is_requested(world: World) -> None:
    lidar, = (e.name for e in world.entities('lidar'))
    world.request('lidar', lidar)
    world.run(1.0)
    scan = world.state('lidar', lidar)
    assert len(scan['ranges']) > 100 and scan['angle_min'] < 0.0
    world.request('lidar', lidar, False)


def test_odometry_has_the_same_fields(world: World) -> None:
    state = world.state('drive', 'turtlebot')
    assert {'x', 'y', 'yaw', 'v', 'w'} <= state.values.keys()


def test_a_saved_world_loads(world: World, tmp_path: Path) -> None:
    path = tmp_path / 'saved.world'
    path.write_text(world.save())
    again = open_world(str(path))
    assert [e.name for e in again.entities()] == [e.name for e in world.entities()]


def test_summaries_have_numbers(world: World) -> None:
    assert world.wait(lambda: len(world.summaries()['pir', 'eye'].values) > 0, LIMIT)
    values = world.summaries()['pir', 'eye'].values
    assert len(values) == 9 and values[0] == 0.0  # no motion
