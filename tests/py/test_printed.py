"""Doors and an elevator whose files have the structure and the names of the thesis: printed/."""
from pathlib import Path

import numpy as np
import pytest

import angen
from sdf_text import DOORS

PRINTED = Path(__file__).resolve().parent / 'printed'


def hung(name: str, joint: str, child: str, axis: str = '0 0 1', limits: str = '-1.57 0.001',
         plugin: str = '', place: str = '0 0 0') -> str:
    """A model with one leaf of 20 kg on the world."""
    lower, upper = limits.split()
    return f'''<model name="{name}"><pose>{place} 0 0 0</pose><link name="{child}"><inertial>
      <pose>0.45 0 1 0 0 0</pose><mass>20</mass><inertia><ixx>6.67</ixx><iyy>8.02</iyy>
      <izz>1.353</izz></inertia></inertial></link>
      <joint name="{joint}" type="revolute"><parent>world</parent><child>{child}</child>
      <axis><xyz>{axis}</xyz><limit><lower>{lower}</lower><upper>{upper}</upper></limit></axis>
      </joint>{plugin}</model>'''


GROUND = '''<model name="ground"><static>true</static><link name="ground"><collision name="plane">
  <geometry><plane/></geometry></collision></link></model>'''


def door_plugin(parameters: str) -> str:
    return f'<plugin name="door" filename="libdoor_world_plugin.so">{parameters}</plugin>'


@pytest.fixture
def doors() -> angen.World:
    return angen.World(str(PRINTED / 'doors.world'))


@pytest.fixture
def elevator() -> angen.World:
    return angen.World(str(PRINTED / 'elevator.world'))


def position(world: angen.World, joint: str) -> float:
    return float(world.joint_positions[world.joints.index(joint)])


def test_each_joint_is_a_door_named_after_its_link(doors):
    assert doors.devices('door') == ['entrance1', 'kitchen0']


def test_doors_by_joint_open_and_close(doors):
    for text, mode, angle in (('Open', 'OPEN', -1.57), ('Close', 'CLOSED', 0.0)):
        doors.command('door', 'entrance1', text)
        doors.run(6)
        assert doors.device('door', 'entrance1')['mode'] == mode
        joint = position(doors, 'apartment_leaves::entrance_f1_door_joint2')
        assert joint == pytest.approx(angle, abs=0.004)
        assert doors.device('door', 'kitchen0')['mode'] == 'CLOSED'


def test_the_leaf_turns_about_its_hinge_and_takes_its_strip_along(doors):
    doors.command('door', 'all', 'Open')
    doors.run(6)
    strip = doors.link_poses[doors.links.index('apartment_leaves::kitchen_f0_door_strip')]
    turned = np.array([[0, 1], [-1, 0]]) @ np.array([0 - 0.0, 0 - 2.0]) + [0, 2]
    assert strip[:2] == pytest.approx(turned, abs=0.01)


def test_a_door_that_nothing_drives_is_a_warning(tmp_path):
    text = (PRINTED / 'doors.world').read_text().replace(
        '<plugin name="door_world_plugin" filename="libdoor_world_plugin.so"/>', '')
    (tmp_path / 'free.world').write_text(text)
    world = angen.World(str(tmp_path / 'free.world'))
    assert not world.devices('door')
    found = [text for text in world.warnings if 'no plug-in drives' in text]
    assert len(found) == 2
    assert 'free.world:55: ' in found[0] and "'entrance_f1_door_joint2'" in found[0]
    assert 'filename="libdoor_world_plugin.so"' in found[0]


@pytest.mark.parametrize('name, joint, child, place, called', [
    ('bathroom_door1', 'joint3', 'leaf', '0 0 4', 'bathroom1'),
    ('flat', 'joint3', 'kitchen_door_block', '0 0 4', 'kitchen1'),
    ('flat', 'hall_f2_door_joint', 'block', '0 0 0', 'hall2'),
    ('flat', 'joint3', 'leaf', '0 0 0', 'flat0')])
def test_a_door_is_named_after_the_part_called_door(world, name, joint, child, place, called):
    made = world(GROUND + hung(name, joint, child, place=place), DOORS)
    assert made.devices('door') == [called]


def test_what_is_no_door_is_none(world):
    flap = hung('flap', 'lid', 'body', axis='1 0 0')
    wheel = hung('wheel', 'spindle', 'disc', limits='-1e16 1e16')
    assert world(flap + wheel, DOORS).devices('door') == []


def framed(model: str, joint: str, leaf: str) -> str:
    """A model whose leaf hangs on a fixed frame."""
    text = hung(model, joint, leaf).replace('<parent>world</parent>', '<parent>frame</parent>')
    return text.replace('</model>', '''<link name="frame"/><joint name="fixed" type="fixed">
      <parent>world</parent><child>frame</child></joint></model>''')


@pytest.mark.parametrize('model, joint, leaf, called', [
    ('hall', 'cellar_door_joint', 'leaf', 'cellar0'), ('hall', 'j', 'pantry_door_block', 'pantry0'),
    ('study_door1', 'j', 'leaf', 'study0')])
def test_a_leaf_on_a_frame_is_a_door_where_a_name_says_so(world, model, joint, leaf, called):
    w = world(framed(model, joint, leaf), DOORS)
    assert w.devices('door') == [called]
    w.command('door', called, 'Open')
    w.run(6)
    assert position(w, f'{model}::{joint}') == pytest.approx(-1.57, abs=0.004)


