"""A person at doors that are not built as ours: hinges at any height, leaves that lean or slide."""
import numpy as np
import pytest

from sdf_text import DOORS, box, person

WIDTH, HEIGHT, FOOT, MASS = 0.9, 1.9, 0.15, 20.0  # of a leaf; m, kg
WALL = (box('wall_west', '-3.03 0 1.2 0 0 0', '6 0.1 2.4', True)
        + box('wall_east', '3.93 0 1.2 0 0 0', '6 0.1 2.4', True))


def door(pose: str = '0 0 0 0 0 0', joint: str = '', origin: float = 0.0, anchor: float = 0.0
         ) -> str:
    """A leaf along x from 0 to its width; the heights (m) of its link's origin, and of its joint
    above that."""
    joint = joint or ('<axis><xyz>0 0 1</xyz><limit><lower>-1.57</lower><upper>0</upper></limit>'
                      '</axis>')
    kind = 'prismatic' if '<xyz>1' in joint else 'revolute'
    middle = f'<pose>{WIDTH / 2} 0 {FOOT + HEIGHT / 2 - origin} 0 0 0</pose>'
    moments = [MASS / 12 * v for v in (HEIGHT ** 2, WIDTH ** 2 + HEIGHT ** 2, WIDTH ** 2)]
    return f'''<model name="hall_door0"><pose>{pose}</pose>
  <link name="base"><inertial><mass>50</mass></inertial></link>
  <joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
  <link name="leaf"><pose>0 0 {origin} 0 0 0</pose><inertial>{middle}<mass>{MASS}</mass><inertia>
  <ixx>{moments[0]}</ixx><iyy>{moments[1]}</iyy><izz>{moments[2]}</izz></inertia></inertial>
  <collision name="c">{middle}<geometry><box><size>{WIDTH - 0.02} 0.04 {HEIGHT}</size></box>
  </geometry></collision></link>
  <joint name="hinge" type="{kind}"><pose>0 0 {anchor} 0 0 0</pose><parent>base</parent>
  <child>leaf</child>{joint}</joint></model>'''


def slide(way: float) -> str:
    low, high = sorted((0.0, way))
    return f'''<axis><xyz>1 0 0</xyz><limit><lower>{low}</lower><upper>{high}</upper></limit>
  </axis>'''


@pytest.mark.parametrize('start', [-2.0, 2.0])
@pytest.mark.parametrize('made', [
    door(), door(anchor=1.1), door(origin=1.1), door('0 0 0 0.1 0 0'),
    door('0 0.09 0 0 0 0', slide(0.88)), door('0 0.09 0 0 0 0', slide(-0.88))],
    ids=['plain', 'high hinge', 'high link', 'leans', 'slides to its edge', 'slides to its hinge'])
def test_a_person_opens_a_door_of_another_make(world, made, start):
    w = world(WALL + made + person(f'0.45 {start} 0 0 0 0'), DOORS)
    w.run(0.3)
    w.command('person', 'ann', f'GoTo 0.45 {-start}')
    w.run(15.0)
    state = w.device('person', 'ann')
    assert np.hypot(state['x'] - 0.45, state['y'] + start) < 0.1
    assert w.device('door', 'hall0')['mode'] == 'OPEN'
