"""Rays against the lidar and the map."""
from pathlib import Path

import angen
import numpy as np
import pytest

from angen_apps.maps.gridmap import OCCUPIED, load_world, make_map

ROOT = Path(__file__).resolve().parents[3]
BUILDING = str(ROOT / 'worlds/angen.world')


def hits(world: angen.World, lidar: str, robot: str) -> np.ndarray:
    """The hits of a scan, (n, 2) m in the world; the lidar is above the robot."""
    world.request('lidar', lidar)
    world.run(0.2)
    scan = world.sensor('lidar', lidar)
    ranges = np.array(scan['ranges'])
    pose = world.link_poses[world.links.index(f'{robot}::base_footprint')]
    angles = (scan['angle_min'] + scan['angle_increment'] * np.arange(len(ranges))
              + 2 * np.arctan2(pose[5], pose[6]))
    far = np.isfinite(ranges)
    return (pose[:2] + ranges[far, None] *
            np.stack([np.cos(angles), np.sin(angles)], axis=1)[far])


@pytest.mark.parametrize('floor', [0, 1])
def test_the_lidar_hits_the_walls_of_the_map(floor: int) -> None:
    world = load_world(BUILDING)
    for person in world.devices('person'):
        world.delete(person)
    world.spawn('model://turtlebot', 'guest', [5.5, 2.0, 4 * floor + 0.01, 0, 0, 1])
    for door in world.devices('door'):
        world.command('door', door, 'Open')
    world.run(4)
    points = hits(world, 'guest_lidar', 'guest')
    grid = make_map(load_world(BUILDING), floor, 'open')
    cells = np.array([grid.point(*cell) for cell in np.argwhere(grid.cells == OCCUPIED)])
    far = np.hypot(*(points[:, None] - cells[None]).transpose(2, 0, 1)).min(axis=1)
    assert len(points) > 700 and far.mean() < 0.05
