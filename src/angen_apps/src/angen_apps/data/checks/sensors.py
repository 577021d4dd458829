"""Computes from track, truth and loads which sensors could and should have reported what, and
compares both ways. Sensors with faults are not compared, but count for the share explained."""
from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from typing import Any, Iterator

from scipy.special import bdtr

from angen_apps.data.recorder import ACTIVE, DEGREES, VALUES, WATTS
from angen_apps.data.whereabouts import WALKS, Whereabouts
from angen_apps.data.written import Findings, Written
from angen_apps.residents.activities import activities
from angen_tools.common.geometry import local

# m from the middle of a cell to one who moves there, from a door or front to one who opens or
# shuts it, and from a seat or mat to one on it
NEAR = {'motion': 1.5, 'area': 0.0, 'door': 3.0, 'item': 1.5}
PASSES = 0.35  # m from there in which a person who walks is detected
EARLY, LATE = 3.0, 1.3  # s before and after an event in which its motion is
DOORWAY = 1.3  # m from a door of a room, in which its sensor may see a person
HOLDS = 8.0  # s before the end of a detection
SHUTS = 31.0  # s that it takes to open or shut a door, at most
STRAIGHT, BELOW = 1.2, 1.0  # m of a walk through a room, and from its sensor
PLACED = ('cell_', 'area_')  # sensors whose places are known
FRONT, FULL = 0.9, 5.0  # m between a thing and its front; s of its use from which that opens
BELL = 2.5  # m between a doorbell and one who rings
MAT = 0.7  # m between a mat and a person on it
SITS = (3.0, 1.0)  # s after the begin and before the end of sitting, when the seat is pressed
LAGS = 2.5  # s between a load and the report of its plug
WARMER = 12.0  # degrees between a reading and the middle one
BRIEF = 0.05  # s: a shorter change is not reported
IDLE = 5.0  # W of an appliance that is off
MISSED, NOISE = 0.02, 0.02  # shares of walks and events, at most
SURE = 0.99  # probability of at most as many missed walks, if each is by chance with that share


def check(findings: Findings, home: Written) -> None:
    """All checks of sensors."""
    shares = {'explained': 0, 'unexplained': 0, 'noise': 0, 'passes': 0, 'missed': 0}
    _alternate(findings, home)
    _could(findings, home, shares)
    _should(findings, home, shares)
    _seats(findings, home)
    _ends(findings, home)
    _doors(findings, home)
    _bells(findings, home)
    _fronts(findings, home)
    _plugs(findings, home)
    _runs(findings, home)
    _mains(findings, home)
    _air(findings, home)
    findings.shares = {
        'explained': _share(shares['explained'], shares['explained'] + shares['unexplained']),
        'noise': _share(shares['noise'], len(home.events)),
        'missed': _share(shares['missed'], shares['passes'])}
    noise = sum(row['cause'] == 'noise' and row['sensor'] not in home.faulty
                for row in home.events)
    findings.say('few events are noise', noise <= NOISE * len(home.events),
                 f'{noise} of {len(home.events)}')
    findings.say('few walks are missed', _is_few(shares['missed'], shares['passes']),
                 f'{shares["missed"]} of {shares["passes"]}')


def _is_few(missed: int, passes: int) -> bool:
    """Whether a share of MISSED explains so many: open leaves and furniture hide people, in a
    small home on some of few walks."""
    return missed <= MISSED * passes or bool(bdtr(missed - 1, passes, MISSED) < SURE)


def _share(count: int, of: int) -> float:
    return count / of if of else 0.0


def _alternate(findings: Findings, home: Written) -> None:
    last: dict[str, str] = {}
    for row in home.events:
        if row['kind'] in VALUES and row['sensor'] not in home.faulty:
            findings.say('on and off alternate', last.get(row['sensor']) != row['value'],
                         f'{row["time"]} {row["sensor"]} {row["value"]} twice')
            if row['sensor'] not in last:
                findings.say('on and off alternate', row['value'] in ACTIVE,
                             f'{row["time"]} {row["sensor"]} {row["value"]} at first')
            last[row['sensor']] = row['value']


