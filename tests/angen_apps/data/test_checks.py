"""Corruptions of a home's data, of more than 90 kinds: each is noticed. All but those of files are
consistent: counts, hashes and the formats that follow from truth and events are written again."""
from __future__ import annotations

import csv
import gzip
import io
import json
import shutil
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable

import pytest

from angen_apps.data.checks import labels as label_checks
from angen_apps.data.checks import places as place_checks
from angen_apps.data.checks import sensors as sensor_checks
from angen_apps.data.checks import tables as table_checks
from angen_apps.data.formats import FORMATS
from angen_apps.data.generate import HOME, MANIFEST, Job, make, sha256
from angen_apps.data.validate import validate, validate_all
from angen_apps.data.written import Findings, Written
from angen_tools.common.failure import Failure

DAY = 86400
SEED = 7  # nobody is ill: both leave for most of the day
Rows = list[dict[str, str]]
PROFILES = {  # a short day at home for each
    'early': '''
speed: 0.9
wakes: '7:00-7:05'
sleeps: '21:30-21:35'
scheduled:
  - {do: [cook, eat], at: '7:15-7:16'}
  - {do: [leave], at: '8:00-8:02', lasts: 11-11.1 h}
  - {do: [cook], at: '19:05-19:06'}
free: {watch_tv: {hours: {0: 1}, lasts: 90-100 min}}
''',
    'late': '''
speed: 1.2
wakes: '8:00-8:05'
sleeps: '23:00-23:05'
scheduled:
  - {do: [leave], at: '9:00-9:02', lasts: 10-10.1 h}
free: {read: {hours: {0: 1}, lasts: 90-120 min}}
needs: {toilet: {every: 3-4 h}}
'''}


@pytest.fixture(scope='module')
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp('good')
    for name, text in PROFILES.items():
        (folder / f'{name}.yaml').write_text(text)
    make(Job(str(folder / 'home'), 'home', SEED, 1,
             tuple(str(folder / f'{name}.yaml') for name in PROFILES), ('casas', 'csv')))
    return folder / 'home'


class Tables:
    """The tables of a home, to change and to write again."""

    FILES = {'events': 'events.csv.gz', 'truth': 'truth.csv.gz', 'track': 'track.csv.gz',
             'moves': 'moves.csv.gz', 'loads': 'loads.csv.gz', 'missed': 'missed.csv',
             'faults': 'faults.csv', 'talks': 'talks.csv.gz'}

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.heads: dict[str, list[str]] = {}
        self.rows: dict[str, Rows] = {}
        for name, file in self.FILES.items():
            data = (folder / file).read_bytes()
            text = (gzip.decompress(data) if file.endswith('gz') else data).decode()
            self.rows[name] = list(csv.DictReader(io.StringIO(text)))
            self.heads[name] = text.partition('\n')[0].split(',')
        self.layout = json.loads((folder / 'layout.json').read_text())
        self.entry = json.loads((folder / HOME).read_text())

    def __getattr__(self, name: str) -> Rows:
        return self.rows[name]

    def write(self) -> None:
        for name, file in self.FILES.items():
            out = io.StringIO()
            writer = csv.DictWriter(out, self.heads[name], lineterminator='\n')
            writer.writeheader()
            writer.writerows(self.rows[name])
            data = out.getvalue().encode()
            (self.folder / file).write_bytes(
                gzip.compress(data, 1) if file.endswith('gz') else data)
        (self.folder / 'layout.json').write_text(json.dumps(self.layout))
        FORMATS['casas'](self.folder, Written(self.folder).data(SEED))
        self.entry.update(events=len(self.events), missed=len(self.missed),
                          faults=len(self.faults), sensors=len(self.layout['sensors']),
                          residents=[[r['name'], r['profile']] for r in self.layout['residents']])
        relist(self.folder, self.entry)

    def ids(self, kind: str, room: str = '') -> list[str]:
        return [s['id'] for s in self.layout['sensors']
                if s['kind'] == kind and s['room'].startswith(room)]

    def swap(self, table: str, column: str, a: str, b: str) -> None:
        for row in self.rows[table]:
            row[column] = {a: b, b: a}.get(row[column], row[column])

    def drop(self, table: str, which: Callable[[dict[str, str]], bool]) -> None:
        kept = [row for row in self.rows[table] if not which(row)]
        assert len(kept) < len(self.rows[table]), 'the corruption changes nothing'
        self.rows[table] = kept

    def shift(self, rows: Rows, seconds: float) -> None:
        for row in rows:
            moved = (clock(row['time']) + seconds) % DAY
            row['time'] = f'{row["time"][:10]} {stamp(moved)}'
        self.events.sort(key=lambda row: (row['time'], row['sensor']))

    def entries(self, of: str, key: str, values: dict[str, Any]) -> None:
        """Replaces values of a key in the layout."""
        for one in self.layout[of]:
            one[key] = values.get(one[key], one[key])


