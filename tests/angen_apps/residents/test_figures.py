"""The cat: a body of its own that people's walker moves."""
from __future__ import annotations

from pathlib import Path

import angen
import pytest

from angen_apps.residents.figures import walker

FLOOR = '''<sdf version="1.6"><world name="w"><gravity>0 0 -9.8</gravity>
  <model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane>
  <normal>0 0 1</normal><size>20 20</size></plane></geometry></collision></link></model>
</world></sdf>'''


@pytest.fixture
def world(tmp_path: Path) -> angen.World:
    (tmp_path / 'floor.world').write_text(FLOOR)
    made = angen.World(str(tmp_path / 'floor.world'))
    made.spawn(walker('tom', 0.6, 'cat'), 'tom', (0, 0, 0, 0, 0, 0))
    return made


def test_a_cat_is_level_while_it_walks_stops_and_stands(world: angen.World) -> None:
    world.run(2.0)
    tilt, height = 0.0, 0.0
    world.command('person', 'tom', 'GoTo 2 1')
    for _ in range(80):
        world.run(0.1)
        x, y, z, qx, qy = world.motion('tom')[0][:5]
        tilt, height = max(tilt, abs(qx), abs(qy)), max(height, abs(z))
    assert (x - 2) ** 2 + (y - 1) ** 2 < 0.1 ** 2
    assert tilt < 0.02 and height < 0.01


def test_a_cat_gives_the_heat_of_its_size(world: angen.World) -> None:
    """About a seventh of a person's, whose surface is as much greater."""
    world.run(1.0)
    heat = world.device('person', 'tom')['heat']
    world.spawn('<sdf version="1.6"><actor name="ann"/></sdf>', 'ann', (4, 0, 0, 0, 0, 0))
    world.run(1.0)
    assert heat == pytest.approx(world.device('person', 'ann')['heat'] * (4 / 70) ** (2 / 3))
    assert 9 < heat < 16  # W
