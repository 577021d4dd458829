"""Slow motion goes on: a body falls asleep at rest, not while it is slow."""
import math

import angen
import pytest

WORLD = ('<sdf version="1.6"><world name="w"><physics type="ode"><max_step_size>0.001'
         '</max_step_size></physics><gravity>0 0 -9.81</gravity>{}</world></sdf>')
BOX = '''<model name="box"><pose>0 0 1 0 0 0</pose><link name="l"><gravity>0</gravity>
  <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
  </link></model>'''
PERIOD = 20.0  # s
# A wheel of 1 kg m^2 about its center with 1 kg off it: its period is 2 pi sqrt(1 / (9.81 d)).
OFF = (2 * math.pi / PERIOD) ** 2 / 9.81  # m
PENDULUM = f'''<model name="p"><pose>0 0 1 0 0 0</pose><link name="l"><inertial>
  <pose>0 0 {-OFF} 0 0 0</pose><mass>1</mass><inertia><ixx>0.5</ixx>
  <iyy>{1 - OFF ** 2}</iyy><izz>0.5</izz></inertia></inertial></link>
  <joint name="j" type="revolute"><parent>world</parent><child>l</child>
  <axis><xyz>0 1 0</xyz></axis></joint></model>'''


def test_a_weightless_box_of_five_millimeters_a_second_arrives() -> None:
    world = angen.World.from_text(WORLD.format(BOX))
    world.set_state('box', [0, 0, 1, 0, 0, 0], [0.005, 0, 0], [0, 0, 0])
    world.run(20)
    assert world.link_poses[world.links.index('box::l')][0] == pytest.approx(0.1, rel=1e-3)


@pytest.mark.parametrize('angle', [0.02, 0.03])  # at most 6 and 9 mrad/s
def test_a_slow_pendulum_swings_on(angle: float) -> None:
    world = angen.World.from_text(WORLD.format(PENDULUM))
    world.set_joints('p', {'j': angle})
    angles = []
    for _ in range(60):
        world.run(1)
        angles.append(world.joint('p::j')['position'])
    expected = [angle * math.cos(2 * math.pi * t / PERIOD) for t in range(1, 61)]
    assert angles == pytest.approx(expected, abs=0.05 * angle)
