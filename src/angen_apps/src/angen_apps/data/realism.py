"""Compares data with real homes: distributions, and their distances from a reference."""
from __future__ import annotations

import datetime
import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np
from scipy.spatial.distance import jensenshannon
from scipy.stats import ks_2samp

from angen_apps.data.site import MAINS
from angen_apps.data.shapes import DAYS
from angen_apps.data.tables import EVENTS, TRUTH, Tables, layout_of, lines
from angen_apps.residents.activities import activities
from angen_tools.common.clock import DAY
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
# Figures of Aruba's labeled activities are the only ones published: half to twice each is in range.
ARUBA = {'cook: a day': 7.3, 'cook: median, min': 5.0, 'cook: CV of the count a day': 0.5,
         'eat: CV of the count a day': 1.21, 'wash_dishes: CV of the count a day': 1.99,
         'all: CV of the count a day': 0.24, 'getting up: standard deviation, h': 1.27,
         'cook: motion ON a minute': 11.7, 'relax: motion ON a minute': 1.8,
         'eat: motion ON a minute': 3.5, 'gap in an activity p95, s': 21.0}
PUBLISHED.update({name: (value / 2, 2 * value, f'Aruba {value:g}, half to twice')
                  for name, value in ARUBA.items()})
LABEL = re.compile(r'(?:(R\d+)_)?(\S+)\s+(begin|end)')
# our names of activities by the labels of CASAS: those of Angen, and some of other homes
NAMES = {**{activity.casas: name for name, activity in reversed(activities().items())},
         'Bed_to_Toilet': 'toilet', 'Bed_Toilet_Transition': 'toilet', 'Sleep': 'sleep',
         'Cook': 'cook', 'Kitchen_Activity': 'cook', 'Eat': 'eat', 'Chores': 'clean',
         'Dining_Rm_Activity': 'eat', 'Desk_Activity': 'work', 'Take_Medicine': 'take_medicine',
         'Morning_Meds': 'take_medicine', 'Eve_Meds': 'take_medicine',
         'Master_Bathroom': 'toilet', 'Guest_Bathroom': 'toilet', 'Step_Out': 'leave',
         'Phone': 'phone', 'Groom': 'wash', 'Wash': 'wash', 'Toilet': 'toilet'}
CASAS = 'casas.txt'
BROKEN = 3600.0  # s that one is awake in the middle of a night, at most


class Did(NamedTuple):
    """A labeled activity of somebody."""

    start: float
    end: float
    activity: str
    who: str


@dataclass
class Stream:
    """Events of a home: time in s since the first midnight, sensor, value."""

    time: np.ndarray
    sensor: list[str]
    value: list[str]
    did: list[Did]
    name: str = 'the data'  # its file or folder

    @property
    def days(self) -> int:
        return max(int(np.ceil(self.time[-1] / DAY)), 1) if len(self.time) else 1


class Clock:
    """Times of events, since the midnight before the first of them."""

    _first: datetime.datetime | None = None

    def seconds(self, where: str, text: str) -> float:
        """Of a date and time; Failure if it is none, or not in the DAYS from the first day on."""
        try:
            at = datetime.datetime.fromisoformat(text)
        except ValueError:
            raise Failure(f'{where}: {text} is not a date and time') from None
        self._first = self._first or datetime.datetime.combine(at.date(), datetime.time())
        found = (at - self._first).total_seconds()
        if not 0.0 <= found <= DAYS * DAY:
            raise Failure(f'{where}: {text} must be in the {DAYS} days from {self._first:%Y-%m-%d} '
                          'on, the day of the first event')
        return found


