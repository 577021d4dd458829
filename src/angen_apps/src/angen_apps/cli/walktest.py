"""angen walktest on the command line."""
import argparse
from typing import Any

from angen_tools.cli.arguments import checked, degrees, setting
from angen_tools.cli.parser import add_json, add_out, command
from angen_tools.common.files import check_folder

PROFILES = ('nema-wd7', 'iec63180', 'en50131-g2')
MODELS = ('pyroelectric', 'range_difference')


def run_walktest(args: argparse.Namespace) -> int:
    from angen_apps.walktest.command import detector, run
    check_folder(args.out)
    tested = detector(args.model, args.set, args.turn)
    return 0 if run(args.profile, tested, args.out, args.json) else 1


def add_walktest(commands: Any) -> None:
    """angen walktest."""
    test = command(commands, 'walktest', run_walktest,
                   'runs the walk test of a standard on a PIR; needs no simulator',
                   'walktest --profile nema-wd7',
                   'walktest --profile iec63180 --model range_difference --out out')
    test.add_argument('--profile', choices=PROFILES, required=True, help='the standard')
    test.add_argument('--model', choices=MODELS, default='pyroelectric',
                      help='of the PIR (pyroelectric)')
    test.add_argument('--set', metavar='KEY=VALUE', action='append', default=[],
                      type=checked(setting), help='a parameter, as angen plugins lists them')
    test.add_argument('--turn', metavar='DEG', type=checked(degrees), default=0.0,
                      help='turns it to the left; 180: to the wall (0)')
    add_json(test)
    add_out(test, 'the CSV file and the figure')
