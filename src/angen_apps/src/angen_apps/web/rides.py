"""Elevators of a generated day, and the residents whom their cabins carry."""
import bisect
import math
from dataclasses import dataclass, field
from typing import Iterable, Iterator

IN = 0.6  # m from the middle of a cabin to one who rides in it
RISES = 0.5  # m, by which links of a cabin differ from the leaves of a landing
STILL = 0.002  # m: a cabin that has moved less is where it was
PAUSE = 2.0  # s without a slide end a ride


@dataclass
class Cabin:
    """Heights of a cabin over time; its middle on each floor."""

    x: float
    y: float
    times: list[float] = field(default_factory=list)
    heights: list[float] = field(default_factory=list)

    def height(self, time: float) -> float:
        """m, between two that were recorded the earlier one."""
        return self.heights[max(0, bisect.bisect_right(self.times, time) - 1)]

    def between(self, begin: float, end: float) -> Iterator[tuple[float, float]]:
        """Times and heights after `begin` and before `end`."""
        first, last = bisect.bisect_right(self.times, begin), bisect.bisect_left(self.times, end)
        return zip(self.times[first:last], self.heights[first:last])

    def states(self) -> Iterator[tuple[float, str, float]]:
        """Times, modes as elevators have them, and m over where it is at the start."""
        ends = [*zip(self.times[1:], self.heights[1:]), (math.inf, 0.0)]
        for time, height, (end, to) in zip(self.times, self.heights, ends):
            rests = end - time > PAUSE or abs(to - height) < STILL
            yield (time, 'IDLE' if rests else 'UP' if to > height else 'DOWN',
                   height - self.heights[0])

    def has(self, x: float, y: float) -> bool:
        """Whether a place, on any floor, is in the cabin or in its shaft."""
        return math.dist((self.x, self.y), (x, y)) < IN


def cabins(slides: Iterable[tuple[float, str, str, float]],
           middles: dict[str, tuple[float, float]]) -> dict[str, Cabin]:
    """By model, of time, model, link and height of each slide, and each model's middle."""
    lines: dict[tuple[str, str], Cabin] = {}
    for time, model, link, z in slides:
        if model in middles:
            line = lines.setdefault((model, link), Cabin(*middles[model]))
            line.times.append(time)
            line.heights.append(z)
    return {model: line for (model, _), line in lines.items()
            if max(line.heights) - min(line.heights) > RISES}


class Rider:
    """The height of a resident's floor over time: that of the storey, or of the cabin."""

    def __init__(self, cabins: list[Cabin], floor: float) -> None:
        self._cabins = cabins
        self._inside: Cabin | None = None
        self._over = 0.0  # m of the floor over the cabin's height
        self.floor = floor

    def step(self, time: float, x: float, y: float, floor: float | None,
             until: float) -> Iterator[tuple[float, float]]:
        """The floor at a time, and at those until the next step at which a cabin moves it."""
        before, self._inside = self._inside, next((c for c in self._cabins if c.has(x, y)), None)
        if self._inside is None:
            self.floor = self.floor if floor is None else floor
        elif self._inside is not before:
            self._over = (self.floor if floor is None else floor) - self._inside.height(time)
        if self._inside is not None:
            self.floor = self._over + self._inside.height(time)
        yield time, self.floor
        if self._inside is not None:
            for moment, height in self._inside.between(time, until):
                self.floor = self._over + height
                yield moment, self.floor
