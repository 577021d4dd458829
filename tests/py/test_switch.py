"""Optical switches open and close at the door angle that geometry predicts, at every door."""
import math

import numpy as np
from lxml import etree

import angen
from sdf_text import WORLDS

LEAST = math.radians(0.5)
REACH, THRESHOLD, SPREAD = 0.5, 0.05, 0.004  # of models/optical_switch: m, m, rad


def strip_of(door: str) -> tuple[np.ndarray, np.ndarray]:
    """The lowest and the greatest corner of the strip on a shut door, in the door's frame (m)."""
    root = etree.parse(str(WORLDS / 'models' / door / 'model.sdf'))
    part = root.find(".//collision[@name='strip_collision']")
    middle, size = (np.array([float(v) for v in part.findtext(path).split()][:3])
                    for path in ('pose', 'geometry/box/size'))
    return middle - size / 2, middle + size / 2


def entry(origin: np.ndarray, way: np.ndarray, low: np.ndarray, high: np.ndarray) -> float:
    """The distance to a box along a ray, m; infinite where it misses. By the box's planes."""
    with np.errstate(divide='ignore'):
        a, b = (low - origin) / way, (high - origin) / way
    near, far = np.minimum(a, b).max(), np.maximum(a, b).min()
    return float(max(near, 0.0)) if near <= far and far >= 0.0 else math.inf


def turned(v: np.ndarray, angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]])


def predicted(beam: np.ndarray, heading: float, strip: tuple[np.ndarray, np.ndarray]) -> float:
    """The angle of the leaf, from which on its strip leaves the beam (rad, below 0).

    `beam` is the emitter, `heading` where it looks, both in the door's frame: the leaf turns
    about its z axis. Bisection over the closed form of a ray and a turned box.
    """
    def cut(angle: float) -> bool:
        for ray in (-SPREAD, SPREAD):
            way = np.array([math.cos(heading + ray), math.sin(heading + ray), 1e-12])
            if entry(turned(beam, -angle), turned(way, -angle), *strip) < REACH - THRESHOLD:
                return True
        return False

    shut, open_ = 0.0, -math.pi / 4
    assert cut(shut) and not cut(open_)
    while shut - open_ > 1e-6:
        middle = (shut + open_) / 2
        shut, open_ = (middle, open_) if cut(middle) else (shut, middle)
    return open_


def yaw(pose: np.ndarray) -> float:
    return 2 * math.atan2(pose[5], pose[6])


def changes(world: angen.World, seconds: float, doors: dict[str, int]) -> dict[str, float]:
    """The angle at which each switch first changes within that time, s."""
    found: dict[str, float] = {}
    for _ in range(round(seconds * 1000)):
        world.step()
        for _, source, kind, _, _ in world.events():
            if kind == 'switch' and source not in found:
                found[source] = world.joint_positions[doors[source]]
    return found


def doors_and_switches(building: str) -> str:
    """The building without all that is no door and no optical switch."""
    root = etree.parse(building).getroot()
    for entry in root.xpath('world/include | world/model | world/actor'):
        uri = entry.findtext('uri', '')
        if not uri.endswith('_door') and uri != 'model://optical_switch':
            entry.getparent().remove(entry)
    return etree.tostring(root, encoding='unicode')


def test_they_change_where_geometry_says(building, monkeypatch):
    monkeypatch.setenv('ANGEN_MODEL_PATH', str(WORLDS / 'models'))
    world = angen.World.from_text(doors_and_switches(building))
    world.run(0.1)
    place = dict(zip(world.links, world.link_poses))
    expected, hinges = {}, {}
    for name in world.sensors('switch'):
        room, floor = name.rsplit('_switch', 1)
        door, beam = place[f'{room}_door{floor}::base'], place[f'{name}::switch']
        at = turned(beam[:3] - door[:3], -yaw(door))
        expected[name] = predicted(at, yaw(beam) - yaw(door), strip_of(f'{room}_door'))
        hinges[name] = world.joints.index(f'{room}_door{floor}::hinge')
    assert len(expected) == 12

    world.command('door', 'all', 'Close')  # three are open for the person
    world.run(5)
    world.events()
    world.command('door', 'all', 'Open')
    opened = changes(world, 0.6, hinges)
    world.run(4)
    world.command('door', 'all', 'Close')
    world.run(2)
    closed = changes(world, 2.5, hinges)
    for name, angle in expected.items():
        assert math.radians(0.5) < -angle < math.radians(2)
        assert abs(opened[name] - angle) < LEAST, (name, 'opens', opened[name], angle)
        assert abs(closed[name] - angle) < LEAST, (name, 'closes', closed[name], angle)
