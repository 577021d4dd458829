"""angen map: a floor's map as the files of map_server."""
from pathlib import Path
from typing import Any

import numpy as np
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED, UNKNOWN, load_world, make_map
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text, writing
from angen_tools.world.models import building

GRAYS = {FREE: 254, OCCUPIED: 0, UNKNOWN: 205}  # values of map_server


def save_map(world: Path | None, floor: int, doors: str, stem: Path) -> dict[str, Any]:
    """Writes STEM.pgm and STEM.yaml; returns a report. `world` is worlds/angen.world without.

    Failure if the world does not load, has no such floor, or the files cannot be written.
    """
    path = world or building()
    try:
        made = make_map(load_world(str(path)), floor, doors)
    except Failure as failure:
        named = str(failure).startswith(str(path))
        raise Failure(str(failure) if named else f'{path}: {failure}') from None
    picture, text = save_grid(made, stem)
    rows, columns = made.cells.shape
    return {'files': [str(picture), str(text)], 'floor': floor, 'columns': columns, 'rows': rows,
            'resolution_m': made.resolution,
            'text': f'wrote {picture} and {text}: floor {floor}, {columns} x {rows} cells of '
                    '0.05 m'}


def save_grid(grid: Grid, stem: Path) -> list[Path]:
    """Writes STEM.pgm and STEM.yaml as map_server reads them; returns their paths."""
    picture, text = stem.with_name(stem.name + '.pgm'), stem.with_name(stem.name + '.yaml')
    shades = np.full(grid.cells.shape, GRAYS[UNKNOWN], np.uint8)
    for value, gray in GRAYS.items():
        shades[grid.cells == value] = gray
    rows, columns = shades.shape
    with writing(picture, binary=True) as file:  # the highest y first
        file.write(b'P5\n%d %d\n255\n' % (columns, rows) + shades[::-1].tobytes())
    write_text(text, f'image: {picture.name}\nresolution: {grid.resolution}\n'
               f'origin: [{grid.origin[0]:.3f}, {grid.origin[1]:.3f}, 0.0]\n'
               'negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n')
    return [picture, text]
