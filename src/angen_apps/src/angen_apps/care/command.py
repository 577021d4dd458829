"""angen care: warns about situations in a home, by rules over its sensors."""
import sys
from contextlib import suppress
from pathlib import Path
from typing import Sequence

from angen_tools.offline.day import read_day
from angen_apps.care.engine import Engine
from angen_apps.care.report import as_dict, line_of, table_of, warnings_of, write, write_events
from angen_apps.care.rules_file import read_rules
from angen_apps.shipped import shipped
from angen_tools.common.failure import Failure
from angen_tools.common.files import make_folder
from angen_tools.common.output import as_json, show


def care_live(path: Path | None, out: Path) -> int:
    """Follows the running simulator until Ctrl-C, and writes what happened then."""
    from angen_apps.care.live import Watch
    from angen_tools.live.spawn import save
    rules = read_rules(path or shipped('care.yaml'))
    live = Watch(rules, lambda change, starts: print(line_of(change, starts), flush=True))
    for why in live.rules.left_out:
        print(f'angen: {why}', file=sys.stderr)
    print(f'angen: {len(live.rules.rules)} rules of {rules.path}; warnings are on /angen/warnings; '
          'Ctrl-C ends', file=sys.stderr)
    copy = out / 'care.world'
    make_folder(out)
    save(copy)  # when the simulator has ended it is too late
    with suppress(KeyboardInterrupt):
        while True:
            live.watch()
    write(live.engine, out)
    print(f'\nangen: wrote {out}/warnings.csv', file=sys.stderr)
    _draw(live.engine, copy, out / 'care.png')
    return 0


def care_offline(path: Path | None, world: Path, seconds: float, day: Path | None,
                 residents: Sequence[str], seed: int, out: Path, json: bool) -> int:
    """Simulates a world for a time; prints its warnings and writes its events."""
    import time

    from angen_apps.care.offline import Watched
    rules = read_rules(path or shipped('care.yaml'))
    began = time.monotonic()
    watched = Watched(rules, world, seed, residents)
    for why in watched.rules.left_out:
        print(f'angen: {why}', file=sys.stderr)
    starts = watched.engine.starts
    orders = read_day(day, starts) if day else []
    watched.run(seconds, orders)
    wall = time.monotonic() - began
    write(watched.engine, out)
    write_events(watched.events, watched.changes, out)
    _draw(watched.engine, world, out / 'care.png')
    warnings = warnings_of(watched.engine)
    if json:
        print(as_json([as_dict(warning) for warning in warnings]))
        return 0
    if warnings:
        show(table_of(warnings, starts))
    print(f'{len(warnings)} warnings of {len(watched.rules.rules)} rules, '
          f'{len(watched.events)} events in {watched.time:g} s, simulated in {wall:.1f} s; see '
          f'{out}/care.png, warnings.csv, events.csv')
    return 0


def _draw(engine: Engine, world: Path, path: Path) -> None:
    """Draws the warnings on the plan of a world, or says why there is no plan."""
    from angen_apps.care.figure import draw
    from angen_apps.plan.draw import Scene, read_scene
    scene: Scene | None = None
    try:
        scene = read_scene(world)
    except Failure as why:
        print(f'angen: no plan in {path}: {why}', file=sys.stderr)
    draw(engine, scene, path)
