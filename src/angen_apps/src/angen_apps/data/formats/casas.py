"""CASAS: one event a line, with labels at the first and last event of an activity; and the newer
columns, in which each event has its label."""
from __future__ import annotations

from bisect import bisect_left
from dataclasses import replace
from pathlib import Path

from angen_apps.data.formats.periods import Period, periods
from angen_apps.data.run import Data
from angen_apps.residents.activities import activities
from angen_tools.common.files import writing

TYPES = {'motion': 'Control4-Motion', 'area': 'Control4-MotionArea', 'door': 'Control4-Door',
         'item': 'Control4-Item', 'power': 'Control4-Plug', 'mains': 'Control4-Power',
         'bell': 'Control4-Button',
         'temperature': 'Control4-Temperature', 'light': 'Control4-LightSensor'}
ENTER = 'Enter_Home'
ENTERING = 60.0  # s: the longest time in which a resident comes home


def write(folder: Path, data: Data) -> list[Path]:
    """casas.txt, as Aruba: date, time, sensor and value between tabs, then a label."""
    notes = labels(data)
    path = folder / 'casas.txt'
    with writing(path) as file:
        for i, event in enumerate(data.events):
            at = data.at(event.time)
            line = f'{at:%Y-%m-%d}\t{at:%H:%M:%S.%f}\t{event.sensor}\t{event.value}'
            file.write(line + (f'\t{notes[i]}' if i in notes else '') + '\n')
    return [path]


def labels(data: Data) -> dict[int, str]:
    """The label of an event, by its index. An activity is labeled if two events that have no label
    yet are in its time, those of its resident first; its begin and end are on these."""
    times = [event.time for event in data.events]
    found: dict[int, str] = {}
    several = len(data.residents) > 1
    numbers = {name: i for i, (name, _) in enumerate(data.residents, 1)}
    for period in _labeled(data):
        inside = range(bisect_left(times, period.start), bisect_left(times, period.end))
        free = [i for i in inside if i not in found and _is_own(data, i, period)] \
            or [i for i in inside if i not in found and not data.events[i].resident]
        if len(free) < 2:
            continue
        name = ENTER if period.activity == ENTER else activities()[period.activity].casas
        label = f'R{numbers[period.resident]}_{name}' if several else name
        found[free[0]], found[free[-1]] = f'{label} begin', f'{label} end'
    return found


def _is_own(data: Data, index: int, period: Period) -> bool:
    return data.events[index].resident == period.resident


def _labeled(data: Data) -> list[Period]:
    """The activities, one after the other; of an absence the ways out and in."""
    found = []
    after: dict[str, Period] = {}
    for period in periods(data):
        before = after.get(period.resident)
        after[period.resident] = period
        if period.away:
            continue
        if before is not None and before.away and before.activity == 'leave':
            enters = min(period.start + ENTERING, period.end)
            found.append(Period(period.start, enters, period.resident, ENTER))
            period = replace(period, start=enters)
        if period.end > period.start:
            found.append(period)
    return found


def write_columns(folder: Path, data: Data) -> list[Path]:
    """casas_columns.tsv: Date Time Sensor Translate01 Translate02 Message SensorType Activity, and
    the resident."""
    path = folder / 'casas_columns.tsv'
    with writing(path) as file:
        file.write('Date\tTime\tSensor\tTranslate01\tTranslate02\tMessage\tSensorType\tActivity\t'
                   'Resident\n')
        for event in data.events:
            at, sensor = data.at(event.time), data.by_id[event.sensor]
            name = activities()[event.activity].casas if event.activity else ''
            words = (f'{at:%Y-%m-%d}', f'{at:%H:%M:%S.%f}', event.sensor, sensor.room, sensor.name,
                     event.value, TYPES[sensor.kind], name, event.resident)
            file.write('\t'.join(words) + '\n')
    return [path]
