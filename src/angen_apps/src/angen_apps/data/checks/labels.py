"""Checks labels against place, posture and the thing in use, in the truth, events and casas.txt."""
from __future__ import annotations

import math
import re

from angen_apps.data.formats.casas import ENTER
from angen_apps.data.tables import lines
from angen_apps.data.written import Findings, Written
from angen_apps.residents.activities import Activity, Step, activities
from angen_apps.residents.places import ENTRANCE, OUTSIDE
from angen_apps.residents.profiles import FOLDER, read

EARLY, LATE = 3.0, 1.0  # s between a cause and its event: motion before, and at, it
HAND = 31.0  # s between a command and the event of its device
KINDS = {'motion': ('motion', 'area'), 'seat': ('item',), 'hand': ('door', 'power', 'bell'),
         'visitor': ('bell',),
         'air': ('temperature',), 'light': ('light',), 'power': ('mains',)}  # kinds, by cause
START = 1.0  # s, in which sensors report their first states
OWN = ('motion', 'seat', 'hand')  # causes that are residents
GUEST = ('visit', 'eat', 'leave')
ALWAYS = {'sleep', 'leave', 'relax', 'toilet', 'wash', 'shower', 'dress', 'nap'}
STANDS = {'does': 300.0, 'waits': 1800.0}  # s on one's feet asleep, and before a place to sleep
NOTED = 0.3  # share of a resident's time with notes of what did not go as planned, at most
LABEL = re.compile(r'(?:(R\d+)_)?(\w+) (begin|end)')


def check(findings: Findings, home: Written) -> None:
    """All checks of labels."""
    _does(findings, home)
    _lies(findings, home)
    _profiles(findings, home)
    _noted(findings, home)
    _events(findings, home)
    _talks(findings, home)
    if (home.folder / 'casas.txt').is_file():
        _turns(findings, home)


def _does(findings: Findings, home: Written) -> None:
    """Who does something has the posture for it, at a thing or in a room for it, or the truth
    says what was in the way."""
    for row in home.truth:
        activity = activities().get(row['activity'])
        where = f'{row["resident"]} at {row["start"]}: {row["activity"]} {row["posture"]} at ' \
            f'{row["thing"] or "no thing"} in {row["room"]}'
        findings.say('an activity is in a room for it', activity is not None,
                     f'{where}: no such activity')
        if activity is None or row['phase'] != 'does' or row['note'] \
                or row['resident'] not in home.people:
            continue
        findings.say('an activity is in a room for it',
                     any(_fits(home, step, row) for step in activity.steps)
                     or _visits(home, activity, row), where)


def _lies(findings: Findings, home: Written) -> None:
    """Who sleeps lies, also if a note says why not."""
    stood: dict[tuple[str, str], float] = {}  # s by resident and phase, since it lay
    for row in home.truth:
        who, phase = row['resident'], row['phase']
        if who not in home.people:
            continue
        if row['activity'] != 'sleep' or row['posture'] != 'stand':
            stood.update({(who, phase): 0.0 for phase in STANDS})
        elif phase in STANDS:
            seconds = stood.get((who, phase), 0.0) + float(row['end']) - float(row['start'])
            stood[who, phase] = seconds
            findings.say('who sleeps lies', seconds <= STANDS[phase],
                         f'{who} at {row["start"]}: stands for {seconds:.0f} s'
                         + (f', {row["note"]}' if row['note'] else ''))


def _visits(home: Written, activity: Activity, row: dict[str, str]) -> bool:
    """Whether it stands for a moment at another thing that the activity is used to visit."""
    thing = home.things.get(row['thing'])
    return activity.visits is not None and thing is not None and row['posture'] == 'stand' \
        and any(_is(what, thing['type'], home.use(row['room'])) for what, _ in activity.visits.to)


def _fits(home: Written, step: Step, row: dict[str, str]) -> bool:
    posture = 'stand' if step.posture == 'roam' else step.posture
    if row['posture'] != posture:
        return False
    use, thing = home.use(row['room']), home.things.get(row['thing'])
    if thing is not None:
        return any(_is(what, thing['type'], use) for what in step.at)
    return step.room == use or bool({OUTSIDE, ENTRANCE} & set(step.at))


def _is(what: str, kind: str, use: str) -> bool:
    wanted, _, name = what.rpartition(' ')
    return name == kind and wanted in ('', use)