def read(path: Path) -> Stream:
    """A home's folder, or a file as CASAS publishes them. Labels of casas.txt, which are at events,
    are compared with those of other homes; a folder without it has those of its truth."""
    if path.is_dir():
        if not (path / CASAS).is_file():
            return _own(path)
        path = path / CASAS
    times, sensors, values = [], [], []
    did: list[Did] = []
    since: dict[tuple[str, str], float] = {}
    clock = Clock()
    for number, line in enumerate(lines(path, encoding='utf-8-sig', errors='replace'), 1):
        found = LINE.match(line.strip())
        if not found:
            if line.strip():
                raise Failure(f'{path}:{number}: is not an event as CASAS writes them: date, time, '
                              'sensor, value')
            continue
        if found[3] == MAINS:  # in few homes
            continue
        times.append(clock.seconds(f'{path}:{number}', f'{found[1]} {found[2][:15]}'))
        sensors.append(found[3])
        values.append(found[4])
        label = LABEL.fullmatch((found[5] or '').strip())
        if label is None:
            continue
        what = NAMES.get(label[2], label[2]), label[1] or ''
        if label[3] == 'begin':
            since[what] = times[-1]
        elif what in since:
            did.append(Did(since.pop(what), times[-1], *what))
    if not times:
        raise Failure(f'{path}: has no events')
    return Stream(np.array(times), sensors, values, sorted(did), str(path))


def _own(folder: Path) -> Stream:
    times, sensors, values = [], [], []
    described = (folder / 'layout.json').exists()
    clock, tables = Clock(), Tables(folder, layout_of(folder) if described else None)
    for row in tables.rows('events.csv.gz',
                           {key: EVENTS[key] for key in ('time', 'sensor', 'value')}):
        if row['sensor'] == MAINS:
            continue
        times.append(clock.seconds(f'{folder}/events.csv.gz', row['time']))
        sensors.append(row['sensor'])
        values.append(row['value'])
    return Stream(np.array(times), sensors, values, _did(tables), str(folder))


def _did(tables: Tables) -> list[Did]:
    """Each activity with the ways between its places: from where it is first done to where it is
    last done."""
    found: list[Did] = []
    doing: dict[str, Did] = {}  # by resident
    columns = ('resident', 'activity', 'phase', 'start', 'end')
    for row in tables.rows('truth.csv.gz', {key: TRUTH[key] for key in columns}):
        who, name = row['resident'], row['activity']
        if who in doing and doing[who].activity != name:
            found.append(doing.pop(who))
        if row['phase'] == 'does':
            begin = doing[who].start if who in doing else float(row['start'])
            doing[who] = Did(begin, float(row['end']), name, who)
    return sorted([*found, *doing.values()])


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
        raise Failure(f'{stream.name}: has no sensor M… with ON and then OFF, as motion sensors of '
                      'CASAS have')
    found = {'events a day': len(stream.time) / stream.days}
    for share in (5, 50, 95):
        found[f'ON time p{share}, s'] = float(np.percentile(on, share))
    for share in (50, 95, 99):
        found[f'gap p{share}, s'] = float(np.percentile(gaps, share))
    found['events an hour at night (1-5 h)'] = float(hours[1:5].mean())
    found['events in the busiest hour'] = float(hours.max())
    return {**found, **{name: value for name, value in _living(stream) if np.isfinite(value)}}


