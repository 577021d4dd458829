"""Lidars and cameras: they sample only on request; images are arrays, equal for equal input."""
import numpy as np
import pytest

import angen
from sdf_text import box


def camera(name: str, pose: str) -> str:
    """A static model with a camera of 64 x 48 pixels, 1 rad wide, 10 Hz."""
    return f'''<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link">
  <sensor name="eye" type="camera"><update_rate>10</update_rate><camera>
  <horizontal_fov>1</horizontal_fov><image><width>64</width><height>48</height></image>
  <clip><near>0.1</near><far>10</far></clip></camera>
  <plugin name="eye" filename="libgazebo_ros_camera.so"/></sensor></link></model>'''


def lidar(name: str, pose: str) -> str:
    """A static model with a lidar of 5 rays over 1 rad, with noise."""
    return f'''<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link">
  <sensor name="lidar" type="ray"><ray><scan><horizontal><samples>5</samples>
  <min_angle>-0.5</min_angle><max_angle>0.5</max_angle></horizontal></scan>
  <range><min>0.1</min><max>8</max></range>
  <noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise></ray>
  <plugin name="lidar" filename="libgazebo_ros_laser.so"/></sensor></link></model>'''


def shown(name: str, pose: str, size: str, color: str) -> str:
    """A static box that is seen but not touched."""
    return f'''<model name="{name}"><static>true</static><pose>{pose}</pose><link name="link">
  <visual name="v"><geometry><box><size>{size}</size></box></geometry>
  <material><diffuse>{color} 1</diffuse></material></visual></link></model>'''


LAMP = '''<include><uri>model://ceiling_lamp</uri><name>hall_lamp0</name>
  <pose>1 0 2.5 0 0 0</pose></include>'''


def test_an_unsubscribed_camera_does_not_sample(world):
    w = world(lidar('l', '0 0 1 0 0 0') + box('wall', '4 0 1 0 0 0', '1 9 2', static=True))
    w.step(500)
    assert w.readings == 0
    with pytest.raises(angen.Error, match=r"measured nothing yet; request\('lidar', 'l'\)"):
        w.sensor('lidar', 'l')
    w.request('lidar', 'l')
    w.step(500)
    assert w.readings == 5
    assert w.sensor('lidar', 'l')['ranges'][2] == pytest.approx(3.5, abs=0.06)
    w.request('lidar', 'l', False)
    w.step(500)
    assert w.readings == 5


def test_a_request_of_an_unknown_sensor_is_rejected(world):
    with pytest.raises(angen.Error, match="no lidar named 'x'"):
        world('').request('lidar', 'x')


def test_wanting_one_changes_no_other(world):
    """Noise is keyed by name and tick: the same scans with and without a camera that looks."""
    scans = []
    for requested in (False, True):
        w = world(lidar('l', '0 0 1 0 0 0') + camera('c', '0 0 1 0 0 0')
                  + box('wall', '4 0 1 0 0 0', '1 9 2', static=True))
        w.request('lidar', 'l')
        w.request('camera', 'c', requested)
        w.step(750)
        scans.append(w.sensor('lidar', 'l')['ranges'])
    assert scans[0] == scans[1]


def test_an_image_is_height_by_width_by_three_bytes(world):
    w = world(shown('red', '3 0 1 0 0 0', '0.2 0.5 0.5', '1 0 0') + camera('c', '0 0 1 0 0 0'))
    w.request('camera', 'c')
    w.step(1)
    image = w.sensor('camera', 'c')['image']
    assert image.shape == (48, 64, 3) and image.dtype == np.uint8
    middle = image[24, 32]
    assert middle[0] > 30 and middle[1] == middle[2] == 0


def test_the_same_input_gives_the_same_pixels(world):
    def run() -> tuple[str, np.ndarray]:
        w = world(box('crate', '3 0 4 0.3 0.2 0.1', '1 1 1') + LAMP + camera('c', '0 0 1 0 0 0')
                  + shown('wall', '6 0 1 0 0 0', '0.2 9 9', '0.7 0.7 0.7'))
        w.request('camera', 'c')
        w.command('lamp', 'hall0', 'On')
        w.run(0.5)
        return w.fingerprint, w.sensor('camera', 'c')['image']
    first, second = run(), run()
    assert first[0] == second[0]
    assert np.array_equal(first[1], second[1]) and first[1].std() > 1
