"""angen plan on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.parser import add_allow_paths, add_file, add_json, add_world_file, command
from angen_tools.common.files import check_output
from angen_tools.common.output import show_done


def run_plan(args: argparse.Namespace) -> int:
    from angen_apps.automation.card import write
    from angen_apps.plan.draw import Axes, draw
    from angen_apps.plan.overlays import What
    check_output(args.output)
    if args.card:
        check_output(args.card, '.yaml')

    def placed(axes: Axes) -> None:
        if args.card:
            write(args.card, args.world, axes, args.output.name)

    show_done(draw(args.world, args.output, What(args.sensors, args.events, args.track), placed),
              args.json)
    return 0


def add_plan(commands: Any) -> None:
    """angen plan."""
    parser = command(commands, 'plan', run_plan,
                     'draws the floor plan of a world to scale; needs no simulator',
                     'plan home.world -o plan.svg', 'plan home.world --sensors -o plan.png',
                     'plan worlds/angen.world --events out/events.csv -o plan.png',
                     'plan worlds/angen.world --card card.yaml -o plan.png',
                     'plan worlds/angen.world --track out/track.csv -o plan.png')
    add_world_file(parser, 'the SDF file of the building', required=True)
    parser.add_argument('--sensors', action='store_true',
                        help='with sensors, their names and fields of view')
    parser.add_argument('--events', metavar='FILE', type=Path, help='with how often each sensor '
                        'and device fired: events.csv of angen run --fast, care or demo, or a CSV '
                        'file with the column source')
    parser.add_argument('--track', metavar='FILE', type=Path, help='with ways: track.csv of '
                        'angen demo or task seek, track.csv.gz of angen generate, or a CSV file '
                        'with the columns x, y and, if it has them, z, storey and name')
    parser.add_argument('--card', metavar='FILE', type=Path, help='also writes a picture-elements '
                        'card of Home Assistant, a YAML file with the entities of angen mqtt')
    add_file(parser, 'a file .svg or .png')
    add_allow_paths(parser)
    add_json(parser)
