"""Suggestions where a name is not known."""
from __future__ import annotations

from difflib import SequenceMatcher
from typing import Iterable

COUNT = 3
WHOLE = 3  # letters that a name has at least to be a part of another


def nearest(name: str, known: Iterable[str]) -> list[str]:
    """The few known names that are most like `name`, whatever its case, the nearest first; those
    that hold it as a part before others.
    """
    def likeness(other: str) -> tuple[bool, float]:
        ratio = SequenceMatcher(None, name.lower(), other.lower()).ratio()
        return len(name) >= WHOLE and name.lower() in other.lower(), ratio
    return sorted(sorted(set(known)), key=likeness, reverse=True)[:COUNT]


def did_you_mean(name: str, known: Iterable[str], listing: str = '') -> str:
    """As in the simulator's messages: "did you mean a, b or c?"; "there are none" of none.

    The command `listing` is named where there are more.
    """
    every = set(map(str, known))
    if not every:
        return 'there are none'
    *first, last = nearest(name, every)
    question = f'did you mean {", ".join(first)}{" or " * bool(first)}{last}?'
    more = listing and len(every) > COUNT
    return question + f' `{listing}` lists all' * bool(more)
