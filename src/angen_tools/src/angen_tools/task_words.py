"""The words of angen task; what they do is loaded when they are said."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, Callable

from .bench_words import at_least


def run_patrol(args: argparse.Namespace) -> int:
    if args.seeds > 1:
        from . import patrol_seeds
        words = [word for name in ('route', 'world') if getattr(args, name)
                 for word in (f'--{name}', str(getattr(args, name)))]
        return patrol_seeds.patrols([*words, '--rate', f'{args.rate:g}'],
                                    range(args.seed, args.seed + args.seeds), args.out)
    from . import patrol_command
    return patrol_command.patrol(args.route, args.world, args.seed, args.rate, args.out)


def pace(text: str) -> float:
    """Simulated seconds a second, 0 or more; ValueError where it is none."""
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0.0 <= number <= 1000.0:
        raise ValueError(f"'{text}' is no rate; give 0 to 1000")
    return number


def add_task(commands: Any, command: Callable[..., argparse.ArgumentParser],
             checked: Callable[[Any], Any]) -> None:
    """angen task patrol."""
    task = command(commands, 'task', run_patrol, 'has the robot do something; starts its own node',
                   'task patrol')
    kinds = task.add_subparsers(dest='what', metavar='WHAT', required=True)
    patrol = command(kinds, 'patrol', run_patrol, 'drives the TurtleBot through every room, '
                     'watched by the sensors, and leaves a table, figures and a rosbag',
                     'task patrol', 'task patrol --seed 7 --rate 1',
                     'task patrol --route my.yaml --out my_run', 'task patrol --seeds 20')
    patrol.add_argument('--route', metavar='FILE', type=Path,
                        help="where to go and how fast; config/patrol.yaml of angen_tools without")
    patrol.add_argument('--world', metavar='FILE', type=Path, help='worlds/angen.world without')
    patrol.add_argument('--seed', metavar='S', type=checked(at_least(0)), default=1,
                        help='of start, noise and timing (1)')
    patrol.add_argument('--seeds', metavar='N', type=checked(at_least(1)), default=1,
                        help='so many patrols, with this seed and the next ones, each in a folder '
                        'of its own, and a table of them (1)')
    patrol.add_argument('--rate', metavar='R', type=checked(pace), default=0.0,
                        help='simulated seconds a second, with rviz where there is a display; '
                        '0: as fast as it goes, without (0)')
    patrol.add_argument('-o', '--out', metavar='DIR', type=Path, default=Path('out'),
                        help='where everything goes (out)')
