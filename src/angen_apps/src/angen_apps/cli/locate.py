"""angen locate on the command line."""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.arguments import checked, duration
from angen_tools.cli.parser import add_allow_paths, add_json, add_out, add_seed, command
from angen_tools.common.files import check_folder
from angen_tools.common.output import show


def run_locate(args: argparse.Namespace) -> int:
    if args.world is not None or args.span is not None:
        check_folder(args.out)
    if args.world is not None:
        if args.span is None:
            args.parser.error('--world needs --for TIME')
        from angen_apps.locate.offline import run
        rows, answers = run(str(args.world), args.span or 0.0, args.seed)
    elif args.span is not None:
        from angen_apps.locate.live import locate_for
        from angen_tools.common.progress import Progress
        with Progress('locate') as progress:
            rows, answers = locate_for(
                args.span, lambda done: progress.update(done / args.span))
    elif args.json:
        args.parser.error('--json needs --for TIME')
    else:
        from angen_apps.locate.live import watch
        watch()
        return 0
    _print(args, rows, answers)
    return 0


def _print(args: argparse.Namespace, rows: Any, answers: Any) -> None:
    from angen_apps.locate import figure, score
    from angen_apps.locate.live import answers_table
    from angen_apps.plan.draw import read_running, read_scene
    from angen_tools.common.output import table
    show(answers_table(answers, args.json))
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
                     'locate', 'locate --for 60', 'locate --world worlds/angen.world --for 300')
    locate.set_defaults(parser=locate)
    locate.add_argument('--for', metavar='TIME', dest='span', type=checked(duration),
                        help='for that many simulated seconds, then compares with the truth; '
                        'otherwise shows a live table')
    locate.add_argument('--world', metavar='FILE', type=Path,
                        help='in a world of its own, without a running simulator')
    add_seed(locate, 'of all noise, with --world', 0)
    add_allow_paths(locate)
    add_json(locate)
    add_out(locate, 'locate.csv and locate.png')
