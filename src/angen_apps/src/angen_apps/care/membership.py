"""Fuzzy membership: the degree, 0 to 1, to which a quantity belongs to a set."""
import math
from dataclasses import dataclass
from typing import Sequence


@dataclass(frozen=True)
class Trapezoid:
    """Rises from `a` to `b`, is 1 to `c`, falls to 0 at `d`; edges may be upright or at infinity.

    With a `cycle` the quantity is a periodic one, as the time of day is.
    """

    a: float
    b: float
    c: float = math.inf
    d: float = math.inf
    cycle: float = 0.0

    def degree(self, value: float) -> float:
        """The degree of membership; 1 at the corner of an upright edge."""
        if self.cycle:
            value = self.a + (value - self.a) % self.cycle
        if value < self.a or value > self.d:
            return 0.0
        if value < self.b:
            return (value - self.a) / (self.b - self.a)
        if value <= self.c:
            return 1.0
        return (self.d - value) / (self.d - self.c)


def around(corners: Sequence[float], cycle: float) -> Trapezoid:
    """Four corners of a periodic quantity: each is the next after the one before.

    ValueError where they go round more than once.
    """
    a, b, c, d = corners
    b = a + (b - a) % cycle
    c = b + (c - b) % cycle
    d = c + (d - c) % cycle
    if d - a > cycle:
        raise ValueError('span more than 24 hours')
    return Trapezoid(a, b, c, d, cycle)
