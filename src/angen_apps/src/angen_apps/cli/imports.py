"""angen import on the command line."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.parser import command

SENSORS = ('seed', 'casas', 'none')


def run_import(args: argparse.Namespace) -> int:
    from angen_apps.imports.command import import_home
    print(import_home(args.file, args.output, args))
    return 0


def add_import(commands: Any) -> None:
    """angen import."""
    parser = command(commands, 'import', run_import,
                     'writes a world from a floor plan; needs no simulator',
                     'import home.sh3d -o home.world')
    parser.add_argument('file', metavar='FILE', type=Path,
                        help='a home of Sweet Home 3D (.sh3d, or its Home.xml), or a '
                        'building of Open-RMF (building.yaml)')
    parser.add_argument('--sensors', choices=SENSORS, default='seed', help='seed: two PIRs and a '
                        'luminosity sensor a room, a reed contact a door and window, contacts in '
                        'seats; casas: a PIR of the CASAS flats on each ceiling and reed contacts '
                        '(seed)')
    parser.add_argument('--things', metavar='FILE', type=Path,
                        help='a table of furniture that goes before the built-in one')
    parser.add_argument('-o', '--output', metavar='FILE', type=Path, required=True,
                        help='the world that is written')
