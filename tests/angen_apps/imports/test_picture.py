"""Plans that are pictures, against a plan of known areas at four sizes of noise."""
import struct
import warnings
import zlib
from pathlib import Path
from typing import Any

import angen
import numpy as np
import pytest
from PIL import Image

from angen_apps.imports.picture import read_map, read_picture
from angen_apps.plan.model import Plan
from angen_apps.plan.polygons import area
from angen_apps.plan.writer import write_world
from angen_bench import plans
from angen_tools.common.failure import Failure
from angen_tools.cli import main as cli
from tests.angen_apps.imports.measured import import_measured

MEMORY = 90 << 20  # bytes of the program
BYTES = 16  # bytes a pixel: a picture of 20 million pixels takes less than 400 MB
SCALE = 0.025  # m a pixel
# inner faces of the rooms in m, from the lower left: walls of 0.2 m around and 0.15 m between
ROOMS = ((0.2, 0.2, 4.2, 3.2), (4.35, 0.2, 8.0, 3.2), (0.2, 3.35, 8.0, 5.35))
AREAS = sorted((x1 - x0) * (y1 - y0) for x0, y0, x1, y1 in ROOMS)
DOORS = ((4.2, 1.0, 4.35, 1.9), (2.0, 3.2, 2.8, 3.35), (6.0, 5.35, 7.0, 5.55))


def picture(noise: float, seed: int = 3) -> np.ndarray:
    """Gray values, row 0 at the top. Walls 20, paper 235; specks and gray noise."""
    shape = round(5.55 / SCALE), round(8.2 / SCALE)
    gray = np.full(shape, 20.0)
    for x0, y0, x1, y1 in (*ROOMS, *DOORS):
        rows = slice(round(y0 / SCALE), round(y1 / SCALE))
        gray[rows, round(x0 / SCALE):round(x1 / SCALE)] = 235.0
    gray = np.pad(gray, 12, constant_values=235.0)[::-1]
    dice = np.random.default_rng(seed)
    gray += dice.normal(0, 60 * noise, gray.shape)
    specks = dice.random(gray.shape) < 0.02 * noise
    gray[specks] = 255 - gray[specks]
    return np.clip(gray, 0, 255).astype(np.uint8)


def scanned(folder: Path, gray: np.ndarray | Image.Image, scale: float = SCALE) -> Plan:
    """The plan of a scan in that folder."""
    (gray if isinstance(gray, Image.Image) else Image.fromarray(gray)).save(folder / 'scan.png')
    return read_picture(folder / 'scan.png', scale, True)


def areas(plan: Plan) -> list[float]:
    return sorted(area(room.polygon) for room in plan.all_rooms())


@pytest.mark.parametrize('noise', [0.0, 0.25, 0.5, 0.75])
def test_rooms_and_doors_of_a_noisy_scan(noise: float, tmp_path: Path) -> None:
    plan = scanned(tmp_path, picture(noise))
    made = areas(plan)
    assert len(made) == len(AREAS)
    assert max(abs(a - b) / b for a, b in zip(made, AREAS)) < 0.05
    doors = sorted(opening.width for opening in plan.all_openings() if opening.kind == 'door')
    assert doors == pytest.approx([0.8, 0.9, 1.0], abs=0.08)
    assert plan.entrance


@pytest.mark.parametrize('degrees', [1, -3, 20, 45])
def test_a_scan_that_is_askew_is_put_upright(degrees: int, tmp_path: Path) -> None:
    plan = scanned(tmp_path, Image.fromarray(picture(0.25)).rotate(degrees, expand=True,
                                                                   fillcolor=235))
    assert areas(plan) == pytest.approx(AREAS, rel=0.05)
    assert len([o for o in plan.all_openings() if o.kind == 'door']) == 3
    assert 'the picture is put upright' in plan.remarks[0]
    corners = [p for room in plan.all_rooms() for p in room.polygon]
    assert len({round(x, 3) for x, _ in corners}) < 10


