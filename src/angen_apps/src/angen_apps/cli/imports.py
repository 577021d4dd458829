"""angen import on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.arguments import checked
from angen_tools.cli.parser import add_file, add_json, command
from angen_tools.common.files import check_output
from angen_tools.common.output import show_done
from angen_tools.common.verbs import comma_hint

SENSORS = ('seed', 'casas', 'none')


def pixel(text: str) -> float:
    """The width of a pixel: 0.0005 to 1 m."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0005 <= value <= 1.0:
        raise ValueError(f"'{text}' is not a valid width of a pixel; give 0.0005 to 1 m"
                         + comma_hint(text))
    return value


def run_import(args: argparse.Namespace) -> int:
    from angen_apps.imports.command import import_home
    check_output(args.output)
    show_done(import_home(args.file, args.output, args), args.json)
    return 0


def add_import(commands: Any) -> None:
    """angen import."""
    parser = command(commands, 'import', run_import,
                     'writes a world from a floor plan; needs no simulator',
                     'import home.sh3d -o home.world',
                     'import plan.png --scale 0.05 --doors -o home.world')
    parser.add_argument('file', metavar='FILE', type=Path,
                        help='a home of Sweet Home 3D (.sh3d, or its Home.xml), a building of '
                        'Open-RMF (building.yaml), a picture, or a map of map_server (map.yaml)')
    parser.add_argument('--scale', metavar='M', type=checked(pixel),
                        help='width of a pixel of a picture, in m')
    parser.add_argument('--doors', action='store_true', help='gaps of 0.7 to 1.1 m in the walls '
                        'of a picture or map are doors')
    parser.add_argument('--sensors', choices=SENSORS, default='seed', help='seed: two PIRs and a '
                        'luminosity sensor a room, a reed contact a door and window, contacts in '
                        'seats; casas: a PIR on each ceiling, as in the CASAS apartments, and reed '
                        'contacts (seed)')
    parser.add_argument('--things', metavar='FILE', type=Path,
                        help='a table of furniture that precedes the built-in one')
    parser.add_argument('--meshes', action='store_true', help='furniture of a .sh3d file looks '
                        'like its OBJ meshes; boxes stay for contacts and rays')
    add_file(parser)
    add_json(parser)
