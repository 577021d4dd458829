"""The home that is derived from a world: `world.home` and its findings."""
import math
from typing import Callable

import pytest

import angen
from angen_tools.common.home import Home
from sdf_text import box

Make = Callable[..., angen.World]
HIGH = 2.5      # m, walls
DOOR = '''<model name="{name}"><pose>{pose}</pose><link name="base"><inertial><mass>1</mass>
  </inertial></link><link name="leaf"><pose>0.45 0 0 0 0 0</pose>
  <inertial><mass>15</mass></inertial>
  <collision name="leaf"><pose>0 0 1 0 0 0</pose><geometry><box><size>0.9 0.04 2</size></box>
  </geometry></collision></link><joint name="fix" type="fixed"><parent>world</parent>
  <child>base</child></joint><joint name="hinge" type="revolute"><parent>base</parent>
  <child>leaf</child><pose>-0.45 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit><lower>-1.57</lower>
  <upper>0</upper></limit></axis></joint><plugin name="d" filename="libdoor_world_plugin.so"/>
  </model>'''


def wall(name: str, x0: float, y0: float, x1: float, y1: float, low: float = 0.0) -> str:
    """A wall over a rectangle, from `low` up."""
    return box(name, f'{(x0 + x1) / 2} {(y0 + y1) / 2} {(low + HIGH) / 2} 0 0 0',
               f'{x1 - x0} {y1 - y0} {HIGH - low}', static=True)


# Two rooms, 4 x 3 and 2 x 3 m, with a doorway between them and one in the west.
HOUSE = (wall('south', -0.1, -0.1, 6.2, 0) + wall('north', -0.1, 3, 6.2, 3.1)
         + wall('east', 6.1, 0, 6.2, 3) + wall('west_a', -0.1, 0, 0, 1)
         + wall('west_b', -0.1, 1.9, 0, 3) + wall('west_c', -0.1, 1, 0, 1.9, low=2.0)
         + wall('middle_a', 4, 0, 4.1, 1) + wall('middle_b', 4, 1.9, 4.1, 3)
         + wall('middle_c', 4, 1, 4.1, 1.9, low=2.0))
DOORS = (DOOR.format(name='front_door', pose=f'-0.05 1 0 0 0 {math.pi / 2}')
         + DOOR.format(name='inner_door', pose=f'4.05 1 0 0 0 {math.pi / 2}'))


def room(name: str, corners: str, extra: str = '') -> str:
    return (f'<angen:room name="{name}"><angen:polygon>{corners}</angen:polygon>{extra}'
            '</angen:room>')


def contradictions(world: angen.World) -> list[str]:
    return [text for kind, text in world.home_findings() if kind == 'contradicting']


def test_our_building_is_described_without_a_finding(building: str) -> None:
    world = angen.World(building)
    home = Home.of_world(world)
    assert world.home_findings() == []
    assert [(s.number, s.elevation, s.height) for s in home.storeys] == [(0, 0, 4), (1, 4, 2.8)]
    assert len(home.rooms) == 14
    kitchen = home.room('kitchen1')
    assert kitchen is not None and kitchen.use == 'kitchen' and kitchen.storey == 1
    assert kitchen.area == pytest.approx(3.9 * 3.9)
    doors = {door.name: door for door in home.doors if door.kind == 'door'}
    assert set(doors['entrance0'].rooms) == {'landing0', 'entrance0'}
    assert set(doors['bathroom1'].rooms) == {'bathroom1', 'entrance1'}
    assert doors['kitchen0'].pose[:3] == pytest.approx((2.9, 3.96, 0), abs=0.01)
    assert doors['kitchen0'].width == pytest.approx(0.99)
    assert doors['kitchen0'].height == pytest.approx(2.095)
    windows = [door for door in home.doors if door.kind == 'window']
    assert len(windows) == 12 and all('' in window.rooms for window in windows)
    lift, = home.elevators
    assert [(at.storey, at.room) for at in lift.landings] == [(0, 'landing0'), (1, 'landing1')]
    assert home.entrance == 'entrance0' and home.start == '2026-03-21T06:00:00'


def test_things_have_rooms_and_places(building: str) -> None:
    home = Home.of_world(angen.World(building))
    things = {thing.name: thing for thing in home.things}
    assert all(thing.room for thing in home.things)
    bed = things['bedroom_bed1']
    assert (bed.type, bed.room) == ('bed', 'bedroom1')
    # its head is in the north: x of the piece is south, so its left side is in the east
    x, y, z, yaw = bed.places[0].pose
    assert (x, y, z) == pytest.approx((1.6 + 0.39, 8.5 - 0.05, 4.53), abs=1e-6)
    assert yaw == pytest.approx(math.pi / 2, abs=1e-4)
    for thing in home.things:
        for place in thing.places:
            at = home.room_at(*place.pose[:3])
            assert at is not None and at.name == thing.room, (thing.name, place)


def test_rooms_are_found_between_walls(world: Make) -> None:
    made = world(HOUSE + DOORS)
    home = Home.of_world(made)
    assert sorted(room.area for room in home.rooms) == pytest.approx([6.0, 12.0], abs=0.25)
    assert all(room.guessed for room in home.rooms)
    large = home.room_at(1, 1, 1)
    small = home.room_at(5, 1, 1)
    assert large and small and large.area > small.area
    assert [made.room_at(x, 1, z) for x, z in ((1, 1), (5, 1), (5, 9), (-3, 1))] == [
        large.name, small.name, '', '']
    doors = {door.name: door for door in home.doors}
    assert set(doors['front0'].rooms) == {large.name, ''}
    assert set(doors['inner0'].rooms) == {large.name, small.name}
    assert doors['inner0'].pose[:3] == pytest.approx((4.05, 1.45, 0.0), abs=1e-6)
    assert home.entrance == 'front0'
    kinds = {kind for kind, _ in made.home_findings()}
    assert kinds == {'guessed'}, made.home_findings()


