"""Checks what the tables beside the truth say: causes, floors, talks, and what sensors missed."""
from __future__ import annotations

import math
from collections import defaultdict
from typing import Any

from angen_apps.data.checks.labels import ALWAYS
from angen_apps.data.checks.places import CABIN, STEP
from angen_apps.data.generate import TALKS
from angen_apps.data.recorder import CELL, LEAST
from angen_apps.data.written import Findings, Written
from angen_apps.residents.agenda import RESORT
from angen_apps.residents.user import TV
from angen_apps.residents.profiles import FOLDER, read
from angen_tools.common.geometry import local

PLANNED = 'scheduled', 'free'  # causes of what does not follow from something else
PLACED = 'cell_'  # sensors over a cell
BESIDE = 1.5  # m from the middle of a cabin to its sides, at most
AROUND = 0.4  # m and s by which places of the track may be beside those of a missed cell


def check(findings: Findings, home: Written) -> None:
    """All checks of tables."""
    _causes(findings, home)
    _floors(findings, home)
    _missed(findings, home)
    if (home.folder / TALKS).exists():
        findings.say('people talk with each other', bool(home.talks),
                     f'{TALKS} has no line; there is no such file if nobody talks')


def _causes(findings: Findings, home: Written) -> None:
    """Not all continues or interrupts; what is scheduled, free or a need is so in the profile, if
    that is one of Angen's."""
    check, planned = 'each activity has a cause', set()
    allowed = {resident['name']: _by_cause(str(resident.get('profile', '')))
               for resident in home.layout['residents']}
    allowed.update(dict.fromkeys(home.hosts, {'free': frozenset(), 'interrupts': frozenset()}))
    for row in home.truth:
        who, name, cause = row['resident'], row['activity'], row['cause']
        findings.say(check, name in allowed.get(who, {}).get(cause, {name}),
                     f'{who} at {row["start"]}: {name} is {cause}')
        if cause in PLANNED:
            planned.add(who)
    for who in home.names:
        findings.say(check, who in planned, f'{who}: nothing is {" or ".join(PLANNED)}')


def _by_cause(name: str) -> dict[str, frozenset[str]]:
    """The activities of a profile by their cause, if it is one of Angen's."""
    if not (FOLDER / f'{name}.yaml').is_file():
        return {}
    profile = read(name)
    free = frozenset({*profile.free, RESORT, TV, 'nap'})
    return {'free': free, 'interrupts': free | profile.needs.keys(),
            'scheduled': frozenset(ALWAYS.union(*(part.do for part in profile.scheduled)))}


def _floors(findings: Findings, home: Written) -> None:
    """Who walks is on a floor of the home, and on the same one during a walk, but in an elevator.
    """
    check = 'who walks is on a floor of the home'
    storeys = {room['storey'] for room in home.layout['rooms']}
    last: dict[str, tuple[float, tuple[int, float, float]]] = {}
    for row in home.track:
        who, time = row['resident'], float(row['time'])
        place = int(row['storey']), float(row['x']), float(row['y'])
        before, other = last.get(who, (-math.inf, place))
        findings.say(check, place[0] in storeys and (
            place[0] == other[0] or time - before > STEP or _rides(home, place, other)),
            f'{who} at {row["time"]} on floor {place[0]}, before on floor {other[0]}')
        last[who] = time, place


def _rides(home: Written, *ends: tuple[int, float, float]) -> bool:
    """Whether both places are in the cabin of one elevator."""
    near = [{landing['elevator'] for landing in home.layout.get('landings', [])
             if landing['storey'] == storey and _is_in_cabin(landing, (x, y))}
            for storey, x, y in ends]
    return bool(set.intersection(*near))


def _is_in_cabin(landing: Any, at: tuple[float, float]) -> bool:
    ahead, aside = local(landing['pose'][:2], landing['pose'][3], at)
    return 0.0 < ahead < CABIN and abs(aside) < BESIDE


def _missed(findings: Findings, home: Written) -> None:
    """Who was missed walked into a cell and out of it, and its sensor reported nothing."""
    tracks = defaultdict[str, list[tuple[float, float, float]]](list)
    for row in home.track:
        tracks[row['resident']].append((float(row['time']), float(row['x']), float(row['y'])))
    for row in home.missed:
        start, end = float(row['start']), float(row['end'])
        where = f'missed.csv: {row["resident"]} from {row["start"]} to {row["end"]}'
        sensor = home.sensors.get(row['sensor'])
        known = sensor is not None and sensor['name'].startswith(PLACED)
        findings.say('missed.csv has who was missed', known and end - start > LEAST - 0.01,
                     f'{where} over {row["sensor"]}, which is no cell, or for less than '
                     f'{LEAST:g} s')
        if sensor is None or not known:
            continue
        findings.say('missed.csv has who was missed', all(
            any(abs(time - at) < AROUND and math.dist((x, y), (sensor['x'], sensor['y']))
                < CELL + AROUND for time, x, y in tracks[row['resident']]) for at in (start, end)),
            f'{where} over {row["sensor"]}: the track has nobody there')
        findings.say('missed.csv has who was missed', row['sensor'] in home.faulty or not any(
            value == 'ON' and start <= time <= end for time, value in home.states(row['sensor'])),
            f'{where}: {row["sensor"]} reported ON')
