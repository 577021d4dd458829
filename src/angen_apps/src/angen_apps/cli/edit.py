"""angen edit on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_apps.cli.imports import SENSORS, pixel
from angen_apps.cli.web import add_address
from angen_tools.cli.arguments import checked
from angen_tools.cli.parser import command


def run_edit(args: argparse.Namespace) -> int:
    from angen_apps.edit.command import edit
    edit(args)
    return 0


def add_edit(commands: Any) -> None:
    """angen edit."""
    parser = command(commands, 'edit', run_edit,
                     'serves a page on which one draws a home, furnishes and simulates it',
                     'edit', 'edit home.world', 'edit plan.sh3d',
                     'edit scan.png --scale 0.05 --doors')
    parser.add_argument('file', metavar='FILE', type=Path, nargs='?',
                        help='a world that was drawn, imported or made by angen world home, which '
                        'is saved; a new one; or a plan that angen import reads (home.world in '
                        'this folder, or home2.world, …)')
    parser.add_argument('-o', '--output', metavar='FILE', type=Path,
                        help='the world that is written, if FILE is a plan (NAME.world beside it)')
    parser.add_argument('--scale', metavar='M', type=checked(pixel),
                        help='width of a pixel of a picture, in m')
    parser.add_argument('--doors', action='store_true',
                        help='gaps of 0.7 to 1.1 m in the walls of a picture or map are doors')
    parser.add_argument('--sensors', choices=SENSORS, default='seed',
                        help='as of angen import, for a plan (seed)')
    parser.set_defaults(things=None, meshes=False)
    add_address(parser, 8081)
