"""Checks where residents are: no gap, no jump, no wall crossed, in the rooms that the truth names.
"""
from __future__ import annotations

import math
from typing import Any

from angen_apps.data.written import Findings, Written
from angen_tools.common.geometry import contains, local
from angen_tools.common.home import Room

FASTER = 1.35  # times the speed of a profile that a person may reach
USUAL = (0.75, 1.15)  # times that speed, of the middle of their walks
STRETCH = 2.0  # m of a walk in which nobody is in its way: its fastest
WALKS = 3  # least number whose usual speed is checked
SLACK = 0.5  # m from the middle of an opening to the end of a step to its room
CABIN, LEAVES = 3.0, 0.6  # m from a landing into the cabin, and to the sides between the leaves
STEP = 0.65  # s between two places of one walk, at most
JUMP = 2.3  # m between two places without a walk: from a bed to where one stands
NEAR = 1.9  # m from the middle of a thing to its user
EDGE = 0.3  # m beyond the edge of a room in which one still is
GIVEN_UP = 0.02  # share of a resident's places that it may not reach
PHASES = {'goes': ('stand',), 'does': ('stand', 'sit', 'lie'), 'waits': ('stand', 'sit', 'lie'),
          'away': ('',)}


def check(findings: Findings, home: Written) -> None:
    """All checks of places."""
    _layout(findings, home)
    _times(findings, home)
    _walls(findings, home)
    _rooms(findings, home)
    _jumps(findings, home)
    _given_up(findings, home)


def _layout(findings: Findings, home: Written) -> None:
    """Sensors and things are in their rooms."""
    for kind in ('sensors', 'things'):
        for one in home.layout[kind]:
            if one['room']:
                findings.say('rooms contain what is in them',
                             _is_in(home, one['room'], one['x'], one['y']),
                             f'{one["name"]} at {one["x"]} {one["y"]} is not in {one["room"]}')


def _is_in(home: Written, name: str, x: float, y: float) -> bool:
    room = home.rooms.get(name)
    if room is None:
        return False
    shape = Room(name, '', 0, room['polygon'], room.get('holes', []), 0.0, 0.0, 0.0, False)
    return shape.contains(x, y) or shape.distance(x, y) < EDGE


def _times(findings: Findings, home: Written) -> None:
    check = 'no gap in the truth'
    ends = dict.fromkeys(home.names, 0.0)
    for row in home.truth:
        who, start = row['resident'], float(row['start'])
        findings.say(check, who in ends and abs(start - ends[who]) < 0.01
                     and float(row['end']) > start,
                     f'{who} at {row["start"]}, before it {ends.get(who, math.nan):.3f}')
        ends[who] = float(row['end'])
    for who, end in ends.items():
        findings.say(check, abs(end - home.end) < 0.01, f'{who} ends at {end:.3f}')


