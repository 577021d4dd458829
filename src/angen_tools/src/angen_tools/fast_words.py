"""The words of angen run; what they do is loaded when they are said."""
from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any, Callable

from .bench_words import at_least


def span(text: str) -> float:
    """A length of time in s, more than 0; ValueError where it is none."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0.0 < number < math.inf:
        raise ValueError(f"'{text}' is no time; give seconds, more than 0")
    return number


def run_fast(args: argparse.Namespace) -> int:
    from . import fast_run
    print(fast_run.run(args.world, args.span, args.seed, args.out))
    return 0


def add_run(commands: Any, command: Callable[..., argparse.ArgumentParser],
            checked: Callable[[Any], Any]) -> None:
    """angen run --fast."""
    run = command(commands, 'run', run_fast,
                  'runs a world without ROS, leaping over time in which nothing happens, and '
                  'leaves its events in a CSV file; for ROS: ./angen run NAME:=VALUE ...',
                  'run --fast worlds/angen.world --for 3600')
    run.add_argument('world', metavar='WORLD', help='the SDF file of the building')
    run.add_argument('--fast', action='store_true', required=True,
                     help='as fast as it goes; the only way without ROS')
    run.add_argument('--for', metavar='SECONDS', dest='span', type=checked(span), required=True,
                     help='how much time to simulate')
    run.add_argument('--seed', metavar='S', type=checked(at_least(0)), default=1,
                     help='of all noise (1)')
    run.add_argument('-o', '--out', metavar='DIR', type=Path, default=Path('out'),
                     help='where events.csv goes (out)')
