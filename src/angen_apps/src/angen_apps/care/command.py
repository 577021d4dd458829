"""angen care: warns about situations in a home, by rules over its sensors."""
from __future__ import annotations

import sys
from contextlib import suppress
from pathlib import Path
from typing import Sequence

from angen_tools.offline.day import read_day
from angen_apps.care.report import as_dict, line_of, table_of, warnings_of, write, write_events
from angen_apps.care.rules_file import read_rules
from angen_apps.shipped import shipped
from angen_tools.common.output import as_json, show


def care_live(path: Path | None, out: Path) -> int:
    """Follows the running simulator until Ctrl-C, and writes what happened then."""
    from angen_apps.care.live import Live
    rules = read_rules(path or shipped('care.yaml'))
    live = Live(rules, lambda change, starts: print(line_of(change, starts), flush=True))
    for why in live.left_out:
        print(f'angen: {why}', file=sys.stderr)
    print(f'angen: {len(rules.rules) - len(live.left_out)} rules of {rules.path}; warnings are on '
          '/angen/warnings; Ctrl-C ends', file=sys.stderr)
    with suppress(KeyboardInterrupt):
        while True:
            live.follow()
    write(live.engine, out)
    print(f'\nangen: wrote {out}/warnings.csv and care.png', file=sys.stderr)
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
