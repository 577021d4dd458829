#!/usr/bin/env python3
"""Measures single ticks while all lamps, doors and the elevator of the building are used.

    python3 bench/ticks.py                 10 minutes of simulated time, some minutes
    python3 bench/ticks.py --seconds 130

CPU time of the ticking thread, without ROS. Once a minute a lamp and a luminosity sensor are
spawned and deleted; their files are loaded in the same thread, unlike in the node.
"""
import argparse
import gc
import sys
import time
from pathlib import Path
from typing import Callable, Iterator

import angen
import numpy as np

STEP = 0.001  # s
LIMIT = 20.0  # ms
WORLDS = Path(__file__).resolve().parent.parent / 'worlds'
LAMP = 'model://ceiling_lamp'
SENSOR = 'model://luminosity_sensor'


def uses(world: angen.World, second: int) -> Iterator[Callable[[], None]]:
    """The work at the start of one second; each call takes a tick."""
    lamps, doors = world.devices('lamp'), world.devices('door')
    if second == 2:
        yield lambda: world.command('lamp', 'all', 'On')
    elif second % 60 == 59:
        yield lambda: world.command('lamp', 'all', 'Off' if second % 120 == 59 else 'On')
    elif second > 10:
        name, text = lamps[second % len(lamps)], ('Off', 'On', 'Dim 40')[second // len(lamps) % 3]
        yield lambda: world.command('lamp', name, text)
    if second % 2 == 1:
        turn, door = divmod(second // 2, len(doors))
        yield lambda: world.command('door', doors[door], 'Close' if turn % 2 else 'Open')
    if second % 8 == 5:
        yield lambda: world.command('elevator', 'all', f'Floor{second // 8 % 2}')
    if second % 60 == 30:
        yield lambda: world.spawn(LAMP, 'bench0', [2.0, 2.0, 2.3, 0, 0, 0])
    if second % 60 == 35:
        yield lambda: world.command('lamp', 'bench0', 'On')
    if second % 60 == 40:
        yield lambda: world.spawn(SENSOR, 'bench_lux', [2.0, 2.5, 1.5, 0, 0, 0])
    if second % 60 == 50:
        yield lambda: world.delete('bench0')
        yield lambda: world.delete('bench_lux')


def measure(world: angen.World, seconds: int) -> tuple[np.ndarray, np.ndarray]:
    """Simulated time and CPU time in ms of each tick."""
    rows = []

    def tick(call: Callable[[], None]) -> None:
        start = time.thread_time_ns()
        call()
        rows.append((world.time, (time.thread_time_ns() - start) / 1e6))
    for second in range(seconds):
        for use in uses(world, second):
            tick(use)
        while world.time < second + 1 - STEP / 2:
            tick(world.step)
    t, spent = np.array(rows).T
    return t, spent


def main() -> int:
    """The program."""
    parser = argparse.ArgumentParser(description=__doc__.split('\n', 1)[0])
    parser.add_argument('--seconds', type=int, default=600, help='of simulated time (600)')
    parser.add_argument('--world', default=str(WORLDS / 'angen.world'), help='(worlds/angen.world)')
    options = parser.parse_args()
    world = angen.World(options.world)
    gc.disable()
    t, spent = measure(world, options.seconds)
    print(f'{len(spent)} ticks, {spent.sum() / 1e3:.1f} s of CPU time')
    print(f'longest {spent.max():.1f} ms, {(spent > LIMIT).sum()} of more than {LIMIT:.0f} ms, '
          f'first {spent[0]:.1f} ms')
    print('percentiles 50, 99, 99.9: ' + ', '.join(
        f'{value:.3f} ms' for value in np.percentile(spent, (50, 99, 99.9))))
    print('the longest: ' + ', '.join(f'{spent[i]:.1f} ms at {t[i]:.3f} s'
                                      for i in np.argsort(spent)[::-1][:10]))
    print(f'fingerprint {world.fingerprint}')
    return 0


if __name__ == '__main__':
    sys.exit(main())
