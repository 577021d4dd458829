"""Reads a home's data again: its files, with the place of what is not as it must be."""
from __future__ import annotations

import csv
import gzip
import io
import json
import math
import zlib
from pathlib import Path
from typing import IO, Any, Callable, Iterator, Mapping, cast

from angen_apps.data.shapes import (DAYS, YEARS, Each, Many, Reader, boolean, check_plain,
                                    check_shape, check_value, clock, figure, inner_path, number,
                                    shown, text, word)
from angen_apps.data.site import LETTERS
from angen_apps.plan.polygons import area
from angen_tools.common.clock import DAY
from angen_tools.common.failure import Failure
from angen_tools.common.output import SEED
from angen_tools.common.text_file import LARGEST, read_text

LONGEST = 1 << 14  # characters of a line
LAYOUT_SIZE = 16 << 20  # bytes of layout.json and home.json, at most
MANIFEST_SIZE = 4 * LARGEST  # bytes of a list of many homes, at most
DAILY = 4 << 20  # characters of a table for each day and person, at most
TABLE = 1 << 30  # characters of a table, at most
AREA = 200_000.0  # m^2 that the rooms of all storeys may span
EXACT = 0.01  # m^2, and share, by which the area of a room may differ from that of its corners
LAST = (DAYS + 1) * DAY  # s


def homes(folder: Path) -> list[Path]:
    """The homes of an output folder; Failure if there are none."""
    if (folder / 'layout.json').is_file():
        return [folder]
    found = sorted(path.parent for path in folder.glob('*/layout.json')
                   if not path.parent.name.endswith('.part'))
    if not found:
        raise Failure(f'{folder}: has no data of angen generate')
    return found


# columns of the files, and how their values are read
Row = dict[str, str]
Columns = Mapping[str, Reader]
TEXT, NAME = text(), text(1)
WHO = text(1, 50, '/')  # who lives there: files have their names
TIME, STAMP = figure(0.0, LAST), figure(-LAST, LAST)  # a faulty clock may be slow
PLACE, STOREY = figure(-1e4, 1e4), figure(-1000, 1000, whole=True)  # m
MAYBE = figure(-1e4, 1e4, nan=True)  # nan: away
WATTS = figure(0.0, 1e7)
PHASES = 'goes', 'does', 'waits', 'away'
POSTURES = '', 'stand', 'sit', 'lie'
CAUSES = 'scheduled', 'free', 'interrupts', 'continues'
KINDS = (*LETTERS, 'mains')  # sensors have these
TRUTH: Columns = {
    'resident': NAME, 'start': TIME, 'end': TIME, 'activity': NAME, 'phase': word(*PHASES),
    'posture': word(*POSTURES), 'room': TEXT, 'thing': TEXT, 'note': TEXT,
    'cause': word(*CAUSES), 'x': MAYBE, 'y': MAYBE}
EVENTS: Columns = {
    'time': clock(YEARS[0] - 1, YEARS[1] + 101), 'sensor': NAME, 'kind': TEXT, 'value': TEXT,
    'cause': TEXT, 'resident': TEXT, 'room': TEXT, 'activity': TEXT}
TRACK: Columns = {'time': TIME, 'resident': NAME, 'x': PLACE, 'y': PLACE, 'storey': STOREY}
MOVES: Columns = {'time': TIME, 'resident': NAME}
TALKS: Columns = {'start': TIME, 'end': TIME, 'resident': NAME, 'to': NAME}
MISSED: Columns = {'start': STAMP, 'end': STAMP, 'sensor': NAME, 'resident': TEXT}
FAULTS: Columns = {'time': STAMP, 'sensor': NAME, 'fault': TEXT, 'detail': TEXT}
POWER: Columns = {'time': TIME, 'kind': NAME, 'device': NAME, 'watts': WATTS}
SLIDES: Columns = {'time': TIME, 'model': NAME, 'link': NAME, 'x': PLACE, 'y': PLACE, 'z': PLACE}
MEASURED = {'temperature': figure(-1e3, 1e3), 'light': figure(0.0, 1e6), 'mains': WATTS}  # by kind

