"""Lidar and depth camera in a world, against closed forms of rays and solids.

A ray hits a solid at each crossing of its surface: one that starts inside hits its far side.
"""
import math
from dataclasses import dataclass

import numpy as np
import pytest

import angen
from sdf_text import box

RAYS = 1000  # of a lidar, all a message holds
REACH = 12.0  # m
HOUSING = 0.5  # m: nearer a camera sees nothing from behind


@dataclass
class Solid:
    """A convex shape at a pose x y z roll pitch yaw; sizes in m."""
    kind: str
    size: tuple[float, ...]
    pose: np.ndarray

    def geometry(self) -> str:
        if self.kind == 'box':
            return f'<box><size>{" ".join(map(str, self.size))}</size></box>'
        if self.kind == 'sphere':
            return f'<sphere><radius>{self.size[0]}</radius></sphere>'
        radius, length = self.size
        return f'<cylinder><radius>{radius}</radius><length>{length}</length></cylinder>'

    def model(self, name: str) -> str:
        shape = f'<geometry>{self.geometry()}</geometry>'
        return f'''<model name="{name}"><static>true</static><pose>{text(self.pose)}</pose>
          <link name="link"><collision name="c">{shape}</collision><visual name="v">{shape}</visual>
          </link></model>'''

    def crossings(self, origin: np.ndarray, ways: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The points where lines enter and leave, in lengths of `ways`; nan where they miss."""
        turn = rotation(self.pose[3:])
        o, d = (origin - self.pose[:3]) @ turn, ways @ turn
        with np.errstate(divide='ignore', invalid='ignore'):
            if self.kind == 'box':
                first, last = slab(o, d, np.array(self.size) / 2)
            elif self.kind == 'sphere':
                first, last = ball(o, d, self.size[0])
            else:
                first, last = ball(o[:2], d[:, :2], self.size[0])
                low, high = slab(o[2:], d[:, 2:], np.array([self.size[1] / 2]))
                first, last = np.maximum(first, low), np.minimum(last, high)
        empty = ~(first <= last)
        return np.where(empty, np.nan, first), np.where(empty, np.nan, last)


def slab(o: np.ndarray, d: np.ndarray, half: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    a, b = (-half - o) / d, (half - o) / d
    return np.minimum(a, b).max(axis=1), np.maximum(a, b).min(axis=1)


def ball(o: np.ndarray, d: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    a, b, c = (d * d).sum(axis=1), d @ o, o @ o - radius ** 2
    root = np.sqrt(b * b - a * c)
    return (-b - root) / a, (-b + root) / a


def rotation(rpy: np.ndarray) -> np.ndarray:
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                     [-sp, cp * sr, cp * cr]])


def text(values: np.ndarray) -> str:
    return ' '.join(repr(float(v)) for v in values)


def hits(solids: list[Solid], origin: np.ndarray, ways: np.ndarray, least: float, most: float,
         behind: float = 0.0) -> np.ndarray:
    """The nearest surface from `least` to `most` along each way, from behind only from `behind` on;
    infinite where there is none.
    """
    found = np.full(len(ways), np.inf)
    for solid in solids:
        enters, leaves = solid.crossings(origin, ways)
        for at, first in (enters, least), (leaves, max(least, behind)):
            found = np.where((at >= first) & (at <= most) & (at < found), at, found)
    return found


def some_solids(rng: np.random.Generator, kinds: tuple[str, ...], count: int) -> list[Solid]:
    solids = [Solid('box', (20, 20, 0.1), np.array([0, 0, -0.05, 0, 0, 0.0]))]  # the floor
    for i in range(count):
        size = {'box': 3, 'sphere': 1, 'cylinder': 2}[kinds[i % len(kinds)]]
        solids.append(Solid(kinds[i % len(kinds)], tuple(rng.uniform(0.2, 1.2, size)),
                            np.concatenate([rng.uniform(-4, 4, 3) + [0, 0, 4],
                                            rng.uniform(-1.5, 1.5, 3)])))
    return solids


def compare(measured: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """Median error (m) of the rays that hit something, and the share of all that disagree.

    A ray that grazes an edge may hit in one and miss in the other.
    """
    both = np.isfinite(measured) & np.isfinite(exact)
    error = np.abs(measured[both] - exact[both])
    wrong = np.isfinite(measured) != np.isfinite(exact)
    assert both.mean() > 0.3
    return float(np.median(error)), float(((error > 1e-4).sum() + wrong.sum()) / len(measured))


def lidar(name: str, pose: np.ndarray, samples: int = RAYS, least: float = 0.05) -> str:
    return f'''<model name="{name}"><static>true</static><pose>{text(pose)}</pose><link name="link">
      <sensor name="lidar" type="ray"><ray><scan><horizontal><samples>{samples}</samples>
      <min_angle>-3.1</min_angle><max_angle>3.1</max_angle></horizontal></scan>
      <range><min>{least}</min><max>{REACH}</max></range></ray>
      <plugin name="lidar" filename="libgazebo_ros_laser.so"><near_blocks>false</near_blocks>
      </plugin></sensor></link></model>'''


def test_a_hundred_thousand_rays_of_lidars(world):
    rng = np.random.default_rng(4)
    solids = some_solids(rng, ('box', 'sphere', 'cylinder'), 60)
    poses = [np.concatenate([rng.uniform(-4, 4, 3) + [0, 0, 4], rng.uniform(-3, 3, 3)])
             for _ in range(100)]
    w = world(''.join(s.model(f's{i}') for i, s in enumerate(solids[1:]))
              + ''.join(lidar(f'l{i}', pose) for i, pose in enumerate(poses)))
    for i in range(len(poses)):
        w.request('lidar', f'l{i}')
    w.step()
    angles = np.linspace(-3.1, 3.1, RAYS)
    fan = np.stack([np.cos(angles), np.sin(angles), np.zeros(RAYS)], axis=1)
    measured, exact, inside = [], [], 0
    for i, pose in enumerate(poses):
        ways = fan @ rotation(pose[3:]).T
        measured.append(np.array(w.sensor('lidar', f'l{i}')['ranges']))
        exact.append(hits(solids, pose[:3], ways, 0.05, REACH))
        starts = [s.crossings(pose[:3], ways[:1]) for s in solids]
        inside += any(first[0] < 0 < last[0] for first, last in starts)
    assert inside >= 3, 'some must start inside a solid'
    median, wrong = compare(np.concatenate(measured), np.concatenate(exact))
    assert median < 1e-4 and wrong < 1e-4, (median, wrong)


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


def depth_camera(name: str, pose: np.ndarray) -> str:
    return f'''<model name="{name}"><static>true</static><pose>{text(pose)}</pose><link name="link">
      <sensor name="eye" type="depth"><camera><horizontal_fov>1.2</horizontal_fov><image>
      <width>80</width><height>60</height></image><clip><near>0.1</near><far>{REACH}</far></clip>
      </camera><plugin name="eye" filename="libgazebo_ros_openni_kinect.so"/></sensor></link>
      </model>'''


def depths(world: angen.World, name: str, solids: list[Solid], pose: np.ndarray
           ) -> tuple[np.ndarray, np.ndarray]:
    """The camera's measurements and the expected ones, infinite where nothing is."""
    reading = world.sensor('depth', name)
    measured = reading['depth'].astype(float)
    rows, columns = np.indices(measured.shape[:2])
    ways = np.stack([np.ones(rows.shape), -(columns - reading['center_x']) / reading['focal'],
                     -(rows - reading['center_y']) / reading['focal']], axis=-1).reshape(-1, 3)
    exact = hits(solids, pose[:3], ways @ rotation(pose[3:]).T, 0.1, REACH, HOUSING)
    return np.where(np.isnan(measured), np.inf, measured).ravel(), exact


def test_a_hundred_thousand_pixels_of_depth_cameras(world):
    rng = np.random.default_rng(5)
    solids = some_solids(rng, ('box',), 60)
    poses = [np.concatenate([rng.uniform(-4, 4, 3) + [0, 0, 4], rng.uniform(-3, 3, 3)])
             for _ in range(25)]
    w = angen.World.from_text('<sdf version="1.6"><world name="w">' + ''.join(
        s.model(f's{i}') for i, s in enumerate(solids)) + ''.join(
        depth_camera(f'd{i}', pose) for i, pose in enumerate(poses)) + '</world></sdf>')
    for i in range(len(poses)):
        w.request('depth', f'd{i}')
    w.step()
    pairs = [depths(w, f'd{i}', solids, pose) for i, pose in enumerate(poses)]
    median, wrong = compare(*(np.concatenate(part) for part in zip(*pairs)))
    assert median < 1e-4 and wrong < 1e-3, (median, wrong)


def test_depth_of_round_things_is_that_of_their_facets(world):
    sphere = Solid('sphere', (1.0,), np.array([3, 0, 1, 0, 0, 0.0]))
    pose = np.array([0, 0, 1, 0, 0, 0.0])
    w = world(sphere.model('s') + depth_camera('d', pose))
    w.request('depth', 'd')
    w.step()
    measured, exact = depths(w, 'd', [sphere], pose)
    middle = np.isfinite(measured) & (exact < 2.3)  # where rays do not hit at a flat angle
    assert middle.sum() > 300
    error = measured[middle] - exact[middle]
    assert error.min() > -1e-5, 'facets lie within the sphere'
    assert np.median(error) < 0.0025 and error.max() < 0.005  # of a radius of 1 m
