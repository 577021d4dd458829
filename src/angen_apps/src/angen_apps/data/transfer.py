"""How well a usual classifier that learns from our data knows the activities of a real home.

Its features name no sensor: minutes have the shares of each use of rooms in what moves, how long
ago something moved there, how long seats and plugs there are in use, how busy the home is compared
with its other minutes, and the hour. Changes, last sensors and states are the usual three (van
Kasteren et al., UbiComp 2008).
"""
from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from angen_apps.data.realism import CASAS, DAY, Stream, read
from angen_apps.data.tables import layout_of, lines
from angen_tools.common.failure import Failure

USES = ('kitchen', 'living', 'bedroom', 'bathroom', 'work', 'hall')
OTHER = 'hall'  # use of a sensor of no room
MOVES = {'M': 'ON', 'D': 'OPEN'}  # sensors by letter whose reports matter, and which …
LASTS = {'I': 'PRESENT', 'S': 'ON'}  # … and those whose states do
MINUTES = 1440  # a day
AROUND = 10  # minutes before and after, whose sums are features, too
LONG = 240.0  # minutes since something moved, at most
EARLIER = 0.6  # share of a real home's days from which one learns; the others are for the test
SHARES = (0.05, 0.1)  # share of these days that is added to ours
WINDOWS = 60_000  # minutes from which one learns, at most
TREES = 100
LIFT = 1.5  # times that a sensor reports more in activities of a use, if it belongs there
# the use of the room of an activity, to find those of sensors where nobody says them
PLACES = {'cook': 'kitchen', 'wash_dishes': 'kitchen', 'sleep': 'bedroom', 'toilet': 'bathroom',
          'wash': 'bathroom', 'shower': 'bathroom', 'relax': 'living', 'watch_tv': 'living',
          'read': 'living', 'work': 'work', 'study': 'work'}
# what a home calls an activity for which it has no name of its own
ALIKE = {'watch_tv': 'relax', 'read': 'relax', 'study': 'work', 'shower': 'wash', 'snack': 'eat',
         'visit': 'relax', 'play': 'relax', 'nap': 'relax', 'wash': 'toilet', 'laundry': 'clean'}


class Minutes(NamedTuple):
    """Features (minutes, features) and activities (minutes,); '' where nothing is labeled."""

    features: np.ndarray
    activity: np.ndarray

    def part(self, chosen: np.ndarray) -> Minutes:
        return Minutes(self.features[chosen], self.activity[chosen])


