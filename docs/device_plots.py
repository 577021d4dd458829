"""The plots of docs/devices; docs/plots.py draws them."""
import matplotlib.pyplot as plt
import numpy as np
from plot_base import air, curves, figure, include, sampled, world


def stove() -> plt.Figure:
    w = world(air('-2 -2 0 2 2 2.8', extra='<heat_capacity>5</heat_capacity>')
              + include('stove', 'kitchen_stove0'))

    def read() -> tuple[float, ...]:
        now = w.device('stove', 'kitchen0')
        return (*now['plate_temperatures'][:3], now['power'], now['heat'],
                w.device('climate', 'flat')['temperatures'][0])

    times, (left, right, rear, power, heat, warmth) = sampled(w, 5, 360, read, [
        (at, 'stove', 'kitchen0', text) for at, text in (
            (12, 'FrontLeft 60'), (60, 'FrontRight 100'), (180, 'FrontRight 0'), (252, 'Off'))])
    drawn, (ax, flow, room) = figure(3, 'Two plates of a stove')
    curves(ax, times / 60, '°C', {'front left': left, 'front right': right, 'rear left': rear})
    flow.step(times / 60, power, where='post', label='electric power')
    curves(flow, times / 60, 'W', {'heat to the room': heat})
    curves(room, times / 60, 'air, °C', {'': warmth}, 'min')
    return drawn


def warm_surface() -> plt.Figure:
    drawn, (ax, volts) = figure(2, 'A plate of 0.2 x 0.5 m at 2 m warms by 40 K')
    shape = '<geometry><box><size>0.02 0.2 0.5</size></box></geometry>'
    for time_constant in (0.5, 2, 10):
        w = world(include('pir_pyroelectric', 'eye', '0 0 2.2 0 0 0') + f'''
          <model name="plate"><static>true</static><pose>2 0.15 1.2 0 0 0</pose><link name="link">
          <collision name="face">{shape}</collision><visual name="face">{shape}</visual></link>
          <plugin name="warm" filename="libwarm_surface.so"><time_constant>{time_constant}
          </time_constant></plugin></model>''')
        w.run(1.0)
        w.command('warm_surface', 'plate', 'Temperature 335.15')
        _, (signal,) = sampled(w, 0.1, 149, lambda: [1e6 * w.sensor('pir', 'eye')['signal']])
        times = np.arange(1, 150) / 10
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
    w = world(include('fan', 'fan') + include('stereo', 'stereo', '2 0 0 0 0 0'))
    levels = list(range(10, 101, 5))
    power, loudness = {}, {}
    for name, verb in (('fan', 'Speed'), ('stereo', 'Volume')):
        w.command('appliance', name, 'On')

        def read() -> tuple[float, float]:
            now = w.device('appliance', name)
            return now['power'], now['sound_power_level']

        _, (power[name], loudness[name]) = sampled(w, 0.1, len(levels), read, [
            (i, 'appliance', name, f'{verb} {level}') for i, level in enumerate(levels)])
    drawn, (ax, sound) = figure(2, 'A fan by its speed, a stereo by its volume')
    curves(ax, levels, 'W', power, mark='.-')
    for values in loudness.values():
        curves(sound, levels, 'sound power level, dB', {'': values}, '%', '.-')
    return drawn


def cup() -> plt.Figure:
    w = world(include('weighing_table', 't', '0 0 0.001 0 0 0')
              + include('cup', 'c', '0 0 0.503 0 0 0'))

    def read() -> tuple[float, ...]:
        state, felt = w.device('cup', 'c'), w.sensor('accelerometer', 'c')
        return (state['content'], *felt['acceleration'], felt['tilt'],
                w.sensor('load_cells', 't')['weight'])

    times, (content, x, _, z, tilt, weight) = sampled(w, 0.1, 700, read, [
        (10 * at, 'cup', 'c', text) for at, text in (
            (10, 'Fill 300'), (20, 'Lift 0.25'), (30, 'Tilt 0.9'), (40, 'Tilt 1.3'), (50, 'Put'))])
    drawn, axes = figure(4, 'A cup: filled, lifted, tilted twice, put back')
    curves(axes[0], times, 'content, ml', {'': content})
    curves(axes[1], times, 'm/s²', {'x': x, 'z': z})
    curves(axes[2], times, 'tilt, rad', {'': tilt})
    curves(axes[3], times, 'table, kg', {'': weight}, 's')
    return drawn


def cup_cools() -> plt.Figure:
    drawn, (ax,) = figure(1, 'A cup that cools at 22 °C')
    heat = {}
    for volume in (100, 250, 350):
        w = world(include('cup', 'c'))
        w.command('cup', 'c', f'Fill {volume}')
        times, (heat[f'{volume} ml'],) = sampled(
            w, 60, 90, lambda: [w.device('cup', 'c')['temperature']])
    curves(ax, times / 60, '°C', heat, 'min')
    return drawn


def plant() -> plt.Figure:
    w = world(include('plant', 'dry') + include('plant', 'watered', '2 0 0 0 0 0'))
    times, columns = sampled(
        w, 4 * 3600, 6 * 42,
        lambda: [w.sensor('soil_moisture', name)['moisture'] for name in ('dry', 'watered')],
        [(step, 'plant', 'watered', 'Water 500') for step in range(41, 6 * 42, 42)])
    drawn, (ax,) = figure(1, 'Soil of two plants at 22 °C and 50 %')
    curves(ax, times / 86400, 'moisture, %', dict(zip(('never watered', '500 ml a week'), columns)),
           'days')
    ax.axhline(21, color='0.5', linestyle=':')
    return drawn
