"""Which sensors and devices of a world the signals of rules mean."""
from __future__ import annotations

from dataclasses import replace
from fnmatch import fnmatchcase
from typing import Collection, Iterable, Mapping

from angen_tools.common.clock import time_of_day
from angen_apps.care.rules import Rules, Signal
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home
from angen_tools.common.nearest import did_you_mean

LISTED = 'angen watch --once'


def chosen(patterns: Iterable[str], existing: Collection[str]) -> set[str]:
    """The existing KIND/NAME that any pattern matches."""
    return {source for source in existing
            if any(fnmatchcase(source, pattern) for pattern in patterns)}


def at_home(rules: Rules, home: Home, rooms: Mapping[str, str]) -> Rules:
    """The rules with the sources that signals have by their rooms, and with the home's start.

    `rooms`: the room of each KIND/NAME. Failure where a signal names an unknown room.
    """
    uses = {room.name: room.use for room in home.rooms}
    known = {*uses.values(), *uses}
    signals = {}
    for name, signal in rules.signals.items():
        for room in signal.rooms:
            if room not in known:
                raise Failure(f"{rules.path}:{signal.line}: signal '{name}': the home has no room "
                              f"'{room}'; {did_you_mean(room, known, 'angen home FILE.world')}")
        if signal.rooms:
            inside = {source for source, room in rooms.items()
                      if room in signal.rooms or uses.get(room) in signal.rooms}
            of = tuple(sorted(chosen(signal.of, inside)))
            if not of:
                raise Failure(f"{rules.path}:{signal.line}: signal '{name}': no "
                              f"{' or '.join(signal.of)} is in {' or '.join(signal.rooms)}")
            signal = replace(signal, of=of)
        signals[name] = signal
    starts = rules.starts
    if starts is None:
        starts = time_of_day(home.start[11:]) if home.start else 0.0
    return replace(rules, starts=starts, signals=signals)


def check_sources(rules: Rules, existing: Collection[str], places: Collection[str]) -> None:
    """Failure where a signal names an unknown source, or a rule an unknown place.

    `existing`: each KIND/NAME of a sensor or device; `places`: names of models, sensors, devices.
    """
    for signal in rules.signals.values():
        for pattern in (*signal.of, *signal.elsewhere):
            if not chosen([pattern], existing):
                raise Failure(f"{rules.path}:{signal.line}: signal '{signal.name}': the world has "
                              f'no {pattern}; {_suggest(pattern, existing)}')
    for rule in rules.rules:
        if rule.at and rule.at not in places:
            raise Failure(f"{rules.path}:{rule.line}: rule '{rule.name}': nothing is named "
                          f"'{rule.at}'; {did_you_mean(rule.at, places, 'angen list')}")


def _suggest(pattern: str, existing: Collection[str]) -> str:
    kind = pattern.split('/')[0]
    same = [source for source in existing if source.startswith(f'{kind}/')]
    return did_you_mean(pattern.replace('*', ''), same or existing, LISTED)


def first_source(signal: Signal, existing: Collection[str]) -> str:
    """The NAME of the first thing that a signal means."""
    return min(chosen(signal.of[:1], existing)).split('/', 1)[1]
