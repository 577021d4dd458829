"""angen map on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.arguments import at_least, checked
from angen_tools.cli.parser import add_allow_paths, add_file, add_json, add_world_file, command
from angen_tools.common.files import check_output
from angen_tools.common.output import show_done


def run_map(args: argparse.Namespace) -> int:
    from angen_apps.maps.files import save_map
    for ending in ('.pgm', '.yaml'):
        check_output(args.output.with_name(args.output.name + ending))
    show_done(save_map(args.world, args.floor, args.doors, args.output), args.json)
    return 0


def add_map(commands: Any) -> None:
    """angen map."""
    parser = command(commands, 'map', run_map,
                     "writes a floor's map for map_server; needs no simulator",
                     'map --floor 0 -o map', 'map my.world --floor 1 --doors open -o upper')
    parser.add_argument('--floor', metavar='N', type=checked(at_least(0)), default=0,
                        help='which floor, counted from 0 (0)')
    add_world_file(parser, 'the SDF file of the building (worlds/angen.world)')
    parser.add_argument('--doors', choices=['away', 'open', 'shut'], default='away',
                        help='away: doorways are free; otherwise as the leaves are (away)')
    add_file(parser, 'writes NAME.pgm and NAME.yaml (map)', 'NAME', Path('map'))
    add_allow_paths(parser)
    add_json(parser)
