"""The apartment world, in the simulator."""
from pathlib import Path

import angen
import numpy as np
import pytest

from angen_bench import sensors as bench
from angen_tools.cli import main as cli
from angen_tools.world import apartment as world_maker
from angen_tools.world import placing
from angen_models import plan
from tests.angen_models import world_geometry as geometry

COUNTS = {'pir': 30, 'switch': 15, 'luminosity': 14, 'contact': 25}


def write(path: Path, counts: dict[str, int], **options: object) -> bytes:
    world_maker.write_apartment(path, **{'floors': 2, 'counts': counts, 'seed': 1, **options})
    return path.read_bytes()


@pytest.fixture(scope='module')
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp('world') / 'a.world'
    write(made, COUNTS, elevator=True)
    return made


@pytest.fixture(scope='module')
def world(path: Path) -> angen.World:
    return angen.World(str(path))


@pytest.mark.parametrize('kind', placing.KINDS)
def test_the_simulator_finds_as_many_sensors_as_asked_for(world: angen.World, kind: str) -> None:
    names = {sensor.name for sensor in world_maker.apartment(2, COUNTS, 1, True)
             if sensor.kind == kind}
    assert len(world.sensors(kind)) == COUNTS[kind] and set(world.sensors(kind)) == names


def test_a_world_without_sensors_has_none(tmp_path: Path) -> None:
    write(tmp_path / 'a.world', {})
    bare = angen.World(str(tmp_path / 'a.world'))
    assert not any(bare.sensors(kind) for kind in placing.KINDS)


def test_the_same_options_give_the_same_bytes(tmp_path: Path) -> None:
    first = write(tmp_path / 'a.world', COUNTS)
    assert write(tmp_path / 'b.world', COUNTS) == first
    assert write(tmp_path / 'c.world', COUNTS, seed=2) != first


def test_every_pir_is_in_a_room_and_sees_its_walls(path: Path) -> None:
    world = geometry.shut_world(path)
    assert len(world.sensors('pir')) == COUNTS['pir']
    for _, name, _, pose in world.entities('pir'):
        x0, y0, x1, y1 = plan.ROOMS[name.split('_')[0]]
        assert x0 + 0.05 < pose[0] < x1 - 0.05 and y0 + 0.05 < pose[1] < y1 - 0.05
        ranges, _, reach = geometry.cast(world, 'pir', name)
        assert (ranges < reach).any() and ranges.max() > 1.0, name


def test_every_pir_of_the_running_world_measures_ranges(world: angen.World) -> None:
    world.run(0.25)
    for name in world.sensors('pir'):
        ranges = np.array(world.sensor('pir', name)['ranges'])
        assert np.mean(ranges < 6.0) > 0.3 and ranges.max() > 1.0, name


def test_sensors_on_one_link_stand_where_models_would(path: Path, tmp_path: Path) -> None:
    write(tmp_path / 'a.world', COUNTS, elevator=True, one_link=True)
    apart, together = (angen.World(str(p)) for p in (path, tmp_path / 'a.world'))
    assert len(together.models) < len(apart.models) - COUNTS['pir']
    for kind in placing.KINDS:
        names = apart.sensors(kind)
        own = names if kind == 'contact' else [f'{kind}_sensors_{name}' for name in names]
        assert set(together.sensors(kind)) == set(own)
    for world in (apart, together):
        world.run(0.15)
    for name in apart.sensors('pir'):
        ranges = apart.sensor('pir', name)['ranges']
        others = together.sensor('pir', f'pir_sensors_{name}')['ranges']
        assert np.allclose(ranges, others, atol=0.08), name  # each has noise of 0.01 m


def test_the_robot_drives_the_round_by_one_order(tmp_path: Path) -> None:
    write(tmp_path / 'a.world', {}, mover='robot')
    world = angen.World(str(tmp_path / 'a.world'))
    x, y, radius = plan.ROUND
    assert 'person' not in world.models and not world.sensors('lidar')
    speed, turn = bench.robot_round()
    world.command('drive', 'turtlebot', f'{speed} {turn}')
    base = world.links.index('turtlebot::base_footprint')
    places = []
    for _ in range(20):
        world.run(0.5)
        places.append(world.link_poses[base][:2])
    assert np.allclose(np.hypot(*(np.array(places) - (x, y + radius)).T), radius, atol=0.05)
    assert np.ptp(places, axis=0).min() > 1.8 * radius


def test_added_chairs_stand_free(path: Path) -> None:
    world = geometry.shut_world(path)
    solids = geometry.shapes(world)
    for name in world.joints:
        model, _, joint = name.partition('::')
        if joint == 'hinge':
            world.set_joints(model, {joint: -1.57})
    solids += geometry.shapes(world)
    chairs = [shape for shape in solids if '_seat' in shape.model]
    assert chairs
    for chair in chairs:
        others = [shape for shape in solids if shape.model != chair.model]
        assert geometry.nearest(chair, others)[0] > 1e-4, chair.model


def test_the_command_writes_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / 'out.world'
    words = ['world', 'apartment', '--floors', '1', '--pir', '3', '-o', str(file)]
    assert cli.run(words) == 0
    assert capsys.readouterr().out == f'wrote {file}: 1 floor, 3 sensors\n'
    assert len(angen.World(str(file)).sensors('pir')) == 3
