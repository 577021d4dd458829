"""The shapes of a world's file that a plan draws."""
from __future__ import annotations

from pathlib import Path

import pytest

from angen_apps.plan.finish import finish
from angen_apps.plan.model import Leaf, Opening, Plan, Room, Storey, Wall
from angen_apps.plan.shapes import read_shapes
from angen_apps.plan.writer import write_world


def test_a_leaf_that_slides_is_drawn_shut_and_open(tmp_path: Path) -> None:
    corners = ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0))
    door = Opening('door', 2.5, 0.0, 0.0, 1.0, 0.0, 2.1, (-0.05, 0.05),
                   (Leaf((-0.53, 0.06), 1.03, 0.0, 0.0, -1.0),))
    storey = Storey(0, 'ground', 0.0, 2.5, rooms=[Room('den', 'living', corners, 0.0, 2.5)],
                    openings=[door], walls=[Wall(a, b, 0.1, 0.0, 2.5) for a, b in
                                            zip(corners, corners[1:] + corners[:1])])
    path = tmp_path / 'home.world'
    write_world(finish(Plan('home', [storey])), path, 'none')
    shapes = read_shapes(path)
    slide, = shapes.slides
    assert slide.model == 'den_door0' and not shapes.swings
    for corners_of, west, east in ((slide.shut, 1.97, 3.0), (slide.open, 0.97, 2.0)):
        xs = [x for x, _ in corners_of]
        assert (min(xs), max(xs)) == pytest.approx((west, east), abs=0.01)
