"""Lengths and angles of a world that are out of proportion, as those in other units are."""
import math
from pathlib import Path
from typing import Any, Iterator

import numpy as np

from angen_tools.common.angle import MOST_TURN, radians
from angen_tools.common.text_file import read_bytes
from angen_tools.common.xml_file import parse_xml

WIDEST = 200.0  # m of a room or wall
HIGH = 1.0  # m: what is lower is ground
IN_MILLIMETERS = 2000.0  # a room of 2 m has this length in mm; a shorter one is in cm
JOINS_NOTHING = ' joins nothing: '  # in findings about a home


def remarks(world: Any, path: str) -> Iterator[str]:
    """A line about each finding; `path` is the world's file."""
    yield from turns(path)
    widths = [(f"room '{room['name']}'", float(np.ptp(room['polygon'], axis=0).max()))
              for room in world.home['rooms']]
    widths += [(f"'{model}'", float(np.ptp(corners[:, :2], axis=0).max()))
               for model, _, kind, moves, corners in world.shapes
               if len(corners) and not moves and kind != 'mesh'
               and np.ptp(corners[:, 2]) >= HIGH]
    what, width = max(widths, key=lambda each: each[1], default=('', 0.0))
    if width > WIDEST:
        unit, part = ('milli', 1000) if width >= IN_MILLIMETERS else ('centi', 100)
        yield (f'{path}: {what} is {width:.6g} m wide; lengths are in m, so divide those in '
               f'{unit}meters by {part}: {width / part:.3g} m')
    yield from (f'{path}: {text}' for _, text in world.home_findings() if JOINS_NOTHING in text)


def turns(path: str) -> Iterator[str]:
    """Angles of poses in a file that are more than a turn, as on no path that leads round."""
    root = parse_xml(path, read_bytes(Path(path)), recover=True)
    for pose in root.iter('{*}pose'):
        for word in () if pose.getparent().tag == 'waypoint' else (pose.text or '').split()[3:]:
            angle = radians(word)
            if abs(angle) > MOST_TURN and pose.get('degrees') != 'true':
                yield (f'{path}:{pose.sourceline}: the angle {word} is in rad, more than a turn; '
                       f'{word} degrees are {math.radians(angle):.4g}')
                break
