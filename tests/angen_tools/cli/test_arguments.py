"""Values of the command line."""
import argparse
import math
from typing import Any, Callable

import pytest

from angen_tools.cli import arguments


@pytest.mark.parametrize('parse, text, value', [
    (arguments.at_least(1), '3', 3), (arguments.counts, '0, 10,100', [0, 10, 100]),
    (arguments.window, '1', 1.0), (arguments.duration, '1e-3', 1e-3), (arguments.rate, '0', 0.0),
    (arguments.degrees, '180', math.pi),
    (arguments.degrees, '180deg', math.pi), (arguments.setting, 'a/b=c=d', ('a/b', 'c=d')),
    (arguments.link, 'table::body', 'table::body'), (arguments.new_name, 'my table', 'my table')])
def test_what_fits_is_its_value(parse: Callable[[str], Any], text: str, value: Any) -> None:
    assert parse(text) == value


@pytest.mark.parametrize('parse, text', [
    (arguments.at_least(1), '0'), (arguments.at_least(1), '1.5'), (arguments.counts, '1,x'),
    (arguments.window, '0.5'), (arguments.window, 'nan'), (arguments.duration, '0'),
    (arguments.duration, 'inf'), (arguments.rate, '-1'), (arguments.degrees, 'north'),
    (arguments.setting, 'a'), (arguments.link, 'table'), (arguments.new_name, 'a/b')])
def test_what_does_not_fit_is_named(parse: Callable[[str], Any], text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError) as wrong:
        arguments.checked(parse)(text)
    assert text.split(',')[-1] in str(wrong.value)
