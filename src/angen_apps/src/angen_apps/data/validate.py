"""Checks a home's data against itself: walls, rooms, seats, causes, labels."""
from __future__ import annotations

import csv
import gzip
import json
import math
import zlib
from collections import Counter
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping, TextIO

from angen_apps.data.recorder import VALUES
from angen_apps.residents.activities import Step, activities
from angen_apps.residents.places import ENTRANCE, OUTSIDE
from angen_apps.plan.polygons import contains
from angen_tools.common.failure import Failure
from angen_tools.common.text_file import shortened

DAY = 86400.0
FASTER = 1.35  # times the speed of a profile that a person may reach
SLACK = 0.5  # m from the middle of an opening to the end of a step to its room
SITS = (3.0, 1.0)  # s after the begin and before the end of sitting, when the seat is pressed
SHOWN = 3  # findings of a kind that are listed
GIVEN_UP = 0.02  # share of a resident's places that it may not reach
LONGEST = 1 << 14  # characters of a line
CAUSES = ('air', 'light', 'start', 'noise')  # causes of events that no resident has caused


def finite(text: str | float) -> float:
    """A number; ValueError for others, and for those that are not finite."""
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f'{text} is not finite')
    return value


@dataclass
class Findings:
    """Errors by check, and the number of checked items."""

    wrong: dict[str, list[str]] = field(default_factory=dict)
    checked: Counter[str] = field(default_factory=Counter)

    def say(self, check: str, fine: bool, what: str) -> None:
        self.checked[check] += 1
        self.wrong.setdefault(check, [])
        if not fine:
            self.wrong[check].append(what)

    @property
    def count(self) -> int:
        return sum(len(found) for found in self.wrong.values())


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
    'posture': str, 'room': str, 'thing': str, 'note': str}
EVENTS: Columns = {
    'time': datetime.fromisoformat, 'sensor': str, 'kind': str, 'value': str, 'cause': str,
    'resident': str, 'room': str}
TRACK: Columns = {'time': finite, 'resident': str, 'x': finite, 'y': finite, 'storey': int}
FAULTS: Columns = {'sensor': str}
POWER: Columns = {'time': finite, 'kind': str, 'device': str, 'watts': finite}
SLIDES: Columns = {'time': finite, 'model': str, 'link': str, 'x': finite, 'y': finite, 'z': finite}
# keys of layout.json; a list has entries like its one
LAYOUT = {'start': datetime.fromisoformat, 'days': finite,
          'residents': [{'name': str, 'speed': finite}],
          'rooms': [{'name': str, 'use': str, 'storey': int, 'polygon': [[finite]]}],
          'doors': [{'kind': str, 'pose': [finite], 'width': finite}],
          'things': [{'name': str, 'type': str, 'room': str}],
          'sensors': [{'name': str, 'id': str, 'kind': str}]}


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
                    _check(f'{path}:{reader.line_num}: {column}', row[column], read)
                yield row
    except (OSError, EOFError, UnicodeDecodeError, csv.Error, zlib.error) as error:
        raise Failure(f'{path}: cannot be read: {error}') from None


def _lines(path: Path, file: TextIO) -> Iterator[str]:
    number = 0
    while line := file.readline(LONGEST + 1):
        number += 1
        if len(line) > LONGEST:
            raise Failure(f'{path}:{number}: has a line of more than {LONGEST} characters')
        yield line


def _check(what: str, value: object, shape: Any) -> None:
    """Failure if a value is not of a shape: a dict of keys, a list of one shape, or a reader."""
    if isinstance(shape, dict):
        if not isinstance(value, dict):
            raise Failure(f'{what} must be an object')
        for key, inner in shape.items():
            if key not in value:
                raise Failure(f'{what} has no {key}')
            _check(f'{what}: {key}', value[key], inner)
    elif isinstance(shape, list):
        if not isinstance(value, list):
            raise Failure(f'{what} must be a list')
        for entry in value:
            _check(what, entry, shape[0])
    else:
        try:
            shape(value)
        except (TypeError, ValueError):
            raise Failure(f'{what} is {shortened(str(value))}, which cannot be read') from None


