"""Activities and states as periods of time, from which the formats are written."""
from __future__ import annotations

import gzip
import io
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import IO, Any, Callable, Iterator, cast

import numpy as np

from angen_apps.data.recorder import ACTIVE
from angen_apps.data.run import Data
from angen_tools.common.clock import DAY
from angen_tools.common.files import writing

LEVEL = 4  # gzip's level


@dataclass(frozen=True)
class Period:
    """A resident does one thing from `start` to `end`, on the way there included."""

    start: float
    end: float
    resident: str
    activity: str
    away: bool = False


def periods(data: Data) -> list[Period]:
    """The activities of residents one after the other, with their durations; those that were not
    done, as the way to them was given up, are left out."""
    found: list[Period] = []
    for resident, _ in data.residents:
        own: list[Period] = []
        done: set[float] = set()  # begins of those that were done
        for interval in data.intervals(resident):
            away = interval.phase == 'away'
            if own and own[-1].activity == interval.activity and own[-1].away == away \
                    and interval.start - own[-1].end < 1e-6:
                own[-1] = replace(own[-1], end=interval.end)
            else:
                own.append(Period(interval.start, interval.end, resident, interval.activity, away))
            if interval.phase in ('does', 'away'):
                done.add(own[-1].start)
        found += [period for period in own if period.start in done]
    return sorted(found, key=lambda p: (p.start, p.resident))


def binary(data: Data, sensor: str) -> list[tuple[float, float]]:
    """When a sensor is on: from, to."""
    found, since = [], None
    for event in data.events:
        if event.sensor != sensor:
            continue
        if event.value in ACTIVE and since is None:
            since = event.time
        elif event.value not in ACTIVE and since is not None:
            found.append((since, event.time))
            since = None
    if since is not None:
        found.append((since, data.days * DAY))
    return found


def seconds(spans: list[tuple[float, float]], day: int) -> np.ndarray:
    """In which seconds of a day one of the spans holds, also for a part: (86400,) of 0 and 1."""
    found = np.zeros(int(DAY), np.uint8)
    for start, end in spans:
        first, last = start - day * DAY, end - day * DAY
        if last >= 0 and first < DAY:
            found[max(int(first), 0):min(int(np.ceil(last)), int(DAY))] = 1
    return found


def label(cells: np.ndarray, of: list[Period], day: int, named: Callable[[Period], Any]) -> None:
    """Writes the name of each period into its seconds of a day (86400,)."""
    for period in of:
        first, last = period.start - day * DAY, period.end - day * DAY
        if last > 0 and first < DAY:
            cells[max(int(first), 0):max(int(last), 0)] = named(period)


def runs(changes: np.ndarray) -> Iterator[tuple[int, int]]:
    """Begins and ends of runs of equal lines, by whether each differs from the one before."""
    return pairwise([0, *(np.flatnonzero(changes) + 1).tolist(), len(changes) + 1])


@contextmanager
def zipped(path: Path) -> Iterator[IO[str]]:
    """A text file that is compressed to the same bytes at any time."""
    with writing(path, binary=True) as file:
        with gzip.GzipFile('', 'wb', LEVEL, file, mtime=0) as packed:
            text = io.TextIOWrapper(cast(IO[bytes], packed), 'utf-8', newline='')
            yield text
            text.flush()
            text.detach()
