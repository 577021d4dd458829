"""angen plan on the command line."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.parser import add_allow_paths, add_json, command
from angen_tools.common.output import show_done


def run_plan(args: argparse.Namespace) -> int:
    from angen_apps.plan.draw import draw
    from angen_apps.plan.overlays import What
    show_done(draw(args.world, args.output, What(args.sensors, args.events, args.track)), args.json)
    return 0


def add_plan(commands: Any) -> None:
    """angen plan."""
    parser = command(commands, 'plan', run_plan,
                     'draws the floor plan of a world to scale; needs no simulator',
                     'plan home.world -o plan.svg', 'plan home.world --sensors -o plan.png')
    parser.add_argument('world', metavar='WORLD', type=Path, help='the SDF file of the building')
    parser.add_argument('--sensors', action='store_true',
                        help='with sensors, their names and fields of view')
    parser.add_argument('--events', metavar='FILE', type=Path, help='with how often each sensor '
                        'and device is in the column source of a CSV file, as in events.csv')
    parser.add_argument('--track', metavar='FILE', type=Path, help='with ways, from the columns '
                        'x, y and if they are there z and name of a CSV file')
    parser.add_argument('-o', '--output', metavar='FILE', type=Path, required=True,
                        help='a file .svg or .png')
    add_allow_paths(parser)
    add_json(parser)