def validate(folder: Path) -> Findings:
    """Checks one home."""
    findings = Findings()
    try:
        layout = json.loads((folder / 'layout.json').read_text(encoding='utf-8'))
    except (OSError, ValueError) as error:
        raise Failure(f'{folder}/layout.json: cannot be read: {error}') from None
    _check(f'{folder}/layout.json', layout, LAYOUT)
    truth = list(rows(folder / 'truth.csv.gz', TRUTH))
    events = list(rows(folder / 'events.csv.gz', EVENTS))
    faulty = next(rows(folder / 'faults.csv', FAULTS), None) is not None
    _times(findings, layout, truth)
    _walls(findings, layout, folder)
    _rooms(findings, layout, truth)
    _uses(findings, layout, truth)
    _given_up(findings, layout, truth)
    _causes(findings, events)
    if not faulty:
        _alternate(findings, events)
        _seats(findings, layout, truth, events)
    if (folder / 'casas.txt').is_file():
        _labels(findings, folder / 'casas.txt')
    return findings


def _times(findings: Findings, layout: Any, truth: list[dict[str, str]]) -> None:
    for resident in layout['residents']:
        own = [row for row in truth if row['resident'] == resident['name']]
        time = 0.0
        for row in own:
            findings.say('no gap in the truth', abs(float(row['start']) - time) < 0.01,
                         f'{resident["name"]} at {row["start"]}, before it {time:.3f}')
            time = float(row['end'])
        findings.say('no gap in the truth', abs(time - layout['days'] * DAY) < 0.01,
                     f'{resident["name"]} ends at {time:.3f}')


def _walls(findings: Findings, layout: Any, folder: Path) -> None:
    """No resident exceeds its speed, or changes rooms except through a door or opening."""
    speeds = {r['name']: FASTER * r['speed'] for r in layout['residents']}
    last: dict[str, tuple[float, float, float, int]] = {}
    for row in rows(folder / 'track.csv.gz', TRACK):
        who, time, x, y = row['resident'], float(row['time']), float(row['x']), float(row['y'])
        before = last.get(who)
        storey = int(row['storey'])
        last[who] = (time, x, y, storey)
        if before is None or time - before[0] > 0.65 or storey != before[3]:
            continue
        way = math.dist(before[1:3], (x, y))
        findings.say('no speed above their own', way <= speeds[who] * (time - before[0]) + 0.06,
                     f'{who} at {time}: {way:.2f} m in {time - before[0]:.2f} s')
        rooms = [_room(layout, *before[1:]), _room(layout, x, y, storey)]
        if rooms[0] != rooms[1]:
            near = any(_through(door, before[1:3], (x, y)) for door in layout['doors'])
            findings.say('no resident crossed a wall', near,
                         f'{who} at {time}: from {rooms[0]} at {before[1]} {before[2]} to '
                         f'{rooms[1]} at {x} {y}')


def _room(layout: Any, x: float, y: float, storey: int) -> str:
    return next((str(room['name']) for room in layout['rooms']
                 if room['storey'] == storey and contains(room['polygon'], x, y)
                 and not any(contains(hole, x, y) for hole in room.get('holes', ()))), '')


def _through(door: Any, start: tuple[float, float], end: tuple[float, float]) -> bool:
    """Whether a step leads through a door or opening, or begins or ends close before it."""
    x, y, _, yaw = door['pose']
    (u0, v0), (u1, v1) = ((math.cos(yaw) * (a - x) + math.sin(yaw) * (b - y),
                           math.cos(yaw) * (b - y) - math.sin(yaw) * (a - x))
                          for a, b in (start, end))
    share = min(max(v0 / (v0 - v1), 0.0), 1.0) if v0 != v1 else 0.5  # share of the step
    return (door['kind'] != 'window' and abs(u0 + share * (u1 - u0)) <= door['width'] / 2 + 0.05
            and abs(v0 + share * (v1 - v0)) <= SLACK)


def _rooms(findings: Findings, layout: Any, truth: list[dict[str, str]]) -> None:
    """A resident who uses a thing is in its room."""
    things = {thing['name']: thing['room'] for thing in layout['things']}
    for row in truth:
        if row['phase'] == 'does' and row['thing'] and row['room']:
            findings.say('label matches room', things.get(row['thing']) == row['room'],
                         f'{row["resident"]} at {row["start"]}: {row["activity"]} at '
                         f'{row["thing"]} in {row["room"]}')


