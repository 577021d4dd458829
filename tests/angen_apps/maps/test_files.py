"""map_server's files."""
from pathlib import Path

import numpy as np
import pytest
import yaml
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED, UNKNOWN, load_world, make_map
from angen_tools.cli import main as cli
from tests.angen_apps.maps.test_gridmap import sdf, solid


def read_as_map_server(path: Path) -> Grid:
    """The map that map_server publishes for a yaml file (its rules: wiki.ros.org/map_server)."""
    written = yaml.safe_load(path.read_text())
    assert written['negate'] == 0
    kind, size, depth, shades = (path.parent / written['image']).read_bytes().split(b'\n', 3)
    assert (kind, depth) == (b'P5', b'255')
    columns, rows = map(int, size.split())
    dark = (255 - np.frombuffer(shades, np.uint8).reshape(rows, columns)[::-1]) / 255
    cells = np.where(dark > written['occupied_thresh'], OCCUPIED,
                     np.where(dark < written['free_thresh'], FREE, UNKNOWN))
    assert written['origin'][2] == 0
    return Grid(cells, tuple(written['origin'][:2]), written['resolution'], 0)


def test_the_files_have_the_map(tmp_path: Path, capsys: pytest.CaptureFixture[str]
                                ) -> None:
    world = tmp_path / 'w.world'
    world.write_text(sdf(solid('upper', '0 0 3.9 0 0 0', '4 4 0.2'),
                         solid('box', '1 -0.5 4.5 0 0 0', '0.5 2 1'),
                         solid('wall', '-2 0 4.5 0 0 0', '0.1 4 1')))
    stem = tmp_path / 'new' / 'up.1'  # the folder is made
    assert cli.run(['map', str(world), '--floor', '0', '-o', str(stem)]) == 0
    grid = make_map(load_world(str(world)), 0)
    assert capsys.readouterr().out == (
        f'wrote {stem}.pgm and {stem}.yaml: floor 0, '
        f'{grid.cells.shape[1]} x {grid.cells.shape[0]} cells of 0.05 m\n')
    read = read_as_map_server(tmp_path / 'new' / 'up.1.yaml')
    assert (read.cells == grid.cells).all() and set(read.cells.flat) == {FREE, OCCUPIED, UNKNOWN}
    assert read.resolution == grid.resolution
    assert read.origin == pytest.approx(grid.origin, abs=1e-6)
