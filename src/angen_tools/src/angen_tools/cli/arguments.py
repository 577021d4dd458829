"""Values of the command line: each function returns what a word means, or ValueError says what is
wrong and what would be right.
"""
from __future__ import annotations

import argparse
import math
from typing import Any, Callable


def checked(check: Callable[[str], Any]) -> Callable[[str], Any]:
    """`check` for argparse, which shows only errors of its own type in full."""
    def run(text: str) -> Any:
        try:
            return check(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from None
    return run


def _number(text: str) -> float:
    """The number, or NaN."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def at_least(least: int) -> Callable[[str], int]:
    """A whole number that is not below `least`."""
    def whole(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = least - 1
        if number < least:
            raise ValueError(f"'{text}' is not a whole number of at least {least}")
        return number
    return whole


def counts(text: str) -> list[int]:
    """Whole numbers between commas."""
    return [at_least(0)(word.strip()) for word in text.split(',')]


def window(text: str) -> float:
    """How long to measure: 1 to 3600 s."""
    number = _number(text)
    if not 1.0 <= number <= 3600.0:
        raise ValueError(f"'{text}' is not a valid time; give 1 to 3600 s")
    return number


def duration(text: str) -> float:
    """A length of time in s, more than 0."""
    number = _number(text)
    if not 0.0 < number < math.inf:
        raise ValueError(f"'{text}' is not a valid time; give seconds, more than 0")
    return number


def moment(text: str) -> float:
    """A time in s, 0 or more."""
    number = _number(text)
    if not 0.0 <= number < math.inf:
        raise ValueError(f"'{text}' is not a valid time; give seconds, 0 or more")
    return number


def rate(text: str) -> float:
    """Simulated seconds per second, 0 or more."""
    number = _number(text)
    if not 0.0 <= number <= 1000.0:
        raise ValueError(f"'{text}' is not a valid rate; give 0 to 1000")
    return number


def degrees(text: str) -> float:
    """An angle in degrees as rad."""
    number = _number(text)
    if not math.isfinite(number):
        raise ValueError(f"'{text}' is not an angle in degrees")
    return math.radians(number)


def pose(text: str) -> Any:
    from angen_tools.world.sdf import parse_pose
    return parse_pose(text)


def new_name(text: str) -> str:
    from angen_tools.common.catalog import angen_module
    return angen_module().check_name(text)


def link(text: str) -> str:
    from angen_tools.world.sdf import check_link
    return check_link(text)


def setting(text: str) -> tuple[str, str]:
    from angen_tools.world.sdf import parse_settings
    return parse_settings([text])[0]
