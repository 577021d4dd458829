#!/usr/bin/env python3
"""Draws figures of the thesis as they are here, and of further openings: pictures and diagrams.

    ./angen shell
    python3 docs/thesis_figures.py [-o FOLDER] [NAME ...]     # all of them into docs/images/thesis
"""
import argparse
import re
from collections import Counter
from math import pi
from pathlib import Path
from typing import Any, Callable, Sequence

import matplotlib
import numpy as np
from scipy.spatial.transform import Rotation
from shapely.geometry import MultiPoint, Polygon

import angen

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
WORLD = ROOT / 'worlds/angen.world'
CAMERA = '''<sdf version="1.6"><model name="eye"><static>true</static><link name="link">
<sensor name="eye" type="camera"><camera><horizontal_fov>{fov}</horizontal_fov>
<image><width>640</width><height>480</height></image></camera>
<plugin name="eye" filename="libgazebo_ros_camera.so"/></sensor></link></model></sdf>'''
LANDING_LAMP = (-1.4, 5.0, 2.8, 0, 0, 0)
LANDING_EYE = (-0.35, 5.0, 1.5, 0, 0, pi)
Draw = Callable[[], plt.Figure]
Pose = Sequence[float]


def lit_world(*lamps: str) -> Any:
    """The building with some lamps on."""
    world = angen.World(str(WORLD), seed=1)
    for lamp in lamps:
        world.command('lamp', lamp, 'On')
    return world


def picture(world: Any, pose: Pose, fov: float = 1.25) -> plt.Figure:
    """The picture of a camera that looks along x of its pose."""
    world.spawn(CAMERA.format(fov=fov), 'eye', list(pose))
    world.request('camera', 'eye')
    world.run(0.1)
    image = world.sensor('camera', 'eye')['image']
    figure = plt.figure(figsize=(6.4, 4.8))
    figure.add_axes((0, 0, 1, 1)).imshow(image)
    figure.axes[0].axis('off')
    return figure


def door_open() -> plt.Figure:
    world = lit_world('entrance0', 'kitchen0')
    world.command('door', 'kitchen0', 'Open')
    world.run(6)
    return picture(world, (2.9, 5.85, 1.5, 0, 0, -pi / 2))


def door_closed() -> plt.Figure:
    world = lit_world('entrance0')
    world.command('door', 'livingroom0', 'Close')
    world.run(6)
    return picture(world, (4.8, 5.85, 1.5, 0, 0, -pi / 2))


def landing() -> Any:
    """The building with a lamp on the landing of floor 0."""
    world = lit_world()
    world.spawn('model://ceiling_lamp', 'landing_lamp0', list(LANDING_LAMP))
    world.command('lamp', 'landing0', 'On')
    return world


def elevator_open() -> plt.Figure:
    world = landing()
    world.run(6)
    return picture(world, LANDING_EYE)


def elevator_closed() -> plt.Figure:
    world = landing()
    world.command('elevator', 'elevator', 'Floor1')
    world.run(6)
    return picture(world, LANDING_EYE)


def robot_livingroom() -> plt.Figure:
    world = lit_world('livingroom0')
    world.delete('turtlebot')
    world.spawn('model://turtlebot', 'turtlebot', [6.6, 2.6, 0.001, 0, 0, -0.3])
    world.command('drive', 'turtlebot', values=[0.2, 0.0])
    world.run(1)
    return picture(world, (9.2, 3.0, 1.5, 0, 0.3, -2.95), 1.1)


def lamp_kitchen() -> plt.Figure:
    """A lit lamp, and the sensor that measures its light, on the wall behind."""
    return picture(lit_world('kitchen0'), (1.1, 3.3, 2.0, 0, -0.15, -1.0), 0.9)


def plan_view(world: Any, z: float, middle: tuple[float, float], half: float) -> plt.Axes:
    """A square of the plan: outlines of the shapes at a height."""
    figure, axes = plt.subplots(figsize=(6, 6), layout='constrained')
    axes.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half),
             xlabel='x (m)', ylabel='y (m)', aspect='equal')
    for _, _, _, _, points in world.shapes:
        if len(points) and points[:, 2].min() < z < points[:, 2].max():
            outline = MultiPoint(points[:, :2]).convex_hull
            if isinstance(outline, Polygon):
                axes.fill(*outline.exterior.xy, facecolor='0.85', edgecolor='0.4', linewidth=0.8)
    return axes


