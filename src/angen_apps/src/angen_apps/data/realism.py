"""Compares data with real homes: distributions, and their distances from a reference."""
from __future__ import annotations

import datetime
import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.distance import jensenshannon
from scipy.stats import ks_2samp

from angen_apps.data.site import MAINS
from angen_apps.data.tables import EVENTS, TRUTH, rows
from angen_tools.common.failure import Failure
from angen_tools.common.files import pyplot, save_figure

LINE = re.compile(r'(\d{4}-\d\d-\d\d)\s+(\d\d:\d\d:\d\d(?:\.\d+)?)\s+(\S+)\s+(\S+)(?:\s+(.*))?')
# WSU's AL sample home (30 days, 7 merged sensors) and Aruba (8 months), measured for this project
PUBLISHED = {
    'events a day': (1410.0, 7816.0, 'AL sample home least; Aruba mean'),
    'ON time p5, s': (0.8, 1.4, 'AL sample home 1.10'),
    'ON time p50, s': (1.3, 2.6, 'AL sample home 1.86'),
    'ON time p95, s': (4.0, 11.0, 'AL sample home 6.73'),
    'gap p50, s': (1.5, 10.0, 'AL sample home 3.8'),
    'gap p95, s': (10.0, 60.0, 'AL sample home 21'),
    'gap p99, s': (200.0, 1200.0, 'AL sample home 528'),
    'events an hour at night (1-5 h)': (8.0, 29.0, 'AL sample home 8 to 29'),
    'events in the busiest hour': (279.0, 322.0, 'AL sample home 302, 322, 279 at 8, 12, 18 h'),
}


@dataclass
class Stream:
    """Events of a home: time in s since the first midnight, sensor, value."""

    time: np.ndarray
    sensor: list[str]
    value: list[str]
    labels: list[tuple[float, str, str]]  # time, activity, begin or end

    @property
    def days(self) -> int:
        return max(int(np.ceil(self.time[-1] / 86400.0)), 1) if len(self.time) else 1


def read(path: Path) -> Stream:
    """A home's folder, or a file as CASAS publishes them."""
    if path.is_dir():
        return _own(path)
    times, sensors, values, labels = [], [], [], []
    first = None
    try:
        lines = path.read_text(encoding='utf-8-sig', errors='replace').splitlines()
    except OSError as error:
        raise Failure(f'{path}: cannot be read: {error.strerror}') from None
    for number, line in enumerate(lines, 1):
        found = LINE.match(line.strip())
        if not found:
            if line.strip():
                raise Failure(f'{path}:{number}: is not an event as CASAS writes them: date, time, '
                              'sensor, value')
            continue
        if found[3] == MAINS:  # in few homes
            continue
        at = datetime.datetime.fromisoformat(f'{found[1]} {found[2][:15]}')
        first = first or datetime.datetime.combine(at.date(), datetime.time())
        times.append((at - first).total_seconds())
        sensors.append(found[3])
        values.append(found[4])
        label = (found[5] or '').split()
        if len(label) == 2:
            labels.append((times[-1], label[0], label[1]))
    if not times:
        raise Failure(f'{path}: has no events')
    return Stream(np.array(times), sensors, values, labels)


def _own(folder: Path) -> Stream:
    times, sensors, values = [], [], []
    first = None
    for row in rows(folder / 'events.csv.gz',
                    {key: EVENTS[key] for key in ('time', 'sensor', 'value')}):
        if row['sensor'] == MAINS:
            continue
        at = datetime.datetime.fromisoformat(row['time'])
        first = first or datetime.datetime.combine(at.date(), datetime.time())
        times.append((at - first).total_seconds())
        sensors.append(row['sensor'])
        values.append(row['value'])
    return Stream(np.array(times), sensors, values, _labels(folder / 'truth.csv.gz'))


def _labels(path: Path) -> list[tuple[float, str, str]]:
    """Begin and end of each activity, with the ways between its places, one resident after the
    other: from where it is first done to where it is last done."""
    found: list[tuple[float, str, str]] = []
    doing: dict[str, tuple[str, float, float]] = {}  # activity, begin, end, by resident

    def close(who: str) -> None:
        if who in doing:
            name, begin, end = doing.pop(who)
            found.extend([(begin, name, 'begin'), (end, name, 'end')])
    columns = ('resident', 'activity', 'phase', 'start', 'end')
    for row in rows(path, {key: TRUTH[key] for key in columns}):
        who, name = row['resident'], row['activity']
        if who in doing and doing[who][0] != name:
            close(who)
        if row['phase'] == 'does':
            begin = doing[who][1] if who in doing else float(row['start'])
            doing[who] = (name, begin, float(row['end']))
    for who in sorted(doing):
        close(who)
    return found


