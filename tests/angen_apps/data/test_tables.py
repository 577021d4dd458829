"""Damaged files of a home's data: one line with the file and the place in it, for each reader."""
from __future__ import annotations

import copy
import gzip
import json
import os
import re
import tracemalloc
from pathlib import Path
from typing import Any, Callable

import pytest

from angen_apps.data import realism, tables, transfer
from angen_apps.data.formats.casas import TYPES
from angen_apps.data.tables import EVENTS, TRACK, layout_of, rows
from angen_apps.data.validate import validate
from angen_apps.web.day import Day
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure

LAYOUT: dict[str, Any] = {
    'start': '2026-03-02T00:00:00', 'days': 1, 'residents': [{'name': 'ann', 'speed': 1.0}],
    'rooms': [], 'doors': [], 'landings': [], 'things': [], 'sensors': []}


@pytest.mark.parametrize('layout, what', [
    ({'x': 1}, 'layout.json has no start'),
    ([], 'layout.json must be an object'),
    ({**LAYOUT, 'days': 'two'}, 'layout.json: days is two, must be a whole number from 1 to 36525'),
    ({**LAYOUT, 'days': float('nan')}, 'layout.json: days is nan'),
    ({**LAYOUT, 'start': 5}, 'layout.json: start is 5'),
    ({**LAYOUT, 'residents': [{'name': 'ann'}]}, r'layout.json: residents\[0\] has no speed'),
    ({**LAYOUT, 'rooms': {}}, 'layout.json: rooms must be a list'),
    ({**LAYOUT, 'doors': [{'name': 'a', 'kind': 'door', 'width': 1, 'rooms': [],
                           'pose': [0, 0, 0, None]}]}, r'doors\[0\].pose\[3\] is null')])
def test_a_damaged_layout(layout: Any, what: str, tmp_path: Path) -> None:
    (tmp_path / 'layout.json').write_text(json.dumps(layout))
    with pytest.raises(Failure, match=what):
        validate(tmp_path)


@pytest.mark.parametrize('change, what', [
    ({'things.0': 'again'}, r'things[1].name is sofa, must differ from that of things[0]'),
    ({'guests.0': 'again'}, 'guests[1].name is bob, must differ from those of the other residents '
     'and guests'),
    ({'rooms.0.area': 1e6}, 'rooms[0].area is 1000000, its polygon has 81.0000 m2'),
    ({'doors.0.rooms': ['narnia', '']}, 'doors[0].rooms has narnia, must have rooms, or an empty '
     'text for outside'),
    ({'doors.0.rooms': ['hall']}, 'doors[0].rooms must have 2 entries')])
def test_a_layout_that_contradicts_itself(change: dict[str, Any], what: str, tmp_path: Path
                                          ) -> None:
    layout = copy.deepcopy(WHOLE)
    for place, value in change.items():
        part, number, *key = place.split('.')
        if key:
            layout[part][int(number)][key[0]] = value
        else:
            layout[part].append(layout[part][int(number)])
    (tmp_path / 'layout.json').write_text(json.dumps(layout))
    with pytest.raises(Failure, match=re.escape(f'layout.json: {what}')):
        layout_of(tmp_path)


def track(folder: Path, text: str) -> Path:
    path = folder / 'track.csv.gz'
    path.write_bytes(gzip.compress(text.encode()))
    return path


@pytest.mark.parametrize('text, what', [
    ('time,resident,x,y\n', ':1: has no column storey'),
    ('', ':1: has no column time'),
    ('time,resident,x,y,storey\n1,ann,2,3,0\n2,ann,nan,3,0\n', ':3: x is nan'),
    ('time,resident,x,y,storey\n1,ann,2\n', ':2: y is missing'),
    ('time,resident,x,y,storey\n1,ann,2,3,0,4,5,6\n', ':2: has 8 cells, must have 5'),
    ('time,resident,x,y,storey\n1,ann,\uff12,3,0\n', ':2: x is \uff12, must be a number'),
    ('time,resident,x,y,storey\n1,ann,2,3,first\n', ':2: storey is first'),
    ('time,resident,x,y,storey\n' + 'x' * 100_000, ':2: has a line of more than')])