def relist(folder: Path, entry: dict[str, Any]) -> None:
    """A list of the files as they are."""
    entry['files'] = {name: sha256(folder / name) for name in entry['files']
                      if (folder / name).is_file()}
    (folder / HOME).write_text(json.dumps(entry))


def clock(text: str) -> float:
    hours, minutes, seconds = text[11:].split(':')
    return 3600.0 * int(hours) + 60.0 * int(minutes) + float(seconds)


def stamp(time: float) -> str:
    whole, micro = divmod(round(time * 1e6), 1_000_000)
    return f'{whole // 3600:02d}:{whole // 60 % 60:02d}:{whole % 60:02d}.{micro:06d}'


def two(*kinds: str) -> Callable[[dict[str, str]], bool]:
    return lambda row: row['activity'] in kinds


# --- consistent corruptions

def ghosts(t: Tables) -> None:
    """40 events of the kitchen again 15 h later."""
    own = [dict(row) for row in t.events if row['sensor'] in t.ids('motion', 'kitchen')][:40]
    assert len(own) == 40
    t.events.extend(own)
    t.shift(own, 15 * 3600.0)


def sensors_swapped(t: Tables) -> None:
    t.swap('events', 'sensor', t.ids('motion', 'kitchen')[0], t.ids('motion', 'bathroom')[0])
    t.swap('events', 'room', 'kitchen0', 'bathroom0')


def postures(t: Tables, old: str, new: str) -> None:
    for row in t.truth:
        row['posture'] = new if row['posture'] == old else row['posture']


def power(t: Tables, kind: str, watts: str, device: str = '') -> None:
    for row in t.loads:
        if row['kind'] == kind and device in row['device']:
            row['watts'] = watts


def one_of_ten(t: Tables) -> None:
    """Of the cells every tenth ON, with its OFF."""
    count, gone = 0, set()
    kept = []
    for row in t.events:
        if row['kind'] == 'motion' and row['value'] == 'ON':
            count += 1
            if count % 10 == 0:
                gone.add(row['sensor'])
        if row['sensor'] in gone:
            if row['value'] == 'OFF':
                gone.discard(row['sensor'])
            continue
        kept.append(row)
    t.rows['events'] = kept


def stuck(kind: str) -> Callable[[Tables], None]:
    """Each sensor of a kind is on from its first ON to its last OFF, by whom it came on."""
    def change(t: Tables) -> None:
        for sensor in t.ids(kind):
            own = [row for row in t.events if row['sensor'] == sensor and row['cause'] != 'start']
            if len(own) < 4 or own[-1]['value'] not in ('OFF', 'ABSENT'):
                continue
            on = next(row for row in own if row['value'] in ('ON', 'PRESENT'))
            own[-1].update({key: on[key] for key in ('resident', 'activity', 'cause')})
            t.drop('events', lambda row: any(row is one for one in own[own.index(on) + 1:-1]))
    return change


