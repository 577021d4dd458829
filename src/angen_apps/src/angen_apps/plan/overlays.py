"""Draws over a plan: sensors with their fields of view, events, and tracks."""
import csv
import gzip
import math
import re
from collections import Counter
from dataclasses import dataclass, field
from math import hypot, inf, pi
from pathlib import Path
from typing import Any, Iterable

import numpy as np

from angen_apps.plan.polygons import reach_of
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import edges, turned
from angen_tools.common.home import Storey
from angen_tools.common.text_file import separator_hint

ROWS = 5_000_000
COLUMN = re.compile('^(x|y|z)_m$')  # columns that tasks write
WHO = ('name', 'person', 'who', 'resident')  # columns with the name of the track
FAR = 6.0  # m of the field of view of a camera that are drawn
WITH_FIELD = ('pir', 'camera', 'lidar', 'depth')
NAME_PLACES = [(ring, dx, dy) for ring in (2, 8, 14, 22, 32)  # points from the mark, directions
               for dx, dy in ((0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (-1, 1), (1, -1), (-1, -1))]
STEP = pi / 90  # between the rays of a field of view
COLORS = {'pir': '#c0392b', 'camera': '#8e44ad', 'lidar': '#16a085', 'luminosity': '#d68910',
          'reed': '#1f618d', 'switch': '#1f618d', 'contact': '#7d6608'}
TRACKS = ('#c0392b', '#1f77b4', '#2ca02c', '#9467bd', '#ff7f0e', '#17becf')


@dataclass(frozen=True)
class What:
    """The requested overlays."""

    sensors: bool = False
    events: Path | None = None
    track: Path | None = None


@dataclass
class Data:
    """Counts by sensor, and the tracks by name: rows of x, y, z, storey (z, storey: or NaN)."""

    counts: Counter[str] = field(default_factory=Counter)
    tracks: dict[str, np.ndarray] = field(default_factory=dict)


def read(what: What, entities: Iterable[Any]) -> Data:
    """Reads the files; Failure with file and line where one is wrong."""
    data = Data()
    names = {name for _, name, _, _ in entities}
    if what.events:
        for line, row in _rows(what.events, ('source',)):
            if row.get('kind') != 'world':  # a model is added or removed
                data.counts[row['source']] += 1
        if data.counts and not names & set(data.counts):
            raise Failure(f'{what.events}:2: names no sensor or device of this world')
    if what.track:
        found: dict[str, list[tuple[float, ...]]] = {}
        for line, row in _rows(what.track, ('x', 'y')):
            who = next((row[key] for key in WHO if row.get(key)), 'track')
            try:
                point = tuple(float(row.get(key) or 'nan') for key in ('x', 'y', 'z', 'storey'))
            except ValueError:
                raise Failure(f'{what.track}:{line}: x and y must be numbers') from None
            if not (math.isfinite(point[0]) and math.isfinite(point[1])):
                raise Failure(f'{what.track}:{line}: x and y must be finite')
            found.setdefault(who, []).append(point)
        data.tracks = {name: np.array(points) for name, points in found.items()}
    return data


def _rows(path: Path, needed: tuple[str, ...]) -> Iterable[tuple[int, dict[str, str]]]:
    try:
        with (gzip.open(path, 'rt', newline='', encoding='utf-8-sig') if path.suffix == '.gz'
              else path.open(newline='', encoding='utf-8-sig')) as file:
            reader = csv.DictReader(file)
            reader.fieldnames = [COLUMN.sub(r'\1', name) for name in reader.fieldnames or []]
            missing = [key for key in needed if key not in reader.fieldnames]
            if missing:
                raise Failure(f'{path}:1: has no column {missing[0]}; it needs '
                              f'{", ".join(needed)}{separator_hint(",".join(reader.fieldnames))}')
            for line, row in enumerate(reader, 2):
                if line > ROWS:
                    raise Failure(f'{path}:{line}: has more than {ROWS} rows')
                yield line, {key: value or '' for key, value in row.items() if key}
    except UnicodeDecodeError:
        raise Failure(f'{path}: a byte that is not UTF-8; save the file as UTF-8') from None
    except (OSError, EOFError, csv.Error) as error:
        raise Failure(f'{path}: cannot be read: {getattr(error, "strerror", error)}') from None


def draw(axis: Any, scene: Any, storey: Storey, data: Data, what: What) -> None:
    """Draws the requested overlays of a storey."""
    here = [(kind, name, model, pose) for kind, name, model, pose in scene.entities
            if storey.elevation - 0.2 <= pose[2] < storey.elevation + storey.height]
    if what.sensors:
        walls, drawn = _walls(scene, storey), [entity for entity in here if entity[0] in COLORS]
        for entity in drawn:
            _draw_sensor(axis, scene, storey, entity, walls)
        _name_sensors(axis, drawn)
    if what.events:
        _draw_counts(axis, here, data.counts)
    for i, (name, points) in enumerate(sorted(data.tracks.items())):
        z = points[:, 2]
        mine = np.isnan(z) | ((z > storey.elevation - 0.3)
                              & (z < storey.elevation + storey.height - 0.3))
        mine &= np.isnan(points[:, 3]) | (points[:, 3] == storey.number)
        x, y = np.where(mine, points[:, 0], np.nan), np.where(mine, points[:, 1], np.nan)
        axis.plot(x, y, color=TRACKS[i % len(TRACKS)], lw=1.0, alpha=0.7, zorder=8, label=name)
    if data.tracks:
        axis.legend(loc='lower right', fontsize=6)


def _walls(scene: Any, storey: Storey) -> np.ndarray:
    """Edges (n, 4) of shapes as high as a wall: x0 y0 x1 y1."""
    found = []
    for shape in scene.shapes:
        if shape.top > storey.elevation + 1.7 and shape.bottom < storey.elevation + 1.1 \
                and shape.model not in scene.things:
            found += [(*a, *b) for a, b in edges(shape.corners)]
    return np.array(found, float).reshape(-1, 4)


def _draw_sensor(axis: Any, scene: Any, storey: Storey, entity: Any, walls: np.ndarray) -> None:
    kind, name, _, pose = entity
    color = COLORS[kind]
    yaw, ahead = _heading(pose)
    if (kind, name) in scene.fields:
        right, left, far = scene.fields[kind, name]
        if ahead < 0.3:  # looks down: a circle below
            far = max(0.3, (pose[2] - storey.elevation) * math.tan(min(left, 1.4)))
            outline = [turned(pose, a, far, 0.0) for a in np.linspace(0, 2 * pi, 40)]
        else:
            angles = np.arange(yaw + right, yaw + left + STEP / 2, STEP)
            outline = [(pose[0], pose[1])]
            for a in angles:
                r = reach_of(pose[0], pose[1], float(a), walls, far if far < inf else FAR)
                outline.append(turned(pose, a, r, 0.0))
        axis.fill(*zip(*outline), color=color, alpha=0.10, lw=0, zorder=5)
        axis.plot(*zip(*outline, outline[0]), color=color, alpha=0.4, lw=0.4, zorder=5)
    axis.plot([pose[0]], [pose[1]], 'o', color=color, ms=2.5, zorder=9)


def _name_sensors(axis: Any, drawn: list[Any]) -> None:
    """A name beside each sensor, at the nearest place of NAME_PLACES that covers no other text."""
    from matplotlib.text import Text
    renderer = axis.figure.canvas.get_renderer()
    axis.apply_aspect()
    taken = [text.get_window_extent() for text in axis.texts]
    points = 72.0 / axis.figure.dpi
    for kind, name, _, pose in drawn:
        text = axis.annotate(
            name, pose[:2], (0, 0), textcoords='offset points', fontsize=6.5, color=COLORS[kind],
            ha='center', va='center', zorder=10, parse_math=False,
            bbox={'facecolor': 'white', 'alpha': 0.75, 'lw': 0, 'pad': 0.4},
            arrowprops={'arrowstyle': '-', 'lw': 0.4, 'color': COLORS[kind]})
        text.update_positions(renderer)
        size = Text.get_window_extent(text)
        wide, high = size.width * points / 2, size.height * points / 2
        for ring, dx, dy in NAME_PLACES:
            text.xyann = (dx * (wide + ring), dy * (high + ring))
            text.update_positions(renderer)
            box = Text.get_window_extent(text)
            if not any(box.overlaps(other) for other in taken):
                break
        taken.append(box)


def _heading(pose: Any) -> tuple[float, float]:
    """The yaw of the x axis of a pose, and how much of it is horizontal."""
    x, y, z, w = pose[3:7]
    ahead = 1 - 2 * (y * y + z * z), 2 * (x * y + w * z)
    return math.atan2(ahead[1], ahead[0]), hypot(*ahead)


def _draw_counts(axis: Any, here: list[Any], counts: Counter[str]) -> None:
    """A disc for each sensor that fired, the redder and larger the more often."""
    from matplotlib import colormaps
    most = max(counts.values(), default=1)
    for _, name, _, pose in here:
        count = counts.get(name, 0)
        if not count:
            continue
        share = math.log1p(count) / math.log1p(most)
        for r, alpha in ((0.75, 0.12), (0.5, 0.18), (0.3, 0.35)):
            angles = np.linspace(0, 2 * pi, 32)
            axis.fill(pose[0] + r * (0.4 + 0.6 * share) * np.cos(angles),
                      pose[1] + r * (0.4 + 0.6 * share) * np.sin(angles),
                      color=colormaps['YlOrRd'](0.25 + 0.75 * share), alpha=alpha, lw=0, zorder=8)
        axis.text(pose[0], pose[1], str(count), fontsize=5.5, ha='center', va='center', zorder=10)