def test_a_damaged_table(text: str, what: str, tmp_path: Path) -> None:
    path = track(tmp_path, text)
    with pytest.raises(Failure, match=f'{path}{what}'):
        list(rows(path, TRACK))


def test_a_torn_file(tmp_path: Path) -> None:
    path = track(tmp_path, 'time,resident,x,y,storey\n' + '1,ann,2,3,0\n' * 1000)
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(Failure, match='cannot be read'):
        list(rows(path, TRACK))


def test_a_line_of_gigabytes_takes_little_memory(tmp_path: Path) -> None:
    path = tmp_path / 'events.csv.gz'
    with gzip.open(path, 'wb', 1) as file:
        for _ in range(200):
            file.write(bytes(1 << 20))
    tracemalloc.start()
    with pytest.raises(Failure, match=':1: has a line of more than'):
        list(rows(path, EVENTS))
    assert tracemalloc.get_traced_memory()[1] < 10e6
    tracemalloc.stop()


# --- a whole folder, of which one value is damaged

WHOLE: dict[str, Any] = {
    'start': '2026-03-02T00:00:00', 'days': 1,
    'residents': [{'name': 'ann', 'profile': 'worker', 'body': 'person', 'speed': 1.0}],
    'guests': [{'name': 'bob', 'host': 'ann'}],
    'rooms': [{'name': 'hall', 'use': 'hall', 'storey': 0, 'holes': [],
               'polygon': [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]}],
    'doors': [{'name': 'front', 'kind': 'door', 'rooms': ['hall', ''], 'width': 0.9,
               'pose': [0.0, 4.0, 0.0, 1.57]}],
    'landings': [{'elevator': 'lift', 'storey': 0, 'pose': [9.0, 4.0, 0.0, 0.0]}],
    'things': [{'name': 'sofa', 'type': 'sofa', 'room': 'hall', 'x': 2.0, 'y': 2.0}],
    'sensors': [{'id': 'M001', 'kind': 'motion', 'name': 'cell_hall_00', 'room': 'hall',
                 'x': 3.0, 'y': 3.0, 'z': 2.7},
                {'id': 'P001', 'kind': 'mains', 'name': 'mains', 'room': '',
                 'x': 0.0, 'y': 0.0, 'z': 0.0}]}
ENTRY: dict[str, Any] = {
    'name': 'home', 'version': 'another', 'files': {'truth.csv.gz': ''},
    'settings': {'days': 1, 'seed': 1, 'formats': ['csv'], 'world': '', 'own_sensors': False,
                 'light': False, 'faults': ''}}
TABLES = {
    'truth': 'start,end,resident,activity,cause,phase,room,thing,posture,x,y,note\n'
             '0,50000,ann,read,free,does,hall,sofa,sit,2.0,2.0,\n'
             '0,86400,bob,leave,scheduled,away,,,,nan,nan,\n'
             '50000,86400,ann,read,free,goes,hall,,stand,3.0,3.0,\n',
    'events': 'time,sensor,kind,room,value,resident,activity,cause\n'
              '2026-03-02 10:00:00.000000,M001,motion,hall,ON,ann,read,motion\n'
              '2026-03-02 10:00:05.000000,M001,motion,hall,OFF,ann,read,motion\n'
              '2026-03-02 10:00:06.000000,P001,mains,,80,,,power\n',
    'track': 'time,resident,x,y,storey\n50000.2,ann,2.5,2.5,0\n',
    'loads': 'time,kind,device,watts\n0,lamp,hall,10\n',
    'moves': 'time,resident\n100,ann\n'}
MISSED, FAULTS = 'start,end,sensor,resident\n1,2,M001,ann\n', 'time,sensor,fault,detail\n'


def whole(folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / 'layout.json').write_text(json.dumps(WHOLE))
    (folder / 'home.json').write_text(json.dumps(ENTRY))
    (folder / 'missed.csv').write_text(MISSED)
    (folder / 'faults.csv').write_text(FAULTS)
    for name, text in TABLES.items():
        (folder / f'{name}.csv.gz').write_bytes(gzip.compress(text.encode(), 1))
    return folder