def columns(t: Tables, table: str, change: Callable[[dict[str, str]], None],
            which: Callable[[dict[str, str]], bool] = lambda row: True) -> None:
    rows = [row for row in t.rows[table] if which(row)]
    assert rows, 'the corruption changes nothing'
    for row in rows:
        change(row)


def later(seconds: float) -> Callable[[dict[str, str]], None]:
    def change(row: dict[str, str]) -> None:
        for key in ('start', 'end', 'time'):
            if key in row:
                row[key] = f'{min(max(float(row[key]) + seconds, 0.0), DAY):.3f}'
    return change


def teleport(t: Tables) -> None:
    """Each walk is mirrored."""
    for row in t.track:
        row['x'] = f'{10.0 - float(row["x"]):.3f}'


def stays(t: Tables) -> None:
    """Who is away is in bed."""
    bed = next(row for row in t.truth if (row['activity'], row['phase']) == ('sleep', 'does'))
    for row in t.truth:
        if row['phase'] == 'away':
            row.update({key: bed[key] for key in ('activity', 'phase', 'room', 'thing', 'posture',
                                                  'x', 'y')})


def set_to(**values: str) -> Callable[[dict[str, str]], None]:
    return lambda row: row.update(values)


def of_kind(*kinds: str) -> Callable[[dict[str, str]], bool]:
    return lambda row: row['kind'] in kinds


