"""angen pid on the command line."""
import argparse
from typing import Any

from angen_tools.cli.parser import add_json, add_out, command
from angen_tools.common.files import check_folder
from angen_tools.common.output import show


def run_pid(args: argparse.Namespace) -> int:
    from angen_tools.offline.pid import answers, draw, list_answers
    check_folder(args.out)
    found = answers(args.kind)
    show(list_answers(found, args.json))
    path = args.out / f'pid_{args.kind}.png'
    draw(path, args.kind, found)
    if not args.json:
        print(f'wrote {path}')
    return 0 if all(one.right for one in found) else 1


def add_pid(commands: Any) -> None:
    """angen pid."""
    parser = command(commands, 'pid', run_pid,
                     'draws the step response of a door or an elevator with P, P + I, PID and its '
                     'own controller; needs no simulator', 'pid door', 'pid elevator --out out')
    parser.add_argument('kind', metavar='KIND', choices=('door', 'elevator'),
                        help='door or elevator')
    add_json(parser)
    add_out(parser, 'the figure')