def damaged(of: dict[str, Any], place: str, value: Any) -> str:
    """The JSON of an object with another value at keys between dots."""
    made = copy.deepcopy(of)
    *way, last = [int(key) if key.isdigit() else key for key in place.split('.')]
    inner: Any = made
    for key in way:
        inner = inner[key]
    inner[last] = value
    return json.dumps(made)


def said(read: Callable[[Path], object], folder: Path) -> str:
    """The line of a reader's Failure; '' if it reads all."""
    try:
        read(folder)
    except Failure as failure:
        assert len(str(failure).splitlines()) == 1 and len(str(failure)) < 400
        return str(failure)
    return ''


class Read(Exception):
    """The folder is read, and the world would be made."""


@pytest.fixture
def replay(monkeypatch: pytest.MonkeyPatch) -> Callable[[Path], object]:
    """The reader of angen web --replay, without the world."""
    def stop(*_: object) -> None:
        raise Read
    monkeypatch.setattr(Day, '_furnished', stop)

    def read(folder: Path) -> None:
        with pytest.raises(Read):
            Day(folder, None)
    return read


def test_a_whole_folder_is_read(tmp_path: Path, replay: Callable[[Path], object]) -> None:
    folder = whole(tmp_path)
    assert said(validate, folder) == said(replay, folder) == said(realism.read, folder) == ''
    assert transfer._uses(folder, None) == {'M001': 'hall', 'P001': 'hall'}
    assert set(tables.KINDS) == set(TYPES)