BASE: dict[str, Callable[[Tables], Any]] = {
    'ghosts in the kitchen': ghosts,
    'kitchen and bathroom in events': lambda t: t.swap('events', 'room', 'kitchen0', 'bathroom0'),
    'kitchen and bathroom in the truth': lambda t: t.swap('truth', 'room', 'kitchen0', 'bathroom0'),
    'kitchen and bathroom by name': lambda t: t.entries(
        'rooms', 'name', {'kitchen0': 'bathroom0', 'bathroom0': 'kitchen0'}),
    'kitchen and bathroom by use': lambda t: t.entries(
        'rooms', 'use', {'kitchen': 'bathroom', 'bathroom': 'kitchen'}),
    'two cells': sensors_swapped,
    'residents in the truth': lambda t: t.swap('truth', 'resident', 'anna', 'bert'),
    'residents in the track': lambda t: t.swap('track', 'resident', 'anna', 'bert'),
    'residents in events': lambda t: t.swap('events', 'resident', 'anna', 'bert'),
    'residents everywhere': lambda t: [t.swap(name, 'resident', 'anna', 'bert')
                                       for name in ('truth', 'track', 'moves', 'events')],
    'cook and sleep in events': lambda t: t.swap('events', 'activity', 'cook', 'sleep'),
    'cook and sleep in the truth': lambda t: t.swap('truth', 'activity', 'cook', 'sleep'),
    'cook and sleep everywhere': lambda t: [t.swap(name, 'activity', 'cook', 'sleep')
                                            for name in ('truth', 'events')],
    'eat and watch_tv everywhere': lambda t: [t.swap(name, 'activity', 'eat', 'watch_tv')
                                              for name in ('truth', 'events')],
    'an unknown activity': lambda t: columns(t, 'truth', set_to(activity='fly'), two('read')),
    'a sensor renamed in events': lambda t: t.swap('events', 'sensor',
                                                   t.ids('motion', 'kitchen')[0], 'M999'),
    'a sensor renamed in the layout': lambda t: t.entries(
        'sensors', 'id', {t.ids('motion', 'kitchen')[0]: 'M999'}),
    'sleepers stand': lambda t: postures(t, 'lie', 'stand'),
    'the stove is never on': lambda t: power(t, 'stove', '0.000'),
    'the stove is always on': lambda t: power(t, 'stove', '900.000'),
    'the television is never on': lambda t: power(t, 'appliance', '0.500', 'tv'),
    'lamps while nobody is there': lambda t: columns(
        t, 'loads', set_to(time='50000.000'), lambda row: row['watts'] == '10.000'),
    'no cells in the kitchen': lambda t: t.drop(
        'events', lambda row: row['sensor'] in t.ids('motion', 'kitchen')),
    'no rooms in the evening': lambda t: t.drop(
        'events', lambda row: row['kind'] == 'area' and clock(row['time']) > 64800),
    'a tenth of the cells': one_of_ten,
    **{f'{kind} sensors are stuck': stuck(kind) for kind in ('motion', 'area')},
    'a seat is left an hour later': lambda t: t.shift(
        [[row for row in t.events if row['kind'] == 'item' and row['value'] == 'ABSENT'
          and row['cause'] != 'start'][-1]], 3600.0),
    'no seats': lambda t: t.drop('events', of_kind('item')),
    'no door to the bathroom': lambda t: t.drop(
        'events', lambda row: row['sensor'] == next(
            s['id'] for s in t.layout['sensors'] if s['name'] == 'bathroom0_contact')),
    'no doors': lambda t: t.drop('events', of_kind('door')),
    'no fridge': lambda t: t.drop('events', lambda row: row['sensor'] in t.ids('door', 'kitchen')),
    'no mains': lambda t: t.drop('events', of_kind('mains')),
    'a heat wave': lambda t: columns(
        t, 'events', set_to(value='45.0'), lambda row: row['sensor'] == t.ids('temperature')[0]),
    'a silent thermometer': lambda t: t.drop(
        'events', lambda row: row['sensor'] == t.ids('temperature')[0]),
    'all an hour later': lambda t: t.shift(t.events, 3600.0),
    'one sensor ten minutes later': lambda t: t.shift(
        [row for row in t.events if row['sensor'] == t.ids('motion', 'kitchen')[0]], 600.0),
    'all ten seconds earlier': lambda t: t.shift(
        [row for row in t.events if clock(row['time']) > 60], -10.0),
    'each event twice': lambda t: t.rows.update(events=[r for row in t.events for r in (row, row)]),
    'on and off': lambda t: [t.swap('events', 'value', 'ON', 'OFF')],
    'open and close': lambda t: [t.swap('events', 'value', 'OPEN', 'CLOSE')],
    'causes of another kind': lambda t: t.swap('events', 'cause', 'motion', 'seat'),
    'all is noise': lambda t: columns(t, 'events', set_to(cause='noise', resident='', activity=''),
                                      of_kind('motion', 'area')),
    'no residents': lambda t: columns(t, 'events', set_to(resident='', activity='')),
    'events in another order': lambda t: t.events.reverse(),
    'the truth half an hour later': lambda t: columns(t, 'truth', later(1800.0)),
    'a gap in the truth': lambda t: t.drop('truth', two('eat')),
    'a sleeper beside the bed': lambda t: columns(
        t, 'truth', lambda row: row.update(x=f'{float(row["x"]) + 2.0:.3f}'), two('sleep')),
    'another thing': lambda t: columns(t, 'truth', set_to(thing='bathroom_toilet0'), two('cook')),
    'who is away is in bed': stays,
    'mirrored walks': teleport,
    'no walks for an hour': lambda t: t.drop(
        'track', lambda row: 25200 < float(row['time']) < 28800),
    'walks a minute later': lambda t: columns(t, 'track', later(60.0)),
    'walks on another floor': lambda t: columns(t, 'track', set_to(storey='1')),
    'no small motions': lambda t: t.rows.update(moves=[]),
    'things moved': lambda t: [one.update(x=one['x'] + 3.0) for one in t.layout['things']],
    'sensors moved': lambda t: [one.update(y=one['y'] + 3.0) for one in t.layout['sensors']],
    'doors moved': lambda t: [one['pose'].__setitem__(0, one['pose'][0] + 2.0)
                              for one in t.layout['doors']],
    'a resident is a guest': lambda t: t.layout.update(
        guests=[{'name': t.layout['residents'].pop()['name'], 'host': 'anna'}]),
    'a day more': lambda t: t.layout.update(days=2),
    'faults as an excuse': lambda t: t.faults.extend(
        {'time': '1.0', 'sensor': s['id'], 'fault': 'dropout', 'detail': ''}
        for s in t.layout['sensors']),
}


