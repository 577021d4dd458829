"""A survey of a building whose leaves hang on the world, several in one model."""
import math

import angen
import pytest

from angen_apps.robot.building import Survey

WALLS = {'south': (3, -0.06, 6.24, 0.12), 'north': (3, 3.06, 6.24, 0.12),
         'west': (-0.06, 1.5, 0.12, 3), 'east': (6.06, 1.5, 0.12, 3),
         'one_low': (2, 0.475, 0.12, 0.95), 'one_high': (2, 2.475, 0.12, 1.05),
         'two_low': (4, 0.475, 0.12, 0.95), 'two_high': (4, 2.475, 0.12, 1.05)}


def box(name: str, x: float, y: float, z: float, wide: float, deep: float, high: float) -> str:
    return (f'<collision name="{name}"><pose>{x} {y} {z} 0 0 0</pose><geometry><box>'
            f'<size>{wide} {deep} {high}</size></box></geometry></collision>')


def leaf(name: str, x: float) -> str:
    """A leaf from a hinge at x, 1.0 m along y."""
    return f'''<link name="{name}_door_block"><inertial><pose>{x} 1.45 1 0 0 1.570796</pose>
      <mass>20</mass><inertia><ixx>6.67</ixx><iyy>8.02</iyy><izz>1.353</izz></inertia></inertial>
      {box('c', x, 1.44, 1.02, 0.04, 0.86, 2)}</link>
      <joint name="{name}_turns" type="revolute"><parent>world</parent>
      <child>{name}_door_block</child><pose>{x} 1.0 1 0 0 0</pose><axis><xyz>0 0 1</xyz><limit>
      <lower>-1.57</lower><upper>0.001</upper></limit></axis></joint>'''


@pytest.fixture
def text() -> str:
    walls = ''.join(box(name, x, y, 1.2, wide, deep, 2.4)
                    for name, (x, y, wide, deep) in WALLS.items())
    return f'''<sdf version="1.6"><world name="flat"><gravity>0 0 -9.8</gravity>
      <model name="house"><static>true</static><link name="walls">{walls}
      {box('floor', 3, 1.5, -0.05, 6.24, 3.24, 0.1)}</link></model>
      <model name="leaves">{leaf('study', 2)}{leaf('pantry', 4)}</model>
      <plugin name="doors" filename="libdoor_world_plugin.so"/></world></sdf>'''


def test_each_leaf_of_a_model_is_a_door_where_it_hangs(text: str) -> None:
    world, shut = angen.World.from_text(text), angen.World.from_text(text)
    survey = Survey(world, shut)
    found = {door.name: door for door in survey.doors[0]}
    assert sorted(found) == ['pantry0', 'study0']
    for name, x in (('study0', 2.0), ('pantry0', 4.0)):
        assert found[name].hinge == pytest.approx((x, 1.0), abs=0.01)
        assert found[name].width == pytest.approx(0.87, abs=0.06)
        assert found[name].shut == pytest.approx(math.pi / 2, abs=0.06)
        assert found[name].open - found[name].shut == pytest.approx(-1.57, abs=0.02)
