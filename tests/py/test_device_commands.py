"""Commands to all devices of a kind: all obey, or none."""
import numpy as np
import pytest

import angen


def door(name: str, x: float, lower: float) -> str:
    """A door of 20 kg that opens to `lower` rad."""
    return f'''<model name="{name}_door0"><pose>{x} 0 0 0 0 0</pose><link name="base"/>
      <link name="leaf"><inertial><pose>0.45 0 1 0 0 0</pose><mass>20</mass><inertia><ixx>7</ixx>
      <iyy>8</iyy><izz>1.4</izz></inertia></inertial></link>
      <joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
      <joint name="hinge" type="revolute"><parent>base</parent><child>leaf</child><axis>
      <xyz>0 0 1</xyz><limit><lower>{lower}</lower><upper>0</upper></limit></axis></joint>
      <plugin name="door" filename="libdoor_world_plugin.so"><open_position>{lower}</open_position>
      </plugin></model>'''


def test_where_one_rejects_none_moves(world):
    w = world(door('wide', 0, -1.57) + door('narrow', 3, -0.8))
    w.run(0.1)
    before = w.joint_positions.copy()
    with pytest.raises(angen.Error, match='narrow0: the angle -1.2 is .* none of the others'):
        w.command('door', 'all', 'Set -1.2')
    w.run(2)
    assert np.allclose(w.joint_positions, before, atol=1e-6)
    assert w.device('door', 'wide0')['mode'] == 'CLOSED'


def test_soft_limits_hold_a_door_back(world):
    """It opens to -1.2 rad, where its <safety_controller> leaves no force to go on."""
    guarded = door('hall', 0, -1.57).replace('</limit>', '''</limit><angen:safety_controller>
      <soft_lower_limit>-1.2</soft_lower_limit><k_position>10</k_position>
      <k_velocity>250</k_velocity></angen:safety_controller>''')
    w = world(guarded)
    w.command('door', 'hall0', 'Open')
    farthest = 0.0
    for _ in range(600):
        w.run(0.01)
        farthest = min(farthest, w.device('door', 'hall0')['position'])
    assert farthest == pytest.approx(-1.2, abs=0.005)
    assert w.device('door', 'hall0')['mode'] == 'BLOCKED'
    w.command('door', 'hall0', 'Close')
    w.run(6)
    assert w.device('door', 'hall0')['mode'] == 'CLOSED'