def test_a_leaf_on_a_frame_that_nothing_drives_is_a_warning(world):
    found = world(framed('study_door0', 'j', 'leaf')).warnings
    assert len(found) == 1 and "no plug-in drives joint 'j' of model 'study_door0'" in found[0]


def test_what_turns_on_a_stand_is_no_door(world):
    """As the first joint of an arm does."""
    w = world(framed('arm', 'waist', 'shoulder'), DOORS)
    assert w.devices('door') == [] and w.warnings == []


def test_a_joint_is_named_where_its_axis_does_not_tell(world):
    w = world(hung('flap', 'lid', 'body', axis='1 0 0', limits='0 1.2',
                   plugin=door_plugin('<joint>lid</joint>')))
    assert w.devices('door') == ['flap0']
    w.command('door', 'flap0', 'Open')
    w.run(6)
    assert position(w, 'flap::lid') == pytest.approx(1.2, abs=0.02), 'it opens to its stop'


@pytest.mark.parametrize('parameters, message', [
    ('<joint>lit</joint>', "has no joint 'lit'; known are lid"),
    ('', 'door needs a revolute joint hinge with parent base'),
])
def test_what_is_wrong_with_a_joint_is_said(world, parameters, message):
    with pytest.raises(angen.Error, match=message):
        world(hung('flap', 'lid', 'body', axis='1 0 0', plugin=door_plugin(parameters)))


def test_doors_on_their_way_are_saved(doors, tmp_path):
    doors.command('door', 'entrance1', 'Open')
    doors.command('door', 'kitchen0', 'Set -0.5')
    doors.run(0.6)
    saved = tmp_path / 'saved.world'
    saved.write_text(doors.save())
    after = angen.World(str(saved))
    after.run(6)
    assert after.device('door', 'entrance1')['position'] == pytest.approx(-1.57, abs=0.004)
    assert after.device('door', 'kitchen0')['position'] == pytest.approx(-0.5, abs=0.004)


def test_the_elevator_of_one_body_rides_up_and_down(elevator):
    assert elevator.devices('elevator') == ['my_elevator']
    for floor in (1, 0):
        elevator.command('elevator', 'my_elevator', f'Floor{floor}')
        elevator.run(10)
        assert elevator.device('elevator', 'my_elevator')['floor'] == floor
        assert position(elevator, 'my_elevator::elevator_joint') == pytest.approx(
            4.0 * floor, abs=0.002)


def test_an_elevator_without_doors_is_open_everywhere(elevator):
    """The way in is free: who waits for open doors would wait for good."""
    elevator.run(0.1)
    assert elevator.device('elevator', 'my_elevator')['door_mode'] == 'OPEN'
    elevator.events()
    elevator.command('elevator', 'my_elevator', 'Floor1')
    elevator.run(10)
    assert elevator.device('elevator', 'my_elevator')['mode'] == 'IDLE'
    assert elevator.device('elevator', 'my_elevator')['door_mode'] == 'OPEN'
    assert [event for _, _, _, event, _ in elevator.events()] == ['up', 'arrived', 'idle']


def test_the_elevators_collision_is_smaller_than_its_visual(elevator):
    """A ray hits the collision, 2.5 m times 0.5 wide, not the visual, 2.5 m times 0.6."""
    elevator.spawn('model://proximity', 'eye', [1.352694 - 3, 1.202178, 0.5, 0, 0, 0])
    elevator.run(0.2)
    assert elevator.sensor('proximity', 'eye')['range'] == pytest.approx(3 - 0.625, abs=0.1)


def rail(limits: str = '0 4', axis: str = '0 0 1', parameters: str = '') -> str:
    """A cabin on a rail, m."""
    lower, upper = limits.split()
    return f'''<model name="e"><link name="cabin"/><joint name="rail" type="prismatic">
      <parent>world</parent><child>cabin</child><axis><xyz>{axis}</xyz><limit>
      <lower>{lower}</lower><upper>{upper}</upper></limit></axis></joint>
      <plugin name="p" filename="libros_plugin.so">{parameters}</plugin></model>'''


@pytest.mark.parametrize('model, message', [
    (rail('4 8'), 'the joint rail begins at 4 m, floor 0 is at 0 m; give it a <lower> of 0'),
    (rail('0 3', parameters='<floor_height>4</floor_height>'),
     'the highest floor is at 4 m, the joint rail ends at 3 m'),
    (hung('lift', 'j', 'body', plugin='<plugin name="p" filename="libros_plugin.so"/>'),
     'elevator needs a prismatic joint along z'),
    (rail(axis='0 0 -1'), 'elevator needs a prismatic joint along z, upwards'),
    (rail(axis='1 0 0', parameters='<joint>rail</joint>'),
     "the axis of joint 'rail' does not point up")])
def test_a_rail_that_does_not_serve_the_floors_is_an_error(world, model, message):
    with pytest.raises(angen.Error, match=message):
        world(model)


def test_of_two_that_slide_one_is_named(world):
    joints = ''.join(f'''<link name="{name}"/><joint name="{name}_joint" type="prismatic">
      <parent>world</parent><child>{name}</child><axis><xyz>0 0 1</xyz><limit><lower>0</lower>
      <upper>4</upper></limit></axis></joint>''' for name in ('weight', 'cabin'))
    w = world(f'''<model name="e">{joints}<plugin name="p" filename="libros_plugin.so">
      <joint>cabin_joint</joint></plugin></model>''')
    w.command('elevator', 'e', 'Floor1')
    w.run(8)
    assert position(w, 'e::cabin_joint') == pytest.approx(4.0, abs=0.002)
    assert position(w, 'e::weight_joint') == pytest.approx(0.0, abs=0.002)
