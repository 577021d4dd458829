"""angen map: a floor's map as the files of map_server."""
from __future__ import annotations

from pathlib import Path
from typing import Any

from angen_apps.maps.gridmap import load_world, make_map
from angen_tools.common.failure import Failure
from angen_tools.world.models import building


def save_map(world: Path | None, floor: int, doors: str, stem: Path) -> dict[str, Any]:
    """Writes STEM.pgm and STEM.yaml; returns a report. `world` is worlds/angen.world without.

    Failure where the world does not load, has no such floor, or the files cannot be written.
    """
    path = world or building()
    try:
        made = make_map(load_world(str(path)), floor, doors)
    except Failure as failure:
        named = str(failure).startswith(str(path))
        raise Failure(str(failure) if named else f'{path}: {failure}') from None
    picture, text = made.save(stem)
    rows, columns = made.cells.shape
    return {'files': [str(picture), str(text)], 'floor': floor, 'columns': columns, 'rows': rows,
            'resolution_m': made.resolution,
            'text': f'wrote {picture} and {text}: floor {floor}, {columns} x {rows} cells of '
                    '0.05 m'}
