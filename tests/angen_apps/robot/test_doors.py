"""Doors by geometry."""
from __future__ import annotations

import math

import numpy as np
import pytest

from angen_apps.maps.gridmap import FREE, OCCUPIED, GridMap
from angen_apps.robot.doors import find_door, find_hinge


def box(width: int = 80, height: int = 60) -> GridMap:
    """A room with a pillar; 0.05 m a cell."""
    cells = np.full((height, width), FREE, np.int8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    cells[10:16, 50:54] = OCCUPIED
    return GridMap(cells, (0.0, 0.0), 0.05, 0)


def test_a_hinge_is_found_by_two_poses_of_its_leaf() -> None:
    # the leaf's middle, half a meter from an axis at 2, 1
    hinge = find_hinge([(0, 0, 0), (2.5, 1.0, 0.0)], [(0, 0, 0), (2.0, 0.5, -math.pi / 2)])
    assert hinge.at == pytest.approx((2.0, 1.0))
    assert hinge.turn == pytest.approx(-math.pi / 2)
    assert find_hinge([(0, 0, 0)], [(0, 0, 0)]) is None


def test_a_door_is_what_two_maps_do_not_share() -> None:
    shut, opened = box(), box()
    shut.cells[20, 20:38] = OCCUPIED  # from x = 1.0 to 1.9 at y = 1.025
    opened.cells[2:20, 20] = OCCUPIED
    hinge = find_hinge([(1.0, 1.025, 0.0)], [(1.0, 1.025, -math.pi / 2)])
    assert hinge is None or hinge.at == pytest.approx((1.0, 1.025))
    door = find_door('d', hinge, shut, opened)
    assert door.width == pytest.approx(0.9, abs=0.05)
    assert door.shut == pytest.approx(0.0, abs=0.06)
    assert door.open - door.shut == pytest.approx(-math.pi / 2)
