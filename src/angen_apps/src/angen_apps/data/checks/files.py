"""Checks each file of a home against its list, and against the files from which it follows."""
from __future__ import annotations

import os
import tempfile
import zlib
from collections import Counter
from pathlib import Path
from typing import Any

from angen_apps.data.formats import FORMATS
from angen_apps.data.generate import CABINS, HOME, MANIFEST, TALKS, TRUTH, sha256
from angen_apps.data.recorder import TAP, VALUES
from angen_apps.data.shapes import shown
from angen_apps.data.tables import ENTRY, HOMES, MANIFEST_SIZE, opened, parsed
from angen_apps.data.written import Findings, Written
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure
from angen_tools.common.text_file import shortened

LISTED, FOLLOWS = 'a file is as it is listed', 'a file follows from truth and events'
BLOCK = 1 << 16  # bytes of a line that are compared at a time


def check(findings: Findings, home: Written) -> None:
    """All checks of files."""
    path = home.folder / HOME
    if not path.exists():
        findings.say(LISTED, False, f'{path}: is missing')
        return
    entry = parsed(path, ENTRY)
    files, settings = entry['files'], entry['settings']
    _listed(findings, home, entry, files)
    _manifest(findings, home, entry)
    _ids(findings, home)
    days = home.layout['days']
    last = max((float(row['end']) for row in home.truth), default=0.0)
    if len(home.truth) < days or last < home.end - 1.0:  # else days without data are written
        findings.say(FOLLOWS, False, f'layout.json has {days} days, the truth {len(home.truth)} '
                     f'lines until {last:.3f}')
        return
    known = {*TRUTH, CABINS, TALKS}
    for name in dict.fromkeys((*settings['formats'], 'csv')):
        if name not in FORMATS:
            findings.say(LISTED, False, f'{path}: {name} is not a format')
        elif entry.get('version') == angen_module().__version__:
            known |= _follows(findings, home, name, settings['seed'], files)
    if entry.get('version') == angen_module().__version__:
        for name in sorted(files):
            findings.say(LISTED, name in known, f'{path}: lists {shown(name)}, which is of none of '
                         'its formats')


def _listed(findings: Findings, home: Written, entry: Any, files: dict[str, str]) -> None:
    """Files have the hashes of the list, which has as many events as there are."""
    for name in sorted({*files, *TRUTH}):
        path = home.folder / name
        findings.say(LISTED, path.is_file() and files.get(name) == sha256(path),
                     f'{name} ' + ('was changed' if path.is_file() and name in files
                                   else 'is missing' if name in files else 'is not listed'))
    counts = {'events': len(home.events), 'missed': len(home.missed), 'faults': len(home.faults),
              'sensors': len(home.layout['sensors']),
              'residents': [[r['name'], r.get('profile')] for r in home.layout['residents']]}
    for key, count in counts.items():
        findings.say(LISTED, entry.get(key) == count,
                     f'{HOME}: {key} is {shortened(str(entry.get(key)))}, the files have {count}')
    findings.say(LISTED, not home.faults or bool(entry['settings'].get('faults')),
                 f'{HOME}: has no faults, faults.csv has {len(home.faults)}')
    days = entry['settings'].get('days')
    findings.say(LISTED, days == home.layout['days'],
                 f'{HOME}: days is {days}, layout.json has {home.layout["days"]}')


def _manifest(findings: Findings, home: Written, entry: Any) -> None:
    path = next((folder / MANIFEST for folder in (home.folder, home.folder.parent)
                 if os.path.lexists(folder / MANIFEST)), None)
    if path is not None:
        own = path.parent == home.folder or entry.get('name') == home.folder.name
        findings.say(LISTED, own and entry in parsed(path, HOMES, MANIFEST_SIZE)['homes'],
                     f'{path}: does not list {home.folder.name} as {HOME} does')


