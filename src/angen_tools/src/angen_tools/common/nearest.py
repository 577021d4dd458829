"""Suggestions where a name is not known."""
from difflib import SequenceMatcher
from typing import Iterable, Sequence

COUNT = 3
FAR = 0.6  # share of the likeness of the nearest: less is another word
WHOLE = 3  # letters that a name has at least to be a part of another


def nearest(name: str, known: Iterable[str]) -> list[str]:
    """The few known names that are most like `name`, whatever its case, the nearest first; those
    that hold it as a part before others. Names that are much less like it than the nearest are left
    out. An address as model://NAME is as like as its NAME.
    """
    short = name.lower().rpartition('//')[2]

    def likeness(other: str) -> tuple[bool, float]:
        whole = other.lower().rpartition('//')[2]
        return (len(short) >= WHOLE and short in whole,
                SequenceMatcher(None, short, whole).ratio())
    found = sorted(sorted(set(known)), key=likeness, reverse=True)[:COUNT]
    least = FAR * max((likeness(other)[1] for other in found), default=0.0)
    return [other for other in found if likeness(other)[0] or likeness(other)[1] >= least]


def did_you_mean(name: str, known: Iterable[str], listing: str = '') -> str:
    """As in the simulator's messages: "did you mean a, b or c?"; "there are none" of none.

    The command `listing` is named where there are more.
    """
    every = set(map(str, known))
    if not every:
        return 'there are none'
    more = listing and len(every) > COUNT
    return asked(nearest(name, every)) + f' `{listing}` lists all' * bool(more)


def asked(names: Sequence[str]) -> str:
    """The question for some names, at least one."""
    *first, last = names
    return f'did you mean {", ".join(first)}{" or " * bool(first)}{last}?'