def _could(findings: Findings, home: Written, shares: dict[str, int]) -> None:
    """A sensor reports what a resident near by did, or its fault."""
    alarms: dict[str, list[float]] = {}
    for row in home.faults:
        alarms.setdefault(row['sensor'], []).append(float(row['time']))
    for time, row in zip(home.times, home.events):
        sensor = home.sensors.get(row['sensor'])
        shares['noise'] += row['cause'] == 'noise'
        if sensor is None or sensor['kind'] not in ('motion', 'area', 'door', 'item') \
                or row['cause'] == 'start':
            continue
        found = _explained(home, sensor, time, row['value'] in ACTIVE)
        shares['explained' if found else 'unexplained'] += 1
        if row['sensor'] not in home.faulty:
            findings.say('a resident could have caused it', found,
                         f'{row["time"]} {row["sensor"]} {row["value"]} in {sensor["room"]}')
            who = row['resident']
            if found and who in home.who and row['value'] in ACTIVE:
                findings.say('its resident could have caused it',
                             _explained(home, sensor, time, True, who),
                             f'{row["time"]} {row["sensor"]} {row["value"]}: {who}')


def _explained(home: Written, sensor: Any, time: float, on: bool, who: str = '') -> bool:
    """Whether one of the residents, or that one, could have caused an event."""
    for name, one in home.who.items():
        if who not in ('', name):
            continue
        if sensor['kind'] in ('motion', 'area'):
            begin = time - (EARLY if on else HOLDS)
            places = one.moving(begin, time + LATE)
            places += [place for place in one.between(begin, time + LATE)
                       if _at_door(home, sensor, place)]
        elif sensor['kind'] == 'door':
            places = one.between(time - SHUTS, time + LATE)
        else:
            places = one.between(time - EARLY, time + LATE)
        if any(_is_near(home, sensor, place) for place in places):
            return True
    return False


def _is_near(home: Written, sensor: Any, place: tuple[float, float, int]) -> bool:
    """Whether what a resident does at a place may make a sensor report it."""
    at = sensor['x'], sensor['y']
    return not math.isnan(place[0]) and (
        math.dist(at, place[:2]) < NEAR[sensor['kind']] or sensor['kind'] == 'area' and (
            _at_door(home, sensor, place) or home.floors.sees(at, place)))


def _at_door(home: Written, sensor: Any, place: tuple[float, float, int]) -> bool:
    """Whether a person is at a door of a sensor's room: the leaf hides and shows who stands there.
    """
    return any(door['kind'] != 'window' and sensor['room'] in door['rooms']
               and math.dist(door['pose'][:2], place[:2]) < DOORWAY
               for door in home.layout['doors'])


def _should(findings: Findings, home: Written, shares: dict[str, int]) -> None:
    """Who walks over a cell or through a room is detected, but for what missed.csv has."""
    known: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for row in home.missed:
        known.setdefault((row['sensor'], row['resident']), []).append(
            (float(row['start']) - LATE, float(row['end']) + LATE))
    for sensor in home.layout['sensors']:
        passes = _over_cell if sensor['name'].startswith('cell_') else _through_room
        if sensor['kind'] not in ('motion', 'area') or sensor['id'] in home.faulty \
                or not sensor['name'].startswith(PLACED):
            continue
        states = home.states(sensor['id'])
        for name in sorted(home.people):
            for time in passes(home, sensor, home.who[name]):
                found = _was_on(states, time) or any(
                    start <= time <= end for start, end in known.get((sensor['id'], name), []))
                shares['passes'] += 1
                shares['missed'] += not found
                if sensor['kind'] == 'motion':  # furniture may hide who is in a room
                    findings.say('who walks over a cell is detected', found,
                                 f'{name} at {time:.3f} by {sensor["id"]}')


def _over_cell(home: Written, sensor: Any, one: Whereabouts) -> Iterator[float]:
    """When a resident walks over the middle of a cell."""
    storey = home.rooms[sensor['room']]['storey'] if sensor['room'] in home.rooms else 0
    for i in range(1, len(one.times) - 1):
        x, y, floor = one.places[i]
        if floor == storey and math.dist((x, y), (sensor['x'], sensor['y'])) < PASSES \
                and one.times[i + 1] - one.times[i - 1] < 2 * WALKS \
                and math.dist(one.places[i - 1][:2], one.places[i + 1][:2]) > 2 * PASSES:
            yield one.times[i]


def _through_room(home: Written, sensor: Any, one: Whereabouts) -> Iterator[float]:
    """When a resident walks STRAIGHT through a room, in sight of its sensor and not below it."""
    at = sensor['x'], sensor['y']
    for i in range(2, len(one.times) - 2):
        way = one.places[i - 2:i + 3]
        if one.times[i + 2] - one.times[i - 2] < 4 * WALKS \
                and math.dist(way[0][:2], way[4][:2]) > STRAIGHT \
                and math.dist(way[2][:2], at) > BELOW \
                and home.floors.room(*way[2]) == sensor['room'] \
                and all(home.floors.sees(at, place) for place in way[::2]):
            yield one.times[i]


