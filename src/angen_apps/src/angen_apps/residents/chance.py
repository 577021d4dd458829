"""Random numbers that depend on their keys only: a day can be planned again without the others."""
from __future__ import annotations

import hashlib
import math
from random import Random
from typing import Sequence, TypeVar

Choice = TypeVar('Choice')

QUANTILE = 1.2816  # quantile of the normal distribution, at 10 % and 90 %
WIDEST = 1.5  # times the given range: values are clipped to it


def chance(*keys: object) -> Random:
    """Random numbers of these keys."""
    words = '\x1f'.join(str(key) for key in keys)
    return Random(int.from_bytes(hashlib.sha256(words.encode()).digest()[:8], 'big'))


def spread(numbers: Random, low: float, high: float) -> float:
    """A log-normal number (of a duration); a tenth of them is below `low`, a tenth above `high`."""
    if low >= high or low <= 0:
        return high
    middle = (math.log(low) + math.log(high)) / 2
    sigma = (math.log(high) - math.log(low)) / 2 / QUANTILE
    value = math.exp(numbers.gauss(middle, sigma))
    return min(max(value, low / WIDEST), high * WIDEST)


def around(numbers: Random, low: float, high: float) -> float:
    """A normal number (of a time of day) with the same quantiles, at most half a range outside."""
    middle, half = (low + high) / 2, (high - low) / 2
    return middle + min(max(numbers.gauss(0.0, half / QUANTILE), -2 * half), 2 * half)


def choose(numbers: Random, weighted: Sequence[tuple[Choice, float]]) -> Choice | None:
    """One of some things by weight; None if all weights are 0."""
    total = sum(weight for _, weight in weighted)
    if total <= 0:
        return None
    left = numbers.random() * total
    for thing, weight in weighted:
        left -= weight
        if left < 0:
            return thing
    return next(thing for thing, weight in reversed(weighted) if weight > 0)
