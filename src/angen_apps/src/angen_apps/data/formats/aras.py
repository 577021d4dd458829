"""ARAS: a file a day, a line a second: 20 binary sensors and the activities of two residents."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from angen_apps.data.formats.periods import Period, binary, label, periods, runs, seconds
from angen_apps.data.run import Data
from angen_apps.data.site import Sensor
from angen_apps.residents.activities import activities
from angen_tools.common.clock import DAY
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text, writing

COLUMNS, RESIDENTS, OTHER = 20, 2, 1
FIRST = ('door', 'item', 'power', 'area', 'motion')  # kinds, those that ARAS has first


def write(folder: Path, data: Data) -> list[Path]:
    """aras/DAY_n.txt and aras/columns.txt."""
    if len(data.residents) > RESIDENTS:
        raise Failure(f'aras has {RESIDENTS} residents, the home has {len(data.residents)}; '
                      'leave aras out of --format')
    chosen = columns(data)
    spans = [binary(data, sensor.id) for sensor in chosen]
    every = periods(data)
    paths = [folder / 'aras/columns.txt']
    write_text(paths[0], ''.join(f'{i}\t{s.id}\t{s.kind}\t{s.room}\t{s.name}\n'
                                 for i, s in enumerate(chosen, 1)))
    for day in range(data.days):
        cells = np.zeros((int(DAY), COLUMNS + RESIDENTS), np.uint8)
        for i, line in enumerate(spans):
            cells[:, i] = seconds(line, day)
        cells[:, COLUMNS:] = OTHER
        for number, (name, _) in enumerate(data.residents):
            own = [period for period in every if period.resident == name]
            label(cells[:, COLUMNS + number], own, day, _number)
        paths.append(folder / f'aras/DAY_{day + 1}.txt')
        with writing(paths[-1]) as file:
            file.write(_lines(cells))
    return paths


def columns(data: Data) -> list[Sensor]:
    """The sensors of the 20 columns."""
    able = [s for s in data.sensors if s.kind in FIRST]
    return sorted(able, key=lambda s: (FIRST.index(s.kind), s.id))[:COLUMNS]


def _number(period: Period) -> int:
    activity = activities()[period.activity]
    return activity.number(activity.aras, period.start / 3600 % 24)


def _lines(cells: np.ndarray) -> str:
    """A line for each second; a run of equal lines is formatted once."""
    return ''.join((' '.join(map(str, cells[a].tolist())) + '\n') * (b - a)
                   for a, b in runs((cells[1:] != cells[:-1]).any(axis=1)))
