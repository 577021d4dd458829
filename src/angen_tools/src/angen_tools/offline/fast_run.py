"""angen run --fast: a world in this process, leaping over time in which nothing happens."""
from __future__ import annotations

import csv
import time
from pathlib import Path
from typing import Any, Callable

from angen_tools.common.catalog import simulator
from angen_tools.common.files import writing
from angen_tools.common.progress import Progress

SLICE = 10.0  # simulated s between two checks for Ctrl-C and two progress reports
COLUMNS = ('time', 'source', 'kind', 'event', 'detail')


def run(path: str, seconds: float, seed: int, out: Path) -> str:
    """Runs a world file for so many simulated seconds and writes OUT/events.csv as it goes.

    Columns are `time` (s of simulated time), source, kind, event and detail, as in
    angen_msgs/Event. Returns what was done; Failure where the world does not load, or the file
    cannot be written.
    """
    with simulator() as angen:
        world = angen.World(path, seed=seed)
    log = out / 'events.csv'
    with writing(log, log=True) as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(COLUMNS)
        began = time.monotonic()
        count = _run(world, seconds, path, writer, file.flush)
        wall = time.monotonic() - began
    return (f'{world.time:g} s in {wall:.1f} s, {world.time / wall:.0f} times real time; '
            f'{world.readings} readings, {count} events in {log}')


def _run(world: Any, seconds: float, name: str, writer: Any, flush: Callable[[], None]) -> int:
    """Runs slice by slice; returns how many events it has written."""
    count = 0
    slices, rest = divmod(seconds, SLICE)
    with Progress(name) as progress:
        for number in range(int(slices) + 1):
            world.run(SLICE if number < slices else rest)
            events = world.events()
            writer.writerows((f'{at:.6f}', *what) for at, *what in events)
            flush()
            count += len(events)
            progress.update(world.time / seconds)
    return count
