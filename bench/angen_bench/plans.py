"""Plans to import and examine: Sweet Home 3D's examples, buildings of Open-RMF, scans, maps."""
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import yaml
from PIL import Image, ImageDraw

from angen_apps.imports.picture import is_map, read_map, read_picture
from angen_apps.imports.rmf import read_rmf
from angen_apps.imports.sweethome import read_sweethome
from angen_apps.plan.apartment import apartment
from angen_apps.plan.model import Plan, Point
from angen_apps.plan.polygons import area, hole
from angen_apps.plan.walls import footprint
from angen_tools.common.yaml_file import YamlFile

PIXEL = 0.025  # m of a scan
EDGE = 1.0  # m of paper around it
NOISES = (0.25, 0.75)  # of 60 gray levels, and of 2 % of inverted pixels
LEAST_WALL = 0.01  # m
RMF_PARTS = ('walls', 'doors')


@dataclass
class Case:
    """A plan: the numbers of its parts and the areas of its rooms (m2) as its file says."""

    name: str
    path: Path
    said: dict[str, int] = field(default_factory=dict)
    areas: list[float] | None = None
    is_home: bool = False  # people walk through each door
    scale: float | None = None

    def read(self) -> Plan:
        """Reads it as `angen import --doors`."""
        if self.scale is not None:
            return read_picture(self.path, self.scale, True)
        if self.path.suffix not in ('.yaml', '.yml'):
            return read_sweethome(self.path)
        return read_map(self.path, True) if is_map(self.path) else read_rmf(self.path)


def given(path: Path) -> Case:
    """A file of the user."""
    if path.suffix in ('.yaml', '.yml') and not is_map(path):
        return Case(path.name.partition('.')[0], path, in_building(path))
    return Case(path.parent.name if path.stem == 'map' else path.stem, path)


def in_building(path: Path) -> dict[str, int]:
    """The numbers of parts in a building.yaml, counted in its text alone."""
    file = YamlFile(path)
    if not isinstance(file.root, yaml.MappingNode):
        raise file.fail(file.root, 'is not a building of Open-RMF')
    root = {key.value: node for key, node in file.root.value}
    levels = [{key.value: node for key, node in level.value} for _, level in root['levels'].value]
    found = {part[:-1]: sum(len(level[part].value) for level in levels if part in level)
             for part in RMF_PARTS}
    found['level'] = len(levels)
    found['lift'] = len(root['lifts'].value) if 'lifts' in root else 0
    return found


def scans(folder: Path) -> list[Case]:
    """Drawings of a home by seed with two sizes of noise; its windows are drawn as wall."""
    plan = apartment(3, 1, 27)
    storey = plan.storeys[0]
    corners = np.array([p for wall in storey.walls for p in footprint(wall)])
    west, south = corners.min(axis=0) - EDGE
    wide, high = np.ceil((corners.max(axis=0) + EDGE - (west, south)) / PIXEL).astype(int)
    picture = Image.new('L', (int(wide), int(high)), 235)
    pen = ImageDraw.Draw(picture)

    def fill(points: list[Point], gray: int) -> None:
        pen.polygon([((x - west) / PIXEL - 0.5, high - (y - south) / PIXEL - 0.5)
                     for x, y in points], fill=gray)

    for wall in storey.walls:
        fill(list(footprint(wall)), 20)
    gaps = [opening for opening in storey.openings if opening.kind != 'window']
    for gap in gaps:
        fill(hole(gap, 0.0, 0.03), 235)
    rooms = [area(room.polygon) for room in storey.rooms if room.use != 'outdoor']
    cases = []
    for noise in NOISES:
        dice = np.random.default_rng(27)
        gray = np.asarray(picture, float) + dice.normal(0, 60 * noise, (high, wide))
        specks = dice.random(gray.shape) < 0.02 * noise
        gray[specks] = 255 - gray[specks]
        path = folder / f'scan{100 * noise:.0f}.png'
        Image.fromarray(np.clip(gray, 0, 255).astype(np.uint8)).save(path)
        said = {'room': len(rooms), 'door': len(gaps)}
        cases.append(Case(f'scan with noise {noise:g}', path, said, rooms, scale=PIXEL))
    return cases


def in_plan(case: Case, plan: Plan, counts: dict[str, int]) -> dict[str, int]:
    """The parts of `case.said` that were built."""
    built = {'wall': counts['walls'], 'door': counts['doors'], 'level': counts['floors'],
             'lift': counts['lifts'], 'room': counts['rooms']}
    return {key: built[key] for key in case.said}
