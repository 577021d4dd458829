"""Plans that are pictures, against a plan of known areas at four sizes of noise."""
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from angen_apps.imports.picture import read_map, read_picture
from angen_apps.plan.polygons import area
from angen_tools.cli import main as cli

SCALE = 0.025  # m a pixel
# inner faces of the rooms in m, from the lower left: walls of 0.2 m around and 0.15 m between
ROOMS = ((0.2, 0.2, 4.2, 3.2), (4.35, 0.2, 8.0, 3.2), (0.2, 3.35, 8.0, 5.35))
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


@pytest.mark.parametrize('noise', [0.0, 0.25, 0.5, 0.75])
def test_rooms_and_doors_of_a_noisy_scan(noise: float, tmp_path: Path) -> None:
    path = tmp_path / 'scan.png'
    Image.fromarray(picture(noise)).save(path)
    plan = read_picture(path, SCALE, True)
    made = sorted(area(room.polygon) for room in plan.all_rooms())
    said = sorted((x1 - x0) * (y1 - y0) for x0, y0, x1, y1 in ROOMS)
    assert len(made) == len(said)
    assert max(abs(a - b) / b for a, b in zip(made, said)) < 0.05
    doors = sorted(opening.width for opening in plan.all_openings() if opening.kind == 'door')
    assert doors == pytest.approx([0.8, 0.9, 1.0], abs=0.08)
    assert plan.entrance


def test_a_map_has_its_origin_and_resolution(tmp_path: Path) -> None:
    Image.fromarray(picture(0.0)).save(tmp_path / 'map.pgm')
    path = tmp_path / 'map.yaml'
    path.write_text('image: map.pgm\nresolution: 0.025\norigin: [-3.0, -2.0, 0.0]\nnegate: 0\n'
                    'occupied_thresh: 0.65\nfree_thresh: 0.196\n')
    plan = read_map(path, False)
    x = [p[0] for room in plan.all_rooms() for p in room.polygon]
    assert min(x) == pytest.approx(-3.0 + 0.2 + 12 * 0.025, abs=0.06)
    assert {opening.kind for opening in plan.all_openings()} == {'opening'}


@pytest.mark.parametrize('text, what', [
    ('image: ../map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n', 'not in the folder'),
    ('resolution: 0.05\norigin: [0, 0, 0]\n', 'has no image'),
    ('image: map.pgm\nresolution: nan\norigin: [0, 0, 0]\n', 'resolution is nan')])
def test_maps_that_are_refused(text: str, what: str, tmp_path: Path,
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