def check_folder(findings: Findings, folder: Path, homes: list[Path]) -> None:
    """The manifest of an output folder lists each home that is in it once, and no other one."""
    path = folder / MANIFEST
    if not os.path.lexists(path):
        return
    listed = Counter(entry['name'] for entry in parsed(path, HOMES, MANIFEST_SIZE)['homes'])
    if homes == [folder]:
        findings.say(LISTED, listed.total() == 1,
                     f'{path}: lists {listed.total()} homes, the folder is one')
        return
    there = {home.name for home in homes}
    for name in sorted({*listed, *there}):
        findings.say(LISTED, name in there, f'{path}: lists {shown(name)}, which is missing')
        findings.say(LISTED, listed[name] > 0, f'{path}: does not list {name}')
        findings.say(LISTED, listed[name] < 2, f'{path}: lists {shown(name)} twice')


def _ids(findings: Findings, home: Written) -> None:
    """Events are in order, in the days, of sensors that there are, in their rooms."""
    check, last = 'events are of the sensors', 0.0
    for time, row in zip(home.times, home.events):
        sensor = home.sensors.get(row['sensor'])
        where = f'{row["time"]} {row["sensor"]} {row["value"]}'
        findings.say(check, sensor is not None, f'{where}: no such sensor')
        findings.say(check, last <= time <= home.end + 1e-6, f'{where}: is not in order')
        last = time
        if sensor is not None:
            findings.say(check, (row['kind'], row['room']) == (sensor['kind'], sensor['room']),
                         f'{where}: {row["kind"]} in {row["room"]}, layout.json has '
                         f'{sensor["kind"]} in {sensor["room"]}')
            findings.say(check, _is_value(sensor['kind'], row['value']), f'{where}: no such value')
        person = row['resident']
        findings.say(check, not person or person in home.names, f'{where}: no resident {person}')


def _is_value(kind: str, value: str) -> bool:
    if kind in VALUES:
        return value in VALUES[kind]
    if kind == 'bell':
        return value == TAP
    try:
        number = float(value)
    except ValueError:
        return False
    return {'temperature': -30 <= number <= 60, 'light': 0 <= number <= 100,
            'mains': 0 <= number <= 1e5}.get(kind, False)


def _follows(findings: Findings, home: Written, name: str, seed: int,
             files: dict[str, str]) -> set[str]:
    """The files of a format are those that its writer makes of truth, events and loads; returns
    their names."""
    names: set[str] = set()
    with tempfile.TemporaryDirectory(prefix='angen_') as scratch:
        try:
            made = FORMATS[name](Path(scratch), home.data(seed))
        except (Failure, KeyError, ValueError) as error:
            findings.say(FOLLOWS, False, f'{name}: cannot be made of truth and events: {error}')
            return set(files)
        for path in made:
            own = home.folder / path.relative_to(scratch)
            path_in = str(own.relative_to(home.folder))
            names.add(path_in)
            findings.say(LISTED, path_in in files, f'{path_in} is not listed')
            wrong = _difference(own, path) if own.is_file() else ' is missing'
            findings.say(FOLLOWS, not wrong, f'{path_in}{wrong}')
    return names


def _difference(own: Path, made: Path) -> str:
    """The first line in which two files differ; empty if they do not."""
    if own.suffix == '.parquet':
        from angen_apps.data.formats.table import pyarrow
        arrow = pyarrow()
        try:
            same = arrow.parquet.read_table(own).equals(arrow.parquet.read_table(made))
        except (OSError, arrow.ArrowException) as error:
            return f' cannot be read: {error}'
        return '' if same else ' differs'
    number = 1
    try:
        with opened(own) as file, opened(made) as other:
            while (line := file.readline(BLOCK)) == (right := other.readline(BLOCK)):
                if not line:
                    return ''
                number += line.endswith(b'\n')
    except (OSError, EOFError, zlib.error) as error:
        return f':{number}: cannot be read from here: {error}'
    return f':{number}: is {_part(line)}, must be {_part(right)}'


def _part(line: bytes) -> str:
    """A line, or the part that is read, for an error."""
    return shown(line.decode(errors='replace').rstrip('\n')) if line else 'nothing'
