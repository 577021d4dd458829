#!/usr/bin/env python3
"""Illuminance in furnished rooms beside Radiance's path tracing.

    python3 -m venv /tmp/rad && /tmp/rad/bin/pip install pyradiance==1.3.1
    python3 bench/radiance.py /tmp/rad/lib/python3.11/site-packages/pyradiance

Three rooms of movable furniture, a door ajar in one: each is written as a world and as a scene of
Radiance. Exit code 1 where a sensor differs by more than 2 % or 0.05 lx and the tracer's own
noise.
"""
import argparse
import math
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import angen
import numpy as np

PATHS = 10_000  # from each sensor
RUNS = 4        # whose spread is the tracer's noise
RADIUS = 0.05   # m, of a lamp's globe
Vec = tuple[float, float, float]


@dataclass(frozen=True)
class Box:
    """`how`: static, loose, or a leaf about its -y edge."""
    center: Vec
    size: Vec
    albedo: float
    how: str = 'static'
    yaw: float = 0.0

    def corners(self) -> list[Vec]:
        """Bottom then top, each counterclockwise."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return [(self.center[0] + c * x - s * y, self.center[1] + s * x + c * y,
                 self.center[2] + z) for z in (-self.size[2] / 2, self.size[2] / 2)
                for x, y in [(a * self.size[0] / 2, b * self.size[1] / 2)
                             for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]]


@dataclass
class Room:
    """Boxes, lamps (place, lm) and sensors (place, normal)."""
    name: str
    boxes: list[Box]
    lamps: list[tuple[Vec, float]]
    sensors: list[tuple[Vec, Vec]]
    seconds: float = 7.0  # until loose bodies count as resting


def shell(size: Vec, albedo: float) -> list[Box]:
    """Six slabs around the room from the origin to `size`."""
    slabs = []
    for axis in range(3):
        for side in (0, 1):
            center, extent = [s / 2 for s in size], [s + 0.4 for s in size]
            center[axis] = -0.1 if side == 0 else size[axis] + 0.1
            extent[axis] = 0.2
            slabs.append(Box((center[0], center[1], center[2]), (extent[0], extent[1], extent[2]),
                             albedo))
    return slabs


def on_floor(x: float, y: float, size: Vec, albedo: float, yaw: float = 0.0, z: float = 0.0) -> Box:
    """A loose box at that height."""
    return Box((x, y, z + size[2] / 2), size, albedo, 'loose', yaw)


UP, DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
EAST, WEST, NORTH = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0)


def rooms() -> list[Room]:
    """A study, two rooms with a door ajar between them, and a store with a corridor."""
    study = Room('study', shell((5, 4, 2.7), 0.6) + [
        on_floor(0.35, 2.9, (0.6, 1.6, 2.1), 0.2), on_floor(4.6, 1.0, (0.7, 1.2, 0.75), 0.45),
        on_floor(2.3, 0.4, (1.0, 0.4, 1.1), 0.75, 0.3),
        on_floor(3.2, 2.9, (0.5, 0.5, 0.5), 0.85, 0.8),
        on_floor(3.2, 2.9, (0.4, 0.3, 0.3), 0.3, 0.2, 0.5)], [((2.4, 2.1, 2.35), 1000.0)],
        [((0.05, 1.2, 1.8), EAST), ((1.5, 1.5, 0.8), UP), ((2.3, 0.12, 0.6), NORTH),
         ((4.9, 3.6, 0.3), WEST), ((0.9, 3.9, 0.2), (0.0, -1.0, 0.0))])
    ajar = 0.5  # rad
    leaf = (4.05 - 0.44 * math.sin(ajar), 1.53 + 0.44 * math.cos(ajar), 1.0)
    pair = Room('door ajar', shell((8.1, 4, 2.6), 0.7) + [
        Box((4.05, 0.75, 1.3), (0.1, 1.5, 2.6), 0.7), Box((4.05, 3.2, 1.3), (0.1, 1.6, 2.6), 0.7),
        Box((4.05, 1.95, 2.3), (0.1, 0.9, 0.6), 0.7),
        Box(leaf, (0.04, 0.88, 1.97), 0.5, 'leaf', ajar),
        on_floor(5.0, 3.3, (1.2, 0.5, 1.9), 0.3), on_floor(7.4, 0.6, (0.8, 0.8, 0.8), 0.8, 0.4),
        on_floor(1.0, 3.5, (1.6, 0.6, 0.9), 0.25)], [((2.0, 2.0, 2.2), 800.0)],
        [((0.05, 1.0, 2.0), EAST), ((8.05, 1.0, 2.0), WEST), ((6.0, 2.0, 0.05), UP),
         ((4.2, 2.9, 1.5), EAST), ((4.2, 0.2, 0.3), NORTH)])
    store = Room('store', shell((7, 5, 2.5), 0.5) + [
        Box((3.5, 1.6, 1.25), (5.0, 0.1, 2.5), 0.5),
        *[on_floor(1.2 + 1.1 * i, 3.4, (0.4, 1.8, 1.9), 0.15 + 0.2 * i) for i in range(4)],
        on_floor(6.4, 0.7, (0.5, 0.6, 1.2), 0.8, 0.5), on_floor(0.5, 0.8, (0.6, 0.6, 1.0), 0.3)],
        [((3.0, 0.8, 2.2), 600.0), ((5.5, 4.2, 2.2), 800.0)],
        [((1.75, 3.4, 0.5), UP), ((0.05, 4.0, 1.5), EAST), ((3.5, 0.05, 1.5), NORTH),
         ((6.95, 2.5, 1.0), WEST), ((2.8, 4.0, 2.45), DOWN)])
    return [study, pair, store]


def model(name: str, box: Box) -> str:
    """A box of a world; a leaf has a hinge and stays where it is."""
    shape = '<geometry><box><size>{} {} {}</size></box></geometry>'.format(*box.size)
    color = f'{box.albedo} {box.albedo} {box.albedo} 1'
    mass = 20.0
    moments = ''.join(f'<{tag}>{mass / 12 * (b * b + c * c)}</{tag}>' for tag, b, c in (
        ('ixx', box.size[1], box.size[2]), ('iyy', box.size[0], box.size[2]),
        ('izz', box.size[0], box.size[1])))
    hinge = f'''<joint name="j" type="revolute"><parent>world</parent><child>link</child>
      <pose>0 {-box.size[1] / 2} 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit><lower>-1</lower>
      <upper>1</upper></limit><dynamics><friction>5</friction></dynamics></axis></joint>'''
    return f'''<model name="{name}"><static>{str(box.how == "static").lower()}</static>
      <pose>{box.center[0]} {box.center[1]} {box.center[2]} 0 0 {box.yaw}</pose><link name="link">
      <inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>
      <collision name="c">{shape}</collision><visual name="v">{shape}<material><diffuse>{color}
      </diffuse></material></visual></link>{hinge if box.how == "leaf" else ""}</model>'''


def world_of(room: Room) -> str:
    """The room for Angen."""
    text = ''.join(model(f'box{i}', box) for i, box in enumerate(room.boxes))
    for i, (place, flux) in enumerate(room.lamps):
        text += f'''<model name="{"ab"[i]}_lamp0"><static>true</static>
          <pose>{place[0]} {place[1]} {place[2]} 0 0 0</pose>
          <link name="link"><light name="l" type="point"><diffuse>1 1 1</diffuse></light></link>
          <plugin name="p" filename="libros_plugin.so"><luminous_flux>{flux}</luminous_flux>
          <level>100</level></plugin></model>'''
    for i, (place, normal) in enumerate(room.sensors):
        yaw, pitch = math.atan2(normal[1], normal[0]), -math.asin(normal[2])
        text += f'''<model name="lux{i}"><static>true</static><pose>{place[0]} {place[1]}
          {place[2]} 0 {pitch} {yaw}</pose><link name="link"><sensor name="s" type="camera">
          <plugin name="p" filename="libluminosity_sensor_controller.so"/></sensor></link>
          </model>'''
    return f'<sdf version="1.9"><world name="w">{text}</world></sdf>'


def scene_of(room: Room) -> str:
    """The room for Radiance: its radiances are cd/m2, gray."""
    faces = ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
    lines = []
    for i, box in enumerate(room.boxes):
        lines.append(f'void plastic m{i} 0 0 5 {box.albedo} {box.albedo} {box.albedo} 0 0')
        corners = box.corners()
        for k, face in enumerate(faces):
            points = ' '.join(f'{v:.9g}' for corner in face for v in corners[corner])
            lines.append(f'm{i} polygon b{i}.{k} 0 0 12 {points}')
    for i, (place, flux) in enumerate(room.lamps):
        luminance = flux / (4 * math.pi ** 2 * RADIUS ** 2)
        lines.append(f'void light l{i} 0 0 3 {luminance} {luminance} {luminance}')
        lines.append(f'l{i} sphere g{i} 0 0 4 {place[0]} {place[1]} {place[2]} {RADIUS}')
    return '\n'.join(lines)


def trace(room: Room, radiance: Path) -> np.ndarray:
    """(sensors, runs) of lux: paths that end by chance, and direct light by many samples."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / 'room.rad').write_text(scene_of(room))
        octree = Path(folder) / 'room.oct'
        with octree.open('wb') as out:
            subprocess.run([radiance / 'bin' / 'oconv', '-f', 'room.rad'], cwd=folder, stdout=out,
                           check=True)
        rays = ''.join(' '.join(map(str, (*at, *normal))) + '\n' for at, normal in room.sensors)
        options = ['-I', '-h', '-ab', '30', '-aa', '0', '-ad', str(PATHS), '-as', '0', '-lr', '-30',
                   '-lw', '1e-9', '-dj', '1', '-dt', '0', '-dc', '1', '-ds', '0.01', '-u+']
        runs = []
        for _ in range(RUNS):
            answer = subprocess.run([radiance / 'bin' / 'rtrace', *options, octree], input=rays,
                                    text=True, stdout=subprocess.PIPE, check=True,
                                    env={**os.environ, 'RAYPATH': str(radiance / 'lib')}).stdout
            runs.append([float(line.split()[1]) for line in answer.splitlines() if line.strip()])
    return np.array(runs).T


def main() -> int:
    """The program."""
    parser = argparse.ArgumentParser(description=__doc__.split('\n', 1)[0])
    parser.add_argument('radiance', type=Path, help='the folder that has bin/rtrace and bin/oconv')
    radiance = parser.parse_args().radiance
    wrong = 0
    print(f'{"room":10} {"sensor":>6} {"Angen":>9} {"Radiance":>9} {"off":>8} {"noise":>8}')
    for room in rooms():
        world = angen.World.from_text(world_of(room))
        world.run(room.seconds)
        traced = trace(room, radiance)
        for i, runs in enumerate(traced):
            lux = world.sensor('luminosity', f'lux{i}')['illuminance']
            true, noise = runs.mean(), runs.std(ddof=1) / math.sqrt(RUNS)
            ok = abs(lux - true) <= max(0.02 * true, 0.05) + 2 * noise
            wrong += not ok
            print(f'{room.name:10} {i:6} {lux:9.3f} {true:9.3f} {lux / true - 1:+8.2%} '
                  f'{noise / true:8.2%}{"" if ok else "  WRONG"}')
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
