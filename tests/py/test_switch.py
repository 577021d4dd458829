"""Optical switches open and close at the door angle that geometry predicts, at every door."""
import math

from lxml import etree

import angen
from sdf_text import WORLDS

LEAST = math.radians(0.5)
THRESHOLD = 0.05  # m, of models/optical_switch


def predicted(world: angen.World, switch: str, door: str) -> float:
    """The angle of a leaf, from which on its strip leaves the beam (rad, below 0): bisection over
    rays in the world."""
    rays = world.detection_rays('switch', switch)

    def cut(angle: float) -> bool:
        world.set_joints(door, {'hinge': angle})
        ranges = world.cast(rays[:, :3], rays[:, 3:6], rays[:, 7])
        return bool((ranges < rays[:, 7] - THRESHOLD).any())

    shut, open_ = 0.0, -math.pi / 4
    assert cut(shut) and not cut(open_)
    while shut - open_ > 1e-6:
        middle = (shut + open_) / 2
        shut, open_ = (middle, open_) if cut(middle) else (shut, middle)
    world.set_joints(door, {'hinge': 0.0})
    return open_


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
    text = doors_and_switches(building)
    world, still = angen.World.from_text(text), angen.World.from_text(text)
    expected, hinges = {}, {}
    for name in world.sensors('switch'):
        door = name.replace('_switch', '_door')
        expected[name] = predicted(still, name, door)
        hinges[name] = world.joints.index(f'{door}::hinge')
    world.run(0.1)
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
