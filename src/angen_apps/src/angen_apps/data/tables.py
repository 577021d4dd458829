"""Reads a home's data again: its tables, with file and line of what cannot be read."""
from __future__ import annotations

import csv
import gzip
import math
import zlib
from datetime import datetime
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping, TextIO

from angen_tools.common.failure import Failure
from angen_tools.common.text_file import shortened

LONGEST = 1 << 14  # characters of a line


def finite(text: str | float) -> float:
    """A number; ValueError for others, and for those that are not finite."""
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f'{text} is not finite')
    return value


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
Columns = Mapping[str, Callable[[str], object]]
TRUTH: Columns = {
    'resident': str, 'start': finite, 'end': finite, 'activity': str, 'phase': str,
    'posture': str, 'room': str, 'thing': str, 'note': str, 'cause': str, 'x': float, 'y': float}
EVENTS: Columns = {
    'time': datetime.fromisoformat, 'sensor': str, 'kind': str, 'value': str, 'cause': str,
    'resident': str, 'room': str, 'activity': str}
TRACK: Columns = {'time': finite, 'resident': str, 'x': finite, 'y': finite, 'storey': int}
MOVES: Columns = {'time': finite, 'resident': str}
MISSED: Columns = {'start': finite, 'end': finite, 'sensor': str, 'resident': str}
FAULTS: Columns = {'time': finite, 'sensor': str, 'fault': str, 'detail': str}
POWER: Columns = {'time': finite, 'kind': str, 'device': str, 'watts': finite}
SLIDES: Columns = {'time': finite, 'model': str, 'link': str, 'x': finite, 'y': finite, 'z': finite}
# keys of layout.json; a list has entries like its one
LAYOUT = {'start': datetime.fromisoformat, 'days': finite,
          'residents': [{'name': str, 'speed': finite}],
          'rooms': [{'name': str, 'use': str, 'storey': int, 'polygon': [[finite]]}],
          'doors': [{'name': str, 'kind': str, 'pose': [finite], 'width': finite, 'rooms': [str]}],
          'landings': [{'elevator': str, 'storey': int, 'pose': [finite]}],
          'things': [{'name': str, 'type': str, 'room': str, 'x': finite, 'y': finite}],
          'sensors': [{'name': str, 'id': str, 'kind': str, 'room': str,
                       'x': finite, 'y': finite, 'z': finite}]}


def rows(path: Path, columns: Columns) -> Iterator[dict[str, str]]:
    """The lines of a CSV file, compressed or not, by column; Failure with file and line for a
    column or a value that is missing or cannot be read."""
    try:
        opened: Any = gzip.open(path, 'rt', encoding='utf-8', newline='') \
            if path.suffix == '.gz' else path.open(encoding='utf-8', newline='')
        with opened as file:
            reader = csv.DictReader(_lines(path, file))
            for column in columns:
                if column not in (reader.fieldnames or ()):
                    raise Failure(f'{path}:1: has no column {column}')
            for row in reader:
                for column, read in columns.items():
                    check_shape(f'{path}:{reader.line_num}: {column}', row[column], read)
                yield row
    except (OSError, EOFError, UnicodeDecodeError, csv.Error, zlib.error) as error:
        raise Failure(f'{path}: cannot be read: {error}') from None


def lines(path: Path) -> Iterator[str]:
    """The lines of a text; Failure if it cannot be read."""
    try:
        with path.open(encoding='utf-8') as file:
            yield from _lines(path, file)
    except (OSError, UnicodeDecodeError) as error:
        raise Failure(f'{path}: cannot be read: {error}') from None


def _lines(path: Path, file: TextIO) -> Iterator[str]:
    number = 0
    while line := file.readline(LONGEST + 1):
        number += 1
        if len(line) > LONGEST:
            raise Failure(f'{path}:{number}: has a line of more than {LONGEST} characters')
        yield line


def check_shape(what: str, value: object, shape: Any) -> None:
    """Failure if a value is not of a shape: a dict of keys, a list of one shape, or a reader."""
    if isinstance(shape, dict):
        if not isinstance(value, dict):
            raise Failure(f'{what} must be an object')
        for key, inner in shape.items():
            if key not in value:
                raise Failure(f'{what} has no {key}')
            check_shape(f'{what}: {key}', value[key], inner)
    elif isinstance(shape, list):
        if not isinstance(value, list):
            raise Failure(f'{what} must be a list')
        for entry in value:
            check_shape(what, entry, shape[0])
    else:
        try:
            shape(value)
        except (TypeError, ValueError):
            raise Failure(f'{what} is {shortened(str(value))}, which cannot be read') from None
