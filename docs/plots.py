#!/usr/bin/env python3
"""Draws the plots of docs/sensors and docs/devices from runs of the simulator, into docs/images.

    ./angen shell
    python3 docs/plots.py            # all of them, or the names of some
"""
import sys
from typing import Callable

import matplotlib
import numpy as np

import angen

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

from device_plots import (appliance, cup, cup_cools, plant, stove,  # noqa: E402
                          warm_surface)
from pir_plots import pir_polar, pir_signal, pir_zones  # noqa: E402
from plot_base import (ROOT, air, box, curves, figure, holder, include, sampled,  # noqa: E402
                       sensor, states, world)

IMAGES = ROOT / 'docs/images'


def proximity() -> plt.Figure:
    w = world(include('proximity', 'd', '0 0 0.5 0 0 0'))
    times, truth, read = [], [], []
    for k in range(60):
        away = 3.2 - 0.05 * k
        post = 20 <= k < 35
        w.spawn(box('wall', '0 0 0 0 0 0', '0.1 3 1', True), 'wall',
                [away + 0.05, 0, 0.5, 0, 0, 0])
        if post:
            w.spawn(box('post', '0 0 0 0 0 0', '0.05 0.05 1', True), 'post',
                    [away - 0.3, 0, 0.5, 0, 0, 0])
        w.run(0.1)
        times.append(w.time)
        truth.append(away - 0.325 if post else away)
        read.append(w.sensor('proximity', 'd')['range'])
        w.delete('wall')
        if post:
            w.delete('post')
    drawn, (ax, error) = figure(2, 'Proximity')
    ax.plot(times, truth, color='0.6', label='nearest face')
    ax.plot(times, read, '.', label='range')
    ax.set_ylabel('m')
    ax.legend()
    curves(error, times, 'error, mm', {'': 1000 * (np.array(read) - truth)}, 's', '.')
    return drawn


def pressure_mat() -> plt.Figure:
    w = world(include('pressure_mat', 'm'))
    steps = {2.0: ('low', 9.0, 0.156), 6.0: ('high', 20.0, 0.457)}
    times, load, pressed = [], [], []
    while w.time < 16:
        for at, (name, mass, z) in steps.items():
            if abs(w.time - at) < 1e-6:
                w.spawn(box(name, '0 0 0 0 0 0', '0.3 0.3 0.3', mass=mass), name,
                        [0, 0, z, 0, 0, 0])
        for at, name in ((10.0, 'high'), (13.0, 'low')):
            if abs(w.time - at) < 1e-6:
                w.delete(name)
        w.run(0.5)
        times.append(w.time)
        load.append(w.sensor('pressure', 'm')['load'])
        pressed.append(w.sensor('pressure', 'm')['pressed'])
    drawn, (ax, state) = figure(2, 'Pressure mat, threshold 10 kg, release 8 kg')
    ax.step(times, load, where='post')
    ax.axhline(10, color='tab:red', linewidth=0.8)
    ax.axhline(8, color='tab:orange', linewidth=0.8)
    ax.set_ylabel('load, kg')
    states(state, times, pressed, ['free', 'pressed'])
    return drawn


def reed() -> plt.Figure:
    w = world(include('window', 'hall_window0', '0 0 1 0 0 0'))
    times, (angles, closed) = sampled(
        w, 0.01, 800, lambda: (-w.joint('hall_window0::sash')['position'],
                               w.sensor('reed', 'hall_window0')['closed']),
        [(50, 'window', 'hall0', 'Set -0.2'), (400, 'window', 'hall0', 'Close')])
    drawn, (ax, state) = figure(2, 'Reed contact of a window')
    curves(ax, times, 'sash, rad', {'': angles})
    ax.axhline(0.0172, color='tab:red', linewidth=0.8, label='opens')
    ax.axhline(0.0097, color='tab:orange', linewidth=0.8, label='closes')
    ax.legend()
    states(state, times, closed, ['open', 'closed'])
    return drawn


def rfid() -> plt.Figure:
    places = [(x, y) for x in np.arange(-0.5, 2.41, 0.1) for y in np.arange(-2.2, 2.21, 0.1)]
    tags = ''.join(include('rfid_tag', f't{i}', f'{x + 0.013} {y + 0.007} 1 0 0 0')
                   for i, (x, y) in enumerate(places))
    w = world(include('rfid_reader', 'r', '0 0 1 0 0 0')
              + box('a', '1 0.7 1 0 0 0', '0.1 1 2', True)
              + box('b', '1 -0.6 1 0 0 0', '0.1 0.6 2', True) + tags)
    w.run(0.2)
    seen = {int(name[1:]) for name in w.sensor('rfid', 'r')['ids']}
    drawn, ax = plt.subplots(figsize=(5, 6))
    for read, color in ((False, '0.85'), (True, 'tab:blue')):
        chosen = [p for i, p in enumerate(places) if (i in seen) == read]
        ax.plot(*zip(*chosen), '.', color=color, label='read' if read else 'not read')
    for x, y, half in ((1, 0.7, 0.5), (1, -0.6, 0.3)):
        ax.add_patch(plt.Rectangle((x - 0.05, y - half), 0.1, 2 * half, color='0.3'))
    ax.plot(0, 0, '>', color='tab:red', markersize=10, label='reader')
    ax.set_aspect('equal')
    ax.set_xlabel('m')
    ax.set_ylabel('m')
    ax.legend(loc='lower right')
    ax.set_title('RFID reader, 2 m, 120 degrees', fontsize=10)
    return drawn


