"""A world that includes flats, doors and elevator under the names of the thesis."""
from pathlib import Path

import angen
import pytest

WORLD = Path(__file__).resolve().parents[1] / 'angen_sim/sdf/snippets/two_floors.world'
ROOMS = ('bathroom', 'bedroom', 'entrance', 'kitchen', 'livingroom', 'workroom')


@pytest.fixture(scope='module')
def world() -> angen.World:
    return angen.World(str(WORLD))


def test_it_loads_without_warnings(world: angen.World) -> None:
    assert world.warnings == []
    assert {'apartment0', 'apartment1', 'bath_door0', 'my_elevator'} <= set(world.models)
    assert sorted(world.devices('door')) == sorted(f'{room}{k}' for room in ROOMS for k in (0, 1))


def test_each_door_opens_under_the_name_of_its_room_and_floor(world: angen.World) -> None:
    for name in world.devices('door'):
        world.command('door', name, 'Open')
    world.run(8)
    assert {world.device('door', name)['mode'] for name in world.devices('door')} == {'OPEN'}


def test_the_elevator_moves_up(world: angen.World) -> None:
    world.command('elevator', 'my_elevator', 'Floor1')
    world.run(15)
    assert world.device('elevator', 'my_elevator')['floor'] == 1


def test_warnings_of_worlds_and_models_are_kept() -> None:
    text = '<sdf version="1.6"><world name="w"><physics type="bullet"/></world></sdf>'
    world = angen.World.from_text(text)
    world.spawn('<model name="m"><link name="l"><pose>0 -1 0</pose></link></model>')
    bullet, position = world.warnings
    assert bullet.startswith('<text>:1: ') and 'ODE is used' in bullet
    assert position.startswith('(text):1: <pose> contains 3 numbers')


def test_the_second_name_of_the_luminosity_sensors_library() -> None:
    world = angen.World.from_text('''<sdf version="1.6"><world name="w"><model name="lux">
      <static>true</static><link name="l"><sensor name="s" type="camera">
      <plugin name="p" filename="libluminosity_sensor_utils.so"/></sensor></link></model>
      </world></sdf>''')
    world.run(1.5)
    assert world.sensor('luminosity', 'lux')['illuminance'] == 0.0


def test_a_warning_of_a_model_that_comes_again_is_kept_once(world: angen.World) -> None:
    text = '<model name="m"><link name="l"><pose>0 -1 0</pose></link></model>'
    for name in ('a', 'b'):
        world.spawn(text, name)
        world.delete(name)
    assert len(world.warnings) == 1
