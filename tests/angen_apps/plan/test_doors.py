"""People open both leaves of a double door where one alone is narrow."""
from pathlib import Path

import angen
import pytest

from angen_apps.imports.sweethome import read_sweethome
from angen_apps.plan.writer import write_world

SASHES = ('<sash xAxis="0.015" yAxis="0.5" width="0.48" startAngle="0" endAngle="-1.5707964"/>'
          '<sash xAxis="0.985" yAxis="0.5" width="0.48" startAngle="3.1415927" '
          'endAngle="4.712389"/>')
WALLS = ''.join(f'<wall xStart="{a}" yStart="{b}" xEnd="{c}" yEnd="{d}" thickness="20"/>'
                for a, b, c, d in ((0, 0, 400, 0), (400, 0, 400, 800), (400, 800, 0, 800),
                                   (0, 800, 0, 0), (0, 400, 400, 400)))
ROOMS = ''.join(f'<room name="{name}">' + ''.join(
    f'<point x="{x}" y="{y}"/>' for x, y in ((0, low), (400, low), (400, high), (0, high)))
    + '</room>' for name, low, high in (('Kitchen', 0, 400), ('Living', 400, 800)))
ANN = '''<actor name="ann"><script><trajectory id="0" type="walking"><waypoint><time>0</time>
  <pose>2 {y} 0 0 0 0</pose></waypoint></trajectory></script></actor>'''


def world(folder: Path, width: float, y: float) -> angen.World:
    path = folder / 'home.xml'
    path.write_text(f'<home>{WALLS}{ROOMS}<doorOrWindow catalogId="doubleDoor" name="Door" x="200" '
                    f'y="400" width="{width}" depth="20" height="210">{SASHES}</doorOrWindow>'
                    '</home>')
    write_world(read_sweethome(path), folder / 'home.world', 'none')
    text = (folder / 'home.world').read_text().replace('</world>', ANN.format(y=y) + '</world>')
    made = angen.World.from_text(text)
    made.run(0.5)
    return made


@pytest.mark.parametrize('y', [-2.0, -6.0])  # that one pulls, and pushes
def test_both_leaves_of_a_narrow_double_door_are_opened(tmp_path: Path, y: float) -> None:
    made = world(tmp_path, 130, y)
    made.command('person', 'ann', f'GoTo 2 {-8.0 - y:g}')
    made.run(25)
    state = made.device('person', 'ann')
    assert state['y'] == pytest.approx(-8.0 - y, abs=0.1) and not state['unreachable']
    assert [made.device('door', name)['mode'] for name in made.devices('door')] == ['OPEN', 'OPEN']


def test_a_wide_leaf_suffices(tmp_path: Path) -> None:
    made = world(tmp_path, 200, -2.0)
    made.command('person', 'ann', 'GoTo 1.6 -6')
    made.run(25)
    assert made.device('person', 'ann')['y'] == pytest.approx(-6.0, abs=0.1)
    assert sorted(made.device('door', name)['mode'] for name in made.devices('door')) == [
        'CLOSED', 'OPEN']