def on_times(stream: Stream) -> np.ndarray:
    """The ON times of motion sensors, s."""
    since: dict[str, float] = {}
    found = []
    for time, sensor, value in zip(stream.time.tolist(), stream.sensor, stream.value):
        if value == 'ON' and sensor.startswith('M'):
            since[sensor] = time
        elif value == 'OFF' and sensor in since:
            found.append(time - since.pop(sensor))
    return np.array(found)


def measures(stream: Stream) -> dict[str, float]:
    """The figures that are compared."""
    on, gaps = on_times(stream), np.diff(stream.time)
    hours = by_hour(stream)
    if len(on) == 0 or len(gaps) == 0:
        raise Failure('the data have no events of motion sensors')
    found = {'events a day': len(stream.time) / stream.days}
    for share in (5, 50, 95):
        found[f'ON time p{share}, s'] = float(np.percentile(on, share))
    for share in (50, 95, 99):
        found[f'gap p{share}, s'] = float(np.percentile(gaps, share))
    found['events an hour at night (1-5 h)'] = float(hours[1:5].mean())
    found['events in the busiest hour'] = float(hours.max())
    return found


def by_hour(stream: Stream) -> np.ndarray:
    """Events of a day in each hour (24,)."""
    return np.bincount((stream.time // 3600 % 24).astype(int), minlength=24) / stream.days


def ks(a: np.ndarray, b: np.ndarray) -> float:
    """The Kolmogorov-Smirnov distance of two samples: 0 to 1."""
    return float(ks_2samp(a, b, method='asymp').statistic)


def compare(stream: Stream, reference: Stream | None) -> list[tuple[str, float, str, str]]:
    """Measure, value, reference and verdict; values outside come first."""
    own = measures(stream)
    found = []
    if reference is None:
        for name, value in own.items():
            low, high, source = PUBLISHED[name]
            verdict = 'within' if low <= value <= high else 'below' if value < low else 'above'
            found.append((name, value, f'{low:g} to {high:g} ({source})', verdict))
        return sorted(found, key=lambda row: row[3] == 'within')
    other = measures(reference)
    for name, value in own.items():
        ratio = value / other[name] if other[name] else float('inf')
        found.append((name, value, f'{other[name]:.4g}', f'{ratio:.2f} times'))
    distances = [('ON times, KS', ks(on_times(stream), on_times(reference))),
                 ('gaps, KS', ks(np.diff(stream.time), np.diff(reference.time))),
                 ('hours of the day, Jensen-Shannon',
                  float(jensenshannon(by_hour(stream), by_hour(reference), 2)))]
    return found + [(name, value, '0', 'distance') for name, value in distances]


def durations(stream: Stream) -> dict[str, list[float]]:
    """The durations of activities, s."""
    since: dict[str, float] = {}
    found: dict[str, list[float]] = {}
    for time, activity, turn in stream.labels:
        if turn == 'begin':
            since[activity] = time
        elif activity in since:
            found.setdefault(activity, []).append(time - since.pop(activity))
    return found


def figure(stream: Stream, reference: Stream | None, path: Path) -> None:
    """Hours, ON times, gaps and sensors, of the data and of the reference."""
    plt = pyplot()
    made, axes = plt.subplots(2, 2, figsize=(10, 7))
    both: list[tuple[str, Any]] = [('data', stream)] + (
        [('reference', reference)] if reference else [])
    for name, one in both:
        axes[0, 0].step(range(24), by_hour(one), where='mid', label=name)
        for axis, values in ((axes[0, 1], on_times(one)), (axes[1, 0], np.diff(one.time))):
            values = np.sort(np.maximum(values, 1e-2))
            axis.semilogx(values, np.linspace(0, 1, len(values)), label=name)
        counts = Counter(one.sensor)
        axes[1, 1].plot(sorted((count / one.days for count in counts.values()), reverse=True),
                        '.-', label=name)
    if reference is None:
        axes[0, 1].plot([1.10, 1.86, 6.73], [0.05, 0.5, 0.95], 'kx', label='AL sample home')
        axes[1, 0].plot([3.8, 21.0, 528.0], [0.5, 0.95, 0.99], 'kx', label='AL sample home')
    for axis, title, x in ((axes[0, 0], 'events by hour of the day', 'h'),
                           (axes[0, 1], 'ON time of motion sensors, share below', 's'),
                           (axes[1, 0], 'gap between events, share below', 's'),
                           (axes[1, 1], 'events a day by sensor', 'sensor, the busiest first')):
        axis.set_title(title, fontsize=10)
        axis.set_xlabel(x)
        axis.legend()
    made.tight_layout()
    save_figure(made, path, dpi=100)