def _uses(findings: Findings, layout: Any, truth: list[dict[str, str]]) -> None:
    """An activity is in a room of its kind, if the home has one."""
    rooms = {name: set().union(*(_rooms_for(step, layout) for step in activity.steps))
             for name, activity in activities().items()
             if not any({OUTSIDE, ENTRANCE} & set(step.at) for step in activity.steps)}
    for row in truth:
        allowed = rooms.get(row['activity'])
        if row['phase'] == 'does' and row['room'] and allowed and not row['note']:
            findings.say('an activity is in a room for it', row['room'] in allowed,
                         f'{row["resident"]} at {row["start"]}: {row["activity"]} in {row["room"]}')


def _rooms_for(step: Step, layout: Any) -> set[str]:
    """The rooms with a thing of a step, or of its use."""
    use = {room['name']: room['use'] for room in layout['rooms']}
    found = {name for name, of in use.items() if step.room == of}
    for what in step.at:
        wanted_use, _, kind = what.rpartition(' ')
        found |= {thing['room'] for thing in layout['things'] if thing['type'] == kind
                  and (not wanted_use or use.get(thing['room']) == wanted_use)}
    return found


def _given_up(findings: Findings, layout: Any, truth: list[dict[str, str]]) -> None:
    """People reach nearly all places that they go to; cats wait at shut doors."""
    for resident in layout['residents']:
        if resident.get('body', 'person') != 'person':
            continue
        own = [row for row in truth if row['resident'] == resident['name']]
        ways = sum(row['phase'] == 'goes' for row in own)
        lost = [row for row in own if 'gave up' in row['note']]
        findings.say('few ways are given up', len(lost) <= max(1, GIVEN_UP * ways),
                     f'{resident["name"]}: {len(lost)} of {ways}, first at '
                     + (f'{lost[0]["start"]} for {lost[0]["activity"]}' if lost else ''))


def _causes(findings: Findings, events: list[dict[str, str]]) -> None:
    for row in events:
        caused = row['cause'] in CAUSES or bool(row['resident'])
        findings.say('each event has a cause or is noise', caused,
                     f'{row["time"]} {row["sensor"]} {row["value"]}')


def _alternate(findings: Findings, events: list[dict[str, str]]) -> None:
    last: dict[str, str] = {}
    for row in events:
        if row['kind'] in VALUES:
            findings.say('on and off alternate', last.get(row['sensor']) != row['value'],
                         f'{row["time"]} {row["sensor"]} {row["value"]} twice')
            last[row['sensor']] = row['value']


def _seats(findings: Findings, layout: Any, truth: list[dict[str, str]],
           events: list[dict[str, str]]) -> None:
    """A resident on a chair with a contact presses it."""
    start = datetime.fromisoformat(layout['start'])
    seats = {sensor['name']: sensor['id'] for sensor in layout['sensors']
             if sensor['kind'] == 'item'}
    pressed: dict[str, list[tuple[float, bool]]] = {}
    for row in events:
        if row['kind'] == 'item':
            at = (datetime.fromisoformat(row['time']) - start).total_seconds()
            pressed.setdefault(row['sensor'], []).append((at, row['value'] == 'PRESENT'))
    for row in truth:
        seat = seats.get(row['thing'])
        begin, end = float(row['start']) + SITS[0], float(row['end']) - SITS[1]
        if row['posture'] != 'sit' or row['phase'] != 'does' or seat is None or end <= begin:
            continue
        on = False
        for at, value in pressed.get(seat, []):
            if at <= begin:
                on = value
        findings.say('a seat is pressed while one sits', on,
                     f'{row["resident"]} at {row["start"]} on {row["thing"]}')


def _labels(findings: Findings, path: Path) -> None:
    """Each begin in casas.txt has its end."""
    opened: Counter[str] = Counter()
    for line in path.read_text(encoding='utf-8').splitlines():
        words = line.split('\t')
        if len(words) > 4:
            label, _, turn = words[4].rpartition(' ')
            opened[label] += 1 if turn == 'begin' else -1
            findings.say('each begin has its end', opened[label] in (0, 1), line)
    for label, count in opened.items():
        findings.say('each begin has its end', count == 0, f'{label} has no end')
