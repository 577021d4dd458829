"""angen task on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.arguments import at_least, checked, duration, rate
from angen_tools.cli.parser import add_json, add_out, add_seed, add_world_file, command
from angen_tools.common.files import check_folder


def run_patrol(args: argparse.Namespace) -> int:
    check_folder(args.out)
    if args.seeds > 1:
        from angen_apps.patrol.seeds import patrols
        words = [str(args.world)] * bool(args.world) + (
            ['--route', str(args.route)] if args.route else [])
        return patrols([*words, '--rate', f'{args.rate:g}'],
                       range(args.seed, args.seed + args.seeds), args.out, args.json)
    from angen_apps.patrol.command import patrol
    return patrol(args.route, args.world, args.seed, args.rate, args.out, args.json)


def add_task(commands: Any) -> None:
    """angen task patrol, angen task seek."""
    task = command(commands, 'task', run_patrol, 'runs a task of the robot in a node of its own',
                   'task patrol')
    kinds = task.add_subparsers(dest='what', metavar='WHAT', required=True)
    patrol = command(kinds, 'patrol', run_patrol, 'drives the TurtleBot through every room while '
                     'the sensors watch, and writes a table, figures and a rosbag',
                     'task patrol', 'task patrol --seed 7 --rate 1',
                     'task patrol --route my.yaml --out my_run', 'task patrol --seeds 20')
    patrol.add_argument('--route', metavar='FILE', type=Path,
                        help='where to go and how fast (config/patrol.yaml of angen_apps)')
    add_world_file(patrol, 'the building (worlds/angen.world)')
    add_seed(patrol, 'of start, noise and timing')
    patrol.add_argument('--seeds', metavar='N', type=checked(at_least(1)), default=1,
                        help='this many patrols, with this seed and the next ones, each in a '
                        'folder of its own, and a table of them (1)')
    patrol.add_argument('--rate', metavar='R', type=checked(rate), default=0.0,
                        help='simulated seconds per second, with rviz where there is a display; '
                        '0: as fast as possible, without rviz (0)')
    add_json(patrol)
    add_out(patrol, 'all files that it writes')
    add_seek(kinds)


def run_seek(args: argparse.Namespace) -> int:
    from angen_apps.seek.command import seek, seek_seeds
    check_folder(args.out)
    if args.seeds > 1:
        return seek_seeds(args.route, args.world, range(args.seed, args.seed + args.seeds),
                          args.limit, args.out, args.json)
    return seek(args.route, args.world, args.seed, not args.own_sensors, args.limit, args.out,
                args.json)


def add_seek(kinds: Any) -> None:
    """angen task seek."""
    seek = command(kinds, 'seek', run_seek, 'lets the robot look for a person who walks about, by '
                   "the building's sensors and its own, without ROS", 'task seek',
                   'task seek --seed 7 --own-sensors', 'task seek --seeds 20')
    seek.add_argument('--route', metavar='FILE', type=Path, help='robot, speed and elevator as '
                      'for patrol; its waypoints do not matter (config/patrol.yaml of angen_apps)')
    add_world_file(seek, 'the building; its first actor is the person (worlds/angen.world)')
    add_seed(seek, 'of start, noise, and the places and habits of the person')
    seek.add_argument('--seeds', metavar='N', type=checked(at_least(1)), default=1,
                      help='this many searches with, and as many without ambient sensors, on all '
                      'cores: a table and a figure (1)')
    seek.add_argument('--own-sensors', action='store_true',
                      help="only the robot's own sensors, none of the building's")
    seek.add_argument('--limit', metavar='S', type=checked(duration), default=600.0,
                      help='simulated seconds after which it gives up (600)')
    add_json(seek)
    add_out(seek, 'all files that it writes')