def _was_on(states: list[tuple[float, str]], time: float) -> bool:
    """Whether a sensor was on around a time."""
    first = bisect_left(states, (time - EARLY, ''))
    last = bisect_right(states, (time + LATE, '~'))
    return any(value in ACTIVE for _, value in states[max(first - 1, 0):last])


def _seats(findings: Findings, home: Written) -> None:
    """A resident on a seat or mat presses it."""
    seats = {s['name']: s for s in home.layout['sensors'] if s['kind'] == 'item'}
    for row in home.truth:
        begin, end = float(row['start']) + SITS[0], float(row['end']) - SITS[1]
        if row['phase'] != 'does' or end <= begin or row['resident'] not in home.people:
            continue
        at = float(row['x']), float(row['y'])
        if row['posture'] == 'sit':
            seat = seats.get(row['thing'])
        else:
            seat = next((s for name, s in seats.items() if row['posture'] == 'lie' and row['thing']
                         and name.startswith(f'{row["thing"]}_mat')
                         and math.dist(at, (s['x'], s['y'])) < MAT), None)
        if seat is None or seat['id'] in home.faulty:
            continue
        states = home.states(seat['id'])
        i = bisect_right(states, (begin, '~')) - 1
        findings.say('a seat is pressed while one sits', i >= 0 and states[i][1] in ACTIVE,
                     f'{row["resident"]} at {row["start"]} on {row["thing"]}')


def _ends(findings: Findings, home: Written) -> None:
    """A sensor is off soon after the last motion, or after the last resident who sat or lay there.
    """
    reported = (home.states(sensor['id']) for sensor in home.layout['sensors'])
    last_report = max((states[-1][0] for states in reported if states), default=0.0)
    for sensor in home.layout['sensors']:
        seat = sensor['kind'] == 'item'
        if sensor['id'] in home.faulty or not seat and (
                sensor['kind'] not in ('motion', 'area') or not sensor['name'].startswith(PLACED)):
            continue
        states, most = home.states(sensor['id']), EARLY if seat else HOLDS
        for (begin, value), (end, _) in zip(states, [*states[1:], (last_report, '')]):
            if value not in ACTIVE or end - begin <= most:
                continue
            there = sorted(_sitting(home, sensor, begin, end) if seat else
                           ((time, time) for time in _moving(home, sensor, begin, end)))
            if begin < LATE and (not there or there[0][0] > begin + most):  # a thing is on it
                continue
            last, gap = begin, 0.0
            for start, until in [*there, (end, end)]:
                gap, last = max(gap, start - last), max(last, until)
            findings.say('a sensor is off when nobody is there', gap <= most,
                         f'{sensor["id"]} from {begin:.3f} to {end:.3f}: nobody for {gap:.1f} s')


def _moving(home: Written, sensor: Any, begin: float, end: float) -> Iterator[float]:
    """The moments of a time at which a resident moves in sight of a motion sensor."""
    for one in home.who.values():
        for time in one.moves[bisect_left(one.moves, begin):bisect_right(one.moves, end)]:
            if _is_near(home, sensor, one.at(time)):
                yield time


def _sitting(home: Written, sensor: Any, begin: float, end: float
             ) -> Iterator[tuple[float, float]]:
    """The parts of a time in which a resident is at a seat or mat."""
    for one in home.who.values():
        first = max(bisect_right(one.times, begin) - 1, 0)
        last = bisect_right(one.times, end)
        for start, until, place in zip(one.times[first:last],
                                       [*one.times[first + 1:last], home.end],
                                       one.places[first:last]):
            if _is_near(home, sensor, place):
                yield start, until


def _doors(findings: Findings, home: Written) -> None:
    """A door through which a resident walks is open."""
    contacts = {s['name'].removesuffix('_contact'): s['id'] for s in home.layout['sensors']
                if s['kind'] == 'door' and s['id'] not in home.faulty}
    for door in home.layout['doors']:
        contact = contacts.get(door['name'])
        if door['kind'] != 'door' or contact is None:
            continue
        states = home.states(contact)
        for name, time in _crossings(home, door):
            findings.say('who walks through a door has opened it', _was_on(states, time),
                         f'{name} at {time:.3f} through {door["name"]}')


