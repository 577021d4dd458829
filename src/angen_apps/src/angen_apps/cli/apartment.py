"""angen world home on the command line."""
import argparse
from typing import Any

from angen_apps.cli.imports import SENSORS
from angen_tools.cli.arguments import between, checked
from angen_tools.cli.parser import add_file, add_json, add_seed, command, former
from angen_tools.common.files import check_output
from angen_tools.common.output import show_done


def run_home(args: argparse.Namespace) -> int:
    from angen_apps.plan.tower import building
    from angen_apps.plan.writer import write_world, written
    check_output(args.output)
    counts = write_world(building(args.rooms, args.floors, args.apartments, args.seed),
                         args.output, args.sensors)
    show_done(written(args.output, counts), args.json)
    return 0


def add_home(commands: Any) -> None:
    """angen world home."""
    home = command(commands.choices['world'].kinds, 'home', run_home,
                   'writes a home or building of one of many plans, with furniture and sensors',
                   'world home --rooms 3 --floors 2 --seed 7 -o home.world')
    home.add_argument('--rooms', metavar='N', type=checked(between(1, 5)), default=2,
                      help='1 to 5, besides kitchen, bathroom and hall, in each apartment (2)')
    home.add_argument('--floors', metavar='N', type=checked(between(1, 10)), default=1,
                      help='1 to 10; an elevator serves all of several (1)')
    former(home, '--storeys', '--floors', 'floors', checked(between(1, 10)))
    home.add_argument('--apartments', metavar='N', type=checked(between(1, 6)), default=1,
                      help='1 to 6 on each floor; a corridor joins several (1)')
    home.add_argument('--sensors', choices=SENSORS, default='seed',
                      help='as of angen import (seed)')
    add_seed(home, 'of the plan and of its contents')
    add_json(home)
    add_file(home)
