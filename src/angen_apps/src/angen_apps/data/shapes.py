"""Shapes of what files of others have: types of values with their limits, objects, lists."""
from __future__ import annotations

import re
from typing import Any, Callable, Mapping, NamedTuple, Sequence

from angen_tools.common.failure import Failure
from angen_tools.common.text_file import shortened

Reader = Callable[[Any], None]  # ValueError, which says what would be right, for another value
UNFIT = re.compile('[\0-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]')  # breaks a line or UTF-8
NUMBER = re.compile(r'[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|nan|inf', re.ASCII)
LONGEST = 1000  # characters of a text
MANY = 100_000  # entries of a list
DEEPEST = 20  # objects and lists in each other
YEARS = 1900, 2900  # range of the first day's year
DAYS = 36525  # the most of a home


class Many(NamedTuple):
    """A list of at least some entries of one shape."""

    shape: Any
    least: int = 0


class Each(NamedTuple):
    """An object with any keys: the shapes of a key and of a value."""

    key: Reader
    value: Any


def number(least: float, most: float, whole: bool = False) -> Reader:
    """A number of JSON."""
    def read(value: Any) -> None:
        if isinstance(value, bool) or not isinstance(value, int if whole else (int, float)) \
                or not least <= value <= most:
            raise ValueError(f'must be a {"whole " * whole}number from {least:.10g} to '
                             f'{most:.10g}')
    return read


def figure(least: float, most: float, whole: bool = False, nan: bool = False) -> Reader:
    """A number in a cell of a table; `nan`: or none."""
    check = number(least, most, whole)

    def read(text: Any) -> None:
        try:  # int and float read more: digits of other scripts, spaces, underscores
            value: Any = (int if whole else float)(text) if NUMBER.fullmatch(text) else None
        except (TypeError, ValueError):
            value = None
        if not (nan and value != value):
            check(value)
    return read


def text(least: int = 0, most: int = LONGEST, without: str = '') -> Reader:
    """A text of one line, of a number of characters, without some of them."""
    unfit = re.compile(f'{UNFIT.pattern[:-1]}{re.escape(without)}]')

    def read(value: object) -> None:
        if not isinstance(value, str) or not least <= len(value) <= most or unfit.search(value):
            raise ValueError(f'must be a text of {least} to {most} characters in one line'
                             + (f', without {without}' if without else ''))
    return read


def word(*words: str) -> Reader:
    """One of some texts."""
    known = frozenset(words)

    def read(value: object) -> None:
        if not isinstance(value, str) or value not in known:
            raise ValueError(f'must be {_listed(words)}')
    return read


def _listed(words: Sequence[str]) -> str:
    """Some words for an error: the first ones if there are many."""
    some = [each or 'empty' for each in words[:9]] + ['others'] * (len(words) > 9)
    return ' or '.join(filter(None, (', '.join(some[:-1]), *some[-1:])))


def boolean(value: object) -> None:
    """True or false."""
    if not isinstance(value, bool):
        raise ValueError('must be true or false')


def clock(first: int, last: int) -> Reader:
    """Date and time of the local clock, with its range of years."""
    from datetime import datetime

    def read(value: Any) -> None:
        try:
            found = datetime.fromisoformat(value)
        except (TypeError, ValueError):
            found = None
        if found is None or not value.isascii() or found.tzinfo is not None \
                or not first <= found.year <= last:
            raise ValueError(f'must be a date and time as 2026-03-23T00:00:00, without a zone, in '
                             f'the years {first} to {last}')
    return read


def inner_path(value: object) -> None:
    """A path of a file in a folder, relative to it."""
    text(1)(value)
    parts = str(value).split('/')
    if '..' in parts or not parts[0]:
        raise ValueError('must be a path in the folder')


def shown(value: object) -> str:
    """A value for an error."""
    if isinstance(value, (dict, list)):
        return 'an object' if isinstance(value, dict) else 'a list'
    return 'null' if value is None else shortened(UNFIT.sub('?', str(value)))


def check_shape(what: str, value: object, shape: Any, inside: str = '') -> None:
    """Failure if a value is not of a shape: a dict of keys (those that end with ? may be missing),
    Each, Many, a list of one shape, a tuple of shapes, or a reader. `inside`: its place in a
    file."""
    at = f'{what}: {inside}' if inside else what
    if isinstance(shape, Mapping):
        _check_object(what, value, shape, inside)
    elif isinstance(shape, Each):
        for key, entry in _an(dict, at, value).items():
            check_value(f'{at}: a key', key, shape.key)
            check_shape(what, entry, shape.value, f'{inside}.{key}'.lstrip('.'))
    elif isinstance(shape, (list, Many)):
        one, least = shape if isinstance(shape, Many) else (shape[0], 0)
        entries = _an(list, at, value)
        if not least <= len(entries) <= MANY:
            raise Failure(f'{at} has {len(entries)} entries, must have {least} to {MANY}')
        for i, entry in enumerate(entries):
            check_shape(what, entry, one, f'{inside}[{i}]')
    elif isinstance(shape, tuple):
        if len(_an(list, at, value)) != len(shape):
            raise Failure(f'{at} must have {len(shape)} entries')
        for i, (entry, one) in enumerate(zip(_an(list, at, value), shape)):
            check_shape(what, entry, one, f'{inside}[{i}]')
    else:
        check_value(at, value, shape)


def _an(kind: type, at: str, value: Any) -> Any:
    if not isinstance(value, kind):
        raise Failure(f'{at} must be {"an object" if kind is dict else "a list"}, is '
                      f'{shown(value)}')
    return value


def _check_object(what: str, value: object, shape: Mapping[str, Any], inside: str) -> None:
    at = f'{what}: {inside}' if inside else what
    entries = _an(dict, at, value)
    for name, one in shape.items():
        key = name.removesuffix('?')
        if key in entries:
            check_shape(what, entries[key], one, f'{inside}.{key}'.lstrip('.'))
        elif key == name:
            raise Failure(f'{at} has no {key}')


def check_value(at: str, value: object, read: Reader) -> None:
    """Failure with what a value must be, if its reader raises ValueError."""
    try:
        read(value)
    except ValueError as error:
        raise Failure(f'{at} is {shown(value) or "empty"}, {error}') from None


def check_plain(what: str, value: object, depth: int = 0) -> None:
    """Failure for what no JSON file of ours has: great depth, and texts that break a line."""
    if depth > DEEPEST:
        raise Failure(f'{what}: has more than {DEEPEST} objects and lists in each other')
    if isinstance(value, str) and UNFIT.search(value):
        raise Failure(f'{what}: has the text {shown(value)}, with characters that break its line')
    if isinstance(value, list):
        for entry in value:
            check_plain(what, entry, depth + 1)
    elif isinstance(value, dict):
        for key, entry in value.items():
            check_plain(what, key, depth + 1)
            check_plain(what, entry, depth + 1)