ODD: list[tuple[str, Any]] = [  # of layout.json
    *((f'{kind}.0.{key}', value) for value in (None, 5, [1])
      for kind, keys in (('residents', 'name'), ('guests', 'name host'), ('rooms', 'name use'),
                         ('doors', 'name kind'), ('things', 'name type room'),
                         ('sensors', 'name id kind room')) for key in keys.split()),
    *(('days', value) for value in (0, -1, 1.5, 1e308, 1_000_000, 10 ** 300, True, 'x', None, [])),
    *(('start', value) for value in ('2026-03-02T00:00:00+02:00', '9999-12-31T00:00:00', '', 5)),
    *(('rooms.0.holes', value) for value in (None, 'x', 5, [1], [[1, 2, 3]], [[[0, 0]]])),
    *(('rooms.0.polygon', value) for value in ([], [[0, 0], [1, 1]], [[0, 0, 0]] * 3, [['0', 0]])),
    *(('doors.0.pose', value) for value in ([1], [], None, [0, 0, 0, '1'], [0, 0, 0, 1e308])),
    *(('landings.0.pose', value) for value in ([1], 'x')),
    ('rooms.0.storey', 0.5), ('rooms.0.storey', 10 ** 30), ('rooms.0.polygon.2', [9999.0, 9999.0]),
    ('doors.0.rooms', 'hall'), ('doors.0.rooms.0', None), ('doors.0.width', '1'),
    ('things.0.x', float('nan')), ('things.0.y', -float('inf')), ('sensors.0.z', True),
    ('sensors.0.kind', 'radar'), ('residents.0.speed', 0), ('residents.0.speed', 1e308),
    ('residents.0.name', '../../ann'), ('residents.0.name', '/tmp/ann'),
    ('residents.0.profile', '../ann'), ('residents.0.body', []), ('guests.0.host', 'eve'),
    ('rooms.0.name', 'a\ud800'), ('rooms.0.name', 'a\nb'), ('things.0.name', 'x' * 2000),
    *((key, value) for key in ('residents', 'guests', 'rooms', 'doors', 'landings', 'things',
                               'sensors') for value in (None, {}, 'x', [None], [[]], [{}])),
    ('more', [[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]), ('more', '\0')]


@pytest.mark.parametrize('place, value', ODD)
def test_a_damaged_value_of_the_layout(place: str, value: Any, tmp_path: Path,
                                       replay: Callable[[Path], object]) -> None:
    folder = whole(tmp_path)
    (folder / 'layout.json').write_text(damaged(WHOLE, place, value))
    line = said(validate, folder)
    assert line.startswith(f'{folder}/layout.json: ')
    assert line == said(replay, folder) == said(realism.read, folder)
    assert line == said(lambda home: transfer._uses(home, None), folder)


@pytest.mark.parametrize('text, what', [
    ('[' * 100_000 + ']' * 100_000, ': is not JSON of ours: maximum recursion depth'),
    ('{"days":\n1' + '0' * 5000 + '}', ': is not JSON of ours: Exceeds the limit'),
    ('{\n"days": ', ':2: is not JSON: Expecting value'), ('', ':1: is not JSON'),
    ('[]', ' must be an object, is a list'), ('5', ' must be an object, is 5')])
@pytest.mark.parametrize('name', ['layout.json', 'home.json'])
def test_a_damaged_json_file(name: str, text: str, what: str, tmp_path: Path,
                             replay: Callable[[Path], object]) -> None:
    folder = whole(tmp_path)
    (folder / name).write_text(text)
    line = said(validate, folder)
    assert line.startswith(f'{folder}/{name}{what}') and line == said(replay, folder)


@pytest.mark.parametrize('place, value', [
    ('settings', 5), ('files', 5), ('files', {'../x': ''}), ('files', {'/etc/x': ''}),
    ('files', {'a': 5}), ('settings.seed', 1e308), ('settings.seed', -1), ('settings.seed', '1'),
    ('settings.formats', 'csv'), ('settings.formats', [None]), ('settings.world', None),
    ('settings.light', 1), ('settings.own_sensors', None), ('version', '\ud800')])
def test_a_damaged_value_of_the_list(place: str, value: Any, tmp_path: Path,
                                     replay: Callable[[Path], object]) -> None:
    folder = whole(tmp_path)
    (folder / 'home.json').write_text(damaged(ENTRY, place, value))
    line = said(validate, folder)
    assert line.startswith(f'{folder}/home.json: ') and line == said(replay, folder)


@pytest.mark.parametrize('text', ['5', '[]', '{}', '{"homes": 5}', '{"homes": [5]}', '[' * 10_000])
def test_a_damaged_manifest(text: str, tmp_path: Path) -> None:
    folder = whole(tmp_path)
    (folder / 'manifest.json').write_text(text)
    assert said(validate, folder).startswith(f'{folder}/manifest.json')


@pytest.mark.parametrize('table, line, column, value, what', [
    ('truth', 2, 'start', '1e308', 'start is 1e308, must be a number from 0 to'),
    ('truth', 2, 'end', '-1', 'end is -1, must be a number from 0 to'),
    ('truth', 2, 'phase', 'flies', 'phase is flies, must be goes, does, waits or away'),
    ('truth', 2, 'posture', '', 'posture is empty, must be one if'),
    ('truth', 2, 'x', 'nan', 'x and y are nan and 2.0, must be numbers or both nan'),
    ('truth', 3, 'y', 'inf', 'y is inf, must be a number'),
    ('truth', 2, 'note', 'x' * 2000, 'note is xxx'),
    ('track', 2, 'x', '1e308', 'x is 1e308, must be a number'),
    ('track', 2, 'y', 'nan', 'y is nan, must be a number'),
    ('track', 2, 'storey', '1' * 400, 'storey is 111'),
    ('events', 2, 'time', '9999-12-31', 'time is 9999-12-31, must be a date'),
    ('events', 2, 'time', '2026-03-02T00:00:00Z', 'time is 2026-03-02T00:00:00Z, must be'),
    ('events', 4, 'value', 'x', 'value of a sensor of mains is x, must be a number'),
    ('events', 2, 'kind', 'mains', 'value of a sensor of mains is ON, must be a number'),
    ('events', 2, 'sensor', 'P001', 'value of a sensor of mains is ON, must be a number'),
    ('loads', 2, 'watts', '-5', 'watts is -5, must be a number from 0'),
    ('loads', 2, 'time', '', 'time is empty, must be a number'),
    ('moves', 2, 'time', 'x', 'time is x, must be a number'),
    ('moves', 2, 'resident', '', 'resident is empty, must be a text')])
def test_a_damaged_cell(table: str, line: int, column: str, value: str, what: str, tmp_path: Path,
                        replay: Callable[[Path], object]) -> None:
    folder = whole(tmp_path)
    lines = [row.split(',') for row in TABLES[table].splitlines()]
    lines[line - 1][lines[0].index(column)] = value
    path = folder / f'{table}.csv.gz'
    path.write_bytes(gzip.compress('\n'.join(map(','.join, lines)).encode(), 1))
    told = said(validate, folder)
    assert told.startswith(f'{path}:{line}: {what}')
    assert table == 'moves' or told == said(replay, folder)


@pytest.mark.parametrize('table, column, what', [
    ('truth', 'resident', ':2: resident is eve, must be ann or bob'),
    ('track', 'resident', ':2: resident is eve, must be ann or bob'),
    ('events', 'sensor', ':2: sensor is eve, must be M001 or P001')])
def test_a_replay_knows_who_and_what_is_in_the_layout(
        table: str, column: str, what: str, tmp_path: Path,
        replay: Callable[[Path], object]) -> None:
    folder = whole(tmp_path)
    lines = [row.split(',') for row in TABLES[table].splitlines()]
    lines[1][lines[0].index(column)] = 'eve'
    path = folder / f'{table}.csv.gz'
    path.write_bytes(gzip.compress('\n'.join(map(','.join, lines)).encode(), 1))
    assert said(replay, folder) == f'{path}{what}'
    assert said(validate, folder) == '' and validate(folder).count


@pytest.mark.parametrize('name', [
    'layout.json', 'home.json', 'truth.csv.gz', 'events.csv.gz', 'track.csv.gz', 'moves.csv.gz',
    'loads.csv.gz', 'missed.csv', 'faults.csv', 'talks.csv.gz'])
def test_only_regular_files_are_opened(name: str, tmp_path: Path,
                                       replay: Callable[[Path], object]) -> None:
    folder = whole(tmp_path)
    (folder / name).unlink(missing_ok=True)
    os.mkfifo(folder / name)
    what = 'has no data' if name == 'layout.json' else 'is not a file that can be read'
    readers: list[Callable[[Path], object]] = [validate] if name != 'layout.json' else []
    if name in ('layout.json', 'home.json', 'truth.csv.gz', 'events.csv.gz', 'track.csv.gz',
                'loads.csv.gz'):
        readers.append(replay)
    for read in readers:
        assert what in said(read, folder)


def test_a_table_of_many_lines_takes_little_memory(
        tmp_path: Path, replay: Callable[[Path], object],
        monkeypatch: pytest.MonkeyPatch) -> None:
    folder = whole(tmp_path)
    monkeypatch.setattr(tables, 'DAILY', 1 << 20)
    path = folder / 'track.csv.gz'
    with gzip.open(path, 'wb', 1) as file:
        file.write(b'time,resident,x,y,storey\n')
        for _ in range(100):
            file.write(b'1,ann,1,1,0\n' * 10_000)
    tracemalloc.start()
    line = said(validate, folder)
    assert tracemalloc.get_traced_memory()[1] < 150e6
    tracemalloc.stop()
    found = re.fullmatch(rf'{path}:(\d+): has more than 2 MB, the limit for such a table', line)
    assert found and int(found[1]) == (2 << 20) // 12 and line == said(replay, folder)


def test_a_format_is_not_made_for_days_without_data(tmp_path: Path) -> None:
    folder = whole(tmp_path)
    (folder / 'layout.json').write_text(damaged(WHOLE, 'days', tables.DAYS))
    (folder / 'home.json').write_text(damaged(ENTRY, 'version', angen_module().__version__))
    assert validate(folder).wrong['a file follows from truth and events'] == [
        'layout.json has 36525 days, the truth 3 lines until 86400.000']