AT = number(-1e4, 1e4)  # m or rad
FLOOR = number(-1000, 1000, whole=True)
POINT, POSE = (AT, AT), (AT, AT, AT, AT)
LAYOUT = {'start': clock(*YEARS), 'days': number(1, DAYS, whole=True),
          'residents': [{'name': WHO, 'speed': number(0.01, 10.0), 'profile?': text(0, 50, '/'),
                         'body?': TEXT}],
          'guests?': [{'name': WHO, 'host': WHO}],
          'rooms': [{'name': NAME, 'use': TEXT, 'storey': FLOOR, 'polygon': Many(POINT, 3),
                     'holes?': [Many(POINT, 3)], 'area?': number(0.0, 1e8)}],
          'doors': [{'name': NAME, 'kind': TEXT, 'pose': POSE, 'width': number(0.0, 100.0),
                     'rooms': (TEXT, TEXT), 'storey?': FLOOR}],
          'landings?': [{'elevator': TEXT, 'storey': FLOOR, 'pose': POSE}],
          'things': [{'name': NAME, 'type': TEXT, 'room': TEXT, 'x': AT, 'y': AT}],
          'sensors': [{'name': NAME, 'id': NAME, 'kind': word(*KINDS), 'room': TEXT,
                       'x': AT, 'y': AT, 'z': AT}]}
ENTRY = {'settings': {'seed': number(0, SEED, whole=True), 'formats': [NAME], 'world': TEXT,
                      'own_sensors': boolean, 'light': boolean},
         'files': Each(inner_path, TEXT)}  # home.json
HOMES: dict[str, Any] = {'homes': [{'name': NAME}]}  # manifest.json


def parsed(path: Path, shape: Any, most: int = LAYOUT_SIZE) -> Any:
    """A JSON file of a shape; Failure if it cannot be read or has another."""
    _check_regular(path)
    written = read_text(path, most)
    try:
        value = json.loads(written)
    except json.JSONDecodeError as error:
        raise Failure(f'{path}:{error.lineno}: is not JSON: {error.msg}') from None
    except (ValueError, RecursionError) as error:  # digits, depth
        raise Failure(f'{path}: is not JSON of ours: {error}') from None
    check_plain(str(path), value)
    check_shape(str(path), value, shape)
    return value


def layout_of(folder: Path) -> Any:
    """The layout of a home; Failure if there is none, or it contradicts itself."""
    path = folder / 'layout.json'
    layout = parsed(path, LAYOUT)
    names = [resident['name'] for resident in layout['residents']]
    _check_once(path, layout)
    for i, guest in enumerate(layout.get('guests', [])):
        if guest['host'] not in names:
            raise Failure(f'{path}: guests[{i}].host is {shown(guest["host"])}, must be one of '
                          'the residents')
    storeys: dict[int, list[tuple[float, float]]] = {}
    for room in layout['rooms']:
        storeys.setdefault(room['storey'], []).extend(room['polygon'])
    spanned = sum(math.prod(max(values) - min(values) for values in zip(*points))
                  for points in storeys.values())
    if spanned > AREA:
        raise Failure(f'{path}: the rooms span {spanned:.0f} m2, must be at most {AREA:.0f}')
    return layout


def _check_once(path: Path, layout: Any) -> None:
    """Failure for two of a name, a door of a room that there is not, and a room's wrong area."""
    for part, *keys in (('rooms', 'name'), ('doors', 'pose', 'kind', 'name'), ('things', 'name'),
                        ('sensors', 'id'), ('landings', 'elevator', 'storey')):
        known: dict[tuple[str, ...], int] = {}
        for i, one in enumerate(layout.get(part, [])):
            first = known.setdefault(tuple(str(one[key]) for key in keys), i)
            if first != i:
                raise Failure(f'{path}: {part}[{i}].{keys[-1]} is {shown(one[keys[-1]])}, must '
                              f'differ from that of {part}[{first}]')
    people = [(part, i, one['name']) for part in ('residents', 'guests')
              for i, one in enumerate(layout.get(part, []))]
    for before, (part, i, name) in enumerate(people):
        if name in (other for *_, other in people[:before]):
            raise Failure(f'{path}: {part}[{i}].name is {shown(name)}, must differ from those of '
                          'the other residents and guests')
    rooms = {room['name'] for room in layout['rooms']}
    for i, door in enumerate(layout['doors']):
        for name in door['rooms']:
            if name and name not in rooms:
                raise Failure(f'{path}: doors[{i}].rooms has {shown(name)}, must have rooms, or '
                              'an empty text for outside')
    for i, room in enumerate(layout['rooms']):
        size = area(room['polygon']) - sum(area(hole) for hole in room.get('holes', []))
        if abs(room.get('area', size) - size) > EXACT + EXACT * size:
            raise Failure(f'{path}: rooms[{i}].area is {room["area"]:.10g}, its polygon has '
                          f'{size:.4f} m2')


