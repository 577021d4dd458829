"""Polygons of plans, against those of one point."""
import numpy as np
import pytest

from angen_apps.plan.polygons import inside
from angen_tools.common.geometry import contains

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
HOLES = [[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)], [(2.5, 2.5), (3.5, 2.6), (3.0, 3.5)]]


@pytest.mark.parametrize('steps', [1, 7, 40])
def test_points_are_inside_as_one_is(steps: int) -> None:
    x, y = np.meshgrid(np.linspace(-2.1, 6.2, steps), np.linspace(-1.3, 5.4, steps))
    x = np.append(x.ravel(), 0.5)  # one of them is in the square, at least
    y = np.append(y.ravel(), 0.5)
    assert inside(SQUARE, x, y, HOLES).tolist() == [
        contains(SQUARE, *point) and not any(contains(hole, *point) for hole in HOLES)
        for point in zip(x, y)]


def test_a_mesh_keeps_its_shape() -> None:
    x, y = np.meshgrid(np.linspace(-1.0, 5.0, 13), np.linspace(-1.0, 5.0, 9))
    assert inside(SQUARE, x, y, HOLES).shape == (9, 13)
