"""Walls and doors of pictures with other walls, pixels and noise."""
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from angen_apps.imports.picture import read_picture
from angen_apps.plan.model import Plan
from angen_apps.plan.polygons import area

EDGE = 1.0  # m of paper
# axes of walls and of rooms: west, south, east, north, m; a hall of 1.4 m between five rooms
WALLS = ((0, 0, 11, 0), (11, 0, 11, 9), (0, 9, 11, 9), (0, 0, 0, 9), (0, 4, 11, 4),
         (0, 5.4, 11, 5.4), (3.5, 0, 3.5, 4), (7, 0, 7, 4), (5, 5.4, 5, 9), (8, 5.4, 8, 9))
ROOMS = ((0, 0, 3.5, 4), (3.5, 0, 7, 4), (7, 0, 11, 4), (0, 4, 11, 5.4), (0, 5.4, 5, 9),
         (5, 5.4, 8, 9), (8, 5.4, 11, 9))
# middles and widths; the last one is in the end of the hall, between two corners
DOORS = ((1.7, 4, 0.8), (5, 4, 0.8), (9, 4, 0.9), (2, 5.4, 0.9), (6.5, 5.4, 0.75), (9.5, 5.4, 0.9))


def flat(scale: float, thick: float, end: float = 0.9) -> np.ndarray:
    """Gray values of the flat, row 0 at the top; `end`: m of the door in the end of the hall."""
    gray = np.full((round(11 / scale), round(13 / scale)), 235.0)

    def fill(west: float, south: float, east: float, north: float, value: float) -> None:
        rows, columns = ([round((v + EDGE) / scale) for v in pair]
                         for pair in ((south, north), (west, east)))
        gray[rows[0]:rows[1], columns[0]:columns[1]] = value

    half = thick / 2
    for west, south, east, north in WALLS:
        fill(west - half, south - half, east + half, north + half, 20.0)
    for x, y, wide in DOORS:
        fill(x - wide / 2, y - half, x + wide / 2, y + half, 235.0)
    fill(-half, 4.7 - end / 2, half, 4.7 + end / 2, 235.0)
    return gray[::-1]


def read(gray: np.ndarray, scale: float, path: Path) -> Plan:
    Image.fromarray(np.clip(gray, 0, 255).astype(np.uint8)).save(path)
    return read_picture(path, scale, True)


def check(plan: Plan, thick: float, error: float) -> None:
    """Its doors, and areas within a share."""
    assert [opening.kind for opening in plan.all_openings()] == ['door'] * 7
    said = sorted((x1 - x0 - thick) * (y1 - y0 - thick) for x0, y0, x1, y1 in ROOMS)
    assert sorted(area(room.polygon) for room in plan.all_rooms()) == pytest.approx(said, rel=error)


@pytest.mark.parametrize('scale', [0.02, 0.05])
@pytest.mark.parametrize('thick', [0.08, 0.15, 0.2, 0.3, 0.4])
def test_walls_of_any_thickness_part_rooms(thick: float, scale: float, tmp_path: Path) -> None:
    check(read(flat(scale, thick), scale, tmp_path / 'flat.png'), thick, 0.05)


def test_a_door_may_be_as_wide_as_its_hall(tmp_path: Path) -> None:
    check(read(flat(0.02, 0.4, 1.0), 0.02, tmp_path / 'flat.png'), 0.4, 0.05)


@pytest.mark.parametrize('degrees', [3, 44])
def test_no_edge_of_a_wall_askew_is_a_wall(degrees: float, tmp_path: Path) -> None:
    gray = np.pad(flat(0.02, 0.2), 100, constant_values=235.0)
    turned = Image.fromarray(gray).rotate(degrees, Image.BICUBIC, True, fillcolor=235.0)
    check(read(np.asarray(turned), 0.02, tmp_path / 'flat.png'), 0.2, 0.05)


@pytest.mark.parametrize('noise, specks', [(30, 0.005), (45, 0.015)])
def test_noise_of_coarse_pixels(noise: float, specks: float, tmp_path: Path) -> None:
    dice = np.random.default_rng(27)
    gray = flat(0.05, 0.2)
    gray = gray + dice.normal(0, noise, gray.shape)
    inverted = dice.random(gray.shape) < specks
    gray[inverted] = 255 - gray[inverted]
    check(read(gray, 0.05, tmp_path / 'flat.png'), 0.2, 0.05)
