"""Values of the command line: each function returns the meaning of a word, or a ValueError with the
error and its fix.
"""
import argparse
import math
from pathlib import Path
from typing import Any, Callable

from angen_tools.common import clock
from angen_tools.common.angle import warn_of_turns
from angen_tools.common.verbs import comma_hint, number

LONGEST = 100 * 365.25 * clock.DAY  # s: a longer time is a typing error, as 1e99
MOST = 1_000_000  # a greater number of things is, too


def checked(check: Callable[[str], Any]) -> Callable[[str], Any]:
    """`check` for argparse, which shows only errors of its own type in full."""
    def run(text: str) -> Any:
        try:
            return check(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from None
    return run


def at_least(least: int, most: int = MOST) -> Callable[[str], int]:
    """A whole number that is not below `least`, nor more than a world or a processor can take."""
    def whole(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = least - 1
        if value < least:
            raise ValueError(f"'{text}' is not a whole number of at least {least}")
        if value > most:
            raise ValueError(f"'{text}' is too large; give at most {most}")
        return value
    return whole


def between(least: int, most: int) -> Callable[[str], int]:
    """A whole number within these."""
    def whole(text: str) -> int:
        value = int(text) if text.isascii() and text.isdigit() else least - 1
        if not least <= value <= most:
            raise ValueError(f"'{text}' is not a whole number of {least} to {most}")
        return value
    return whole


def counts(text: str) -> list[int]:
    """Whole numbers between commas."""
    return [at_least(0, 10_000)(word.strip()) for word in text.split(',')]


def _within(text: str, low: float, high: float, otherwise: str,
            read: Callable[[str], float] = number) -> float:
    value = read(text)
    if value > high == LONGEST:
        raise ValueError(f"'{text}' is more than 100 years; give a shorter time")
    if not low <= value <= high:
        raise ValueError(f"'{text}' is not a valid {otherwise}{comma_hint(text)}")
    return value


def _in_seconds(text: str) -> float:
    """The seconds of '90', '90s', '10m', '1h 30min'; else NaN."""
    try:
        return clock.duration(text)
    except ValueError:
        return number(text)


def window(text: str) -> float:
    """A time to measure: 1 to 3600 s."""
    return _within(text, 1.0, 3600.0, 'time; give 1 to 3600 s', _in_seconds)


def duration(text: str) -> float:
    """A length of time in s, more than 0; in seconds or with units."""
    return _within(text, math.ulp(0.0), LONGEST,
                   'time; give more than 0 seconds, as 90, 10m or 1h30m', _in_seconds)


def moment(text: str) -> float:
    """A time in s, 0 or more."""
    return _within(text, 0.0, LONGEST,
                   'time; give 0 or more seconds, as 90, 10m or 1h30m', _in_seconds)


def rate(text: str) -> float:
    """Simulated seconds per second, 0 or more."""
    return _within(text, 0.0, 1000.0, 'rate; give 0 to 1000')


def degrees(text: str) -> float:
    """An angle in degrees as rad."""
    value = number(text.removesuffix('deg').removesuffix('°'))
    if not math.isfinite(value):
        raise ValueError(f"'{text}' is not an angle in degrees")
    return math.radians(value)


def pose(text: str) -> Any:
    from angen_tools.world.sdf import parse_pose
    numbers = parse_pose(text)
    for word in text.replace(',', ' ').split()[3:]:
        warn_of_turns(word)
    return numbers


def path(text: str) -> Path:
    if not text:
        raise ValueError("'' is not a path; give a file or a folder")
    return Path(text)


def new_name(text: str) -> str:
    from angen_tools.common.catalog import angen_module
    return angen_module().check_name(text)


def link(text: str) -> str:
    from angen_tools.world.sdf import check_link
    return check_link(text)


def setting(text: str) -> tuple[str, str]:
    from angen_tools.world.sdf import parse_settings
    return parse_settings([text])[0]
