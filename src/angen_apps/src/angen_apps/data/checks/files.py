"""Checks each file of a home against its list, and against the files from which it follows."""
from __future__ import annotations

import gzip
import tempfile
from itertools import zip_longest
from pathlib import Path
from typing import Any

from angen_apps.data.formats import FORMATS
from angen_apps.data.generate import HOME, MANIFEST, TRUTH, sha256
from angen_apps.data.recorder import VALUES
from angen_apps.data.written import Findings, Written, parsed
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure
from angen_tools.common.text_file import shortened

LISTED, FOLLOWS = 'a file is as it is listed', 'a file follows from truth and events'


def check(findings: Findings, home: Written) -> None:
    """All checks of files."""
    path = home.folder / HOME
    entry = parsed(path) if path.is_file() else None
    try:
        files, settings = dict(entry['files']), dict(entry['settings'])
        formats = [str(name) for name in settings['formats']]
        seed = int(settings['seed'])
    except (KeyError, TypeError, ValueError):
        findings.say(LISTED, False, f'{path}: is missing, or has no files and settings')
        return
    _listed(findings, home, entry, files)
    _manifest(findings, home, entry)
    _ids(findings, home)
    for name in dict.fromkeys((*formats, 'csv')):
        if name not in FORMATS:
            findings.say(LISTED, False, f'{path}: {name} is not a format')
        elif entry.get('version') == angen_module().__version__:
            _follows(findings, home, name, seed, files)


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
                 if (folder / MANIFEST).is_file()), None)
    if path is not None:
        homes = parsed(path)
        listed = homes.get('homes', []) if isinstance(homes, dict) else []
        findings.say(LISTED, entry in listed, f'{path}: does not list {home.folder.name} as '
                     f'{HOME} does')


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
    try:
        number = float(value)
    except ValueError:
        return False
    return {'temperature': -30 <= number <= 60, 'light': 0 <= number <= 100,
            'mains': 0 <= number <= 1e5}.get(kind, False)


def _follows(findings: Findings, home: Written, name: str, seed: int,
             files: dict[str, str]) -> None:
    """The files of a format are those that its writer makes of truth, events and loads."""
    with tempfile.TemporaryDirectory(prefix='angen_') as scratch:
        try:
            made = FORMATS[name](Path(scratch), home.data(seed))
        except (Failure, KeyError, ValueError) as error:
            findings.say(FOLLOWS, False, f'{name}: cannot be made of truth and events: {error}')
            return
        for path in made:
            own = home.folder / path.relative_to(scratch)
            shown = str(own.relative_to(home.folder))
            findings.say(LISTED, shown in files, f'{shown} is not listed')
            wrong = _difference(own, path) if own.is_file() else 'is missing'
            findings.say(FOLLOWS, not wrong, f'{shown}{wrong}')


def _difference(own: Path, made: Path) -> str:
    """The first line in which two files differ; empty if they do not."""
    if own.suffix == '.parquet':
        from angen_apps.data.formats.table import pyarrow
        parquet = pyarrow().parquet
        return '' if parquet.read_table(own).equals(parquet.read_table(made)) else ' differs'
    try:
        texts = [(gzip.decompress(path.read_bytes()) if path.suffix == '.gz'
                  else path.read_bytes()) for path in (own, made)]
    except (OSError, EOFError) as error:
        return f' cannot be read: {error}'
    if texts[0] == texts[1]:
        return ''
    for number, (line, right) in enumerate(zip_longest(*(text.splitlines() for text in texts),
                                                       fillvalue=b'nothing'), 1):
        if line != right:
            return (f':{number}: is {shortened(line.decode(errors="replace"))}, must be '
                    f'{shortened(right.decode(errors="replace"))}')
    return ' differs'
