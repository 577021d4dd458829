"""angen edit: opens a home, and serves the page that draws it."""
import argparse
import sys
from pathlib import Path
from typing import Any

from angen_apps.edit.catalog import catalog
from angen_apps.edit.desk import Desk, in_use
from angen_apps.edit.habits import days, durations
from angen_apps.edit.server import Editor
from angen_apps.edit.simulation import Simulation
from angen_apps.edit.worker import Worker
from angen_apps.imports.command import SHOWN, read_plan
from angen_apps.imports.picture import UPRIGHT
from angen_apps.plan.drawing import drawing_of, to_json
from angen_apps.residents.profiles import names
from angen_apps.web.command import page, serve, symbols
from angen_tools.common.failure import Failure
from angen_tools.common.files import check_output
from angen_tools.common.port import require_free

WORLDS = ('.world', '.sdf')
SEEN = ('.png', '.jpg', '.jpeg')  # pictures that browsers show
BEGINS = '2026-03-23T07:00:00'  # local time; empty() of page/js/drawing.js has the same


def edit(args: argparse.Namespace) -> None:
    """Serves until Ctrl-C."""
    path, plan = _files(args)
    check_output(path)
    require_free(args.host, args.port)
    with in_use(path):
        worker = Worker()  # before there are threads
        try:
            drawing, remarks = worker.run(plan, _imported, plan, args) if plan else (None, [])
            for remark in remarks:
                print(f'remark: {remark}', file=sys.stderr)
            desk = Desk(path, worker, drawing)
            behind = plan if plan and plan.suffix.lower() in SEEN and not any(
                remark.endswith(UPRIGHT) for remark in remarks) else None
            given = {'behind': args.scale if behind else None,
                     'catalog': worker.run('the catalog', catalog), 'symbols': symbols(),
                     'profiles': names(), 'days': days(), 'durations': durations()}
            simulation = Simulation(args.host)
            serve('edit', lambda guard: Editor(desk, simulation, given, guard, page(), behind),
                  args.host, args.port, args.json)
        finally:
            worker.end()


def _files(args: argparse.Namespace) -> tuple[Path, Path | None]:
    """The world that is written, and the plan that is read."""
    if args.file is None:
        return args.output or _free(Path('home.world')), None
    if args.file.suffix.lower() in WORLDS:
        if args.output is not None:
            raise Failure('-o is for a plan that is imported; a world is saved where it is')
        return args.file, None
    if not args.file.exists():
        raise Failure(f'{args.file}: there is no such plan; the name of a new home ends in .world')
    path = args.output or args.file.with_name(args.file.name.partition('.')[0] + '.world')
    if path.exists():
        raise Failure(f'{path}: exists; edit it, or give -o FILE')
    return path, args.file


def _free(path: Path) -> Path:
    """The path, or the next one like it without a file."""
    number = 2
    tried = path
    while tried.exists():
        tried = path.with_stem(f'{path.stem}{number}')
        number += 1
    return tried


def _imported(file: Path, args: argparse.Namespace) -> tuple[dict[str, Any], list[str]]:
    plan = read_plan(file, args)
    plan.start = BEGINS
    return to_json(drawing_of(plan, args.sensors)), plan.remarks[:SHOWN]
