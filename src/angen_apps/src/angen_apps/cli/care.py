"""angen care on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_tools.common.clock import DAY
from angen_apps.cli.data import residents
from angen_tools.cli.arguments import checked, duration
from angen_tools.cli.parser import (add_allow_paths, add_json, add_out, add_seed, add_world_file,
                                    command)
from angen_tools.common.files import check_folder


def run_care(args: argparse.Namespace) -> int:
    from angen_apps.care.command import care_live, care_offline
    if args.world is not None and args.world.suffix in ('.yaml', '.yml'):
        args.parser.error(f'{args.world} is a file of rules; give it by --rules')
    check_folder(args.out)
    if args.world is None:
        for option, given in (('for', args.span), ('day', args.day), ('json', args.json),
                              ('residents', args.residents)):
            if given:
                args.parser.error(f'--{option} needs WORLD')
        return care_live(args.rules, args.out)
    return care_offline(args.rules, args.world, args.span or DAY, args.day,
                        args.residents, args.seed, args.out, args.json)


def add_care(commands: Any) -> None:
    """angen care."""
    care = command(commands, 'care', run_care,
                   'warns by rules over the sensors of a home, in the running simulator; with '
                   'WORLD it simulates a time of its own, without ROS', 'care',
                   'care --rules my_rules.yaml --out my_run',
                   'care home.world --residents 1 --for 24h',
                   'care worlds/care/wrong.world --day worlds/care/wrong.csv --for 24h')
    care.set_defaults(parser=care)
    add_world_file(care, 'simulates this world as fast as possible')
    care.add_argument('--rules', metavar='FILE', type=Path,
                      help='a YAML file of rules, as docs/care.md describes it (config/care.yaml '
                      'of angen_apps)')
    care.add_argument('--for', metavar='TIME', dest='span', type=checked(duration),
                      help='how much time to simulate, as 90min (24h)')
    care.add_argument('--day', metavar='FILE', type=Path,
                      help='commands to devices: a CSV file with time,target,command')
    care.add_argument('--residents', metavar='WHO', type=checked(residents), default=(),
                      help='people who live there: a number, or profiles between commas, as of '
                      'angen generate (none)')
    add_seed(care, 'of all noise and habits')
    add_allow_paths(care)
    add_json(care)
    add_out(care, 'care.png, warnings.csv and, with WORLD, events.csv')
