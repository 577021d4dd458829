"""Which sensors and devices of a world the signals of rules mean."""
from __future__ import annotations

from fnmatch import fnmatchcase
from typing import Collection, Iterable

from angen_apps.care.rules import Rules, Signal
from angen_tools.common.failure import Failure
from angen_tools.common.nearest import did_you_mean

LISTED = 'angen watch --once'


def chosen(patterns: Iterable[str], existing: Collection[str]) -> set[str]:
    """The existing KIND/NAME that any pattern matches."""
    return {source for source in existing
            if any(fnmatchcase(source, pattern) for pattern in patterns)}


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
