"""The SDF that the angen command builds, judged by the simulator that has to read it."""
from __future__ import annotations

from pathlib import Path

import angen
import pytest
from lxml import etree

from angen_tools.common.failure import Failure
from angen_tools.world import sdf

BLOCKS = Path(__file__).resolve().parents[3] / 'worlds/models'
EMPTY = BLOCKS.parent / 'empty.world'
TABLE = '''<sdf version="1.6"><model name="table"><static>true</static><link name="body">
  <collision name="top"><geometry><box><size>1 1 0.1</size></box></geometry></collision>
  <collision name="leg"><pose>0 0 -0.4 0 0 0</pose><geometry><box><size>0.1 0.1 0.7</size></box>
  </geometry></collision></link></model></sdf>'''


def build(kind: str, *settings: str, lone: bool = False) -> etree._Element:
    return sdf.build_sensor(kind, 's1', sdf.parse_settings(list(settings)), lone, BLOCKS)


@pytest.fixture
def world() -> angen.World:
    return angen.World(str(EMPTY))


@pytest.mark.parametrize('kind', sdf.BLOCKS)
def test_a_built_model_has_one_sensor_of_its_name(world: angen.World, kind: str) -> None:
    world.spawn(sdf.text(build(kind)), 's1', [0, 0, 1, 0, 0, 0])
    world.want(kind, 's1')
    world.run(1.1)
    assert world.sensors(kind) == ['s1'] and world.sensor(kind, 's1')['kind'] == kind


@pytest.mark.parametrize('kind', sdf.KINDS)
def test_a_lone_sensor_sits_on_a_link(world: angen.World, kind: str) -> None:
    world.spawn(TABLE, 'table', [0, 0, 1, 0, 0, 0])
    needed = {'contact': ['collision=top'], 'pressure': ['collision=top'],
              'reed': ['magnet_link=body']}
    world.spawn(sdf.text(build(kind, *needed.get(kind, []), lone=True)), 's1', [0, 0, 0.1, 0, 0, 0],
                'table::body')
    world.want(kind, 's1')
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
    from angen_tools.common.catalog import known_parameters
    for kind in sdf.BLOCKS:
        settings = [f'{key}={param["default"]}' for key, param in known_parameters(kind).items()
                    if not param['doc'].startswith('with ')
                    and (param['default'] or 'any number' not in param['type'])]
        world.spawn(sdf.text(build(kind, *settings)), kind, [0, 0, 1, 0, 0, 0])
    assert set(sdf.BLOCKS) <= set(world.models)


def test_a_collision_can_be_given_more_than_once() -> None:
    sensor = build('contact', 'collision=top', 'contact/collision=leg', lone=True)
    assert [c.text for c in sensor.iterfind('contact/collision')] == ['top', 'leg']


@pytest.mark.parametrize('setting, part', [
    ('range=3', "no parameter 'range'; known are model, ray/scan/horizontal/samples"),
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


def test_the_block_is_read_not_changed() -> None:
    before = (BLOCKS / 'pir/model.sdf').read_bytes()
    assert build('pir', 'threshold=9').findtext('.//threshold') == '9'
    assert build('pir').findtext('.//threshold') == '0.1'
    assert (BLOCKS / 'pir/model.sdf').read_bytes() == before


@pytest.mark.parametrize('text, pose', [
    ('1 2 3', (1, 2, 3, 0, 0, 0)),
    (' -1 2e0  3 0 0 1.57 ', (-1, 2, 3, 0, 0, 1.57)),
    ('1,2,3', (1, 2, 3, 0, 0, 0)),
])
def test_poses_have_three_or_six_numbers(text: str, pose: tuple[float, ...]) -> None:
    assert sdf.parse_pose(text) == pose


@pytest.mark.parametrize('text, part', [('', '0 numbers'), ('1 2', '2 numbers'),
                                        ('1 2 3 4', '4 numbers'), ('1 2 x', "'x'"),
                                        ('1 2 nan', 'finite'), ('1 2 1e999', 'finite')])
def test_what_is_no_pose_is_explained(text: str, part: str) -> None:
    with pytest.raises(ValueError, match=part):
        sdf.parse_pose(text)


@pytest.mark.parametrize('name', ['', '  ', 'a::b', 'a/b', ' a', 'a\nb', '\udcff'])
def test_names_that_nothing_can_have(name: str) -> None:
    with pytest.raises(ValueError, match='the name'):
        sdf.check_name(name)


@pytest.mark.parametrize('name', ['p1', 'Küche 2', '机器人'])
def test_names_that_things_can_have(name: str) -> None:
    assert sdf.check_name(name) == name


@pytest.mark.parametrize('link', ['', 'a', 'a::', '::b', 'a::::b'])
def test_what_is_no_link(link: str) -> None:
    with pytest.raises(ValueError, match='MODEL::LINK'):
        sdf.check_link(link)


def test_broken_xml_is_told_with_its_line(tmp_path: Path) -> None:
    broken = tmp_path / 'model.sdf'
    broken.write_text('<sdf>\n<model name="a">\n</sdf>')
    with pytest.raises(Failure, match=r'model\.sdf:3: '):
        sdf.read(broken)


def test_a_pyroelectric_pir_takes_its_own_parameters(world: angen.World) -> None:
    own = build('pir', 'model=pyroelectric', 'lens=curtain', 'tape=0 1 -1 1', 'hold_time=3')
    world.spawn(sdf.text(own), 's1', [0, 0, 2, 0, 0, 0])
    world.run(0.2)
    assert world.sensor('pir', 's1')['signal_threshold'] == 0.0003