def transfer(folders: list[Path], real: Path, rooms: Path | None) -> list[tuple[str, float]]:
    """Macro F1 on a real home's later days of models that learned from the days of others."""
    theirs = read(real)
    days = sorted({int(one.start // DAY) for one in theirs.did})
    if len(days) < 2:
        raise Failure(f'{real}: has labels on {len(days)} day{"s" * (len(days) != 1)}; needs two')
    until = days[max(1, min(len(days) - 1, round(EARLIER * len(days))))]
    use = _uses(real, rooms) or _guessed(theirs, until * DAY)
    homes = [(read(folder), _uses(folder, None)) for folder in folders]
    letters = [letter for letter in (*MOVES, *LASTS) if all(
        any(name.startswith(letter) for name in stream.sensor)
        for stream in (theirs, *(stream for stream, _ in homes)))]
    every = minutes(theirs, use, letters)
    known = set(every.activity) - {''}
    ours = _joined([_renamed(minutes(stream, uses, letters), known) for stream, uses in homes])
    if not set(ours.activity) & known - {''}:
        raise Failure(f'{real}: has no activity that the data have')
    day = np.arange(len(every.activity)) // MINUTES
    labeled = every.activity != ''
    test = every.part(labeled & (day >= until))
    found = [('all earlier real days', _score([every.part(labeled & (day < until))], test)),
             ('ours', _score([ours], test))]
    earlier = [number for number in days if number < until]
    for share in SHARES:
        some = every.part(labeled & np.isin(day, earlier[:max(1, round(share * len(earlier)))]))
        found += [(f'{share:.0%} of these days', _score([some], test)),
                  (f'ours and {share:.0%} of these days', _score([ours, some], test))]
    names, counts = np.unique(test.activity, return_counts=True)
    return [*found, ('commonest activity', _f1(test.activity, np.full(
        len(test.activity), names[counts.argmax()])))]


def minutes(stream: Stream, use: dict[str, str], letters: list[str]) -> Minutes:
    """The minutes of a home."""
    size = stream.days * MINUTES
    at = np.minimum((stream.time // 60).astype(int), size - 1)
    sensor, value = np.array(stream.sensor), np.array(stream.value)
    ids = np.unique(sensor, return_inverse=True)[1]
    columns = []
    for letter in letters:
        if letter in LASTS:
            shares = _in_use(stream, use, letter, size)
            columns += [*shares, *map(_since, shares)]
            continue
        on = np.char.startswith(sensor, letter) & (value == MOVES[letter])
        where = np.array([use.get(name, OTHER) for name in sensor[on]], str)
        counts = np.array([np.bincount(at[on][where == one], minlength=size) for one in USES],
                          float)
        for summed in (counts, _sums(counts, -AROUND), _sums(counts, AROUND)):
            total = summed.sum(axis=0)
            columns += [*(summed / np.maximum(total, 1.0)), _ranks(total)]
        columns += [_since(count) for count in counts]
        pairs = np.unique(np.stack([at[on], ids[on]]), axis=1)  # who walks around meets many
        several = np.bincount(pairs[0], minlength=size)[None].astype(float)
        columns += [_ranks(_sums(several, over)[0]) for over in (0, -AROUND, AROUND)]
    hour = np.arange(size) % MINUTES / 60.0
    return Minutes(np.array([*columns, hour, _ranks(np.bincount(at, minlength=size))]).T,
                   _labels(stream, size))


def _in_use(stream: Stream, use: dict[str, str], letter: str, size: int) -> np.ndarray:
    """The share of each minute in which something of a use of rooms is active (uses, minutes)."""
    found = np.zeros((len(USES), size))
    edges = 60.0 * np.arange(size + 1)
    sensor, value = np.array(stream.sensor), np.array(stream.value)
    for name in sorted({name for name in stream.sensor if name.startswith(letter)
                        and use.get(name, OTHER) in USES}):
        time = np.append(stream.time[sensor == name], edges[-1])
        spent = np.cumsum(np.diff(time) * (value[sensor == name] == LASTS[letter]))
        found[USES.index(use.get(name, OTHER))] += np.diff(
            np.interp(edges, time, np.append(0.0, spent))) / 60.0
    return np.minimum(found, 1.0)


def _sums(counts: np.ndarray, over: int) -> np.ndarray:
    """Sums over some minutes before, or after."""
    sums = np.pad(np.cumsum(counts, axis=1), ((0, 0), (1, 0)))
    here = np.arange(counts.shape[1])
    first = np.clip(here + min(over, 1), 0, counts.shape[1])
    last = np.clip(here + max(over + 1, 0), 0, counts.shape[1])
    return np.asarray(sums[:, last] - sums[:, first])


def _ranks(counts: np.ndarray) -> np.ndarray:
    """The share of the home's minutes with a lower count: homes differ in how many sensors see
    the same."""
    return np.searchsorted(np.sort(counts), counts) / len(counts)


def _since(counts: np.ndarray) -> np.ndarray:
    here = np.arange(len(counts))
    last = np.maximum.accumulate(np.where(counts > 0, here, -int(LONG)))
    return np.minimum(here - last, LONG)


def _labels(stream: Stream, size: int) -> np.ndarray:
    """The activity in the middle of each minute."""
    found = np.full(size, '', dtype='<U40')
    for one in stream.did:
        found[max(round(one.start / 60), 0):round(one.end / 60)] = one.activity
    return found


def _renamed(ours: Minutes, known: set[Any]) -> Minutes:
    """The minutes of activities that the real home has, by its names."""
    names = {}
    for name in set(ours.activity):
        other = name
        while other not in known and other in ALIKE:
            other = ALIKE[other]
        names[name] = other if other in known else ''
    activity = np.array([names[name] for name in ours.activity])
    return Minutes(ours.features, activity).part(activity != '')


def _joined(parts: list[Minutes]) -> Minutes:
    return Minutes(*(np.concatenate(columns) for columns in zip(*parts)))


def _uses(home: Path, rooms: Path | None) -> dict[str, str]:
    """The use of the room of each sensor: that of a list, or of our own layout."""
    folder = home.parent if home.name == CASAS else home
    if rooms is None and (folder / 'layout.json').is_file():
        layout = layout_of(folder)
        use = {room['name']: room['use'] for room in layout['rooms']}
        return {one['id']: use.get(one['room'], OTHER) for one in layout['sensors']}
    found = {}
    for number, line in enumerate(lines(rooms) if rooms else (), 1):
        words = line.replace(',', ' ').split()
        if words and (len(words) != 2 or words[1] not in USES):
            raise Failure(f'{rooms}:{number}: must be a sensor and one of {", ".join(USES)}')
        if words:
            found[words[0]] = words[1]
    return found


def _guessed(stream: Stream, until: float) -> dict[str, str]:
    """The use of the room of each sensor, by the activities in which it reports most often."""
    spent = dict.fromkeys(USES, 1.0)
    counts: dict[str, dict[str, float]] = {}
    for one in stream.did:
        use = PLACES.get(one.activity)
        if use is None or one.end > until:
            continue
        spent[use] += one.end - one.start
        first, last = np.searchsorted(stream.time, [one.start, one.end])
        for name in stream.sensor[first:last]:
            counts.setdefault(name, dict.fromkeys(USES, 0.0))[use] += 1.0
    found = {}
    for name, count in counts.items():
        rates = {use: count[use] / spent[use] for use in USES}
        best = max(USES, key=lambda use: rates[use])
        mean = sum(count.values()) / sum(spent.values())
        found[name] = best if rates[best] > LIFT * mean else OTHER
    return found


def _score(parts: list[Minutes], test: Minutes) -> float:
    """The macro F1 of a forest that learns from parts, of which each counts the same."""
    try:
        from sklearn.ensemble import RandomForestClassifier
    except ImportError:
        raise Failure('--transfer needs scikit-learn: apt install python3-sklearn') from None
    kept = [part.part(np.linspace(0, len(part.activity) - 1, min(
        len(part.activity), WINDOWS // len(parts))).astype(int)) for part in parts]
    every = _joined(kept)
    weights = np.concatenate([np.full(len(part.activity), 1.0 / max(len(part.activity), 1))
                              for part in kept])
    names, number = np.unique(every.activity, return_inverse=True)
    weights /= np.bincount(number, weights)[number]  # each activity counts the same, too
    model = RandomForestClassifier(TREES, min_samples_leaf=5, random_state=0, n_jobs=1)
    model.fit(every.features, number, weights * len(weights) / weights.sum())
    return _f1(test.activity, names[model.predict(test.features)])


def _f1(true: np.ndarray, said: np.ndarray) -> float:
    """The mean over the activities of the test of 2 TP / (2 TP + FP + FN)."""
    scores = []
    for name in np.unique(true):
        right = np.count_nonzero((true == name) & (said == name))
        scores.append(2 * right / (np.count_nonzero(true == name) + np.count_nonzero(said == name)))
    return float(np.mean(scores))