# --- consistent corruptions of the layout, and of tables beside the truth

def set_all(entries: list[dict[str, Any]], **values: Any) -> None:
    for one in entries:
        one.update(values)


def missed(sensor: str, resident: str, kind: str = 'cell_', start: str = '50000.000'
           ) -> Callable[[Tables], None]:
    """A row of one who is not there, or over what is no cell. `sensor` empty: one of that kind."""
    def change(t: Tables) -> None:
        known = next(s['id'] for s in t.layout['sensors'] if s['name'].startswith(kind))
        t.missed.append({'start': start, 'end': f'{float(start) + 2:.3f}',
                         'sensor': sensor or known, 'resident': resident})
    return change


def missed_though_on(t: Tables) -> None:
    """A row over a cell that detected who was there."""
    event = next(row for row in t.events if row['sensor'] in t.ids('motion') and row['resident']
                 and row['cause'] == 'motion' and row['value'] == 'ON')
    time = clock(event['time'])
    t.missed.append({'start': f'{time - 1:.3f}', 'end': f'{time + 1:.3f}',
                     'sensor': event['sensor'], 'resident': event['resident']})


def twice(part: str) -> Callable[[Tables], None]:
    return lambda t: t.layout[part].append(dict(t.layout[part][0]))


def door(key: str, change: Callable[[Any], Any]) -> Callable[[Tables], None]:
    def changed(t: Tables) -> None:
        one = next(one for one in t.layout['doors'] if one['kind'] == 'door')
        one[key] = change(one[key])
    return changed


BESIDE: dict[str, Callable[[Tables], Any]] = {
    'a wide door': door('width', lambda _: 5.0),
    'a door a bit wider': door('width', lambda width: width + 0.05),
    'a door turned': door('pose', lambda pose: [*pose[:3], pose[3] + 1.5708]),
    'a door turned around': door('pose', lambda pose: [*pose[:3], pose[3] + 3.1416]),
    'a door to a room that is not there': door('rooms', lambda rooms: ['narnia', rooms[1]]),
    'a door of one room': door('rooms', lambda rooms: rooms[:1]),
    'a door to another room': door('rooms', lambda rooms: [rooms[0], 'kitchen0']),
    'sensors in the sky': lambda t: set_all(t.layout['sensors'], z=50.0),
    'sensors a bit higher': lambda t: set_all(t.layout['sensors'][:1], z=2.0),
    'a room of a square kilometer': lambda t: set_all(t.layout['rooms'][:1], area=1e6),
    'a thing of another type': lambda t: set_all(t.layout['things'][-1:], type='piano'),
    **{f'{part} twice': twice(part) for part in ('rooms', 'doors', 'things', 'sensors',
                                                 'residents')},
    'a guest twice': lambda t: t.layout.update(guests=2 * [{'name': 'carl', 'host': 'anna'}]),
    'a guest with the name of a resident': lambda t: t.layout.update(
        guests=[{'name': 'bert', 'host': 'anna'}]),
    'a resident of another name': lambda t: [t.entries('residents', 'name', {'bert': 'bertha'})],
    'a missed walk of nobody': missed('', 'zoe'),
    'a missed walk of one who is away': missed('', 'anna'),
    'a missed walk in a room': missed('', 'anna', 'area_'),
    'a missed walk by no sensor': missed('M999', 'anna'),
    'a missed walk that was noticed': missed_though_on,
    'a step on another floor': lambda t: t.track[9].update(storey='99'),
    'no talks': lambda t: t.drop('talks', lambda row: True),
    **{f'all is {cause}': lambda t, cause=cause: columns(t, 'truth', set_to(cause=cause))
       for cause in ('need', 'continues', 'interrupts')},
}


