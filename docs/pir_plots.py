"""The plots of docs/sensors/pir.md; docs/plots.py draws them."""
import math
from typing import Iterable

import angen
import matplotlib.pyplot as plt
import numpy as np
import plot_base
from plot_base import ROOT, include, sampled, sdf_world

LENSES = ROOT / 'src/angen_sim/sensors/pir/lenses.txt'
AZIMUTHS = np.arange(-60, 60.1, 3)  # degrees
HEIGHT = 2.2  # m


def room(content: str) -> angen.World:
    """A floor, and `content`; steps of 5 ms."""
    text = sdf_world(content).replace('0.001', '0.005').replace('20 20 0.1', '60 60 0.1')
    return angen.World.from_text(text, seed=1)


def pir(name: str, azimuth: float) -> str:
    """A PIR that has the x axis in this direction, in degrees to its left."""
    return include('pir_pyroelectric', name, f'0 0 {HEIGHT} 0 0 {-math.radians(azimuth)}')


def walker(points: Iterable[tuple[float, float, float]]) -> str:
    """A person who is at x y at each time t, after that at the last."""
    return plot_base.walker('anna', *(f'{t} {x} {y}' for t, x, y in points), plugin='''
      <plugin name="person" filename="libperson_controller.so"><avoid>false</avoid>
      <force_max>2000</force_max></plugin>''')


def first_motion(points: list[tuple[float, float, float]], start: float) -> dict[float, float]:
    """When each PIR that has the walk in its azimuth first detects it after `start`."""
    names = {f'p{i}': float(azimuth) for i, azimuth in enumerate(AZIMUTHS)}
    w = room(''.join(pir(*each) for each in names.items()) + walker(points))
    w.run(start)
    w.events()
    w.run(points[-1][0] - start)
    found: dict[float, float] = {}
    for time, source, _, event, _ in w.events():
        if event == 'motion':
            found.setdefault(names[source], time)
    return found


def radial_ranges(farthest: float = 14.0) -> list[float]:
    """By azimuth, how far away who walks towards the detector is when it detects him."""
    start, nearest = 4.0, 0.6
    found = first_motion([(0, farthest, 0), (start, farthest, 0),
                          (start + farthest - nearest, nearest, 0)], start)
    return [farthest - (found[azimuth] - start) if azimuth in found else 0.0
            for azimuth in map(float, AZIMUTHS)]


def tangential_ranges(farthest: int = 20) -> list[float]:
    """By azimuth, up to which distance who crosses it is detected, from 1 m on."""
    ranges = dict.fromkeys(map(float, AZIMUTHS), 0.0)
    reached = set(ranges)
    for away in range(1, farthest + 1):
        found = first_motion([(0, away, -1.5), (4, away, -1.5), (7, away, 1.5), (8, away, 1.5)], 4)
        reached &= set(found)
        for azimuth in reached:
            ranges[azimuth] = away
    return list(ranges.values())


def pir_polar() -> plt.Figure:
    drawn, ax = plt.subplots(figsize=(7, 4.4), subplot_kw={'projection': 'polar'})
    for label, ranges in (('across', tangential_ranges()), ('towards it', radial_ranges())):
        ax.plot(np.radians(AZIMUTHS), ranges, '.-', label=label)
    ax.plot(np.radians(AZIMUTHS), [12] * len(AZIMUTHS), ':', color='0.4', label='rated')
    ax.set_theta_zero_location('N')
    ax.set_thetalim(-math.pi / 3, math.pi / 3)
    ax.set_rticks(range(0, 21, 4))
    ax.legend(loc='lower center', ncols=3, fontsize=8, bbox_to_anchor=(0.5, 0.02))
    ax.set_title('A person is detected up to here, m, at 1 m/s', fontsize=10)
    return drawn


def pir_zones() -> plt.Figure:
    rows = [[float(word) for word in line.split()[1:]]
            for line in LENSES.read_text().splitlines() if line.startswith('area ')]
    drawn, ax = plt.subplots(figsize=(7, 4))
    for pairs, right, left, low, high in rows:
        width = (left - right) / pairs / 4
        for zone in range(2 * int(pairs)):
            middle = right + width * (2 * zone + 1)
            ax.add_patch(plt.Rectangle((middle - width / 2, low), width, high - low, color=(
                'tab:red' if zone % 2 == 0 else 'tab:blue')))
    for away in (12, 6, 3):
        spread = np.degrees(np.arcsin(0.25 / away))
        feet, head = (-np.degrees(np.arctan2(below, away)) for below in (HEIGHT, HEIGHT - 1.75))
        ax.add_patch(plt.Rectangle((-spread, feet), 2 * spread, head - feet, fill=False))
        ax.annotate(f'{away} m', (spread, feet), fontsize=7)
    ax.set_xlim(60, -60)
    ax.set_ylim(-62, 2)
    ax.set_xlabel('azimuth, degrees to its left')
    ax.set_ylabel('elevation, degrees')
    ax.set_title('Zones of the lens "area", and a person who comes straight towards it',
                 fontsize=10)
    return drawn


def pir_signal() -> plt.Figure:
    w = room(pir('eye', 0) + walker([(0, 5, -4), (2, 5, -4), (10, 5, 4), (16, 5, 4), (20, 9, 4),
                                     (24, 9, 0), (28, 9, 0), (36.4, 0.6, 0), (40, 0.6, 0)]))
    times, (volts, motion) = sampled(w, 0.02, 2000, lambda: (
        1e6 * w.sensor('pir', 'eye')['signal'], w.sensor('pir', 'eye')['motion']))
    drawn, (ax, state) = plt.subplots(2, 1, sharex=True, figsize=(7, 4.6), height_ratios=[3, 1])
    ax.plot(times, volts, linewidth=0.8)
    for limit in (-300, 300):
        ax.axhline(limit, color='tab:red', linewidth=0.8)
    for time, words in ((2, 'across at 5 m'), (10, 'stands'), (16, 'away, across at 9 m'),
                        (24, 'stands'), (28, 'towards it')):
        ax.axvline(time, color='0.8', linewidth=0.8)
        ax.annotate(words, (time, 0.97), xycoords=('data', 'axes fraction'), fontsize=7, va='top')
    ax.set_yscale('symlog', linthresh=1000)
    ax.set_ylabel('signal, µV')
    state.step(times, motion, where='post')
    state.set_yticks([0, 1], ['still', 'motion'])
    state.set_xlim(0, 40)
    state.set_xlabel('s')
    return drawn
