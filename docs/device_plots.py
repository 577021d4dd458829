"""The plots of docs/devices; docs/plots.py draws them."""
from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np

from plot_base import block, figure, world


def stove() -> plt.Figure:
    w = world('''<model name="flat"><static>true</static><link name="l"/>
      <angen:room name="kitchen"><angen:polygon>-2 -2 2 -2 2 2 -2 2</angen:polygon>
      <angen:ceiling>2.8</angen:ceiling></angen:room>
      <plugin name="air" filename="libroom_climate.so">
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