def test_a_format_that_is_not_in_the_settings_is_noticed(good: Path, tmp_path: Path) -> None:
    folder = copied(good, tmp_path)
    entry = json.loads((folder / HOME).read_text())
    entry['settings']['formats'] = ['csv']
    (folder / HOME).write_text(json.dumps(entry))
    assert [line.partition(': ')[2] for line in validate(folder).wrong[
        'a file is as it is listed']] == ['lists casas.txt, which is of none of its formats']


# --- corruptions of files, with and without a new list

def casas(folder: Path, change: Callable[[list[str]], Any]) -> None:
    path = folder / 'casas.txt'
    lines = path.read_text().splitlines()
    before = list(lines)
    change(lines)
    assert lines != before, 'the corruption changes nothing'
    path.write_text('\n'.join(lines) + '\n')


def replaced(lines: list[str], a: str, b: str) -> None:
    lines[:] = [line.replace(a, '~').replace(b, a).replace('~', b) for line in lines]


def dropped(lines: list[str], word: str) -> None:
    del lines[next(i for i, line in enumerate(lines) if word in line)]


FILES: dict[str, Callable[[Path], Any]] = {
    'no casas.txt': lambda f: (f / 'casas.txt').unlink(),
    'cook and sleep in casas.txt': lambda f: casas(
        f, lambda lines: replaced(lines, 'Meal_Preparation', 'Sleeping')),
    'residents in casas.txt': lambda f: casas(f, lambda lines: replaced(lines, 'R1_', 'R2_')),
    'no end in casas.txt': lambda f: casas(f, lambda lines: dropped(lines, ' end')),
    'one event less in casas.txt': lambda f: casas(f, lambda lines: dropped(lines, 'M0')),
    'another sensor in casas.txt': lambda f: casas(
        f, lambda lines: replaced(lines, 'M016', 'M017')),
}


def copied(good: Path, folder: Path) -> Path:
    shutil.copytree(good, folder / 'home')
    return folder / 'home'


@pytest.mark.parametrize('kind', [*BASE, *BESIDE])
def test_a_corruption_is_noticed(kind: str, good: Path, tmp_path: Path) -> None:
    tables = Tables(copied(good, tmp_path))
    (BASE | BESIDE)[kind](tables)
    try:
        tables.write()
        noticed = validate(tables.folder).count
    except (Failure, KeyError):  # a format cannot be made of it
        noticed = 1
    assert noticed


@pytest.mark.parametrize('kind', FILES)
def test_a_corruption_of_a_file_is_noticed(kind: str, good: Path, tmp_path: Path) -> None:
    folder = copied(good, tmp_path)
    FILES[kind](folder)
    relist(folder, json.loads((folder / HOME).read_text()))
    assert validate(folder).count


def test_a_list_that_is_missing_or_another_is_noticed(good: Path, tmp_path: Path) -> None:
    folder = copied(good, tmp_path)
    entry = json.loads((folder / HOME).read_text())
    (folder / MANIFEST).write_text(json.dumps({'homes': [{**entry, 'events': 1}]}))
    assert [line.partition(': ')[2] for line in validate(folder).wrong[
        'a file is as it is listed']] == ['does not list home as home.json does']
    (folder / MANIFEST).unlink()
    assert validate(folder).count == 0
    (folder / 'casas.txt').write_text((folder / 'casas.txt').read_text() + '\n')
    assert 'casas.txt was changed' in validate(folder).wrong['a file is as it is listed']
    (folder / HOME).unlink()
    assert validate(folder).count


