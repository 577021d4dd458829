"""Which sensors and devices of a world the signals of rules mean."""
from dataclasses import replace
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Collection, Iterable, Mapping

from angen_tools.common.clock import time_of_day
from angen_apps.care.rules import Rule, Rules, Signal
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home
from angen_tools.common.nearest import did_you_mean

LISTED = 'angen watch --once'
ENTRANCE = '{entrance}'
USES = ('kitchen', 'bedroom', 'bathroom', 'living', 'hall', 'work', 'landing', 'outdoor')


def chosen(patterns: Iterable[str], existing: Collection[str]) -> set[str]:
    """The existing KIND/NAME that any pattern matches."""
    return {source for source in existing
            if any(fnmatchcase(source, pattern) for pattern in patterns)}


def at_home(rules: Rules, home: Home, rooms: Mapping[str, str], existing: Collection[str]) -> Rules:
    """The rules with their sources and places in a home, and with the home's start.

    `rooms`: the room of each KIND/NAME that is in one. Signals chosen by kind, use or the entrance
    may be missing: rules that ask for it are left out. Failure if something named is missing.
    """
    signals: dict[str, Signal] = {}
    missing: dict[str, str] = {}
    for name, signal in rules.signals.items():
        of = _entrance(signal.of, home)
        why = '' if of else 'the home has no main entrance'
        if of and signal.rooms:
            why = _check_rooms(rules.path, signal, home)
            of = tuple(sorted(chosen(of, _inside(signal, home, rooms))))
            why = why or ('' if of else f'no {" or ".join(signal.of)} is in '
                                        f'{" or ".join(signal.rooms)}')
        elif ENTRANCE in ' '.join(signal.of) and of and not chosen(of, existing):
            why = f'the main entrance {home.entrance} is no device'
        elif of and any('*' in pattern for pattern in of) and not chosen(of, existing):
            why = f'the home has no {" or ".join(signal.of)}'
        if why:
            missing[name] = why
        else:
            signals[name] = replace(signal, of=of)
    kept, left_out = [], []
    for rule in rules.rules:
        whys = [missing[part.signal] for part in rule.when if part.signal in missing]
        if whys:
            left_out.append(f'{rules.path}:{rule.line}: rule {rule.name} is left out: {whys[0]}')
        else:
            kept.append(replace(rule, at=_place(rule.at, home)))
    starts = rules.starts
    if starts is None:
        starts = time_of_day(home.start[11:]) if home.start else 0.0
    return replace(rules, starts=starts, signals=signals, rules=tuple(kept),
                   left_out=tuple(left_out))


def _entrance(patterns: Iterable[str], home: Home) -> tuple[str, ...]:
    """The patterns with the name of the main entrance; none if the home has none."""
    if not home.entrance:
        return tuple(pattern for pattern in patterns if ENTRANCE not in pattern)
    return tuple(pattern.replace(ENTRANCE, home.entrance) for pattern in patterns)


def _check_rooms(path: Path, signal: Signal, home: Home) -> str:
    """Why no room of a known use is there; Failure if a room is not known at all."""
    known = {name for room in home.rooms for name in (room.use, room.name)}
    for room in signal.rooms:
        if room not in known | set(USES):
            raise Failure(f"{path}:{signal.line}: signal '{signal.name}': the home has no room "
                          f"'{room}'; {did_you_mean(room, known, 'angen home FILE.world')}")
    return '' if known & set(signal.rooms) else f'the home has no {" or ".join(signal.rooms)}'


def _inside(signal: Signal, home: Home, rooms: Mapping[str, str]) -> set[str]:
    uses = {room.name: room.use for room in home.rooms}
    return {source for source, room in rooms.items()
            if room in signal.rooms or uses.get(room) in signal.rooms}


def _place(at: str, home: Home) -> str:
    """The first thing of a type; other places are names."""
    return next((thing.name for thing in home.things if thing.type == at), at)


def check_sources(rules: Rules, existing: Collection[str], places: Collection[str]) -> None:
    """Failure if a signal names an unknown source, or a rule an unknown place.

    `existing`: each KIND/NAME of a sensor or device; `places`: names of models, sensors, devices.
    """
    for signal in rules.signals.values():
        for pattern in (*signal.of, *signal.elsewhere):
            if not chosen([pattern], existing):
                raise Failure(f"{rules.path}:{signal.line}: signal '{signal.name}': the world has "
                              f'no {pattern}; {_suggest(pattern, existing)}')
    for rule in rules.rules:
        if rule.at and rule.at not in places:
            raise Failure(f"{rules.path}:{rule.line}: rule '{rule.name}': no source is named "
                          f"'{rule.at}'; {did_you_mean(rule.at, places, 'angen list')}")


def _suggest(pattern: str, existing: Collection[str]) -> str:
    kind = pattern.split('/')[0]
    same = [source for source in existing if source.startswith(f'{kind}/')]
    return did_you_mean(pattern.replace('*', ''), same or existing, LISTED)


def place_of(rule: Rule, rules: Rules, existing: Collection[str]) -> str:
    """The name of the model, sensor or device where a rule's warnings are shown; '' nowhere."""
    if rule.at:
        return rule.at
    signal = next((rules.signals[part.signal] for part in rule.when if part.signal), None)
    return min(chosen(signal.of[:1], existing)).split('/', 1)[1] if signal else ''
