"""OpenSHS: a CSV file with a line a second: each device, the activity, the time."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from angen_apps.data.formats.periods import Period, binary, label, periods, runs, seconds
from angen_apps.data.run import Data
from angen_apps.residents.activities import activities
from angen_tools.common.clock import DAY, show_time
from angen_tools.common.files import writing

CLOCK = [show_time(second) for second in range(int(DAY))]


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
                label(labels, own, day, _name)
                file.write(_lines(cells, labels, f'{data.at(day * DAY):%Y-%m-%d}'))
    return paths


def _name(period: Period) -> str:
    return activities()[period.activity].openshs


def _lines(cells: np.ndarray, labels: np.ndarray, date: str) -> str:
    changes = (cells[1:] != cells[:-1]).any(axis=1) | (labels[1:] != labels[:-1])
    parts = []
    for a, b in runs(changes):
        head = ','.join(map(str, cells[a].tolist())) + f',{labels[a]},{date} '
        parts += [f'{head}{clock}\n' for clock in CLOCK[a:b]]
    return ''.join(parts)