def test_a_map_with_walls_askew_keeps_its_frame(tmp_path: Path) -> None:
    """Robots are localized in it."""
    straight = picture(0.0)
    said = scanned(tmp_path, straight)
    askew = np.asarray(Image.fromarray(straight).rotate(20, expand=True, fillcolor=235))
    plan = read_map(write_map(tmp_path, askew, 'map.pgm', 'origin: [-3.0, -2.0, 0.0]\n'), True)
    assert areas(plan) == pytest.approx(areas(said), rel=0.02)
    middles = [SCALE * np.array(shape[::-1]) / 2 for shape in (straight.shape, askew.shape)]
    c, s = np.cos(np.radians(20)), np.sin(np.radians(20))
    turn = np.array([[c, -s], [s, c]])
    for room, other in zip(sorted(said.all_rooms(), key=lambda r: area(r.polygon)),
                           sorted(plan.all_rooms(), key=lambda r: area(r.polygon))):
        at = turn @ (np.mean(room.polygon, axis=0) - middles[0]) + middles[1] + (-3.0, -2.0)
        assert np.hypot(*(np.mean(other.polygon, axis=0) - at)) < 0.05


@pytest.mark.parametrize('walls, paper', [(150, 250), (10, 100)])
def test_pale_and_dim_pictures_have_the_same_rooms(walls: int, paper: int, tmp_path: Path) -> None:
    gray = np.where(picture(0.0) < 128, walls, paper).astype(np.uint8)
    assert len(areas(scanned(tmp_path, gray))) == len(ROOMS)


@pytest.mark.parametrize('gray, what', [
    (255 - picture(0.0), 'more than half of it is dark; walls are dark on light paper'),
    (np.full((200, 300), 255, np.uint8), 'has no walls'),
    (np.zeros((200, 300), np.uint8), 'more than half of it is dark')])
def test_a_picture_without_walls_on_light_paper_is_rejected(gray: np.ndarray, what: str,
                                                            tmp_path: Path) -> None:
    with pytest.raises(Failure, match=what):
        scanned(tmp_path, gray)


def test_a_fine_picture_is_read_by_blocks_of_pixels(tmp_path: Path) -> None:
    plan = scanned(tmp_path, picture(0.0).repeat(5, 0).repeat(5, 1), SCALE / 5)
    assert areas(plan) == pytest.approx(AREAS, rel=0.02)


@pytest.mark.parametrize('closed', [0, 1])
def test_a_plan_with_no_room_or_a_spot_of_one_is_an_error(closed: int, tmp_path: Path) -> None:
    gray = np.full((200, 300), 235, np.uint8)
    gray[20:28, 20:280] = gray[160:168, 20:280] = 20
    if closed:
        gray[100:150, 100:150] = 20
        gray[106:144, 106:144] = 235
    with pytest.raises(Failure, match='its walls close .* between the outermost of them'):
        scanned(tmp_path, gray)


def test_a_map_has_its_origin_and_resolution(tmp_path: Path) -> None:
    plan = read_map(write_map(tmp_path, picture(0.0), 'map.pgm', 'origin: [-3.0, -2.0, 0.0]\n'
                              'negate: 0\noccupied_thresh: 0.65\n'), False)
    x = [p[0] for room in plan.all_rooms() for p in room.polygon]
    assert min(x) == pytest.approx(-3.0 + 0.2 + 12 * 0.025, abs=0.06)
    assert {opening.kind for opening in plan.all_openings()} == {'opening'}


def write_map(folder: Path, gray: np.ndarray, image: str, more: str) -> Path:
    Image.fromarray(gray).save(folder / image)
    path = folder / 'map.yaml'
    path.write_text(f'image: {image}\nresolution: 0.025\nfree_thresh: 0.196\n{more}')
    return path


def corners(plan: Plan) -> np.ndarray:
    return np.array(sorted(p for room in plan.all_rooms() for p in room.polygon))