class Tables:
    """The tables of a home, whose length has a limit by its layout if there is one."""

    def __init__(self, folder: Path, layout: Any) -> None:
        self.folder, self._most = folder, TABLE
        self._kinds: dict[str, str] = {}
        if layout is not None:
            people = len(layout['residents']) + len(layout.get('guests', []))
            self._most = min(TABLE, DAILY * layout['days'] * max(people, 1))
            self._kinds = {sensor['id']: sensor['kind'] for sensor in layout['sensors']}

    def rows(self, name: str, columns: Columns,
             check: Callable[[Row], None] = lambda row: None) -> Iterator[Row]:
        """The lines of one."""
        return rows(self.folder / name, columns, check, self._most)

    def truth(self, more: Columns | None = None) -> Iterator[Row]:
        """truth.csv.gz; `more`: readers instead of those of TRUTH."""
        return self.rows('truth.csv.gz', {**TRUTH, **(more or {})}, _check_place)

    def events(self, more: Columns | None = None) -> Iterator[Row]:
        """events.csv.gz; `more`: readers instead of those of EVENTS."""
        return self.rows('events.csv.gz', {**EVENTS, **(more or {})}, self._check_measured)

    def _check_measured(self, row: Row) -> None:
        for kind in (row['kind'], self._kinds.get(row['sensor'], '')):
            if kind in MEASURED:
                check_value(f'value of a sensor of {kind}', row['value'], MEASURED[kind])


def _check_place(row: Row) -> None:
    """Who is not away has a posture; both numbers of a place are known or none is."""
    if row['phase'] != 'away' and not row['posture']:
        raise Failure('posture is empty, must be one if the phase is not away')
    if math.isnan(float(row['x'])) != math.isnan(float(row['y'])):
        raise Failure(f'x and y are {row["x"]} and {row["y"]}, must be numbers or both nan')


def rows(path: Path, columns: Columns, check: Callable[[Row], None] = lambda row: None,
         most: int = TABLE) -> Iterator[Row]:
    """The lines of a CSV file, compressed or not, by column; Failure with file and line for a
    column or a value that is missing or not as it must be, or if it has more characters.
    `check`: of a line, raises Failure without its place."""
    reader = csv.DictReader(lines(path, most=most))
    try:
        for column in columns:
            if column not in (reader.fieldnames or ()):
                raise Failure(f'{path}:1: has no column {column}')
        for row in reader:
            try:
                _check_cells(row, columns)
                check(row)
            except Failure as failure:
                raise Failure(f'{path}:{reader.line_num}: {failure}') from None
            yield row
    except csv.Error as error:
        raise Failure(f'{path}:{reader.line_num}: cannot be read: {error}') from None


def _check_cells(row: dict[Any, Any], columns: Columns) -> None:
    """Failure for more cells than the head has, or one that is missing or not as it must be."""
    if None in row:  # the key of cells behind the last column
        raise Failure(f'has {len(row) - 1 + len(row[None])} cells, must have {len(row) - 1}')
    for column, read in columns.items():
        try:
            read(row[column])
        except ValueError as error:
            value = 'missing' if row[column] is None else shown(row[column]) or 'empty'
            raise Failure(f'{column} is {value}, {error}') from None


def _check_regular(path: Path) -> None:
    if not path.is_file():  # a pipe would block
        raise Failure(f'{path}: is not a file that can be read')


def opened(path: Path) -> IO[bytes]:
    """A regular file, unpacked if it is compressed; Failure if it is none."""
    _check_regular(path)
    return cast(IO[bytes], gzip.open(path)) if path.suffix == '.gz' else path.open('rb')


def lines(path: Path, most: int = TABLE, encoding: str = 'utf-8',
          errors: str = 'strict') -> Iterator[str]:
    """The lines of a text, compressed or not; Failure if it cannot be read, has a longer line, or
    more characters. `encoding`, `errors`: as open() has them."""
    count = read = 0
    try:
        with opened(path) as packed, io.TextIOWrapper(packed, encoding, errors) as file:
            while line := file.readline(LONGEST + 1):
                count, read = count + 1, read + len(line)
                if len(line) > LONGEST:
                    raise Failure(f'{path}:{count}: has a line of more than {LONGEST} characters')
                if read > most:
                    raise Failure(f'{path}:{count}: has more than {most >> 20} MB, the limit for '
                                  'such a table')
                yield line
    except UnicodeDecodeError as error:
        raise Failure(f'{path}:{count + 1}: cannot be read from here: {error}') from None
    except (OSError, EOFError, zlib.error) as error:
        raise Failure(f'{path}:{count + 1}: cannot be read from here: {error}') from None