def _profiles(findings: Findings, home: Written) -> None:
    """Residents do what their profile has, if it is one of Angen's; guests come to see somebody."""
    for guest, host in home.hosts.items():
        for row in home.truth:
            if row['resident'] == guest and row['phase'] == 'does':
                findings.say('a guest comes to see its host', row['activity'] in GUEST
                             and host in home.who and not math.isnan(
                                 home.who[host].at(float(row['start']))[0]),
                             f'{guest} at {row["start"]}: {row["activity"]}, {host} is away')
    for resident in home.layout['residents']:
        profile = str(resident.get('profile', ''))
        if (FOLDER / f'{profile}.yaml').is_file():
            allowed = read(profile).does | ALWAYS
            for row in home.truth:
                if row['resident'] == resident['name']:
                    findings.say('residents do what their profile has', row['activity'] in allowed,
                                 f'{row["resident"]} ({profile}) at {row["start"]}: '
                                 f'{row["activity"]}')


def _noted(findings: Findings, home: Written) -> None:
    for name in home.names:
        own = [row for row in home.truth if row['resident'] == name and row['phase'] == 'does']
        lost = sum(bool(row['note']) for row in own)
        findings.say('most goes as planned', lost <= max(2, NOTED * len(own)),
                     f'{name}: {lost} of {len(own)} have notes')


def _events(findings: Findings, home: Written) -> None:
    """Events have causes of their kind, and the activity that the truth has for their resident."""
    whose: dict[str, tuple[str, str]] = {}  # resident and activity as it came on
    for time, row in zip(home.times, home.events):
        where = f'{row["time"]} {row["sensor"]} {row["value"]}'
        cause, who, name = row['cause'], row['resident'], row['activity']
        findings.say('each event has a cause or is noise',
                     (bool(who) == (cause in OWN) or cause == 'light') and bool(who) == bool(name)
                     and row['kind'] in KINDS.get(cause, (row['kind'],))
                     and (cause in (*KINDS, 'noise') or cause == 'start' and time < START),
                     f'{where} has cause {cause}')
        if not who or row['sensor'] in home.faulty or who not in home.who:
            continue
        if row['value'] in ('OFF', 'ABSENT') and row['kind'] != 'power':
            findings.say('an event has the activity of its resident',
                         whose.get(row['sensor'], ('', '')) == (who, name),
                         f'{where}: {who} {name}, it came on for {whose.get(row["sensor"])}')
            continue
        whose[row['sensor']] = who, name
        early = HAND if cause == 'hand' else EARLY
        did = {interval['activity'] for interval in
               home.who[who].intervals(time - early, time + LATE)}
        findings.say('an event has the activity of its resident', name in did,
                     f'{where}: {who} {name}, the truth has {" and ".join(sorted(did))}')


def _talks(findings: Findings, home: Written) -> None:
    """Who talks does so with somebody in the same room, and is awake and at home."""
    for row in home.talks:
        both: list[dict[str, str]] = [
            next(home.who[name].intervals(at, at), {}) if name in home.who else {}
            for name in (row['resident'], row['to'])
            for at in (float(row['start']), float(row['end']) - 0.01)]
        rooms = {one.get('room', '') for one in both}
        findings.say('people talk with each other', row['resident'] != row['to']
                     and len(rooms) == 1 and '' not in rooms
                     and all(one.get('posture') in ('stand', 'sit') for one in both),
                     f'{row["resident"]} to {row["to"]} at {row["start"]}')


def _turns(findings: Findings, home: Written) -> None:
    """Labels of casas.txt alternate: of each resident one at a time is open, and each is ended."""
    check = 'each begin has its end'
    names = {activity.casas for activity in activities().values()} | {ENTER}
    opened: dict[str, str] = {}
    for number, line in enumerate(lines(home.folder / 'casas.txt'), 1):
        words = line.rstrip('\n').split('\t')
        if len(words) < 5:
            continue
        found = LABEL.fullmatch(words[4])
        where = f'casas.txt:{number}: {words[4]}'
        findings.say(check, found is not None and found[2] in names, f'{where} is not a label')
        if found is None:
            continue
        who, name, turn = found[1] or '', found[2], found[3]
        fine = opened.get(who, '') == ('' if turn == 'begin' else name)
        findings.say(check, fine, f'{where}, but {opened.get(who) or "nothing"} had begun')
        opened[who] = name if turn == 'begin' else ''
    for who, name in opened.items():
        findings.say(check, not name, f'{who} {name} has no end'.strip())