def test_a_map_that_is_turned_has_its_rooms_turned(tmp_path: Path) -> None:
    path = write_map(tmp_path, picture(0.0), 'map.pgm', 'origin: [-3.0, -2.0, 0.5]\n')
    straight = read_picture(tmp_path / 'map.pgm', 0.025, True)
    plan = read_map(path, True)
    turn = np.array([[np.cos(0.5), -np.sin(0.5)], [np.sin(0.5), np.cos(0.5)]])
    expected = corners(straight) @ turn.T + (-3.0, -2.0)
    assert np.array(sorted(map(tuple, expected))) == pytest.approx(corners(plan), abs=0.02)
    doors = {o.name: o for o in straight.all_openings()}
    for door in plan.all_openings():
        before = doors[door.name]
        assert turn @ (before.x, before.y) + (-3.0, -2.0) == pytest.approx((door.x, door.y))
        assert door.yaw == pytest.approx(before.yaw + 0.5)
    out = tmp_path / 'home.world'
    write_world(plan, out, 'none')
    world = angen.World(str(out))
    assert not [text for kind, text in world.home_findings() if kind == 'contradicting']
    world.command('door', 'all', 'Open')
    world.run(8)
    assert {world.device('door', name)['mode'] for name in world.devices('door')} == {'OPEN'}


@pytest.mark.parametrize('image, more, change', [
    ('map.png', 'negate: 1\n', lambda gray: 255 - gray),
    ('map.png', 'mode: scale\noccupied_thresh: 0.5\n', lambda gray: np.where(
        gray < 128, 120, gray).astype(np.uint8)),
    ('map.png', 'mode: raw\n', lambda gray: np.where(gray < 128, 100, 0).astype(np.uint8)),
    ('map.png', '', lambda gray: gray.astype(np.uint16) * 257),
    ('map.pgm', 'occupied_thresh: 0.9\n', lambda gray: np.where(
        gray < 128, 0, np.where(np.arange(gray.shape[1]) % 9 == 4, 100, gray)).astype(np.uint8))])
def test_a_map_is_the_same_in_all_encodings(image: str, more: str, change: Any, tmp_path: Path
                                            ) -> None:
    gray = picture(0.0)
    plain = read_map(write_map(tmp_path, gray, 'map.pgm', 'origin: [0, 0, 0]\n'), True)
    path = write_map(tmp_path, change(gray), image, 'origin: [0, 0, 0]\n' + more)
    assert corners(read_map(path, True)) == pytest.approx(corners(plain), abs=1e-9)


def test_a_gap_beside_furniture_is_no_door(tmp_path: Path) -> None:
    gray = picture(0.0)
    for x in (1.0, 2.1):  # two sideboards, 0.8 m apart, in the room of 4 m x 3 m
        rows, columns = slice(-80, -72), slice(round(x / SCALE), round((x + 0.3) / SCALE))
        gray[rows, columns] = 20
    plan = scanned(tmp_path, gray)
    assert len(plan.all_rooms()) == 3
    assert sorted(o.width for o in plan.all_openings()) == pytest.approx([0.8, 0.9, 1.0], abs=0.08)
    assert any('from a room into itself' in remark for remark in plan.remarks)


