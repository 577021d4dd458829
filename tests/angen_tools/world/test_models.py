"""Models and their parts."""
from pathlib import Path

import pytest
from lxml import etree

from angen_tools.world import models


def test_collisions_are_found_in_models_and_includes(monkeypatch: pytest.MonkeyPatch,
                                                     tmp_path: Path, table: str) -> None:
    (tmp_path / 'desk').mkdir()
    (tmp_path / 'desk/model.sdf').write_text(table)
    monkeypatch.setenv('ANGEN_MODEL_PATH', str(tmp_path))
    world = etree.fromstring(
        '<sdf version="1.6"><world name="w"><include><uri>model://desk</uri><name>d1</name>'
        f'</include>{table.split(">", 1)[1].removesuffix("</sdf>")}</world></sdf>')
    assert models.collisions(world, 'd1::body') == ['top', 'leg']
    assert models.collisions(world, 'table::body') == ['top', 'leg']
    assert models.collisions(world, 'table::foot') == []
    assert models.collisions(world, 'missing::body') == []


def test_parts_of_a_merged_include_are_found() -> None:
    world = etree.fromstring('<sdf version="1.6"><world name="w"><include>'
                             '<uri>model://my_elevator</uri></include></world></sdf>')
    cabin = models.collisions(world, 'my_elevator::cabin')
    assert cabin and cabin == models.collisions(etree.fromstring(
        '<sdf version="1.6"><world name="w"><include><uri>model://elevator</uri></include></world>'
        '</sdf>'), 'elevator::cabin')
