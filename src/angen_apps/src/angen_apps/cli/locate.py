"""angen locate on the command line."""
from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from angen_tools.cli.arguments import checked, duration
from angen_tools.cli.parser import (add_allow_paths, add_json, add_out, add_seed, add_world_file,
                                    command)
from angen_tools.common.files import check_folder
from angen_tools.common.output import show

if TYPE_CHECKING:
    from angen_apps.locate.belief import Answer
    from angen_apps.locate.score import Row
    from angen_tools.session import World


def run_locate(args: argparse.Namespace) -> int:
    from angen_apps.locate.locator import locate, watch
    from angen_tools.common.failure import Failure
    from angen_tools.common.progress import Progress
    from angen_tools.session.in_process import InProcess
    from angen_tools.session.live import Live
    if args.span is not None:
        check_folder(args.out)
    elif args.world is not None:
        args.parser.error('WORLD needs --for TIME')
    elif args.json:
        args.parser.error('--json needs --for TIME')
    elif not sys.stdin.isatty() or not sys.stdout.isatty():
        raise Failure('a live table needs a terminal; use --for TIME for one table')
    world: World = InProcess.load(str(args.world), args.seed) if args.world else Live(pauses=False)
    if args.span is None:
        watch(world)
        return 0
    with Progress('locate') as progress:
        _print(args, *locate(world, args.span, progress.update))
    return 0


def _print(args: argparse.Namespace, rows: list[Row], answers: list[Answer]) -> None:
    from angen_apps.locate import figure, score
    from angen_apps.plan.draw import read_running, read_scene
    from angen_tools.common.output import table
    show(score.answers_table(answers, args.json))
    if args.json or not rows:
        return
    score.write_csv(args.out / 'locate.csv', rows)
    scene = (read_scene(args.world) if args.world is not None
             else read_running(args.out / 'locate.world'))
    figure.draw(args.out / 'locate.png', rows, scene)
    show('')
    show(table(score.HEAD, score.table_rows(rows), right=score.HEAD[1:]))
    show(f'see {args.out}/locate.csv, locate.png')


def add_locate(commands: Any) -> None:
    """angen locate."""
    locate = command(commands, 'locate', run_locate,
                     'locates tagged people in rooms, by RFID, PIRs, doors and mats',
                     'locate', 'locate --for 60', 'locate worlds/angen.world --for 300')
    locate.set_defaults(parser=locate)
    locate.add_argument('--for', metavar='TIME', dest='span', type=checked(duration),
                        help='for that many simulated seconds, then compares with the truth; '
                        'otherwise shows a live table')
    add_world_file(locate, 'simulates this world, without a running simulator')
    add_seed(locate, 'of all noise, with WORLD', 0)
    add_allow_paths(locate)
    add_json(locate)
    add_out(locate, 'locate.csv and locate.png')
