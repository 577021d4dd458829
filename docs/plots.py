#!/usr/bin/env python3
"""Draws the plots of docs/sensors and docs/devices from runs of the simulator, into docs/images.

    ./angen shell
    python3 docs/plots.py            # all of them, or the names of some
"""
from __future__ import annotations

import sys
from pathlib import Path
from typing import Callable

import matplotlib
import numpy as np

import angen

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

from pir_plots import pir_polar, pir_signal, pir_zones  # noqa: E402

IMAGES = Path(__file__).resolve().parent / 'images'
PLUGINS = '''<plugin name="doors" filename="libdoor_world_plugin.so"/>
<plugin name="robots" filename="librobot_controller.so">
<wheelDiameter>0.0704</wheelDiameter></plugin>'''


def world(content: str) -> angen.World:
    """A floor, the plug-ins of doors and robots, and `content`."""
    return angen.World.from_text(f'''<sdf version="1.6"><world name="plot">
      <physics type="ode"><max_step_size>0.001</max_step_size></physics>{PLUGINS}
      <model name="floor"><static>true</static><link name="link"><collision name="box">
      <pose>0 0 -0.05 0 0 0</pose><geometry><box><size>20 20 0.1</size></box></geometry>
      </collision></link></model>{content}</world></sdf>''', seed=1)


def block(model: str, name: str, pose: str, plugin: str = '') -> str:
    """A model of worlds/models."""
    return (f'<include><uri>model://{model}</uri><name>{name}</name><pose>{pose}</pose>{plugin}'
            '</include>')


def box(name: str, pose: str, size: str, mass: float = 0.0) -> str:
    """A box, static unless it has a mass in kg."""
    x, y, z = (float(v) for v in size.split())
    moments = [mass / 12 * v for v in (y * y + z * z, x * x + z * z, x * x + y * y)]
    return f'''<model name="{name}"><static>{str(not mass).lower()}</static><pose>{pose}</pose>
      <link name="link"><inertial><mass>{mass or 1}</mass><inertia><ixx>{moments[0] or 1}</ixx>
      <iyy>{moments[1] or 1}</iyy><izz>{moments[2] or 1}</izz></inertia></inertial>
      <collision name="box"><geometry><box><size>{size}</size></box></geometry></collision></link>
      </model>'''


def figure(rows: int, heading: str) -> tuple[plt.Figure, list[plt.Axes]]:
    """Axes below each other that share their x."""
    drawn, axes = plt.subplots(rows, 1, sharex=True, figsize=(7, 1.2 + 1.8 * rows), squeeze=False)
    axes[0][0].set_title(heading, fontsize=10)
    for ax in axes[:, 0]:
        ax.grid(alpha=0.3)
    return drawn, list(axes[:, 0])


