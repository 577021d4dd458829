"""angen run --fast: a world in this process, leaping over time in which nothing happens."""
import csv
import sys
import time
from collections import deque
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Sequence

from angen_tools.common.catalog import simulator
from angen_tools.common.files import later_signals, writing
from angen_tools.common.home import Home
from angen_tools.common.progress import Progress
from angen_tools.offline.day import Order, checked_orders, read_day
from angen_tools.offline.events import COLUMNS, row
from angen_tools.offline.readings import Writer, check_name, reading_table

SLICE = 10.0  # simulated s between two checks for Ctrl-C and two progress reports


@dataclass(frozen=True)
class Done:
    """A run in numbers."""

    simulated_s: float
    wall_s: float
    readings: int
    events: int
    events_file: str
    rows: int = 0  # rows of the table of readings
    readings_file: str = ''

    def text(self) -> str:
        table = f', {self.rows} rows in {self.readings_file}' if self.readings_file else ''
        return (f'{self.simulated_s:g} s in {self.wall_s:.1f} s, '
                f'{self.simulated_s / self.wall_s:.0f} times real time; {self.readings} readings'
                f'{table}, {self.events} events in {self.events_file}')


def run(path: str, span: float, seed: int, out: Path, day: Path | None = None,
        readings: Path | None = None) -> Done:
    """Runs a world file for `span` simulated seconds; writes OUT/events.csv meanwhile, and all
    readings into the file `readings`, if any. `day` has commands, which are executed at their
    times of day; time 0 is the time of day that the world gives.

    Failure if the world does not load, an order is wrong, or a file cannot be written. Ctrl-C
    keeps the written files, and prints their paths.
    """
    if readings:
        check_name(readings)
    with simulator() as angen:
        world = angen.World(path, seed=seed)
    for line in world.warnings:
        print(f'warning: {line}', file=sys.stderr)
    orders = checked_orders(world, read_day(day, Home.of_world(world).time_of_day) if day else [])
    log = out / 'events.csv'
    began = time.monotonic()
    with ExitStack() as open_now:
        file = open_now.enter_context(writing(log, log=True))
        table = open_now.enter_context(reading_table(readings)) if readings else None
        made = _Run(world, span, file, table)
        try:
            made.run(path, orders)
        except KeyboardInterrupt:
            kept = f'{log}{f" and {readings}" if readings else ""}'
            print(f'angen: stopped at {world.time:g} s; what happened until then is in {kept}',
                  file=sys.stderr)
            raise
    return Done(world.time, time.monotonic() - began, world.readings, made.events, str(log),
                made.rows, str(readings or ''))


class _Run:
    """Runs slice by slice, and writes after each."""

    def __init__(self, world: Any, span: float, file: IO[str], table: Writer | None) -> None:
        self._world, self._span, self._file, self._table = world, span, file, table
        self._writer = csv.writer(file, lineterminator='\n')
        self._writer.writerow(COLUMNS)
        if table:
            world.keep_readings()
        self.events = self.rows = 0

    def run(self, name: str, orders: Sequence[Order]) -> None:
        waiting = deque(order for order in orders if order.time < self._span)
        with Progress(name) as progress:
            while self._world.time < self._span:
                while waiting and waiting[0].time <= self._world.time:
                    waiting.popleft().execute(self._world)
                end = min([self._span, self._world.time + SLICE,
                           *(order.time for order in list(waiting)[:1])])
                if not self._advance(end - self._world.time):
                    break  # less than a tick is left
                progress.update(self._world.time / self._span)

    def _advance(self, seconds: float) -> bool:
        """Whether time has advanced."""
        before = self._world.tick
        try:
            self._world.run(seconds)
            if self._world.tick == before and self._world.time + seconds < self._span:
                self._world.step()  # an order's time is within a tick
        finally:
            with later_signals():
                self._write()
        return bool(self._world.tick > before)

    def _write(self) -> None:
        events = self._world.events()
        self._writer.writerows(row(*event) for event in events)
        self._file.flush()
        self.events += len(events)
        if self._table:
            self.rows += self._table.write(self._world)