def _walls(findings: Findings, home: Written) -> None:
    """No resident exceeds its speed, or changes rooms except through a door or opening."""
    speeds = home.speeds
    porches = _porches(home.layout)
    last: dict[str, tuple[float, float, float, int]] = {}
    walks: dict[str, list[list[tuple[float, float, float]]]] = {name: [] for name in home.names}
    for row in home.track:
        who, time, x, y = row['resident'], float(row['time']), float(row['x']), float(row['y'])
        findings.say('no speed above their own', who in speeds, f'no resident {who}')
        before = last.get(who)
        storey = int(row['storey'])
        last[who] = (time, x, y, storey)
        if who not in speeds:
            continue
        if before is None or time - before[0] > STEP or storey != before[3]:
            walks[who].append([(time, x, y)])
            continue
        walks[who][-1].append((time, x, y))
        way, took = math.dist(before[1:3], (x, y)), time - before[0]
        findings.say('no speed above their own', way <= FASTER * speeds[who] * took + 0.06,
                     f'{who} at {time}: {way:.2f} m in {took:.2f} s')
        rooms = [_room(home.layout, *before[1:]), _room(home.layout, x, y, storey)]
        if rooms[0] != rooms[1]:
            near = any(_through(door, before[1:3], (x, y)) for door in home.layout['doors']) or (
                '' in rooms and not porches.isdisjoint(rooms)) or (
                '' in rooms and any(_boards(landing, before[1:3], (x, y))
                                    for landing in home.layout.get('landings', [])
                                    if landing['storey'] == storey))
            findings.say('no resident crossed a wall', near,
                         f'{who} at {time}: from {rooms[0]} at {before[1]} {before[2]} to '
                         f'{rooms[1]} at {x} {y}')
    for who, own in walks.items():
        usual = sorted(speed for speed in map(_fastest, own) if speed)
        if len(usual) >= WALKS and who in home.people:
            share = usual[len(usual) // 2] / speeds[who]
            findings.say('no speed above their own', USUAL[0] <= share <= USUAL[1],
                         f'{who} walks at {share:.2f} times the speed in layout.json')


def _fastest(walk: list[tuple[float, float, float]]) -> float:
    """The speed in the fastest STRETCH of a walk (times, x, y), without waiting and stepping
    aside; 0 if it leads less far."""
    best, first = 0.0, 0
    for last, (time, x, y) in enumerate(walk):
        while first < last and math.dist(walk[first + 1][1:], (x, y)) >= STRETCH:
            first += 1
        way = math.dist(walk[first][1:], (x, y))
        if way >= STRETCH:
            best = max(best, way / max(time - walk[first][0], 0.01))
    return best


def _room(layout: Any, x: float, y: float, storey: int) -> str:
    return next((str(room['name']) for room in layout['rooms']
                 if room['storey'] == storey
                 and contains(room['polygon'], x, y, room.get('holes', ()))), '')


def _porches(layout: Any) -> set[str]:
    """Landings outside of a door of the home, without walls."""
    landings = {room['name'] for room in layout['rooms'] if room['use'] == 'landing'}
    return {name for door in layout['doors']
            if door['kind'] != 'window' and set(door['rooms']) - landings
            for name in landings.intersection(door['rooms'])}


def _boards(landing: Any, *step: tuple[float, float]) -> bool:
    """Whether a step is between a landing and its cabin, which is in no room."""
    x, y, _, yaw = landing['pose']
    return all(-SLACK <= ahead <= CABIN and abs(aside) <= LEAVES
               for ahead, aside in (local((x, y), yaw, at) for at in step))


def _through(door: Any, start: tuple[float, float], end: tuple[float, float]) -> bool:
    """Whether a step leads through a door or opening, or begins or ends close before it."""
    x, y, _, yaw = door['pose']
    (u0, v0), (u1, v1) = (local((x, y), yaw, at) for at in (start, end))
    share = min(max(v0 / (v0 - v1), 0.0), 1.0) if v0 != v1 else 0.5  # share of the step
    return (door['kind'] != 'window' and abs(u0 + share * (u1 - u0)) <= door['width'] / 2 + 0.05
            and abs(v0 + share * (v1 - v0)) <= SLACK)


def _rooms(findings: Findings, home: Written) -> None:
    """A resident is in the room that the truth names, and at the thing in use."""
    for row in home.truth:
        where = f'{row["resident"]} at {row["start"]}: {row["activity"]}'
        x, y, away = float(row['x']), float(row['y']), row['phase'] == 'away'
        findings.say('a phase has a place', row['posture'] in PHASES.get(row['phase'], ())
                     and math.isnan(x) == away and not (away and row['room']),
                     f'{where} {row["phase"]} {row["posture"]} in {row["room"]} at {x} {y}')
        if row['room'] and not away:
            findings.say('a resident is in the room named', _is_in(home, row['room'], x, y),
                         f'{where} in {row["room"]} at {x} {y}')
        if row['thing']:
            thing = home.things.get(row['thing'])
            findings.say('label matches room', thing is not None and thing['room'] == row['room'],
                         f'{where} at {row["thing"]} in {row["room"]}')
            if thing is not None:
                away_from = math.dist((x, y), (thing['x'], thing['y']))
                findings.say('a resident is at the thing in use', away_from < NEAR,
                             f'{where} at {row["thing"]}: {away_from:.2f} m from it')


def _jumps(findings: Findings, home: Written) -> None:
    """Between two places is a walk; nobody walks while away."""
    for name, one in home.who.items():
        for (x, y, storey), (u, v, other), time, before in zip(
                one.places, one.places[1:], one.times[1:], one.times):
            if math.isnan(x) or math.isnan(u) or storey != other:
                continue
            findings.say('a walk leads from place to place', math.dist((x, y), (u, v)) < JUMP,
                         f'{name} at {before:.3f} at {x} {y}, at {time:.3f} at {u} {v}')
    away = {name: [(i.start, i.end) for i in one.does if i.row['phase'] == 'away']
            for name, one in home.who.items()}
    for row in [*home.track, *home.moves]:
        time = float(row['time'])
        findings.say('who is away does not walk', not any(
            start < time < end for start, end in away.get(row['resident'], [])),
            f'{row["resident"]} at {row["time"]}')


def _given_up(findings: Findings, home: Written) -> None:
    """People reach nearly all places that they go to; cats wait at shut doors."""
    for name in sorted(home.people):
        own = [row for row in home.truth if row['resident'] == name]
        ways = sum(row['phase'] == 'goes' for row in own)
        lost = [row for row in own if 'gave up' in row['note']]
        findings.say('few ways are given up', len(lost) <= max(1, GIVEN_UP * ways),
                     f'{name}: {len(lost)} of {ways}, first at '
                     + (f'{lost[0]["start"]} for {lost[0]["activity"]}' if lost else ''))
