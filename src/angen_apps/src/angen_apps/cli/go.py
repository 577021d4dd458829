"""angen go on the command line."""
import argparse
from typing import Any

from angen_tools.cli.parser import add_json, command


def run_go(args: argparse.Namespace) -> int:
    from angen_apps.go.command import go
    return go(args.goal, args.robot, args.json)


def add_go(commands: Any) -> None:
    """angen go."""
    parser = command(commands, 'go', run_go, 'drives a robot of the running simulator to a room, '
                     'through doors and by the elevator', 'go kitchen1', 'go 5.6 2.6',
                     'go 8.6 6.6 1 --robot turtlebot')
    parser.usage = '%(prog)s [-h] [--robot NAME] [--json] (ROOM | X Y [FLOOR])'
    parser.add_argument('goal', metavar='ROOM|X Y [FLOOR]', nargs='+',
                        help='a room, or a place in the world in m and its floor (0)')
    parser.add_argument('--robot', metavar='NAME', default='',
                        help='which robot, as angen list --kind drive shows it (the first)')
    add_json(parser)
