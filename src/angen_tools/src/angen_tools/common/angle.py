"""Angles as people write them, in rad or in degrees."""
import math
import sys

MOST_TURN = 6.3  # rad


def radians(word: str) -> float:
    """The angle of '1.57', '90deg' or '90°', rad; NaN if it is not an angle."""
    number = word.removesuffix('deg').removesuffix('°')
    try:
        return float(number) if number == word else math.radians(float(number))
    except ValueError:
        return math.nan


def in_radians(word: str) -> str:
    """The word with an angle in degrees in rad; any other word as it is."""
    value = radians(word)
    return f'{value:.9g}' if word.endswith(('deg', '°')) and math.isfinite(value) else word


def warn_of_turns(word: str) -> None:
    """Says on stderr where an angle in rad is more than a turn: it may be in degrees."""
    if not word.endswith(('deg', '°')) and abs(radians(word)) > MOST_TURN:
        print(f'angen: warning: the angle {word} is in rad, more than a turn; {word} degrees are '
              f'{word}deg', file=sys.stderr)