def walls_of(name: str, x: float, y: float, wide: float, z: float, high: float) -> str:
    """Four walls around a square."""
    sides = ((x + wide / 2, y, wide, 0.1), (x + wide / 2, y + wide, wide, 0.1),
             (x, y + wide / 2, 0.1, wide), (x + wide, y + wide / 2, 0.1, wide))
    return ''.join(box(f'{name}{i}', f'{u} {v} {z + high / 2} 0 0 0', f'{a + 0.1} {b + 0.1} {high}',
                       static=True) for i, (u, v, a, b) in enumerate(sides))


def test_neither_a_low_bed_is_a_floor_nor_a_shaft_the_only_room(world: Make) -> None:
    bed = box('bed', '2 2 0.13 0 0 0', '1.6 2 0.26', static=True)
    made = world(walls_of('room', 0, 0, 4, 0, 2.2) + walls_of('shaft', 8, 0, 1.6, 0, 3.0) + bed)
    home = Home.of_world(made)
    assert sorted(room.area for room in home.rooms) == pytest.approx([1.96, 14.44], abs=0.3)
    assert [room.floor for room in home.rooms] == [0.0, 0.0]


def test_doorways_as_high_as_walls_separate_rooms_too(world: Make) -> None:
    parts = HOUSE.split('</model>')
    open_house = '</model>'.join(part for part in parts if '_c"' not in part)
    assert open_house.count('<model') == HOUSE.count('<model') - 2
    areas = sorted(room['area'] for room in world(open_house).home['rooms'])
    assert areas == pytest.approx([6.0, 12.0], abs=0.3)


def test_contradictions_are_found(world: Make) -> None:
    walls = HOUSE + DOORS
    rooms = {'a': '0 0 4 0 4 3 0 3', 'b': '4.1 0 6.1 0 6.1 3 4.1 3'}

    def finds(text: str, **changed: str) -> list[str]:
        given = {**rooms, **changed}
        return contradictions(world(walls + text, ''.join(room(*r) for r in given.items() if r[1])))

    assert finds('') == []
    assert any('overlap' in text for text in finds('', a='0 0 5 0 5 3 0 3'))
    assert any("'inner0'" in text and 'joins nothing' in text
               for text in finds('', a='0 0 6.1 0 6.1 3 0 3', b=''))
    assert any("no person can reach room 'c'" in text
               for text in finds('', c='20 0 24 0 24 3 20 3'))
    bed = ('<model name="bed"><static>true</static><pose>{} 1 0.3 0 0 0</pose><link name="l">'
           '<collision name="c"><geometry><box><size>2 1 0.5</size></box></geometry></collision>'
           '</link><angen:thing>bed</angen:thing></model>')
    assert finds(bed.format(2)) == []
    # through the west wall
    assert any("bed 'bed' is" in text and 'in a wall' in text for text in finds(bed.format(0.5)))
    plant = ('<model name="plant"><static>true</static><pose>{} 1 0.5 0 0 0.7854</pose>'
             '<link name="l"><collision name="c"><geometry><cylinder><radius>0.3</radius>'
             '<length>0.8</length></cylinder></geometry></collision></link>'
             '<angen:thing>plant</angen:thing></model>')
    assert finds(plant.format(0.31)) == []  # the corners of a box around it are in the wall
    assert any("plant 'plant' is 0.05 m in a wall" in text for text in finds(plant.format(0.25)))
    assert any("bed 'bed' is in no room" in text for text in finds(bed.format(30)))
    site = '<angen:home><angen:entrance>gate</angen:entrance></angen:home>'
    named = contradictions(world(walls, room('a', rooms['a']) + site))
    assert any("'gate' is no door" in text for text in named)


def test_the_home_changes_with_spawn_and_delete(world: Make) -> None:
    made = world(HOUSE, room('a', '0 0 4 0 4 3 0 3'))
    assert made.home['doors'] == [] and made.home['things'] == []
    chair = ('<sdf version="1.6"><model name="chair"><link name="l"/><angen:thing>chair'
             '</angen:thing><angen:place posture="sit">0.1 0 0.4 0</angen:place></model></sdf>')
    made.spawn(chair, 'seat', [1, 2, 0, 0, 0, math.pi / 2])
    thing, = made.home['things']
    assert (thing['name'], thing['type'], thing['room']) == ('seat', 'chair', 'a')
    assert thing['places'][0]['pose'] == pytest.approx([1, 2.1, 0.4, math.pi / 2])
    flat = ('<sdf version="1.6"><model name="flat"><static>true</static><link name="l"/>'
            + room('b{storey}', '0 0 2 0 2 3 0 3') + '</model></sdf>')
    made.spawn(flat, 'flat', [10, 0, 3, 0, 0, math.pi / 2])
    assert [r['name'] for r in made.home['rooms']] == ['a', 'b1']
    assert made.home['rooms'][1]['polygon'][1] == pytest.approx([10, 2])
    assert made.home['storeys'][0]['height'] == pytest.approx(3.0)
    made.delete('flat')
    made.delete('seat')
    assert len(made.home['rooms']) == 1 and made.home['things'] == []
