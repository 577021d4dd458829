"""The walks of a person in a walk test. In m; the detector is at 0 0 and faces along x."""
import math
from dataclasses import dataclass, field
from typing import Any, Iterator, Mapping

TRANSIT = 1.0   # m/s, between probes
BLIND = 0.5     # m: no probe is nearer to the detector


@dataclass(frozen=True)
class Area:
    """A sector that a detector is declared to cover."""
    reach: float
    angle: float  # degrees, all of it

    def holds(self, x: float, y: float) -> bool:
        """Whether a point of the floor is in it."""
        off = math.degrees(abs(math.atan2(y, x)))
        return BLIND <= math.hypot(x, y) <= self.reach and off <= self.angle / 2

    @property
    def half_width(self) -> float:
        return self.reach * math.sin(math.radians(min(self.angle, 180.0) / 2))


@dataclass
class Probe:
    """One thing to be detected: a walk from `start` to `end`, or an arm that moves at `place`."""
    place: tuple[float, float]
    start: tuple[float, float]
    end: tuple[float, float]
    direction: str
    begins: float = 0.0  # s
    ends: float = 0.0
    seen: bool = False


@dataclass
class Walk:
    """Probes in the order in which they are walked, and the way there: rows of t x y yaw."""
    probes: list[Probe]
    waypoints: list[tuple[float, float, float, float]] = field(default_factory=list)

    @property
    def duration(self) -> float:
        return self.waypoints[-1][0]


@dataclass
class Result:
    """One test of a standard: all that was tried, and how much of it had to be seen."""
    name: str
    area: Area
    probes: list[Probe]
    required: float  # share of the places
    cell: float | None = None  # m, where the places are squares

    @property
    def places(self) -> dict[tuple[float, float], bool]:
        """Whether a person was detected there, from any direction."""
        seen: dict[tuple[float, float], bool] = {}
        for probe in self.probes:
            seen[probe.place] = seen.get(probe.place, False) or probe.seen
        return seen

    @property
    def share(self) -> float:
        return sum(self.places.values()) / len(self.places)

    @property
    def passed(self) -> bool:
        return self.share >= self.required


def cells(area: Area, size: float) -> list[tuple[float, float]]:
    """Middles of the squares of a grid whose middle is in the area, from near to far."""
    across = math.ceil(area.half_width / size) + 1
    return [(x, y) for i in range(math.ceil(area.reach / size))
            for j in range(-across, across)
            if area.holds(x := (i + 0.5) * size, y := (j + 0.5) * size)]


def crossings(area: Area, size: float, direction: str) -> list[Probe]:
    """A walk through every cell, line by line: `across` (along y) or `towards` the detector."""
    half = size / 2
    if direction == 'across':
        return [Probe((x, y), (x, y - half), (x, y + half), direction)
                for x, y in sorted(cells(area, size))]
    return [Probe((x, y), (x + half, y), (x - half, y), direction)
            for x, y in sorted(cells(area, size), key=lambda place: (place[1], -place[0]))]


def boundary(area: Area, spacing: float, length: float) -> list[Probe]:
    """Walks inwards over the arc that bounds the area, at 45 degrees to the way to the detector."""
    half_angle = math.radians(area.angle / 2)
    count = max(1, round(2 * half_angle * area.reach / spacing))
    probes = []
    for k in range(count + 1):
        angle = half_angle * (2 * k / count - 1)
        x, y = area.reach * math.cos(angle), area.reach * math.sin(angle)
        heading = angle + math.pi + math.copysign(math.pi / 4, angle)
        dx, dy = length / 2 * math.cos(heading), length / 2 * math.sin(heading)
        probes.append(Probe((x, y), (x - dx, y - dy), (x + dx, y + dy), 'inwards'))
    return probes


def approaches(area: Area, count: int, end: float) -> list[Probe]:
    """Walks straight towards the detector down to `end` m, from `count` directions of the area."""
    probes = []
    for k in range(count):
        angle = math.radians(area.angle * (k / (count - 1) - 0.5))
        x, y = math.cos(angle), math.sin(angle)
        start = area.reach * x, area.reach * y
        probes.append(Probe(start, start, (end * x, end * y), 'approach'))
    return probes


def arms(area: Area, size: float) -> list[Probe]:
    """An arm in the middle of every cell."""
    return [Probe(place, place, place, 'arm') for place in cells(area, size)]


def probes_of(test: Mapping[str, Any], area: Area) -> Iterator[list[Probe]]:
    """The probes of one test of a standard, a list for each walk."""
    if test['mover'] == 'arm':
        yield arms(area, test['cell'])
    elif 'boundary' in test:
        yield boundary(area, test['boundary'], test['length'])
    elif 'approaches' in test:
        yield approaches(area, test['approaches'], test['end'])
    else:
        for direction in test['directions']:
            yield crossings(area, test['cell'], direction)


def walk(probes: list[Probe], speed: float, stop: float) -> Walk:
    """The way through all probes, standing for `stop` s before and after each; sets their times."""
    way = Walk(probes)
    time, at = 0.0, probes[0].start

    def go(to: tuple[float, float], pace: float) -> None:
        nonlocal time, at
        time += math.dist(at, to) / pace
        yaw = math.atan2(to[1] - at[1], to[0] - at[0])
        way.waypoints.append((time, *to, yaw))
        at = to

    def stand() -> None:
        nonlocal time
        time += stop
        way.waypoints.append((time, *at, way.waypoints[-1][3]))

    way.waypoints.append((time, *at, 0.0))
    stand()
    for probe in probes:
        if math.dist(at, probe.start) > 1e-6:
            go(probe.start, TRANSIT)
            stand()
        probe.begins = time
        go(probe.end, speed)
        probe.ends = time
        stand()
    return way