def test_the_manifest_and_the_folder_have_the_same_homes(good: Path, tmp_path: Path) -> None:
    entry = json.loads((good / HOME).read_text())
    for name in ('one', 'two', 'three'):
        shutil.copytree(good, tmp_path / name)
        (tmp_path / name / HOME).write_text(json.dumps({**entry, 'name': name}))
    shutil.copytree(tmp_path / 'one', tmp_path / 'copy')
    (tmp_path / 'three' / 'layout.json').unlink()
    (tmp_path / MANIFEST).write_text(json.dumps(
        {'homes': [{**entry, 'name': name} for name in ('one', 'three', 'four', 'one')]}))
    findings = validate_all(tmp_path)[0]
    assert [line.rpartition(f'{MANIFEST}: ')[2] for line in findings.wrong[
        'a file is as it is listed']] == [
        'does not list copy as home.json does', 'does not list two as home.json does',
        'does not list copy', 'lists four, which is missing', 'lists one twice',
        'lists three, which is missing', 'does not list two']
    for name in ('two', 'three', 'copy'):
        shutil.rmtree(tmp_path / name)
    (tmp_path / MANIFEST).write_text(json.dumps({'homes': [{**entry, 'name': 'one'}]}))
    assert validate_all(tmp_path)[0].count == 0


def test_the_manifest_of_one_home_lists_one(good: Path, tmp_path: Path) -> None:
    folder = copied(good, tmp_path)
    entry = json.loads((folder / HOME).read_text())
    (folder / MANIFEST).write_text(json.dumps({'homes': [entry, {**entry, 'name': 'other'}]}))
    assert validate_all(folder)[0].count == 1
    (folder / MANIFEST).unlink()
    (folder / MANIFEST).mkdir()
    with pytest.raises(Failure, match='is not a file'):
        validate(folder)


def test_good_data_has_no_finding(good: Path, tmp_path: Path) -> None:
    findings = validate(good)
    assert {check: wrong for check, wrong in findings.wrong.items() if wrong} == {}
    assert findings.shares['explained'] == 1.0 and findings.shares['missed'] == 0.0
    Tables(copied(good, tmp_path)).write()
    assert validate(tmp_path / 'home').count == 0


def test_what_a_listed_fault_has_lost_is_no_finding(good: Path, tmp_path: Path) -> None:
    tables = Tables(copied(good, tmp_path))
    broken = tables.ids('motion', 'kitchen')[0]
    tables.drop('events', lambda row: row['sensor'] == broken)
    tables.faults.append({'time': '1.000', 'sensor': broken, 'fault': 'dropout', 'detail': 'ON'})
    tables.entry['settings']['faults'] = 64 * '0'
    tables.write()
    assert validate(tables.folder).count == 0


@pytest.mark.parametrize('places, wrong', [
    ([(-2.0, 0.0, 0), (-2.0, 0.0, 1)], []),  # in the cabin
    ([(2.0, 0.0, 0), (2.0, 0.0, 1)], ['ann at 0.4 on floor 1, before on floor 0']),
    ([(2.0, 0.0, 9)], ['ann at 0.0 on floor 9, before on floor 9'])])
def test_who_walks_changes_floors_in_a_cabin(places: list[tuple[float, float, int]],
                                             wrong: list[str]) -> None:
    home: Any = SimpleNamespace(
        layout={'rooms': [{'storey': 0}, {'storey': 1}], 'landings': [
            {'elevator': 'lift', 'storey': storey, 'pose': [0.0, 0.0, 3.0 * storey, 3.1416]}
            for storey in (0, 1)]},
        track=[{'resident': 'ann', 'time': f'{0.4 * i:.1f}', 'x': f'{x}', 'y': f'{y}',
                'storey': f'{storey}'} for i, (x, y, storey) in enumerate(places)])
    findings = Findings()
    table_checks._floors(findings, home)
    assert findings.wrong['who walks is on a floor of the home'] == wrong


