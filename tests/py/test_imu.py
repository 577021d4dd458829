"""Accelerometers on what turns, against the closed form."""
from __future__ import annotations

import math

import pytest

SPIN = 2 * math.pi  # rad/s
RADIUS = 0.7  # m, from the hinge
ARM = '''<model name="arm"><pose>0 0 1 0 0 0</pose><link name="link"><gravity>false</gravity>
  <inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.02</izz><ixy>0</ixy><ixz>0</ixz>
  <iyz>0</iyz></inertia></inertial><sensor name="s" type="imu"><pose>{radius} 0 0 0 0 0</pose>{more}
  </sensor></link><joint name="hinge" type="revolute"><parent>world</parent><child>link</child>
  <axis><xyz>0 0 1</xyz></axis></joint></model>'''


@pytest.mark.parametrize('rate', [1, 7, 20, 50, 200, 1000])
@pytest.mark.parametrize('kind, library', [('imu_sensor', 'libgazebo_ros_imu_sensor.so'),
                                           ('accelerometer', 'libaccelerometer.so')])
def test_even_turning_reads_as_toward_the_center(world, kind, library, rate):
    """w^2 r toward the hinge, and gravity's reaction, at any rate of publishing."""
    more = f'<update_rate>{rate}</update_rate><plugin name="p" filename="{library}"/>'
    w = world(ARM.format(radius=RADIUS, more=more))
    w.request(kind, 'arm')
    w.push('arm::link', [0, 0, 0], torque=[0, 0, 0.02 * SPIN / 0.001], seconds=0.001)
    w.run(3.0)
    assert w.motion('arm::link')[2][2] == pytest.approx(SPIN, rel=1e-3)
    assert w.sensor(kind, 'arm')['acceleration'] == pytest.approx(
        [-SPIN ** 2 * RADIUS, 0, 9.81], abs=0.05)
