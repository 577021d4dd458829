"""Faults of sensors, of a YAML file: the simulator has them, and says what each has done."""
from __future__ import annotations

import math
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, NamedTuple

from angen_apps.data.site import Site
from angen_tools.common.catalog import simulator
from angen_tools.common.failure import Failure
from angen_tools.common.yaml_file import YamlFile, line_of

PLACE = ('x', 'y', 'z', 'roll', 'pitch', 'yaw')  # m and rad
KINDS = {'dropout': ('share',), 'stuck': ('from', 'lasts'), 'false_alarm': ('per_day',),
         'delay': ('by',), 'duplicate': ('share',), 'clock': ('seconds_per_day',),
         'battery': ('from', 'lasts'), 'moved': ('from',)}
LIMITS = {'share': (0.0, 1.0), 'per_day': (0.0, 1e6), 'seconds_per_day': (-1e4, 1e4)}


@dataclass(frozen=True)
class Fault:
    """One of the sensors whose id matches; `text`: as the simulator takes it."""

    sensors: str
    text: str
    source: str  # file:line


class Happened(NamedTuple):
    """An effect of a fault."""

    time: float
    sensor: str
    fault: str
    detail: str


def read(path: Path) -> list[Fault]:
    """The faults of a YAML file; Failure has file and line of an error."""
    file = YamlFile(path)
    root = file.entries(file.root, 'the file', ('faults',), ('faults',))
    return [_fault(file, node) for node in file.list(root['faults'], 'faults')]


def _fault(file: YamlFile, node: Any) -> Fault:
    known = ('fault', 'sensors', *sorted({key for keys in KINDS.values() for key in keys}), *PLACE)
    entry = file.entries(node, 'a fault', known, ('fault',))
    kind = file.choice(entry['fault'], 'fault', KINDS)
    places = PLACE if kind == 'moved' else ()
    file.entries(node, kind, ('fault', 'sensors', *KINDS[kind], *places), KINDS[kind])
    words = [kind]
    for key in (*KINDS[kind], *places):
        if key in LIMITS:
            words.append(f'{key}={file.number(entry[key], key, *LIMITS[key]):g}')
        elif key in PLACE:
            if key in entry:
                far = math.tau if key in PLACE[3:] else 100.0
                words.append(f'{key}={file.number(entry[key], key, -far, far):g}')
        else:
            least, most = file.span(entry[key], key)
            words.append(f'{key}={least:g}-{most:g}' if key == 'by' else f'{key}={least:g}')
    return Fault(entry.of('sensors', file.text, '*'), ' '.join(words),
                 f'{file.path}:{line_of(node)}')


def give(site: Site, faults: list[Fault]) -> None:
    """Gives faults to a home's sensors; false alarms to those that raise alarms."""
    for fault in faults:
        found = [s for s in site.sensors if fnmatchcase(s.id, fault.sensors)
                 and s.source and s.kind != 'bell'  # a device
                 and (not fault.text.startswith('false_alarm')
                      or s.kind in ('motion', 'area', 'door', 'item'))]
        if not found:
            raise Failure(f"{fault.source}: no sensor with this fault matches '{fault.sensors}'; "
                          f'ids begin with {", ".join(sorted({s.id[0] for s in site.sensors}))}')
        for sensor in found:
            with simulator(f'{fault.source}: '):
                site.world.command('fault', f'{sensor.source}/{sensor.name}', fault.text)