def test_what_touches_no_wall_is_furniture(tmp_path: Path) -> None:
    gray = picture(0.0)

    def outline(x0: float, y0: float, x1: float, y1: float) -> None:
        """Draws a thing, in m from the plan's lower left, as a robot or a drawing shows it."""
        rows = slice(gray.shape[0] - 12 - round(y1 / SCALE), gray.shape[0] - 12 - round(y0 / SCALE))
        columns = slice(12 + round(x0 / SCALE), 12 + round(x1 / SCALE))
        inside = gray[rows, columns]
        inside[:2], inside[-2:], inside[:, :2], inside[:, -2:] = 20, 20, 20, 20

    outline(1.0, 1.2, 2.8, 2.1)  # a table of 1.8 m x 0.9 m
    outline(1.3, 1.5, 1.6, 1.8)  # with a plate
    outline(7.2, 3.35, 8.0, 4.35)  # a cupboard at two walls
    outline(-0.3, 2.0, -0.05, 2.6)  # a letter beside the plan
    plan = scanned(tmp_path, gray)
    (table,) = plan.storeys[0].pieces
    assert (table.depth, table.width) == pytest.approx((1.8, 0.9), abs=0.051)
    assert (table.x, table.y) == pytest.approx((1.9 + 12 * SCALE, 1.65 + 12 * SCALE), abs=0.026)
    assert areas(plan)[-2:] == pytest.approx([12.0, 14.8], rel=0.05)  # the cupboard is wall
    assert not any(room.holes for room in plan.all_rooms())
    assert any('1 things that touch no wall are furniture' in remark for remark in plan.remarks)
    assert '2 dark spots at walls are read as wall, the largest 1.2' in plan.remarks[-1]  # + letter
    out = tmp_path / 'home.world'
    write_world(plan, out, 'none')
    assert [name for name in angen.World(str(out)).models if 'furniture' in name]


def test_a_wall_between_two_doors_is_no_furniture(tmp_path: Path) -> None:
    gray = picture(0.0)
    for x in (3.3, 0.6):  # beside the door at 2.0: the part between two is a pier
        columns = slice(12 + round(x / SCALE), 12 + round((x + 0.9) / SCALE))
        gray[gray.shape[0] - 12 - round(3.35 / SCALE):gray.shape[0] - 12 - round(3.2 / SCALE),
             columns] = 235
    plan = scanned(tmp_path, gray)
    assert len(plan.all_rooms()) == 3 and not plan.storeys[0].pieces
    assert not any('spots' in remark for remark in plan.remarks)


def test_rooms_of_a_map_end_where_it_is_unknown(tmp_path: Path) -> None:
    gray = picture(0.0)
    gray[gray > 128] = 254
    inside = read_map(write_map(tmp_path, gray, 'map.pgm', 'origin: [0, 0, 0]\n'), True)
    gray[:, :12], gray[:, -12:], gray[-12:] = 205, 205, 205  # what the robot has not seen
    gray[-60:-40, :22] = 205  # no wall there: it was not seen either
    seen = read_map(write_map(tmp_path, gray, 'map.pgm', 'origin: [0, 0, 0]\n'), True)
    assert areas(seen) == pytest.approx(areas(inside), abs=0.2)


def test_a_map_of_another_machine_names_a_picture_beside_it(tmp_path: Path) -> None:
    path = write_map(tmp_path, picture(0.0), 'map.pgm', 'origin: [0, 0, 0]\n')
    path.write_text(path.read_text().replace('map.pgm', '/home/somebody/maps/map.pgm'))
    assert len(read_map(path, True).all_rooms()) == 3


@pytest.mark.parametrize('text, what', [
    ('image: ../map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n', 'not in the folder'),
    ('resolution: 0.05\norigin: [0, 0, 0]\n', 'has no image'),
    ('image: map.pgm\nresolution: nan\norigin: [0, 0, 0]\n', 'resolution is nan'),
    ('image: map.pgm\nresolution: 0.05\norigin: [0, 0]\n', 'must be [x, y, yaw]'),
    ('image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nmode: gray\n', 'map.yaml:4: mode')])
def test_maps_that_are_rejected(text: str, what: str, tmp_path: Path,
                                capsys: pytest.CaptureFixture[str]) -> None:
    path, out = tmp_path / 'map.yaml', tmp_path / 'home.world'
    path.write_text(text)
    assert cli.run(['import', str(path), '-o', str(out)]) == 1
    assert what in capsys.readouterr().err and not out.exists()


