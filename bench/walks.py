#!/usr/bin/env python3
"""Walks with long steps and with steps of 1 ms, from equal states: what each sensor reports.

    python3 bench/walks.py --walks 200

A person walks between places of the apartment whose doors are open, in two worlds with the
sensors of `angen generate`. An event is equal if the other world has it within a sample (40 ms).
"""
import argparse
import math
import tempfile
import time
from collections import defaultdict
from pathlib import Path
from random import Random

from angen_apps.data.site import SAMPLES, Site, apartment
from angen_apps.residents.figures import walker

SAMPLE = 1 / SAMPLES  # s
SETTLES = 12.0  # s: filters of motion sensors come to rest
NEAR, LIMIT = 0.35, 40.0  # m and s of a walk

Events = dict[tuple[str, str], list[float]]
Point = tuple[float, float]


class Walker:
    """One world, in which a person walks."""

    def __init__(self, path: Path, long_steps: bool) -> None:
        self.site, self.long_steps = Site(path, 7), long_steps
        self.world, self.spent, self.walked = self.site.world, 0.0, 0.0
        for door in self.world.devices('door'):
            self.world.command('door', door, 'Open')
        self.run(70.0)

    def run(self, seconds: float) -> None:
        self.world.run(seconds, long_steps=self.long_steps)

    def walk(self, points: list[Point], sent: list[float]) -> tuple[Events, Point]:
        """Sensors' events on a way, and where it ended. `sent`: when it went for each place; it is
        filled where it is empty."""
        room = self.site.home.room_at(*points[0], 0.5)
        self.site.simulator.appear('ann', walker('ann', 1.1, 'person'), *points[0],
                                   room.floor if room else 0.0, 0.0)
        self.run(SETTLES)
        self.world.events()
        begun, spent = self.world.time, time.process_time()
        times = list(sent)
        for number, point in enumerate(points[1:]):
            self.world.command('person', 'ann', f'GoTo {point[0]:.3f} {point[1]:.3f}')
            if times:
                self.run(times[number] - (self.world.time - begun))
                continue
            until = self.world.time + LIMIT
            while math.dist(self.at, point) > NEAR and self.world.time < until:
                self.run(0.2)
            sent.append(self.world.time - begun)
        self.run(2.0)
        self.spent += time.process_time() - spent
        self.walked += self.world.time - begun
        found: Events = defaultdict(list)
        for at, source, _, event, _ in self.world.events():
            if source != 'ann':
                found[source, event].append(at - begun)
        at = self.at
        self.site.simulator.vanish('ann')
        self.run(3.0)
        return found, at

    @property
    def at(self) -> Point:
        body = self.site.simulator.body('ann')
        return body.x, body.y


def differ(one: Events, other: Events) -> list[str]:
    """Events that only one has within a sample."""
    found = []
    for key in sorted({*one, *other}):
        a, b = one.get(key, []), other.get(key, [])
        if len(a) != len(b):
            found.append(f'{key[0]} {key[1]}: {len(a)} and {len(b)}')
        found += [f'{key[0]} {key[1]}: {x:.3f} and {y:.3f} s' for x, y in zip(a, b)
                  if abs(x - y) > SAMPLE + 1e-6]
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--walks', type=int, default=200)
    count = parser.parse_args().walks
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'home.world'
        apartment(path)
        fast, exact = Walker(path, True), Walker(path, False)
        floors, numbers = fast.site.floors, Random(5)
        rooms = [room for room in fast.site.home.rooms if room.use not in ('landing', 'outdoor')]
        events, wrong, away = 0, 0, 0.0
        for number in range(count):
            points = [floors.spots(numbers.choice(rooms).name, 1, numbers)[0] for _ in range(2)]
            sent: list[float] = []
            other, there = exact.walk(points, sent)
            one, at = fast.walk(points, sent)
            found = differ(one, other)
            events += sum(map(len, other.values()))
            wrong += len(found)
            away = max(away, math.dist(at, there))
            for line in found:
                print(f'walk {number}: {line}')
    print(f'{count} walks, {events} events, {wrong} differ by more than a sample; ends differ by '
          f'at most {1000 * away:.1f} mm; {1000 * fast.spent / fast.walked:.2f} ms of CPU time a '
          f'second with long steps, {1000 * exact.spent / exact.walked:.2f} ms without')


if __name__ == '__main__':
    main()
