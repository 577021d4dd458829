"""Shapes of values from files: what is right is read, and an error says what would be right."""
from __future__ import annotations

from typing import Any

import pytest

from angen_apps.data.shapes import (Each, Many, Reader, boolean, check_shape, clock, figure,
                                    inner_path, number, text, word)
from angen_tools.common.failure import Failure


@pytest.mark.parametrize('read, right, wrong', [
    (number(0.0, 2.0), (0, 1, 2.0, -0.0), (2.1, -1, '1', True, None, float('nan'), 10 ** 400, [])),
    (number(1, 3, whole=True), (1, 3), (0, 4, 1.0, '1', True)),
    (figure(0.0, 2.0), ('0', '1.5', '2e0'),
     ('', 'x', 'nan', 'inf', '2.1', None, '1e999', '\uff11', ' 1', '1_0', '0x1')),
    (figure(0.0, 2.0, nan=True), ('nan', '1'), ('inf', 'x', '3')),
    (figure(-1, 1, whole=True), ('-1', '1'), ('0.5', '2', '1' * 5000, '\u0661')),
    (text(1, 3, '/'), ('a', 'äöü', 'a b'), ('', 'abcd', 'a/b', 'a\n', '\ud800', '\0', 5, None)),
    (word('a', ''), ('a', ''), ('b', None, ['a'])),
    (boolean, (True, False), (1, 0, 'true', None)),
    (clock(1900, 2900), ('2026-03-02T00:00:00', '2026-03-02'),
     ('2026-03-02T00:00:00+02:00', '1899-12-31', '9999-12-31', 'x', '', 5, None)),
    (inner_path, ('a', 'a/b.txt', 'a..b'), ('', '/a', '../a', 'a/../../b', '..', 5))])
def test_a_reader(read: Reader, right: tuple[Any, ...], wrong: tuple[Any, ...]) -> None:
    for value in right:
        read(value)
    for value in wrong:
        with pytest.raises(ValueError, match='^must be '):
            read(value)


WHOLE = {'a': number(0, 9), 'b?': [text()], 'c?': Each(text(1), number(0, 1)),
         'd?': Many((number(0, 9), number(0, 9)), 2)}


@pytest.mark.parametrize('value, what', [
    ([], 'f must be an object, is a list'), ({}, 'f has no a'),
    ({'a': 10}, 'f: a is 10, must be a number from 0 to 9'),
    ({'a': 1, 'b': {}}, 'f: b must be a list, is an object'),
    ({'a': 1, 'b': ['', 5]}, 'f: b[1] is 5, must be a text of 0 to 1000 characters in one line'),
    ({'a': 1, 'c': {'x': 2}}, 'f: c.x is 2, must be a number from 0 to 1'),
    ({'a': 1, 'c': {'': 1}}, 'f: c: a key is empty, must be a text of 1 to 1000 characters in one '
     'line'),
    ({'a': 1, 'd': [[1, 2]]}, 'f: d has 1 entries, must have 2 to 100000'),
    ({'a': 1, 'd': [[1, 2], [1]]}, 'f: d[1] must have 2 entries'),
    ({'a': 1, 'd': [[1, 2], [1, None]]}, 'f: d[1][1] is null, must be a number from 0 to 9')])
def test_the_place_of_what_is_wrong(value: object, what: str) -> None:
    with pytest.raises(Failure) as raised:
        check_shape('f', value, WHOLE)
    assert str(raised.value) == what


def test_what_may_be_missing() -> None:
    check_shape('f', {'a': 1}, WHOLE)
    check_shape('f', {'a': 1, 'b': ['x'], 'c': {'k': 0}, 'd': [[1, 2], [3, 4]], 'e': None}, WHOLE)
