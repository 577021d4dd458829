"""Models and what is in them."""
from __future__ import annotations

from pathlib import Path

import angen
import pytest
from lxml import etree

from angen_tools.world import models

BLOCKS = Path(__file__).resolve().parents[3] / 'worlds/models'
EMPTY = BLOCKS.parent / 'empty.world'
TABLE = '''<sdf version="1.6"><model name="table"><static>true</static><link name="body">
  <collision name="top"><geometry><box><size>1 1 0.1</size></box></geometry></collision>
  <collision name="leg"><pose>0 0 -0.4 0 0 0</pose><geometry><box><size>0.1 0.1 0.7</size></box>
  </geometry></collision></link></model></sdf>'''


@pytest.fixture
def world() -> angen.World:
    return angen.World(str(EMPTY))


def test_collisions_are_found_in_models_and_includes(monkeypatch: pytest.MonkeyPatch,
                                                     tmp_path: Path) -> None:
    (tmp_path / 'desk').mkdir()
    (tmp_path / 'desk/model.sdf').write_text(TABLE)
    monkeypatch.setenv('ANGEN_MODEL_PATH', str(tmp_path))
    world = etree.fromstring(
        '<sdf version="1.6"><world name="w"><include><uri>model://desk</uri><name>d1</name>'
        f'</include>{TABLE.split(">", 1)[1].removesuffix("</sdf>")}</world></sdf>')
    assert models.collisions(world, 'd1::body') == ['top', 'leg']
    assert models.collisions(world, 'table::body') == ['top', 'leg']
    assert models.collisions(world, 'table::foot') == []
    assert models.collisions(world, 'nobody::body') == []


def test_parts_of_a_merged_include_are_found() -> None:
    world = etree.fromstring('<sdf version="1.6"><world name="w"><include>'
                             '<uri>model://my_elevator</uri></include></world></sdf>')
    cabin = models.collisions(world, 'my_elevator::cabin')
    assert cabin and cabin == models.collisions(etree.fromstring(
        '<sdf version="1.6"><world name="w"><include><uri>model://elevator</uri></include></world>'
        '</sdf>'), 'elevator::cabin')