def smart_plug() -> plt.Figure:
    w = world(include('heater', 'heater1')
              + holder('p', sensor('libsmart_plug.so', '<load>heater/heater1</load>', 2)))

    def read() -> tuple[float, float]:
        reading = w.sensor('plug', 'p')
        return reading['power'], reading['energy'] / 3600

    times, (power, energy) = sampled(w, 0.5, 240, read, [
        (20, 'heater', 'heater1', 'On'), (100, 'heater', 'heater1', 'Set 40'),
        (180, 'heater', 'heater1', 'Off')])
    drawn, (ax, sum_) = figure(2, 'Smart plug with a heater')
    ax.step(times, power, where='post')
    ax.set_ylabel('W')
    curves(sum_, times, 'Wh', {'': energy}, 's')
    return drawn


def temperature() -> plt.Figure:
    w = world(air('0 0.05 0 4 3 2.5', '0 -3 0 4 -0.05 2.5',
                  extra='<heat_capacity>5</heat_capacity>')
              + include('heater', 'heater1', '0.1 1.5 0 0 0 0')
              + include('kitchen_door', 'hall_door0', '1.5 0 0 0 0 0')
              + include('temperature_sensor', 'warm', '2 1.5 1.5 0 0 0')
              + include('temperature_sensor', 'cold', '2 -1.5 1.5 0 0 0')
              + include('humidity_sensor', 'h', '2 1.4 1.5 0 0 0'))
    times, (warm, cold, humidity) = sampled(
        w, 5, 180, lambda: (w.sensor('temperature', 'warm')['temperature'],
                            w.sensor('temperature', 'cold')['temperature'],
                            w.sensor('humidity', 'h')['humidity']),
        [(0, 'heater', 'heater1', 'On'), (60, 'door', 'hall0', 'Open')])
    drawn, (ax, wet) = figure(2, 'A heater of 1 kW in one of two rooms; the door opens after 5 min')
    curves(ax, times / 60, '°C', {'room with the heater': warm, 'next room': cold})
    curves(wet, times / 60, '% RH by the heater', {'': humidity}, 'min')
    return drawn


def battery() -> plt.Figure:
    w = world(include('turtlebot', 'robot', '0 0 0.001 0 0 0', '''<plugin name="battery"
      filename="librobot_battery.so"><capacity>0.08</capacity><level>9</level></plugin>'''))
    times, (charge, speed) = sampled(
        w, 0.5, 100, lambda: (100 * w.device('battery', 'robot_battery')['percentage'],
                              w.device('drive', 'robot')['v']),
        [(step, 'drive', 'robot', '0.4 0.4') for step in range(21, 100)])
    drawn, (ax, fast) = figure(2, 'Battery of a TurtleBot')
    curves(ax, times, '%', {'': charge})
    curves(fast, times, 'm/s', {'': speed}, 's')
    return drawn


def coupled_levels(doors: list[dict]) -> list[float]:
    """Levels in three rooms of 4 m x 2.9 m x 2.5 m in a row, by the equations of the page."""
    surface = 2 * (4 * 2.9 + 2.9 * 2.5 + 4 * 2.5)
    balance = np.diag([0.2 * surface] * 3)
    for i, door in enumerate(doors):
        gap, width, height = door['gap'], door['width'], door['height']
        passed = (height * (gap + (width - gap) * 10 ** -2.2)
                  + (10 - height * width) * 10 ** -3.8)
        balance[[i, i + 1], [i, i + 1]] += passed
        balance[[i, i + 1], [i + 1, i]] -= passed
    power = 10 ** ((95 - 20 * np.log10(2)) / 10)
    fields = np.linalg.solve(balance, [0.8 * power, 0, 0])
    direct = np.array([2 * power / (4 * np.pi * 2.0 ** 2), 0, 0])
    return list(10 * np.log10(4 * fields + direct + 10 ** 3))


