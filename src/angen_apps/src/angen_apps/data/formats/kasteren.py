"""Kasteren: pairs of begin and end, with the number of a sensor or an activity."""
from __future__ import annotations

import datetime
from pathlib import Path

from angen_apps.data.formats.periods import binary, periods
from angen_apps.data.run import Data
from angen_apps.residents.activities import activities
from angen_tools.common.files import write_text, writing

MONTHS = ('Jan', 'Feb', 'Mar', 'Apr', 'May', 'Jun', 'Jul', 'Aug', 'Sep', 'Oct', 'Nov', 'Dec')


def write(folder: Path, data: Data) -> list[Path]:
    """kasteren/sensors.txt, activities_NAME.txt for each resident, and sensor_names.txt."""
    able = [s for s in data.sensors if s.kind in ('door', 'item', 'power', 'motion', 'area')]
    paths = [folder / 'kasteren/sensors.txt', folder / 'kasteren/sensor_names.txt']
    write_text(paths[1], ''.join(f'{i}\t{s.id}\t{s.room}\t{s.name}\n'
                                 for i, s in enumerate(able, 1)))
    rows = sorted((start, end, i) for i, sensor in enumerate(able, 1)
                  for start, end in binary(data, sensor.id))
    _write(paths[0], data, [(start, end, f'{i}\t1') for start, end, i in rows])
    for name, _ in data.residents:
        own = []
        for period in periods(data):
            activity = activities()[period.activity]
            number = activity.number(activity.kasteren, period.start / 3600 % 24)
            if period.resident == name and number:
                own.append((period.start, period.end, str(number)))
        paths.append(folder / f'kasteren/activities_{name}.txt')
        _write(paths[-1], data, own)
    return paths


def _write(path: Path, data: Data, rows: list[tuple[float, float, str]]) -> None:
    with writing(path) as file:
        for start, end, rest in rows:
            file.write(f'{_clock(data.at(start))}\t{_clock(data.at(end))}\t{rest}\n')


def _clock(at: datetime.datetime) -> str:
    return f'{at:%d}-{MONTHS[at.month - 1]}-{at:%Y %H:%M:%S}'
