"""The travel of leaves."""
from math import degrees, pi

import pytest

from angen_apps.plan.model import Leaf, Opening, Plan, Storey, Wall
from angen_apps.plan.travel import hang
from angen_apps.plan.walls import boxes


@pytest.mark.parametrize('lap, most', [(0.0, 90.0), (0.0006, 87.0)])
def test_a_leaf_does_not_open_onto_a_wall_beside_its_hinge(lap: float, most: float) -> None:
    """0.6 mm there hold a leaf a degree back, as in Open-RMF's clinic."""
    hinge = -0.5
    beside = Wall((hinge + lap - 0.05, 0.1), (hinge + lap - 0.05, 2.0), 0.1, 0.0, 2.5)
    door = Opening('door', 0.0, 0.0, 0.0, 1.0, 0.0, 2.1, (-0.05, 0.05),
                   (Leaf((hinge, 0.0), 0.99, 0.0, pi / 2),), name='front0')
    storey = Storey(0, 'ground', 0.0, 2.5, walls=[beside], openings=[door])
    plan = Plan('home', [storey])
    leaf, = hang(storey, boxes(storey.walls, storey.openings, 0.02), [], plan)
    assert degrees(leaf.turn) == pytest.approx(most)
    assert plan.remarks == ([] if most == 90.0 else [
        'door front0 opens by 87 degrees only: a wall is in its way'])
