"""The words of angen walktest; what it does is loaded when they are said."""
from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any, Callable

PROFILES = ('nema-wd7', 'iec63180', 'en50131-g2')
MODELS = ('pyroelectric', 'range_difference')


def degrees(text: str) -> float:
    """An angle in degrees as rad; ValueError where it is none."""
    try:
        return math.radians(float(text))
    except ValueError:
        raise ValueError(f"'{text}' is no angle in degrees") from None


def run_walktest(args: argparse.Namespace) -> int:
    from . import walktest
    tested = walktest.detector(args.model, args.set, args.turn)
    return 0 if walktest.run(args.profile, tested, args.out) else 1


def add_walktest(commands: Any, command: Callable[..., argparse.ArgumentParser],
                 checked: Callable[[Any], Any], setting: Callable[[str], tuple[str, str]]) -> None:
    """angen walktest."""
    test = command(commands, 'walktest', run_walktest,
                   'walks a standard\'s walk test before a PIR; needs no simulator',
                   'walktest --profile nema-wd7',
                   'walktest --profile iec63180 --model range_difference -o out')
    test.add_argument('--profile', choices=PROFILES, required=True, help='the standard')
    test.add_argument('--model', choices=MODELS, default='pyroelectric',
                      help='of the PIR (pyroelectric)')
    test.add_argument('--set', metavar='KEY=VALUE', action='append', default=[],
                      type=checked(setting), help='a parameter, as angen plugins lists them')
    test.add_argument('--turn', metavar='DEG', type=checked(degrees), default=0.0,
                      help='turns it to the left; 180: to the wall (0)')
    test.add_argument('-o', '--out', metavar='DIR', type=Path, default=Path('out'),
                      help='where the CSV file and the figure go (out)')
