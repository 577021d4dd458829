"""OpenSHS: a CSV file with a line a second: each device, the activity, the time."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from angen_apps.data.formats.periods import binary, periods, seconds
from angen_apps.data.run import Data
from angen_apps.residents.activities import activities
from angen_apps.residents.profiles import DAY
from angen_tools.common.files import writing

CLOCK = [f'{s // 3600:02d}:{s // 60 % 60:02d}:{s % 60:02d}' for s in range(int(DAY))]


def write(folder: Path, data: Data) -> list[Path]:
    """openshs_NAME.csv for each resident: OpenSHS knows one, whose activity the lines have."""
    able = [s for s in data.sensors if s.kind in ('door', 'item', 'power', 'motion', 'area')]
    spans = [binary(data, sensor.id) for sensor in able]
    paths = []
    for name, _ in data.residents:
        own = [period for period in periods(data) if period.resident == name]
        paths.append(folder / f'openshs_{name}.csv')
        with writing(paths[-1]) as file:
            file.write(','.join([*(f'{s.room}_{s.id}' for s in able), 'Activity', 'timestamp'])
                       + '\n')
            for day in range(data.days):
                cells = np.array([seconds(line, day) for line in spans], np.uint8).T
                labels = np.full(int(DAY), 'other', object)
                for period in own:
                    first, last = period.start - day * DAY, period.end - day * DAY
                    if last > 0 and first < DAY:
                        labels[max(int(first), 0):max(int(last), 0)] = \
                            activities()[period.activity].openshs
                file.write(_lines(cells, labels, f'{data.at(day * DAY):%Y-%m-%d}'))
    return paths


def _lines(cells: np.ndarray, labels: np.ndarray, date: str) -> str:
    changes = (cells[1:] != cells[:-1]).any(axis=1) | (labels[1:] != labels[:-1])
    edges = [0, *(np.flatnonzero(changes) + 1).tolist(), len(cells)]
    parts = []
    for a, b in zip(edges, edges[1:]):
        head = ','.join(map(str, cells[a].tolist())) + f',{labels[a]},{date} '
        parts += [f'{head}{clock}\n' for clock in CLOCK[a:b]]
    return ''.join(parts)