def test_the_world_of_the_data_has_their_layout(good: Path, tmp_path: Path) -> None:
    """That of the built-in apartment needs no file; another one is told."""
    world = tmp_path / 'home.world'
    world.write_text('<sdf version="1.6"><world name="w"/></sdf>')
    wrong = validate_all(good, world)[0].wrong
    assert wrong['the layout is that of its world'] == [
        f'home: {world} is not the world of the data']
    with pytest.raises(Failure, match='is not a file'):
        validate_all(good, tmp_path / 'none.world')


@pytest.mark.parametrize('room, checked', [('bedroom0', 1), ('bedroom1', 0)])
def test_the_front_of_a_thing_is_in_its_room(room: str, checked: int) -> None:
    """The sensor of a door, or of a front on the floor above, is that of another thing."""
    sensors = [{'id': 'D001', 'kind': 'door', 'name': 'front', 'room': room, 'x': 1.0, 'y': 0.5},
               {'id': 'D002', 'kind': 'door', 'name': 'hall_contact', 'room': 'bedroom0',
                'x': 1.0, 'y': 0.2}]
    home: Any = SimpleNamespace(
        layout={'doors': [{'name': 'hall'}], 'sensors': sensors}, faulty=set(), people={'ann'},
        things={'it': {'type': 'wardrobe', 'room': 'bedroom0', 'x': 1.0, 'y': 0.0}},
        truth=[{'resident': 'ann', 'activity': 'dress', 'phase': 'does', 'thing': 'it', 'note': '',
                'start': '10.0', 'end': '90.0'}], states=lambda name: [])
    findings = Findings()
    sensor_checks._fronts(findings, home)
    assert findings.checked['who uses a thing opens it'] == checked


@pytest.mark.parametrize('missed, passes, few', [
    (0, 0, True), (4, 195, True), (9, 195, True), (10, 195, False), (3, 10, False),
    (200, 10000, True), (260, 10000, False)])
def test_a_share_of_few_walks_has_the_tolerance_of_their_number(missed: int, passes: int, few: bool
                                                                ) -> None:
    assert sensor_checks._is_few(missed, passes) == few


@pytest.mark.parametrize('listed, found', [(1.0, ''), (1.8, '0.56'), (0.8, '1.25')])
def test_the_usual_speed_is_that_of_walks_and_not_of_who_waits(listed: float, found: str) -> None:
    """Ann walks 3 m at 1 m/s four times, and stands in the doorway for a minute after each."""
    track = [{'resident': 'ann', 'time': f'{100 * walk + step * 0.4}', 'storey': '0',
              'x': f'{min(step * 0.4, 3.2)}', 'y': '0.0'}
             for walk in range(4) for step in range(150)]
    home: Any = SimpleNamespace(speeds={'ann': listed}, names=['ann'], people={'ann'}, track=track,
                                layout={'rooms': [], 'doors': []})
    findings = Findings()
    place_checks._walls(findings, home)
    texts = [text for text in findings.wrong['no speed above their own'] if 'walks at' in text]
    assert texts == [f'ann walks at {found} times the speed in layout.json'] * bool(found)


@pytest.mark.parametrize('phase, posture, seconds, found', [
    ('does', 'stand', 12000.0, 1), ('waits', 'stand', 12000.0, 1), ('waits', 'stand', 1000.0, 0),
    ('does', 'stand', 1000.0, 1), ('does', 'lie', 12000.0, 0)])
def test_a_sleeper_who_stands_is_noticed_in_spite_of_a_note(
        phase: str, posture: str, seconds: float, found: int) -> None:
    """In r1-207 dora stood beside the bed for 3.4 h, as bert was on it."""
    rows = [('0', f'{seconds}', 'sleep', phase, posture, 'dora: bert is on bedroom_bed0'),
            (f'{seconds}', '86400', 'sleep', 'does', 'lie', '')]
    home: Any = SimpleNamespace(people={'dora'}, truth=[
        {'resident': 'dora', **dict(zip(('start', 'end', 'activity', 'phase', 'posture', 'note'),
                                        row))} for row in rows])
    findings = Findings()
    label_checks._lies(findings, home)
    assert findings.count == found
