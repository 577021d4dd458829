"""Suggestions for a name that is not known."""
from __future__ import annotations

from angen_tools.common.nearest import did_you_mean, nearest

NAMES = ['kitchen_lamp0', 'kitchen_door0', 'bathroom_lamp0', 'ground_plane', 'sofa']


def test_the_nearest_come_first() -> None:
    assert nearest('kichen_lamp0', NAMES)[0] == 'kitchen_lamp0'
    assert nearest('SOFA', NAMES)[0] == 'sofa'
    assert len(nearest('x', NAMES)) == 3


def test_the_question() -> None:
    assert did_you_mean('sofas', ['sofa']) == 'did you mean sofa?'
    assert did_you_mean('a', ['a1', 'a22']) == 'did you mean a1 or a22?'
    assert did_you_mean('kitchen', NAMES).count(',') == 1
    assert did_you_mean('a', [], 'angen list') == 'there are none'


def test_how_to_list_the_rest() -> None:
    assert did_you_mean('sofas', NAMES, 'angen list').endswith('? `angen list` lists all')
    assert did_you_mean('sofas', NAMES[:3], 'angen list').endswith('?')
