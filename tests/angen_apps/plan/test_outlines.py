"""The shapes of a world that a plan draws."""
from pathlib import Path

import angen
import numpy as np
import pytest

from angen_apps.plan.finish import finish
from angen_apps.plan.model import Leaf, Opening, Plan, Room, Storey, Wall
from angen_apps.plan.outlines import leaves_of, shapes_of
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
    world = angen.World(str(path))
    slide, = leaves_of(world, shapes_of(world))
    assert slide.model == 'den_door0' and slide.hinge is None
    for outline, west, east in ((slide.outlines[0], 1.97, 3.0), (slide.outlines[-1], 0.97, 2.0)):
        xs = [x for x, _ in outline]
        assert (min(xs), max(xs)) == pytest.approx((west, east), abs=0.01)


def test_a_leaf_with_a_joint_of_another_name_is_drawn() -> None:
    leaf = """<link name="leaf"><collision name="c"><pose>0.5 0 1 0 0 0</pose><geometry><box>
        <size>1 0.04 {high}</size></box></geometry></collision></link>
        <joint name="glide" type="prismatic"><parent>world</parent><child>leaf</child><axis>
        <xyz>1 0 0</xyz><limit><lower>0</lower><upper>0.9</upper></limit></axis></joint>
        <plugin name="d" filename="libdoor_world_plugin.so"><joint>glide</joint></plugin>"""
    for high, count in ((2.0, 1), (1.0, 0)):
        world = angen.World.from_text('<sdf version="1.6"><world name="w"><model name="side_door0">'
                                      f'{leaf.format(high=high)}</model></world></sdf>')
        assert len(leaves_of(world, shapes_of(world))) == count


BEAM = '''<sdf version="1.9"><world name="w"><model name="beam"><static>true</static>
<link name="body"><pose>1 2 3 0 0 0</pose>
<collision name="box"><pose>0 0 0 0 0.5 0</pose><geometry><box><size>2 1 0.2</size></box></geometry>
</collision>
<collision name="ring"><pose>5 0 0 0 0 0</pose><geometry><cylinder><radius>0.5</radius>
<length>1</length></cylinder></geometry></collision></link></model>
<model name="gate"><pose>0 -4 0 0 0 1.5708</pose>
<link name="leaf"><collision name="panel"><pose>0.5 0 1 0 0 0</pose><geometry><box>
<size>1 0.04 2</size></box></geometry></collision></link>
<joint name="hinge" type="revolute"><parent>world</parent><child>leaf</child><axis><xyz>0 0 1</xyz>
<limit><lower>-1.5708</lower><upper>0.001</upper></limit></axis></joint></model></world></sdf>'''


@pytest.mark.parametrize('angle', [0.0, -1.0])
def test_shapes_and_leaves_are_where_the_simulator_has_them(angle: float) -> None:
    world = angen.World.from_text(BEAM)
    world.set_joints('gate', {'hinge': angle})
    beam, ring, panel = shapes_of(world)
    assert (beam.model, beam.link, beam.type, beam.moves) == ('beam', 'body', 'box', False)
    half = np.cos(0.5) + 0.1 * np.sin(0.5)
    xs, ys = zip(*beam.corners)
    assert (min(xs), max(xs), min(ys), max(ys)) == pytest.approx((1 - half, 1 + half, 1.5, 2.5))
    assert beam.tilted and not ring.tilted and not panel.tilted and panel.moves
    assert (ring.bottom, ring.top) == pytest.approx((2.5, 3.5))
    assert np.hypot(*(np.array(ring.corners) - (6, 2)).T) == pytest.approx(0.5, rel=0.002)
    gate, = leaves_of(world, [beam, ring, panel])
    assert gate.hinge == pytest.approx((0, -4)) and not gate.window
    assert gate.path[0] == pytest.approx((-0.02, -3), abs=0.05)  # shut, however it is now
    assert gate.path[-1] == pytest.approx((1, -4.02), abs=0.05)
