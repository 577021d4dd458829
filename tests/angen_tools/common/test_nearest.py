"""Suggestions for a name that is not known."""
from angen_tools.common.nearest import did_you_mean, nearest

NAMES = ['kitchen_lamp0', 'kitchen_door0', 'bathroom_lamp0', 'ground_plane', 'sofa']


def test_the_nearest_come_first() -> None:
    assert nearest('kichen_lamp0', NAMES)[0] == 'kitchen_lamp0'
    assert nearest('SOFA', NAMES)[0] == 'sofa'
    assert nearest('kitchen', NAMES) == ['kitchen_door0', 'kitchen_lamp0']


def test_much_farther_ones_are_left_out() -> None:
    assert nearest('sofas', NAMES) == ['sofa']
    assert nearest('model://stoove', ['model://stove', 'model://tv', 'model://sitter']) \
        == ['model://stove']


def test_the_question() -> None:
    assert did_you_mean('sofas', ['sofa']) == 'did you mean sofa?'
    assert did_you_mean('a', ['a1', 'a22']) == 'did you mean a1 or a22?'
    assert did_you_mean('x', ['a', 'b', 'c']) == 'did you mean a, b or c?'
    assert did_you_mean('a', [], 'angen list') == 'there are none'


def test_how_to_list_the_rest() -> None:
    assert did_you_mean('sofas', NAMES, 'angen list').endswith('? `angen list` lists all')
    assert did_you_mean('sofas', NAMES[:3], 'angen list').endswith('?')