def _crossings(home: Written, door: Any) -> Iterator[tuple[str, float]]:
    x, y, _, yaw = door['pose']
    storeys = {home.rooms[room]['storey'] for room in door['rooms'] if room in home.rooms}
    for name, one in home.who.items():
        last = (math.nan, math.nan)
        for time, (px, py, storey) in zip(one.times, one.places):
            now = local((x, y), yaw, (px, py))
            if storey in storeys and last[1] * now[1] < 0 and name in home.people \
                    and max(abs(last[0]), abs(now[0])) < door['width'] / 2 \
                    and max(abs(last[1]), abs(now[1])) < 1.0:
                yield name, time
            last = now


def _bells(findings: Findings, home: Written) -> None:
    """Who rings is at the bell, or a resident answers the door then."""
    for time, row in zip(home.times, home.events):
        if row['kind'] != 'bell' or row['sensor'] not in home.sensors:
            continue
        sensor, guest = home.sensors[row['sensor']], home.who.get(row['resident'])
        fine = any(math.dist((sensor['x'], sensor['y']), place[:2]) < BELL
                   for place in guest.between(time - EARLY, time + LATE)) if guest else any(
            interval['activity'] == 'answer_door' for one in home.who.values()
            for interval in one.intervals(time, time + LATE))
        findings.say('a bell rings for who comes', fine,
                     f'{row["time"]} {row["sensor"]} by {row["resident"] or "a visitor"}')


def _fronts(findings: Findings, home: Written) -> None:
    """Who takes something out of a thing opens its front."""
    doors = {door['name'] for door in home.layout['doors']}
    fronts = [s for s in home.layout['sensors'] if s['kind'] == 'door'
              and s['id'] not in home.faulty and s['name'].removesuffix('_contact') not in doors]
    for row in home.truth:
        activity, thing = activities().get(row['activity']), home.things.get(row['thing'])
        if activity is None or thing is None or row['phase'] != 'does' or row['note'] \
                or float(row['end']) - float(row['start']) < FULL \
                or row['resident'] not in home.people \
                or thing['type'] not in activity.opened:
            continue
        near = [s for s in fronts if s['room'] == thing['room'] and math.dist(
            (s['x'], s['y']), (thing['x'], thing['y'])) < FRONT]
        begin = float(row['start'])
        if near:
            findings.say('who uses a thing opens it', any(
                _is_open(home.states(s['id']), begin - LATE, begin + FULL) for s in near),
                f'{row["resident"]} at {row["start"]}: {row["activity"]} at {row["thing"]}')


def _is_open(states: list[tuple[float, str]], begin: float, end: float) -> bool:
    """Whether a front opens between two times, or opened a short time before and is open still."""
    last = bisect_left(states, (end, ''))
    first = max(bisect_right(states, (begin, '~')) - 1, 0)
    return any(value in ACTIVE and time > begin - SHUTS for time, value in states[first:last])


def _plug_of(home: Written) -> dict[str, str]:
    """The id of the plug of each appliance and stove, by its load."""
    plugs = {s['name'].removesuffix('_plug'): s for s in home.layout['sensors']
             if s['kind'] == 'power'}
    found = {}
    for device in home.loads:
        kind, _, name = device.partition('/')
        names = [thing for thing in plugs if thing == name or kind == 'stove'
                 and home.things.get(thing, {}).get('type') == 'stove'
                 and (plugs[thing]['room'] == name or thing == name or len(
                     [d for d in home.loads if d.startswith('stove/')]) == 1)]
        if kind in ('stove', 'appliance') and names:
            found[device] = plugs[names[0]]['id']
    return found


def _plugs(findings: Findings, home: Written) -> None:
    """A plug reports what its load draws, and each load is somebody's who is at home."""
    check = 'plugs report what loads draw'
    for device, plug in sorted(_plug_of(home).items()):
        if plug in home.faulty:
            continue
        changes = _changes(home, device)
        reports = [time for time, _ in home.states(plug) if time > LAGS]
        for time in (time for time in changes if time > LAGS):
            findings.say(check, any(abs(time - other) < LAGS for other in reports),
                         f'{device} at {time:.3f}: {plug} reports nothing')
        for time in reports:
            times, _ = home.loads[device]
            i = bisect_left(times, time - LAGS)
            findings.say(check, i < len(times) and times[i] < time + LAGS,
                         f'{plug} at {time:.3f}: {device} draws the same')
    for device in home.loads:
        if device.partition('/')[0] in ('stove', 'lamp', 'appliance'):
            for time in _changes(home, device):
                findings.say('who switches is at home', any(
                    not math.isnan(place[0]) for one in home.who.values()
                    for place in one.between(time - SHUTS, time + LATE)),
                    f'{device} at {time:.3f}')