def draw_rays(axes: plt.Axes, world: Any, kind: str, name: str, color: str) -> None:
    """Rays in a sensor's field of view, to what they meet now."""
    pose = next(pose for _, known, _, pose in world.entities(kind) if known == name)
    left, right, reach = world.field_of_view(kind, name)
    turns = np.linspace(left, right, 49)
    ahead = np.column_stack([np.cos(turns), np.sin(turns), np.zeros_like(turns)])
    ways = np.ascontiguousarray(Rotation.from_quat(pose[3:]).apply(ahead))
    ranges = np.ravel(world.cast(np.tile(pose[:3], (len(ways), 1)), ways, min(reach, 10.0)))
    for end in pose[:3] + ways * ranges[:, None]:
        axes.plot([pose[0], end[0]], [pose[1], end[1]], color=color, linewidth=0.7)
    axes.plot(*pose[:2], 'o', color=color, markersize=5)


def pir_entrance() -> plt.Figure:
    world = lit_world()
    axes = plan_view(world, 1.2, (4.5, 5.0), 3.5)
    draw_rays(axes, world, 'pir', 'entrance_pir0_a', 'tab:blue')
    return axes.figure


def pir_livingroom() -> plt.Figure:
    """A PIR that moves up and down: the ranges of its rays at the present tilt over 12 s."""
    world = lit_world()
    scans = []
    for _ in range(120):
        world.run(0.1)
        ranges = world.sensor('pir', 'livingroom_pir0_a')['ranges']
        scans.append(ranges[:len(ranges) // 2])
    figure, axes = plt.subplots(figsize=(8, 3.6), layout='constrained')
    axes.set(xlabel='time (s)', ylabel='ray, from right to left')
    image = axes.imshow(np.array(scans).T, aspect='auto', origin='lower', extent=(0, 12, 0, 24))
    figure.colorbar(image, label='range (m)')
    return figure


def luminosity_entrance() -> plt.Figure:
    world = lit_world('entrance0')
    world.run(2)
    axes = plan_view(world, 1.2, (4.5, 5.0), 3.5)
    draw_rays(axes, world, 'luminosity', 'entrance_lux0', 'tab:orange')
    lux = world.sensor('luminosity', 'entrance_lux0')['illuminance']
    axes.set_title(f'{lux:.1f} lx')
    return axes.figure


def switch(name: str, middle: tuple[float, float]) -> plt.Figure:
    """The beam of an optical switch, above a door: cut off by the shut leaf, else whole."""
    world = lit_world()
    world.run(1)
    axes = plan_view(world, 2.125, middle, 0.8)
    draw_rays(axes, world, 'switch', name, 'tab:blue')
    axes.set_title('shut' if world.sensor('switch', name)['closed'] else 'open')
    return axes.figure


def switch_shut() -> plt.Figure:
    return switch('workroom_switch0', (6.865, 4.8))


def switch_open() -> plt.Figure:
    pose = next(pose for _, name, _, pose in angen.World(str(WORLD)).entities('switch')
                if name == 'kitchen_switch0')
    return switch('kitchen_switch0', (pose[0], pose[1]))


def kitchen_open() -> plt.Figure:
    """Fridge, freezer, oven, counter and window, open."""
    world = lit_world('kitchen0')
    for name in ('kitchen_fridge0', 'kitchen_freezer0', 'kitchen_oven0', 'kitchen_counter_b0'):
        world.command('cabinet', name, 'Open')
    world.command('window', 'kitchen0', 'Open')
    world.run(6)
    return picture(world, (1.3, 3.6, 1.6, 0, 0.16, -1.15), 1.35)


class Diagram:
    """Boxes with text, and arrows between them, on a plane of 100 x 60."""

    def __init__(self, height: float = 60) -> None:
        self.figure, self.axes = plt.subplots(figsize=(9, 9 * height / 100), layout='constrained')
        self.axes.set(xlim=(0, 100), ylim=(0, height))
        self.axes.axis('off')

    def box(self, x: float, y: float, text: str, width: float = 20, height: float = 9,
            color: str = '#dce9f5') -> tuple[float, float]:
        """Draws a box around its middle, which is returned."""
        self.axes.add_patch(plt.Rectangle((x - width / 2, y - height / 2), width, height,
                                          facecolor=color, edgecolor='0.3'))
        self.axes.text(x, y, text, ha='center', va='center', fontsize=8)
        return x, y

    def arrow(self, begin: tuple[float, float], end: tuple[float, float], text: str = '') -> None:
        """Draws an arrow, with its text in the middle."""
        self.axes.annotate('', end, begin, arrowprops={'arrowstyle': '->', 'color': '0.2'})
        middle = [(a + b) / 2 for a, b in zip(begin, end)]
        self.axes.text(*middle, text, ha='center', va='center', fontsize=7, color='0.2',
                       backgroundcolor='white' if text else (0, 0, 0, 0))


def architecture() -> plt.Figure:
    d = Diagram(64)
    d.box(12, 56, 'world, models\n(SDF, URDF, meshes)', color='#fff')
    d.box(40, 56, 'load: to descriptions,\nor errors with file:line', 24)
    d.box(72, 56, 'sim: commands, tick,\nscheduler, snapshots', 26)
    parts = [('physics\n(ODE)', 8), ('rays\n(Embree)', 24), ('light', 40), ('render', 56),
             ('devices', 72), ('sensors', 88)]
    for name, x in parts:
        d.box(x, 37, name, 13)
        d.arrow((72, 51.3), (x, 41.7))
    d.arrow((22, 56), (27.8, 56))
    d.arrow((52, 56), (58.8, 56))
    d.box(20, 20, 'py: import angen', 22)
    d.box(50, 20, 'record: fingerprints,\nsaved worlds', 24)
    d.box(82, 20, 'ros: the node angen', 24)
    d.axes.plot([97, 97, 82], [56, 28.5, 28.5], color='0.2', linewidth=1)
    d.axes.plot([85, 97], [56, 56], color='0.2', linewidth=1)
    d.axes.plot([20, 82], [28.5, 28.5], color='0.2', linewidth=1)
    for x in (20, 50, 82):
        d.arrow((x, 28.5), (x, 24.7), 'snapshots' if x == 50 else '')
    d.box(20, 5, 'a Python program', 22, color='#fff')
    d.box(50, 5, 'rviz', 14, color='#fff')
    d.box(82, 5, 'programs of ROS,\nthe angen command', 24, color='#fff')
    d.arrow((20, 15.3), (20, 9.7))
    d.arrow((74, 15.3), (53, 9.7), 'markers, TF')
    d.arrow((84, 15.3), (84, 9.7), 'topics')
    d.arrow((92, 9.7), (92, 15.3), 'commands')
    return d.figure


def models_and_plugins() -> plt.Figure:
    """The contents of angen.world: the number of each kind, and the library that makes it."""
    world = angen.World(str(WORLD))
    libraries = {plugin['kind']: plugin['library'] for plugin in angen.plugins()}
    rows = {role: [(kind, count, libraries[kind]) for kind in sorted(libraries)
                   if (count := len(getattr(world, role)(kind)))]
            for role in ('devices', 'sensors')}
    height = 14.0 + 6.5 * max(len(found) for found in rows.values())
    d = Diagram(height)
    d.box(50, height - 6, f'angen.world: {len(world.models)} models', 34, 8)
    for role, x in (('devices', 25), ('sensors', 75)):
        for k, (kind, count, library) in enumerate(rows[role]):
            y = height - 17 - 6.5 * k
            d.box(x - 14, y, f'{count} {kind}', 16, 5)
            d.box(x + 10, y, library, 28, 5, '#eef5dc')
            d.arrow((x - 6, y), (x - 4, y))
        d.arrow((50, height - 10), (x - 14, height - 14.3), role)
    return d.figure


def communication() -> plt.Figure:
    """Which topics of the node command which kind of device, and which tell their states."""
    world = angen.World(str(WORLD))
    counts = Counter({plugin['kind']: len(world.devices(plugin['kind']))
                      for plugin in angen.plugins()})
    own = {'drive': '/cmd_vel, /NAME/cmd_vel'}
    rows = [(plugin['command_topic'] or own.get(plugin['kind'], '/angen/command'), plugin['kind'])
            for plugin in sorted(angen.plugins(), key=lambda p: p['kind'])
            if plugin['role'] == 'device' and counts[plugin['kind']]]
    height = 8.0 + 8.0 * len(rows)
    d = Diagram(height)
    d.box(50, height / 2, 'node\nangen', 12, height - 6)
    for k, (topic, kind) in enumerate(rows):
        y = height - 8 - 8.0 * k
        d.box(20, y, topic, 34, 6, '#fff')
        d.box(82, y, f'/angen/{kind}/NAME ({counts[kind]})', 34, 6, '#fff')
        d.arrow((37, y), (44, y))
        d.arrow((56, y), (65, y))
    d.axes.text(20, height - 2, 'commands', ha='center', fontsize=8)
    d.axes.text(82, height - 2, 'states', ha='center', fontsize=8)
    return d.figure


def joints() -> plt.Figure:
    """The joints of the robot, between its links."""
    world = angen.World(str(WORLD))
    found = [world.joint(name) for name in world.joints if name.startswith('turtlebot::')]
    d = Diagram(10.0 + 14 * len(found))
    middle = d.box(16, 5 + 7 * len(found), 'base', 22)
    for k, joint in enumerate(found):
        y = 12.0 + 14 * k
        child = d.box(84, y, joint['child'].split('::')[-1], 26)
        axis = ', '.join(f'{value:.0f}' for value in joint['axis'])
        d.arrow((middle[0] + 11, middle[1]), (child[0] - 13, y), f"{joint['type']}, axis {axis}")
    return d.figure


def pid_loop() -> plt.Figure:
    d = Diagram(40)
    d.box(8, 26, 'command', 14, color='#fff')
    d.box(26, 26, 'error', 12)
    for text, y in (('P: error', 36), ('I: its sum over time', 26), ('D: its change', 16)):
        d.box(48, y, text, 20, 7)
        d.arrow((32, 26), (38, y))
        d.arrow((58, y), (65, 26))
    d.box(72, 26, 'sum, limited:\nforce or torque', 14)
    d.box(92, 26, 'door or\nelevator', 14)
    d.arrow((15, 26), (20, 26))
    d.arrow((79, 26), (85, 26))
    d.axes.plot([92, 92, 26], [21.5, 5, 5], color='0.2', linewidth=1)
    d.arrow((26, 5), (26, 21.5))
    d.axes.text(60, 5, 'measured position', ha='center', va='center', fontsize=7,
                backgroundcolor='white')
    return d.figure


def packages() -> plt.Figure:
    """The packages of the repository, and which needs which to run; messages of others left out.

    angen_sim names the two that need it, so that rosdep installs them too.
    """
    needs = {file.parent.name: set(re.findall(r'<(?:build_|exec_)?depend>(\w+)<', file.read_text()))
             for file in sorted((ROOT / 'src').glob('*/package.xml'))}
    needs['angen_sim'] -= {'angen_apps', 'angen_tools'}
    found = {name for name in needs if name == 'angen_msgs' or not name.endswith('_msgs')}
    level: dict[str, int] = {}
    while len(level) < len(found):
        level |= {name: max((level[need] + 1 for need in needs[name] & found), default=0)
                  for name in found if needs[name] & found <= set(level)}
    rows = [sorted(name for name in found if level[name] == k) for k in sorted({*level.values()})]
    d = Diagram(14.0 * len(rows))
    at = {name: (100 * (k + 0.5) / len(row), 14.0 * y + 7) for y, row in enumerate(rows)
          for k, name in enumerate(row)}
    for name, (x, y) in at.items():
        for need in needs[name] & found:
            d.arrow((x, y - 3), (at[need][0], at[need][1] + 3))
    for name, (x, y) in at.items():
        d.box(x, y, name, 19, 6)
    return d.figure


FIGURES: dict[str, Draw] = {draw.__name__: draw for draw in (
    architecture, models_and_plugins, communication, door_open, door_closed, elevator_open,
    elevator_closed, robot_livingroom, kitchen_open, joints, pid_loop, packages, lamp_kitchen,
    luminosity_entrance, pir_entrance, pir_livingroom, switch_shut, switch_open)}


def main() -> None:
    """Draws the named figures, or all."""
    parser = argparse.ArgumentParser(description=__doc__.split('\n', 1)[0])
    parser.add_argument('names', metavar='NAME', nargs='*', help=f'of {", ".join(FIGURES)}')
    parser.add_argument('-o', '--out', type=Path, default=ROOT / 'docs/images/thesis')
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in FIGURES]
    if unknown:
        parser.error(f'no figure {", ".join(unknown)}; known are {", ".join(FIGURES)}')
    options.out.mkdir(parents=True, exist_ok=True)
    for name in options.names or FIGURES:
        figure = FIGURES[name]()
        figure.savefig(options.out / f'{name}.png', dpi=100)
        plt.close(figure)
        print(options.out / f'{name}.png')


if __name__ == '__main__':
    main()