def microphone() -> plt.Figure:
    w = world(air('0 0.05 0 4 2.95 2.5', '0 -2.95 0 4 -0.05 2.5', '0 -5.95 0 4 -3.05 2.5')
              + include('stereo', 'stereo', '0.9 1.5 0.9 0 0 0')
              + include('kitchen_door', 'near_door0', '1.5 0 0 0 0 0')
              + include('kitchen_door', 'far_door0', '1.5 -3 0 0 0 0')
              + include('microphone', 'm0', '3 1.5 1 0 0 3.14159')
              + ''.join(include('microphone', f'm{i}', f'2 {-3 * i + 1.4} 1.2 0 0 0')
                        for i in (1, 2)))

    def read() -> list[float]:
        return [*(w.sensor('microphone', f'm{i}')['level'] for i in range(3)),
                *coupled_levels([w.device('door', name) for name in ('near0', 'far0')])]

    times, columns = sampled(w, 0.25, 160, read, [
        (0, 'appliance', 'stereo', 'Volume 50'), (0, 'appliance', 'stereo', 'On'),
        (40, 'door', 'near0', 'Open'), (80, 'door', 'far0', 'Open'),
        (120, 'door', 'near0', 'Close')])
    drawn, (ax,) = figure(1, 'A stereo in the first of three rooms')
    drawn.set_size_inches(7, 4.2)
    for expected in columns[3:]:
        ax.plot(times, expected, color='0.7', linewidth=4)
    curves(ax, times, 'dB', dict(zip(('its room, 2 m away', 'second room', 'third room'), columns)),
           's')
    ax.legend(loc='lower right')
    return drawn


def radio() -> plt.Figure:
    w = angen.World(str(ROOT / 'worlds/angen.world'))
    w.spawn('model://radio_beacon', 'kitchen_beacon', [0.3, 1.0, 1.2, 0, 0, 0])
    corners = np.array([(3.6, 1.0), (2.9, 2.4), (2.9, 4.9), (6.3, 4.9), (9.3, 5.2), (9.3, 8.5)])
    path, walked = [], [0.0]
    for start, end in zip(corners, corners[1:]):
        steps = max(2, round(float(np.linalg.norm(end - start)) / 0.1))
        path += [start + (end - start) * i / steps for i in range(steps)]
    for here, before in zip(path[1:], path):
        walked.append(walked[-1] + float(np.linalg.norm(here - before)))
    rssi, free = [], []
    for x, y in path:
        w.spawn('model://radio_receiver', 'walker', [x, y, 1.2, 0, 0, 0])
        w.run(0.002)
        reading = w.sensor('receiver', 'walker')
        rssi.append(dict(zip(reading['ids'], reading['rssi'])).get('kitchen_beacon', np.nan))
        free.append(-20 * np.log10(4 * np.pi * np.hypot(x - 0.3, y - 1.0) * 2440 / 299.792458))
        w.delete('walker')
    drawn, (ax,) = figure(1, 'A beacon of 0 dBm in the kitchen')
    drawn.set_size_inches(7, 4)
    ax.plot(walked, free, color='0.7', label='free space')
    curves(ax, walked, 'dBm', {'RSSI': rssi}, 'm walked', '.-')
    return drawn


def load_cells() -> plt.Figure:
    places = [(x, y) for x in (-0.15, 0.0, 0.15) for y in (-0.15, 0.0, 0.15)]
    drawn, ax = plt.subplots(figsize=(5, 5))
    for mass, mark in ((0.5, 'o'), (4.0, 's')):
        said = []
        for x, y in places:
            w = world(include('weighing_table', 't', '0 0 0.001 0 0 0')
                      + box('crate', f'{x} {y} 0.555 0 0 0', '0.1 0.1 0.1', mass=mass))
            w.run(3)
            reading = w.sensor('load_cells', 't')
            said.append((reading['x'], reading['y']))
        ax.plot(*zip(*said), mark, fillstyle='none', label=f'located, {mass:g} kg')
    ax.plot(*zip(*places), 'k+', markersize=12, label='center of the crate')
    ax.add_patch(plt.Rectangle((-0.225, -0.225), 0.45, 0.45, fill=False, color='0.5'))
    ax.set_aspect('equal')
    ax.set_xlabel('m')
    ax.set_ylabel('m')
    ax.legend(loc='upper center', ncols=3, fontsize=7)
    ax.set_title('Crates on a weighing table', fontsize=10)
    return drawn


PLOTS: dict[str, Callable[[], plt.Figure]] = {
    draw.__name__: draw for draw in (proximity, pressure_mat, reed, rfid, smart_plug, temperature,
                                     battery, stove, warm_surface, appliance, microphone, radio,
                                     cup, cup_cools, load_cells, plant, pir_polar, pir_signal,
                                     pir_zones)}


def main(names: list[str]) -> None:
    """Draws the named plots, or all."""
    unknown = [name for name in names if name not in PLOTS]
    if unknown:
        sys.exit(f'no plot {", ".join(unknown)}; known are {", ".join(PLOTS)}')
    for name in names or PLOTS:
        drawn = PLOTS[name]()
        drawn.tight_layout()
        drawn.savefig(IMAGES / f'{name}.png', dpi=110)
        print(IMAGES / f'{name}.png')


if __name__ == '__main__':
    main(sys.argv[1:])
