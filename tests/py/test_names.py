"""The rule for names, as the tools use it."""
from __future__ import annotations

import pytest

import angen


@pytest.mark.parametrize('name', ['p1', 'Küche 2', '机器人', 'a.b', 'n' * 255])
def test_a_name(name: str) -> None:
    assert angen.check_name(name) == name


@pytest.mark.parametrize('name', ['', ' ', 'a::b', 'a/b', ' a', 'a ', 'a\nb', 'world', '__a__',
                                  'n' * 256])
def test_what_is_not_a_name(name: str) -> None:
    with pytest.raises(angen.Error, match='the name'):
        angen.check_name(name)


def test_what_is_not_utf8_is_an_error_of_values() -> None:
    with pytest.raises(ValueError):
        angen.check_name('\udcff')