def _changes(home: Written, device: str) -> list[float]:
    """When a device was switched on and off."""
    times, watts = home.loads[device]
    found: list[float] = []
    for time, old, new in zip(times[1:], watts, watts[1:]):
        if (old > IDLE) != (new > IDLE):
            if found and time - found[-1] < BRIEF:
                found.pop()
            else:
                found.append(time)
    return found


def _runs(findings: Findings, home: Written) -> None:
    """The stove is on while one cooks at it, and the TV while one watches; no stove otherwise."""
    cooks: list[tuple[float, float]] = []
    for row in home.truth:
        activity, thing = activities().get(row['activity']), home.things.get(row['thing'])
        if activity is None or row['phase'] != 'does' or row['resident'] not in home.people:
            continue
        start, end = float(row['start']), float(row['end'])
        runs = {step.runs for step in activity.steps}
        if 'stove' in runs:
            cooks.append((start, end))
        kind = 'stove' if 'stove' in runs and thing and thing['type'] == 'stove' else \
            'tv' if 'tv' in runs else ''
        devices = [device for device in home.loads if device.startswith('stove/')] \
            if kind == 'stove' else [f'appliance/{name}' for name, thing in home.things.items()
                                     if thing['type'] == 'tv' and f'appliance/{name}' in home.loads]
        if kind and devices and end - start > FULL and not row['note']:
            brief = end - start < 2 * FULL  # the last of cooking, in which the stove is put out
            at = start if brief else start + FULL
            findings.say('what is used is on', any(
                home.watts(device, at) > IDLE for device in devices),
                f'{row["resident"]} at {row["start"]}: {row["activity"]} without {kind}')
    for device, (times, watts) in home.loads.items():
        if device.startswith('stove/'):
            for time, drawn in zip(times, watts):
                findings.say('a stove is on while one cooks', drawn <= IDLE or any(
                    start - LATE <= time <= end for start, end in cooks), f'{device} at {time:.3f}')


def _mains(findings: Findings, home: Written) -> None:
    """The mains report what all loads draw."""
    meter = next((s['id'] for s in home.layout['sensors'] if s['kind'] == 'mains'), None)
    if meter is None:
        return
    check = 'the mains report what all loads draw'
    drawn: dict[str, float] = {}
    series = [(-1.0, 0.0, 0.0, 0.0)]  # time, W of all, least and most W on the way there
    for time, device, watts in sorted((time, device, watts) for device, line in home.loads.items()
                                      for time, watts in zip(*line)):
        more, drawn[device] = watts - drawn.get(device, 0.0), watts
        at, total, least, most = series[-1]
        if at == time:
            series.pop()
        else:
            least = most = total
        series.append((time, total + more, least + min(more, 0.0), most + max(more, 0.0)))
    reports = [(time, float(value)) for time, value in home.states(meter)]
    for time, value in reports:
        _, total, least, most = series[bisect_right(series, (time + 0.0015, math.inf)) - 1]
        findings.say(check, least - 1.0 <= value <= most + 1.0,
                     f'{meter} at {time:.3f}: {value:g} W, the loads draw {total:g} W')
    for (time, total, _, _), (until, *_) in zip(series[1:], [*series[2:], (math.inf,)]):
        if until - time < BRIEF:
            continue
        i = bisect_right(reports, (time + 0.0015, math.inf)) - 1
        last = reports[i][1] if i >= 0 else math.nan
        findings.say(check, abs(total - last) < WATTS + 1.0,
                     f'at {time:.3f} the loads draw {total:g} W, {meter} had {last:g} W')


def _air(findings: Findings, home: Written) -> None:
    """Temperatures change by steps, and each sensor reports one, near those of the others."""
    every = [float(row['value']) for row in home.events if row['kind'] == 'temperature']
    usual = sorted(every)[len(every) // 2] if every else math.nan
    for sensor in home.layout['sensors']:
        if sensor['kind'] != 'temperature' or sensor['id'] in home.faulty:
            continue
        states = home.states(sensor['id'])
        findings.say('temperatures change by steps', bool(states), f'{sensor["id"]} reports none')
        for time, value in states:
            findings.say('temperatures change by steps', abs(float(value) - usual) < WARMER,
                         f'{sensor["id"]} at {time:.3f}: {value}, most are near {usual:g}')
        for (_, before), (time, after) in zip(states, states[1:]):
            step = abs(float(after) - float(before))
            findings.say('temperatures change by steps', DEGREES <= step < 8 * DEGREES,
                         f'{sensor["id"]} at {time:.3f}: from {before} to {after}')