def test_a_picture_needs_a_scale_and_walls(tmp_path: Path, capsys: pytest.CaptureFixture[str]
                                           ) -> None:
    path, out = tmp_path / 'white.png', tmp_path / 'home.world'
    Image.fromarray(np.full((50, 50), 255, np.uint8)).save(path)
    assert cli.run(['import', str(path), '-o', str(out)]) == 1
    assert 'give --scale' in capsys.readouterr().err
    assert cli.run(['import', str(path), '--scale', '0.05', '-o', str(out)]) == 1
    assert 'has no walls' in capsys.readouterr().err
    path.write_bytes(path.read_bytes()[:40])
    assert cli.run(['import', str(path), '--scale', '0.05', '-o', str(out)]) == 1
    assert len(capsys.readouterr().err.splitlines()) == 1 and not out.exists()


def test_a_large_picture_is_rejected_without_a_warning_of_pillow(tmp_path: Path) -> None:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return (struct.pack('>I', len(data)) + kind + data
                + struct.pack('>I', zlib.crc32(kind + data)))

    path = tmp_path / 'large.png'
    path.write_bytes(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack(
        '>IIBBBBB', 12_000, 8_000, 8, 0, 0, 0, 0)) + chunk(b'IDAT', zlib.compress(b'')))
    with warnings.catch_warnings(), pytest.raises(Failure, match='12000 x 8000 pixels'):
        warnings.simplefilter('error')
        read_picture(path, 0.05, True)


def test_a_scan_of_a_home_by_seed_has_its_rooms_and_doors(tmp_path: Path) -> None:
    """Doors beside corners leave stubs of wall that are shorter than a wall has to be."""
    for case in plans.scans(tmp_path):
        plan = case.read()
        assert areas(plan) == pytest.approx(sorted(case.areas or []), rel=0.05), case.name
        doors = [opening for opening in plan.all_openings() if opening.kind == 'door']
        assert len(doors) == case.said['door'], case.name


def test_a_large_picture_takes_little_memory(tmp_path: Path) -> None:
    side, walls = 2000, slice(100, -100, 600)
    gray = np.full((side, side), 65535, np.uint16)
    for k in range(8):
        gray[walls.start + k::walls.step, 100:-100] = gray[100:-100, walls.start + k::600] = 0
    Image.fromarray(gray).save(tmp_path / 'plan.png')
    done = import_measured(tmp_path / 'plan.png', '--scale', '0.03')
    assert done.code == 0 and done.memory < MEMORY + BYTES * side ** 2


def test_other_formats_start_no_program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                        capsys: pytest.CaptureFixture[str]) -> None:
    """Pillow gives PostScript to Ghostscript, whatever the name of the file is."""
    program = tmp_path / 'gs'
    program.write_text(f'#!/bin/sh\ntouch {tmp_path}/started\nexit 1\n')
    program.chmod(0o755)
    monkeypatch.setenv('PATH', str(tmp_path), prepend=':')
    (tmp_path / 'plan.png').write_text('%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 100 100\n'
                                       '%%EndComments\nshowpage\n%%EOF\n')
    (tmp_path / 'map.yaml').write_text('image: plan.png\nresolution: 0.05\norigin: [0, 0, 0]\n')
    for words in (['plan.png', '--scale', '0.05'], ['map.yaml']):
        assert cli.run(['import', str(tmp_path / words[0]), *words[1:], '-o',
                        str(tmp_path / 'home.world')]) == 1
        assert 'plan.png: is not a picture that can be read; known are PNG, JPEG, PPM, BMP, GIF' \
            in capsys.readouterr().err
    assert not (tmp_path / 'started').exists()


@pytest.mark.parametrize('ending, format', [('png', 'GIF'), ('png', 'BMP'), ('jpg', 'JPEG'),
                                            ('pgm', 'PPM')])
def test_known_formats(ending: str, format: str, tmp_path: Path) -> None:
    path = tmp_path / f'scan.{ending}'
    Image.fromarray(picture(0.0)).save(path, format)
    assert len(read_picture(path, SCALE, True).all_rooms()) == len(ROOMS)
