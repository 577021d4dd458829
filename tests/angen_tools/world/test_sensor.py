"""The SDF of sensors that the angen command builds, judged by the simulator that has to read it."""
import json
from pathlib import Path
from typing import Iterator

import angen
import numpy as np
import pytest
from lxml import etree

from angen_tools.common import catalog
from angen_tools.common.failure import Failure
from angen_tools.world import sdf, sensor


def build(kind: str, *settings: str, lone: bool = False) -> etree._Element:
    return sensor.build(kind, 's1', sdf.parse_settings(list(settings)), lone)


# Kinds for a robot's joints, which these models do not have.
JOINTED = {'wheel_states', 'odometry', 'joint_states', 'ft_sensor', 'kobuki_odometry',
           'kobuki_wheels'}
KINDS = {name: kind for name, kind in catalog.kinds('sensor').items() if name not in JOINTED}
FREE = [name for name, kind in KINDS.items() if not sensor.needs_link(kind)]


@pytest.mark.parametrize('kind', FREE)
def test_a_built_model_has_one_sensor_of_its_name(world: angen.World, kind: str) -> None:
    world.spawn(sdf.text(build(kind)), 's1', [0, 0, 1, 0, 0, 0])
    world.request(kind, 's1')
    world.run(1.1)
    assert world.sensors(kind) == ['s1'] and world.sensor(kind, 's1')['kind'] == kind


@pytest.mark.parametrize('kind', KINDS)
def test_a_lone_sensor_sits_on_a_link(world: angen.World, table: str, kind: str) -> None:
    world.spawn(table, 'table', [0, 0, 1, 0, 0, 0])
    needed = {'contact': ['collision=top'], 'pressure': ['collision=top'],
              'load_cells': ['collision=top'], 'reed': ['magnet_link=body'],
              'accelerometer': ['link=body']}
    world.spawn(sdf.text(build(kind, *needed.get(kind, []), lone=True)), 's1', [0, 0, 0.1, 0, 0, 0],
                'table::body')
    world.request(kind, 's1')
    world.run(1.1)
    assert world.sensor(kind, 's1')['kind'] == kind
    world.delete('s1')
    assert world.sensors(kind) == []


def test_a_parameter_of_the_rays_is_obeyed(world: angen.World) -> None:
    world.spawn(sdf.text(build('switch', 'ray/range/max=0.4', 'ray/noise/stddev=0')), 's1',
                [0, 0, 1, 0, 0, 0])
    world.run(1.1)
    assert world.sensor('switch', 's1')['ranges'] == [0.4, 0.4]


def test_a_parameter_of_the_plugin_is_obeyed(world: angen.World) -> None:
    world.spawn(sdf.text(build('pir', 'threshold=0.25')), 's1', [0, 0, 1, 0, 0, 0])
    world.run(0.2)
    assert world.sensor('pir', 's1')['threshold'] == 0.25


def test_the_rate_is_obeyed(world: angen.World) -> None:
    world.spawn(sdf.text(build('pir', 'update_rate=50')), 's1', [0, 0, 1, 0, 0, 0])
    before = world.readings
    world.run(1.0)
    assert abs(world.readings - before - 50) <= 1


def test_every_known_parameter_can_be_set_to_its_default(world: angen.World) -> None:
    for kind in FREE:
        settings = [f'{key}={param["default"]}' for key, param in catalog.parameters(kind).items()
                    if not param['doc'].startswith('with ')
                    and (param['default'] or 'any number' not in param['type'])]
        world.spawn(sdf.text(build(kind, *settings)), kind, [0, 0, 1, 0, 0, 0])
    assert set(FREE) <= set(world.models)


def test_a_collision_can_be_given_more_than_once() -> None:
    built = build('contact', 'collision=top', 'contact/collision=leg', lone=True)
    assert [c.text for c in built.iterfind('contact/collision')] == ['top', 'leg']


@pytest.mark.parametrize('setting, part', [
    ('range=3', "no parameter 'range'; did you mean ray/range/max, ray/range/min or"),
    ('samples=3', "no parameter 'samples'"),
    ('threshold=\x01', 'XML'),
])
def test_what_cannot_be_set_is_explained(setting: str, part: str) -> None:
    with pytest.raises(Failure, match='.*'.join(part.split(' '))):
        build('pir', setting)


def test_a_parameter_is_set_once() -> None:
    with pytest.raises(Failure, match='twice'):
        build('pir', 'threshold=1', 'threshold=2')


def test_a_contact_sensor_needs_a_link() -> None:
    with pytest.raises(Failure, match='--on'):
        build('contact')


def test_text_that_looks_like_xml_stays_text() -> None:
    root = build('pir', 'frameName=</plugin><x>&')
    again = etree.fromstring(sdf.text(root))
    assert again.findtext('.//frameName') == '</plugin><x>&'


def test_durations_and_angles_may_have_units() -> None:
    built = build('pir', 'model=pyroelectric', 'hold_time=1h30min', 'warm_up=5')
    assert built.findtext('.//hold_time') == '5400' and built.findtext('.//warm_up') == '5'


def test_the_model_is_read_not_changed(models_folder: Path) -> None:
    before = (models_folder / 'pir/model.sdf').read_bytes()
    assert build('pir', 'threshold=9').findtext('.//threshold') == '9'
    assert build('pir').findtext('.//threshold') == '0.1'
    assert (models_folder / 'pir/model.sdf').read_bytes() == before


def test_a_pyroelectric_pir_takes_its_own_parameters(world: angen.World) -> None:
    own = build('pir', 'model=pyroelectric', 'lens=curtain', 'tape=0 1 -1 1', 'hold_time=3')
    world.spawn(sdf.text(own), 's1', [0, 0, 2, 0, 0, 0])
    world.run(0.2)
    assert world.sensor('pir', 's1')['signal_threshold'] == 0.0003


class Nosy(angen.Sensor):
    """A plug-in of a user's own."""

    def configure(self, params: angen.Params, wiring: angen.Wiring) -> None:
        self.gain = params.number('gain', 1.0)

    def aim(self, view: angen.View) -> np.ndarray:
        return np.empty((0, 8))

    def read(self, view: angen.View, hits: object, rng: object) -> dict[str, float]:
        return {'gain': self.gain}


@pytest.fixture
def nosy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """A kind that only a catalog file outside of Angen knows, without a model."""
    entry = {**catalog.kind_of('humidity'), 'kind': 'nosy', 'library': 'libnosy.so', 'models': [],
             'params': [{'path': 'gain', 'type': 'number', 'default': '1', 'unit': '', 'doc': '',
                         'choices': []}]}
    (tmp_path / 'libnosy.so').touch()
    (tmp_path / 'libnosy.json').write_text(json.dumps([entry]))
    monkeypatch.setenv('ANGEN_PLUGIN_PATH', str(tmp_path))
    catalog.forget()
    angen.register('libnosy.so', 'nosy', Nosy)
    yield 'nosy'
    catalog.forget()


@pytest.mark.parametrize('lone', [True, False])
def test_a_kind_of_the_users_own_needs_no_model(world: angen.World, table: str, nosy: str,
                                                lone: bool) -> None:
    world.spawn(table, 'table', [0, 0, 1, 0, 0, 0])
    built = build(nosy, 'gain=7', lone=lone)
    world.spawn(sdf.text(built), 's1', [0, 0, 1, 0, 0, 0], *['table::body'] * lone)
    world.request(nosy, 's1')
    world.run(1.1)
    assert world.sensor(nosy, 's1')['gain'] == 7
