"""Lidars and depth cameras at any pose in a world, against rays of the world; and things nearer
than the minimum."""
import math

import numpy as np
import pytest

from angen_tools.common.geometry import quaternion, rotation_of
from sdf_text import box

REACH = 12.0  # m
RAYS = 1000  # a lidar's, all that a message holds
LIDAR = f'''<sensor name="s" type="ray"><ray><scan><horizontal><samples>{RAYS}</samples>
  <min_angle>-3.1</min_angle><max_angle>3.1</max_angle></horizontal></scan>
  <range><min>0.05</min><max>{REACH}</max></range></ray>
  <plugin name="s" filename="libgazebo_ros_laser.so"/></sensor>'''
DEPTH = f'''<sensor name="s" type="depth"><camera><horizontal_fov>1.2</horizontal_fov><image>
  <width>80</width><height>60</height></image><clip><near>0.1</near><far>{REACH}</far></clip>
  </camera><plugin name="s" filename="libgazebo_ros_openni_kinect.so"/></sensor>'''


def solids(rng: np.random.Generator) -> str:
    """Boxes of up to 1.2 m in all positions around the place (0, 0, 20), 1 m of which stay free.
    The floor, which no picture shows, is out of reach."""
    made = ''
    for i, place in enumerate(rng.uniform(-4, 4, (120, 3))):
        if np.linalg.norm(place) > 2.2:
            x, y, z = (f'{value:.4f}' for value in rng.uniform(0.2, 1.2, 3))
            pose = ' '.join(f'{value:.4f}' for value in (*(place + [0, 0, 20]),
                                                         *rng.uniform(-1.5, 1.5, 3)))
            shape = f'<geometry><box><size>{x} {y} {z}</size></box></geometry>'
            made += (f'<model name="s{i}"><static>true</static><pose>{pose}</pose><link name="l">'
                     f'<collision name="c">{shape}</collision><visual name="v">{shape}</visual>'
                     '</link></model>')
    return made


def fan(reading: dict) -> tuple[np.ndarray, np.ndarray]:
    """The rays of a lidar in its frame, and their ranges."""
    angles = np.linspace(-3.1, 3.1, RAYS)
    return (np.stack([np.cos(angles), np.sin(angles), np.zeros(RAYS)], axis=1),
            np.array(reading['ranges']))


def pixels(reading: dict) -> tuple[np.ndarray, np.ndarray]:
    """The same of the pixels of a depth camera, which measures along its axis."""
    depth = reading['depth'].astype(float)
    rows, columns = np.indices(depth.shape[:2])
    ways = np.stack([np.ones(rows.shape), -(columns - reading['center_x']) / reading['focal'],
                     -(rows - reading['center_y']) / reading['focal']], axis=-1).reshape(-1, 3)
    length = np.linalg.norm(ways, axis=1)
    return ways / length[:, None], np.where(np.isnan(depth), np.inf, depth).ravel() * length


@pytest.mark.parametrize('kind, sensor, rays_of, share', [
    ('lidar', LIDAR, fan, 1e-4), ('depth', DEPTH, pixels, 1e-3)], ids=('lidar', 'depth'))
def test_they_measure_what_rays_hit_at_any_pose(world, kind, sensor, rays_of, share):
    """`share`: of rays that graze an edge and hit in one and miss in the other."""
    rng = np.random.default_rng(4)
    w = world(solids(rng))
    wrong = hits = total = 0
    for _ in range(25):
        place, turn = rng.uniform(-0.3, 0.3, 3) + [0, 0, 20], rng.uniform(-3, 3, 3)
        w.spawn(f'<model name="eye"><static>true</static><link name="l">{sensor}</link></model>',
                'eye', [*place, *turn])
        w.request(kind, 'eye')
        w.run(0.2)
        ways, ranges = rays_of(w.sensor(kind, 'eye'))
        ways = ways @ rotation_of(*quaternion(*turn)).T
        exact = w.cast(np.tile(place, (len(ways), 1)), ways, REACH)
        hit = exact < REACH
        wrong += np.where(hit, np.abs(ranges - exact) > 1e-4, ranges < REACH).sum()
        hits, total = hits + hit.sum(), total + len(ways)
        w.delete('eye')
    assert total >= 25_000 and hits > 0.3 * total and wrong < share * total


@pytest.mark.parametrize('library, kind', [
    ('libgazebo_ros_laser.so', 'lidar'), ('libgazebo_ros_block_laser.so', 'block_laser'),
    ('libgazebo_ros_range.so', 'proximity')])
@pytest.mark.parametrize('near, blocks, expected', [
    (False, True, 2.0), (True, True, -math.inf), (True, False, 2.0)])
def test_a_thing_nearer_than_the_minimum_hides_what_is_behind(world, library, kind, near, blocks,
                                                              expected):
    """A post at 0.2 m before a wall at 2 m, minimum 0.5 m; the housing of the sensor is no post."""
    post = '<model name="post"><static>true</static><pose>0.25 0 1 0 0 0</pose><link name="l">' \
        '<collision name="c"><geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision>' \
        '</link></model>'
    w = world(box('wall', '2.5 0 1 0 0 0', '1 4 2', static=True) + (post if near else '') + f'''
      <model name="s"><static>true</static><pose>0 0 1 0 0 0</pose><link name="link">
      <collision name="housing"><geometry><sphere><radius>0.05</radius></sphere></geometry>
      </collision><sensor name="s" type="ray"><ray><scan><horizontal><samples>3</samples>
      <min_angle>-0.01</min_angle><max_angle>0.01</max_angle></horizontal><vertical><samples>1</samples>
      <min_angle>0</min_angle><max_angle>0</max_angle></vertical></scan>
      <range><min>0.5</min><max>5</max></range></ray><plugin name="s" filename="{library}">
      <near_blocks>{str(blocks).lower()}</near_blocks></plugin></sensor></link></model>''')
    if kind != 'proximity':
        w.request(kind, 's')
    w.run(0.2)
    reading = w.sensor(kind, 's')
    found = reading['range'] if kind == 'proximity' else reading['ranges'][1]
    if kind == 'block_laser' and expected < 0:
        expected = math.inf  # a cloud has no point there
    assert found == pytest.approx(expected, abs=1e-3)