def proximity() -> plt.Figure:
    w = world(block('proximity', 'd', '0 0 0.5 0 0 0'))
    times, truth, read = [], [], []
    for k in range(60):
        away = 3.2 - 0.05 * k
        post = 20 <= k < 35
        w.spawn(box('wall', '0 0 0 0 0 0', '0.1 3 1'), 'wall', [away + 0.05, 0, 0.5, 0, 0, 0])
        if post:
            w.spawn(box('post', '0 0 0 0 0 0', '0.05 0.05 1'), 'post',
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
    error.plot(times, 1000 * (np.array(read) - truth), '.')
    error.set_ylabel('error, mm')
    error.set_xlabel('s')
    return drawn


def pressure_mat() -> plt.Figure:
    w = world(block('pressure_mat', 'm', '0 0 0 0 0 0'))
    steps = {2.0: ('low', 9.0, 0.156), 6.0: ('high', 20.0, 0.457)}
    times, load, pressed = [], [], []
    while w.time < 16:
        for at, (name, mass, z) in steps.items():
            if abs(w.time - at) < 1e-6:
                w.spawn(box(name, '0 0 0 0 0 0', '0.3 0.3 0.3', mass), name, [0, 0, z, 0, 0, 0])
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
    state.step(times, pressed, where='post')
    state.set_yticks([0, 1], ['free', 'pressed'])
    state.set_xlabel('s')
    return drawn


def reed() -> plt.Figure:
    w = world(block('window', 'hall_window0', '0 0 1 0 0 0'))
    index = w.joints.index('hall_window0::sash')
    times, angles, closed = [], [], []
    for k in range(800):
        if k == 50:
            w.command('window', 'hall0', 'Set -0.2')
        if k == 400:
            w.command('window', 'hall0', 'Close')
        w.run(0.01)
        times.append(w.time)
        angles.append(-w.joint_positions[index])
        closed.append(w.sensor('reed', 'hall_window0')['closed'])
    drawn, (ax, state) = figure(2, 'Reed contact of a window')
    ax.plot(times, angles)
    ax.axhline(0.0172, color='tab:red', linewidth=0.8, label='opens')
    ax.axhline(0.0097, color='tab:orange', linewidth=0.8, label='closes')
    ax.set_ylabel('sash, rad')
    ax.legend()
    state.step(times, closed, where='post')
    state.set_yticks([0, 1], ['open', 'closed'])
    state.set_xlabel('s')
    return drawn


def rfid() -> plt.Figure:
    places = [(x, y) for x in np.arange(-0.5, 2.41, 0.1) for y in np.arange(-2.2, 2.21, 0.1)]
    tags = ''.join(block('rfid_tag', f't{i}', f'{x + 0.013} {y + 0.007} 1 0 0 0')
                   for i, (x, y) in enumerate(places))
    w = world(block('rfid_reader', 'r', '0 0 1 0 0 0') + box('a', '1 0.7 1 0 0 0', '0.1 1 2')
              + box('b', '1 -0.6 1 0 0 0', '0.1 0.6 2') + tags)
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
    w = world(block('heater', 'heater1', '0 0 0 0 0 0') + '''<model name="p"><static>true</static>
      <link name="l"><sensor name="p" type="custom"><update_rate>2</update_rate><plugin name="p"
      filename="libsmart_plug.so"><load>heater/heater1</load></plugin></sensor></link></model>''')
    times, power, energy = [], [], []
    for k in range(240):
        for at, text in ((20, 'On'), (100, 'Set 40'), (180, 'Off')):
            if k == at:
                w.command('heater', 'heater1', text)
        w.run(0.5)
        reading = w.sensor('plug', 'p')
        times.append(w.time)
        power.append(reading['power'])
        energy.append(reading['energy'] / 3600)
    drawn, (ax, sum_) = figure(2, 'Smart plug with a heater')
    ax.step(times, power, where='post')
    ax.set_ylabel('W')
    sum_.plot(times, energy)
    sum_.set_ylabel('Wh')
    sum_.set_xlabel('s')
    return drawn


def temperature() -> plt.Figure:
    rooms = '<room>0 0.05 0 4 3 2.5</room><room>0 -3 0 4 -0.05 2.5</room>'
    w = world(f'''<model name="flat"><static>true</static><link name="l"/>
      <plugin name="air" filename="libroom_climate.so">{rooms}<heat_capacity>5</heat_capacity>
      </plugin></model>''' + block('heater', 'heater1', '0.1 1.5 0 0 0 0')
              + block('kitchen_door', 'hall_door0', '1.5 0 0 0 0 0')
              + block('temperature_sensor', 'warm', '2 1.5 1.5 0 0 0')
              + block('temperature_sensor', 'cold', '2 -1.5 1.5 0 0 0')
              + block('humidity_sensor', 'h', '2 1.4 1.5 0 0 0'))
    w.command('heater', 'heater1', 'On')
    times, rows = [], []
    for k in range(180):
        if k == 60:
            w.command('door', 'hall0', 'Open')
        w.run(5)
        times.append(w.time / 60)
        rows.append((w.sensor('temperature', 'warm')['temperature'],
                     w.sensor('temperature', 'cold')['temperature'],
                     w.sensor('humidity', 'h')['humidity']))
    warm, cold, humidity = zip(*rows)
    drawn, (ax, wet) = figure(2, 'A heater of 1 kW in one of two rooms; the door opens after 5 min')
    ax.plot(times, warm, label='room with the heater')
    ax.plot(times, cold, label='next room')
    ax.set_ylabel('°C')
    ax.legend()
    wet.plot(times, humidity)
    wet.set_ylabel('% RH by the heater')
    wet.set_xlabel('min')
    return drawn


def battery() -> plt.Figure:
    w = world(block('turtlebot', 'robot', '0 0 0.001 0 0 0', '''<plugin name="battery"
      filename="librobot_battery.so"><capacity>0.08</capacity><level>9</level></plugin>'''))
    times, charge, speed = [], [], []
    for k in range(100):
        if k > 20:
            w.command('drive', 'robot', values=[0.4, 0.4])
        w.run(0.5)
        times.append(w.time)
        charge.append(100 * w.device('battery', 'robot_battery')['percentage'])
        speed.append(w.device('drive', 'robot')['v'])
    drawn, (ax, fast) = figure(2, 'Battery of a TurtleBot')
    ax.plot(times, charge)
    ax.set_ylabel('%')
    fast.plot(times, speed)
    fast.set_ylabel('m/s')
    fast.set_xlabel('s')
    return drawn


def stove() -> plt.Figure:
    w = world('''<model name="flat"><static>true</static><link name="l"/>
      <plugin name="air" filename="libroom_climate.so"><room>-2 -2 0 2 2 2.8</room>
      <heat_capacity>5</heat_capacity></plugin></model>'''
              + block('stove', 'kitchen_stove0', '0 0 0 0 0 0'))
    times, rows = [], []
    for k in range(360):
        for at, text in ((12, 'FrontLeft 60'), (60, 'FrontRight 100'), (180, 'FrontRight 0'),
                         (252, 'Off')):
            if k == at:
                w.command('stove', 'kitchen0', text)
        w.run(5)
        now = w.device('stove', 'kitchen0')
        times.append(w.time / 60)
        rows.append((*now['plate_temperatures'][:3], now['power'], now['heat'],
                     w.device('climate', 'flat')['temperatures'][0]))
    left, right, rear, power, heat, air = zip(*rows)
    drawn, (ax, flow, room) = figure(3, 'Two plates of a stove')
    for values, label in ((left, 'front left'), (right, 'front right'), (rear, 'rear left')):
        ax.plot(times, values, label=label)
    ax.set_ylabel('°C')
    ax.legend()
    flow.step(times, power, where='post', label='electric power')
    flow.plot(times, heat, label='heat to the room')
    flow.set_ylabel('W')
    flow.legend()
    room.plot(times, air)
    room.set_ylabel('air, °C')
    room.set_xlabel('min')
    return drawn


def warm_surface() -> plt.Figure:
    drawn, (ax, volts) = figure(2, 'A plate of 0.2 x 0.5 m at 2 m warms by 40 K')
    shape = '<geometry><box><size>0.02 0.2 0.5</size></box></geometry>'
    for time_constant in (0.5, 2, 10):
        w = world(block('pir_pyroelectric', 'eye', '0 0 2.2 0 0 0') + f'''
          <model name="plate"><static>true</static><pose>2 0.15 1.2 0 0 0</pose><link name="link">
          <collision name="face">{shape}</collision><visual name="face">{shape}</visual></link>
          <plugin name="warm" filename="libwarm_surface.so"><time_constant>{time_constant}
          </time_constant></plugin></model>''')
        w.run(1.0)
        w.command('warm_surface', 'plate', 'Temperature 335.15')
        times, signal = np.arange(1, 150) / 10, []
        for _ in times:
            w.run(0.1)
            signal.append(1e6 * w.sensor('pir', 'eye')['signal'])
        ax.plot(times, 40 * (1 - np.exp(-times / time_constant)), label=f'{time_constant} s')
        volts.plot(times, signal)
    for level in (-300, 300):
        volts.axhline(level, color='0.6', linestyle='--', linewidth=0.8)
    ax.set_ylabel('above the air, K')
    ax.legend()
    volts.set_ylabel('signal, µV')
    volts.set_xlabel('s')
    return drawn


def appliance() -> plt.Figure:
    w = world(block('fan', 'fan', '0 0 0 0 0 0') + block('stereo', 'stereo', '2 0 0 0 0 0'))
    levels = list(range(10, 101, 5))
    drawn, (ax, sound) = figure(2, 'A fan by its speed, a stereo by its volume')
    for name, verb in (('fan', 'Speed'), ('stereo', 'Volume')):
        w.command('appliance', name, 'On')
        rows = []
        for level in levels:
            w.command('appliance', name, f'{verb} {level}')
            w.run(0.1)
            now = w.device('appliance', name)
            rows.append((now['power'], now['sound_power_level']))
        power, loudness = zip(*rows)
        ax.plot(levels, power, '.-', label=name)
        sound.plot(levels, loudness, '.-', label=name)
    ax.set_ylabel('W')
    ax.legend()
    sound.set_ylabel('sound power level, dB')
    sound.set_xlabel('%')
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
    rooms = [(0.05, 2.95), (-2.95, -0.05), (-5.95, -3.05)]
    boxes = ''.join(f'<room>0 {low} 0 4 {high} 2.5</room>' for low, high in rooms)
    w = world(f'''<model name="flat"><static>true</static><link name="l"/>
      <plugin name="air" filename="libroom_climate.so">{boxes}</plugin></model>'''
              + block('stereo', 'stereo', '0.9 1.5 0.9 0 0 0')
              + block('kitchen_door', 'near_door0', '1.5 0 0 0 0 0')
              + block('kitchen_door', 'far_door0', '1.5 -3 0 0 0 0')
              + block('microphone', 'm0', '3 1.5 1 0 0 3.14159')
              + ''.join(block('microphone', f'm{i}', f'2 {-3 * i + 1.4} 1.2 0 0 0')
                        for i in (1, 2)))
    w.command('appliance', 'stereo', 'Volume 50')
    w.command('appliance', 'stereo', 'On')
    times, rows, expected = [], [], []
    for k in range(160):
        for at, name, text in ((40, 'near0', 'Open'), (80, 'far0', 'Open'),
                               (120, 'near0', 'Close')):
            if k == at:
                w.command('door', name, text)
        w.run(0.25)
        times.append(w.time)
        rows.append([w.sensor('microphone', f'm{i}')['level'] for i in range(3)])
        expected.append(coupled_levels([w.device('door', name) for name in ('near0', 'far0')]))
    drawn, (ax,) = figure(1, 'A stereo in the first of three rooms')
    drawn.set_size_inches(7, 4.2)
    ax.plot(times, expected, color='0.7', linewidth=4)
    for label, values in zip(('its room, 2 m away', 'second room', 'third room'), zip(*rows)):
        ax.plot(times, values, label=label)
    ax.set_ylabel('dB')
    ax.set_xlabel('s')
    ax.legend(loc='lower right')
    return drawn


def radio() -> plt.Figure:
    w = angen.World(str(IMAGES.parents[1] / 'worlds/angen.world'))
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
    ax.plot(walked, rssi, '.-', label='RSSI')
    ax.set_ylabel('dBm')
    ax.set_xlabel('m walked')
    ax.legend()
    return drawn


def cup() -> plt.Figure:
    w = world(block('weighing_table', 't', '0 0 0.001 0 0 0')
              + block('cup', 'c', '0 0 0.503 0 0 0'))
    script = {10: 'Fill 300', 20: 'Lift 0.25', 30: 'Tilt 0.9', 40: 'Tilt 1.3', 50: 'Put'}
    times, rows = [], []
    for k in range(700):
        if k % 10 == 0 and k // 10 in script:
            w.command('cup', 'c', script[k // 10])
        w.run(0.1)
        state, felt = w.device('cup', 'c'), w.sensor('accelerometer', 'c')
        times.append(w.time)
        rows.append((state['content'], *felt['acceleration'], felt['tilt'],
                     w.sensor('load_cells', 't')['weight']))
    content, x, _, z, tilt, weight = zip(*rows)
    drawn, axes = figure(4, 'A cup: filled, lifted, tilted twice, put back')
    axes[0].plot(times, content)
    axes[0].set_ylabel('content, ml')
    axes[1].plot(times, x, label='x')
    axes[1].plot(times, z, label='z')
    axes[1].legend()
    axes[1].set_ylabel('m/s²')
    axes[2].plot(times, tilt)
    axes[2].set_ylabel('tilt, rad')
    axes[3].plot(times, weight)
    axes[3].set_ylabel('table, kg')
    axes[3].set_xlabel('s')
    return drawn


def cup_cools() -> plt.Figure:
    drawn, (ax,) = figure(1, 'A cup that cools at 22 °C')
    for volume in (100, 250, 350):
        w = world(block('cup', 'c', '0 0 0 0 0 0'))
        w.command('cup', 'c', f'Fill {volume}')
        times, heat = [], []
        for _ in range(90):
            w.run(60)
            times.append(w.time / 60)
            heat.append(w.device('cup', 'c')['temperature'])
        ax.plot(times, heat, label=f'{volume} ml')
    ax.set_ylabel('°C')
    ax.set_xlabel('min')
    ax.legend()
    return drawn


def load_cells() -> plt.Figure:
    places = [(x, y) for x in (-0.15, 0.0, 0.15) for y in (-0.15, 0.0, 0.15)]
    drawn, ax = plt.subplots(figsize=(5, 5))
    for mass, mark in ((0.5, 'o'), (4.0, 's')):
        said = []
        for x, y in places:
            w = world(block('weighing_table', 't', '0 0 0.001 0 0 0')
                      + box('crate', f'{x} {y} 0.555 0 0 0', '0.1 0.1 0.1', mass))
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


def plant() -> plt.Figure:
    w = world(block('plant', 'dry', '0 0 0 0 0 0') + block('plant', 'watered', '2 0 0 0 0 0'))
    times, rows = [], []
    for hour in range(0, 24 * 42, 4):
        if hour % 168 == 164:
            w.command('plant', 'watered', 'Water 500')
        w.run(4 * 3600)
        times.append(w.time / 86400)
        rows.append([w.sensor('soil_moisture', name)['moisture'] for name in ('dry', 'watered')])
    drawn, (ax,) = figure(1, 'Soil of two plants at 22 °C and 50 %')
    for values, name in zip(zip(*rows), ('never watered', '500 ml a week')):
        ax.plot(times, values, label=name)
    ax.axhline(21, color='0.5', linestyle=':')
    ax.set_ylabel('moisture, %')
    ax.set_xlabel('days')
    ax.legend()
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
