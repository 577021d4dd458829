"""A heightmap of the largest size: its cost, and that bodies rest on it and cameras see them."""
import os
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest

import angen
from sdf_text import sdf_world

SIDE = 2049     # pixels, the most
HIGH = 4.0      # m, of white
SIZE = 200.0    # m
MEMORY = 500.0  # MB, of the whole process
SANITIZED = 'ANGEN_TEST_TREE' in os.environ  # it keeps freed memory, and shadows of all

GROUND = '''<model name="ground"><static>true</static><link name="link">
  <collision name="c"><geometry>FORM</geometry></collision>
  <visual name="v"><geometry>FORM</geometry></visual></link></model>'''.replace(
    'FORM', f'<heightmap><uri>FILE</uri><size>{SIZE} {SIZE} {HIGH}</size></heightmap>')
FLOOR_POSE = '0 0 -0.05'
BALL = '''<model name="ball"><pose>X Y Z 0 0 0</pose><link name="link">
  <inertial><mass>1</mass></inertial><collision name="c"><geometry><sphere><radius>0.5</radius>
  </sphere></geometry></collision></link></model>'''

LOAD = r'''
import re, sys, time
import angen
start = time.process_time()
world = angen.World(sys.argv[1])
world.run(1.0)
# Not ru_maxrss: exec keeps that of the process which started this one.
memory = int(re.search(r'VmHWM:\s+(\d+)', open('/proc/self/status').read()).group(1)) / 1024
print(time.process_time() - start, memory, world.link_poses[world.links.index('ball::link')][2])
'''


def place(world: angen.World, model: str) -> np.ndarray:
    return world.link_poses[world.links.index(f'{model}::link')][:3]


def heights(side: int) -> np.ndarray:
    """A heightmap of 16 bit pixels: slopes that end in a cliff, with a flat middle."""
    y, x = np.mgrid[0:side, 0:side]
    pixels = (x * 31 + y * 17) % 65536
    middle = slice(side // 2 - side // 20, side // 2 + side // 20)
    pixels[middle, middle] = 32768
    return pixels.astype(np.uint16)


def write_png(path: Path, pixels: np.ndarray) -> None:
    side = len(pixels)
    raw = np.zeros((side, 2 * side + 1), np.uint8)
    raw[:, 1:] = pixels.astype('>u2').view(np.uint8).reshape(side, 2 * side)

    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack('>I', len(data)) + name + data + struct.pack(
            '>I', zlib.crc32(name + data))

    path.write_bytes(b'\x89PNG\r\n\x1a\n'
                     + chunk(b'IHDR', struct.pack('>IIBBBBB', side, side, 16, 0, 0, 0, 0))
                     + chunk(b'IDAT', zlib.compress(raw.tobytes(), 1)) + chunk(b'IEND', b''))


@pytest.fixture(scope='module')
def largest(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp('heightmap')
    write_png(folder / 'h.png', heights(SIDE))
    world = folder / 'w.world'
    ball = BALL.replace('X Y Z', f'0 0 {HIGH / 2 + 0.52}')
    models = GROUND.replace('FILE', str(folder / 'h.png')) + ball
    world.write_text(sdf_world(models).replace(FLOOR_POSE, '0 0 -9'))
    return world


def test_the_largest_takes_little(largest: Path) -> None:
    done = subprocess.run([sys.executable, '-c', LOAD, str(largest)], text=True, check=True,
                          capture_output=True, timeout=300)
    seconds, megabytes, height = map(float, done.stdout.split())
    print(f'{seconds:.2f} s of CPU, {megabytes:.0f} MB')
    assert SANITIZED or megabytes < MEMORY
    assert height == pytest.approx(HIGH / 2 + 0.5, abs=0.01)


def test_balls_lie_where_the_pixels_say(largest: Path) -> None:
    world = angen.World(str(largest))
    for x, y in ((-9.0, 0.0), (0.0, 9.0), (7.3, -8.1)):
        name = f'ball{x}{y}'
        world.spawn(BALL.replace('<pose>X Y Z 0 0 0</pose>', ''), name,
                    [x, y, HIGH / 2 + 0.6, 0, 0, 0])
        world.run(1.0)
        assert place(world, name)[2] == pytest.approx(HIGH / 2 + 0.5, abs=0.01)
        assert place(world, name)[:2] == pytest.approx([x, y], abs=0.02)
