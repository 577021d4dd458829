"""The words of angen map and angen drive; what they do is loaded when they are said."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, Callable

from .bench_words import at_least


def run_map(args: argparse.Namespace) -> int:
    from . import map_command
    print(map_command.save_map(args.world, args.floor, args.doors, args.output))
    return 0


def run_drive(args: argparse.Namespace) -> int:
    from . import drive
    drive.drive(args.robot)
    return 0


def add_map(commands: Any, command: Callable[..., argparse.ArgumentParser],
            checked: Callable[[Any], Any]) -> None:
    """angen map."""
    parser = command(commands, 'map', run_map,
                     "writes a floor's map for map_server; needs no simulator",
                     'map --floor 0 -o map', 'map --world my.world --floor 1 --doors open -o upper')
    parser.add_argument('--floor', metavar='N', type=checked(at_least(0)), default=0,
                        help='which floor, counted from 0 (0)')
    parser.add_argument('--world', metavar='FILE', type=Path, help='of a world; worlds/angen.world '
                        'without')
    parser.add_argument('--doors', choices=['away', 'open', 'shut'], default='away',
                        help='away: doorways are free; otherwise as the leaves stand (away)')
    parser.add_argument('-o', '--output', metavar='NAME', type=Path, default=Path('map'),
                        help='writes NAME.pgm and NAME.yaml (map)')


def add_drive(commands: Any, command: Callable[..., argparse.ArgumentParser],
              names: Callable[..., list[str]]) -> None:
    """angen drive; `names` completes robots' names."""
    parser = command(commands, 'drive', run_drive, 'drives a robot by the arrow keys',
                     'drive', 'drive --robot robot2')
    parser.add_argument('--robot', metavar='NAME',
                        help='as angen list --kind drive shows it; the first without'
                        ).completer = names
