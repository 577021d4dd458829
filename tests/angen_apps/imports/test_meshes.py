"""Meshes in a home's zip: they are looks, scaled to their pieces; boxes stay for contacts."""
import zipfile
from pathlib import Path

import angen
import numpy as np
import pytest
from lxml import etree

from angen_tools.cli import main as cli

# a seat from x -1 to 3 and y 0 to 2, whose front edge at z 1 is low, and a back at z -1
OBJ = '''# a seat
mtllib none.mtl
v -1 0 1
v 3 0 1
v 3 2 -1
v -1 2 -1
usemtl red
f 1 2 3
f 1 3 4
'''
HOME = ('<home>\n<wall xStart="0" yStart="0" xEnd="400" yEnd="0" thickness="10"/>\n'
        '<pieceOfFurniture catalogId="x" name="Thing" model="{model}" x="100" y="100" width="80" '
        'depth="40" height="90" {more}/></home>')


def imported(folder: Path, data: bytes, more: str = '', model: str = '1/seat.obj') -> int:
    with zipfile.ZipFile(folder / 'home.sh3d', 'w', zipfile.ZIP_DEFLATED) as archive:
        archive.writestr('Home.xml', HOME.format(model=model, more=more))
        archive.writestr('1/seat.obj', data)
    return cli.run(['import', str(folder / 'home.sh3d'), '--meshes', '--sensors', 'none', '-o',
                    str(folder / 'home.world')])


def corners(folder: Path) -> np.ndarray:
    """The mesh's vertices in the plan, m: scaled, and turned by the model's yaw."""
    model = etree.parse(str(folder / 'home.world')).find('.//model[@name="thing0"]')
    assert model.find('.//collision/geometry/box') is not None
    mesh = model.find('.//visual/geometry/mesh')
    file = folder / mesh.findtext('uri')
    rows = [line.split()[1:] for line in file.read_text().splitlines() if line.startswith('v ')]
    at = np.array(rows, float) * [float(v) for v in mesh.findtext('scale').split()]
    at += [float(v) for v in model.findtext('.//visual/pose').split()[:3]]
    x, y, z, *_, yaw = (float(v) for v in model.findtext('pose').split())
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([(x + u * c - v * s, y + u * s + v * c, z + w) for u, v, w in at])


def test_a_mesh_fills_the_box_of_its_piece_and_looks_its_way(tmp_path: Path) -> None:
    assert imported(tmp_path, OBJ.encode()) == 0
    # its front is down the page, its x to the right
    assert corners(tmp_path) == pytest.approx(np.array(
        [(0.6, -1.2, 0.0), (1.4, -1.2, 0.0), (1.4, -0.8, 0.9), (0.6, -0.8, 0.9)]), abs=1e-3)
    assert 'thing0' in angen.World(str(tmp_path / 'home.world')).models


def test_a_mirrored_and_a_turned_mesh(tmp_path: Path) -> None:
    assert imported(tmp_path, OBJ.encode(), 'modelMirrored="true"') == 0
    assert corners(tmp_path)[0] == pytest.approx((1.4, -1.2, 0.0), abs=1e-3)
    # by a half turn about y: its front is at the back
    assert imported(tmp_path, OBJ.encode(), 'modelRotation="-1 0 0 0 1 0 0 0 -1"') == 0
    assert corners(tmp_path)[0] == pytest.approx((1.4, -0.8, 0.0), abs=1e-3)


@pytest.mark.parametrize('data, model', [
    (b'\x00\x01binary', '1/seat.obj'), (OBJ.encode(), '../seat.obj'),
    (b'<collada/>', '1/seat.obj')])
def test_other_formats_and_missing_files_are_reported(data: bytes, model: str, tmp_path: Path,
                                                      capsys: pytest.CaptureFixture[str]) -> None:
    assert imported(tmp_path, data, model=model) == 0
    assert '1 pieces have no OBJ mesh' in capsys.readouterr().out
    assert not (tmp_path / 'home_meshes').exists()


def test_a_rotation_that_is_none_is_rejected(tmp_path: Path,
                                             capsys: pytest.CaptureFixture[str]) -> None:
    assert imported(tmp_path, OBJ.encode(), 'modelRotation="1 2"') == 1
    said = capsys.readouterr().err
    assert 'modelRotation must be' in said and 'Home.xml:3' in said and len(said.splitlines()) == 1
    assert not list(tmp_path.glob('home[._]*world')) and not (tmp_path / 'home_meshes').exists()


@pytest.mark.parametrize('text, more, why', [
    (OBJ.replace('3 2 -1', 'nan 2 -1'), '', 'finite numbers'),
    (OBJ.replace('3 2 -1', 'a b c'), '', 'could not convert'),
    (OBJ.replace('f 1 3 4', 'f 1 3 5'), '', 'vertex index out of range'),
    (OBJ.replace('f', '#'), '', 'cannot be read'),
    (OBJ, 'v 0 0 0\n', 'has more than 1000000 lines'),
    (OBJ, 'f 1 2 3\n', 'has more than 1000000 lines'),
    (OBJ + 'f', ' 1', 'has a line of more than 10000 characters'),
    (OBJ, '#' * 64, 'more than 64 MB')])
def test_a_damaged_or_large_mesh_is_a_box(text: str, more: str, why: str, tmp_path: Path,
                                          capsys: pytest.CaptureFixture[str]) -> None:
    assert imported(tmp_path, text.encode() + more.encode() * 1_100_000) == 0
    remarks = [line for line in capsys.readouterr().out.splitlines() if '1/seat.obj' in line]
    assert len(remarks) == 1 and why in remarks[0] and 'Home.xml:3' in remarks[0]
    assert not (tmp_path / 'home_meshes').exists()
    assert 'thing0' in angen.World(str(tmp_path / 'home.world')).models