def _living(stream: Stream) -> Iterator[tuple[str, float]]:
    """The figures of labeled activities; NaN of those that there are not."""
    by_name: dict[str, list[Did]] = {}
    for one in stream.did:
        by_name.setdefault(one.activity, []).append(one)
    cooks = by_name.get('cook', [])
    yield 'cook: a day', len(cooks) / stream.days if cooks else np.nan
    yield 'cook: median, min', float(np.median([one.end - one.start for one in cooks])) / 60 \
        if cooks else np.nan
    for name in ('cook', 'eat', 'wash_dishes', 'all'):
        did = stream.did if name == 'all' else by_name.get(name, [])
        count = np.bincount(np.array([one.start // DAY for one in did], int), None, stream.days)
        yield f'{name}: CV of the count a day', float(count.std() / count.mean()) \
            if count.any() and len(count) > 1 else np.nan
    yield 'getting up: standard deviation, h', _getting_up(by_name.get('sleep', []), stream.days)
    for name in ('cook', 'relax', 'eat'):
        yield f'{name}: motion ON a minute', _on_a_minute(stream, by_name.get(name, []))
    gaps = [np.diff(stream.time[first:last]) for first, last in _indices(stream, stream.did)]
    yield 'gap in an activity p95, s', \
        float(np.percentile(np.concatenate(gaps), 95)) if sum(map(len, gaps)) else np.nan


def _indices(stream: Stream, did: list[Did]) -> Iterator[tuple[int, int]]:
    """The first event in each activity, and the first one after it."""
    return zip(np.searchsorted(stream.time, [one.start for one in did]).tolist(),
               np.searchsorted(stream.time, [one.end for one in did], 'right').tolist())


def _on_a_minute(stream: Stream, did: list[Did]) -> float:
    """The ON of motion sensors in some activities."""
    minutes = sum(one.end - one.start for one in did) / 60.0
    count = sum(value == 'ON' and sensor.startswith('M') for first, last in _indices(stream, did)
                for sensor, value in zip(stream.sensor[first:last], stream.value[first:last]))
    return count / minutes if minutes > 0 else np.nan


def _getting_up(sleeps: list[Did], days: int) -> float:
    """The standard deviation of the hour at which the longest sleep of each day ends, around the
    mean of each resident; a sleep goes on after less than BROKEN."""
    nights: dict[tuple[str, int], Did] = {}
    last: dict[str, Did] = {}
    for one in sleeps:
        before = last.get(one.who)
        if before and one.start - before.end < BROKEN:
            one = one._replace(start=before.start)
            if nights.get((one.who, int(before.end // DAY))) == before:
                del nights[one.who, int(before.end // DAY)]
        last[one.who] = one
        key = one.who, int(one.end // DAY)
        if key not in nights or nights[key].end - nights[key].start < one.end - one.start:
            nights[key] = one
    found: list[float] = []
    for who in sorted(last):
        turns = np.array([night.end / DAY * 2 * np.pi for (name, day), night in nights.items()
                          if name == who and day < days])
        mean = np.angle(np.exp(1j * turns).mean()) if len(turns) > 1 else 0.0
        found += np.angle(np.exp(1j * (turns - mean))).tolist() if len(turns) > 1 else []
    return float(np.std(found)) * 12.0 / np.pi if found else np.nan


def by_hour(stream: Stream) -> np.ndarray:
    """Events of a day in each hour (24,)."""
    return np.bincount((stream.time // 3600 % 24).astype(int), minlength=24) / stream.days


def ks(a: np.ndarray, b: np.ndarray) -> float:
    """The Kolmogorov-Smirnov distance of two samples: 0 to 1."""
    return float(ks_2samp(a, b, method='asymp').statistic)


def _verdict(name: str, value: float) -> str:
    low, high, _ = PUBLISHED[name]
    return 'within' if low <= value <= high else 'below' if value < low else 'above'


def compare(stream: Stream, reference: Stream | None) -> list[tuple[str, float, str, str]]:
    """Measure, value, reference and verdict; values outside come first."""
    own = measures(stream)
    found = []
    if reference is None:
        for name, value in own.items():
            low, high, source = PUBLISHED[name]
            found.append((name, value, f'{low:g} to {high:g} ({source})', _verdict(name, value)))
        return sorted(found, key=lambda row: row[3] == 'within')
    other = measures(reference)
    for name, value in own.items():
        if name in other:
            ratio = value / other[name] if other[name] else float('inf')
            found.append((name, value, f'{other[name]:.4g}',
                          f'{ratio:.2f} times, {_verdict(name, value)} published homes'))
    distances = [('ON times, KS', ks(on_times(stream), on_times(reference))),
                 ('gaps, KS', ks(np.diff(stream.time), np.diff(reference.time))),
                 ('hours of the day, Jensen-Shannon',
                  float(jensenshannon(by_hour(stream), by_hour(reference), 2)))]
    return found + [(name, value, '0', 'distance') for name, value in distances]


def durations(stream: Stream) -> dict[str, list[float]]:
    """The durations of activities, s."""
    found: dict[str, list[float]] = {}
    for one in stream.did:
        found.setdefault(one.activity, []).append(one.end - one.start)
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
