"""Reads plans that are pictures: scans, drawings, and the maps of map_server (map.yaml)."""
from __future__ import annotations

from dataclasses import replace
from math import pi, radians
from pathlib import Path
from typing import Sequence

import numpy as np
import yaml
from scipy.ndimage import binary_closing, binary_opening, label

from angen_apps.imports.flood import rooms_of
from angen_apps.imports.raster import (darkness, reduced, straightened, threshold, turn_of,
                                       without_noise)
from angen_apps.imports.source import FARTHEST, read_bytes
from angen_apps.plan.finish import finish, room_at, sides
from angen_apps.plan.model import Leaf, Opening, Piece, Plan, Point, Storey, Wall, turned
from angen_apps.plan.names import slug
from angen_apps.plan.polygons import rectangles
from angen_tools.common.failure import Failure
from angen_tools.common.yaml_file import YamlFile

HEIGHT = 2.5  # m
DOOR_TOP = 2.1  # m
NARROW, WIDE = 0.7, 1.1  # m: gaps that are doors
LEAST_STUB = 0.08  # m across of a shorter piece of wall, as between a corner and a door
THICKEST = 0.45  # m of a wall across
LEAST_WALL = 0.25  # m of a wall along: shorter dark spots are text and dirt
FURNITURE = 0.4, 3.0  # m of the longer side: smaller things are text and pillars
LONGEST_THIN = 1.0  # m of a thing thinner than LEAST_WALL: a longer one is a wall that stands free
FURNITURE_HEIGHT = 0.75  # m
BESIDE = 0.15  # m from a doorway to the wall that ends at it
LEAST_ROOM = 1.0  # m2: a smaller space that is closed is the inside of a thing
SPECK = 0.3  # m of a map that are unknown: smaller specks are in a room
FINEST = 0.02  # m a pixel: finer pictures are read by blocks of pixels
FINE = 0.035  # m a pixel: thin walls have several pixels across
WALLS = 20_000
MODES = ('trinary', 'scale', 'raw')  # of map_server; walls are the same in the first two
SEAM = 1e-4  # m that walls overlap, so that no seam is between them
JOINT = 2  # pixels between walls that meet
Box = tuple[int, int, int, int]  # west, south, east, north
Island = tuple[slice, slice]  # rows and columns
Origin = tuple[float, float, float]  # x, y and yaw of a picture's lower left corner
ENDINGS = ('.png', '.pgm', '.jpg', '.jpeg')


def read_picture(path: Path, scale: float, with_doors: bool) -> Plan:
    """The plan of a picture whose pixels are `scale` m wide; dark is wall."""
    dark = darkness(path)
    if scale <= FINEST / 2:
        factor = min(int(FINEST / scale), *dark.shape)
        dark, scale = reduced(dark, factor), scale * factor
    if scale < FINE:
        dark = without_noise(dark)
    walls, known, _, remarks = _straight(path, dark, np.ones(dark.shape, bool),
                                         threshold(path, dark), scale, (0.0, 0.0, 0.0))
    if remarks:  # the page is put upright
        known[:] = True
        remarks = [f'{remarks[0]}; the picture is put upright']
    return _plan(path, walls, known, scale, (0.0, 0.0, 0.0), with_doors, remarks)


def read_map(path: Path, with_doors: bool) -> Plan:
    """The plan of a map of map_server: its picture, resolution, origin and thresholds."""
    file = YamlFile(path)
    if file.root is None or not hasattr(file.root, 'value'):
        raise file.fail(file.root, 'is not a map: it needs image, resolution and origin')
    values = {key.value: node for key, node in file.root.value if hasattr(key, 'value')}
    for key in ('image', 'resolution', 'origin'):
        if key not in values:
            raise file.fail(file.root, f'has no {key}; a map needs image, resolution and origin')
    picture = _image(file, values['image'])
    scale = file.number(values['resolution'], 'resolution', 1e-4, 10.0)
    origin = [file.number(node, 'origin', -FARTHEST, FARTHEST)
              for node in file.list(values['origin'], 'origin')]
    if len(origin) != 3:
        raise file.fail(values['origin'], 'origin must be [x, y, yaw]')
    limit = file.number(values['occupied_thresh'], 'occupied_thresh', 0.0, 1.0) \
        if 'occupied_thresh' in values else 0.65
    negate = 'negate' in values and file.number(values['negate'], 'negate', 0, 1) == 1
    mode = file.choice(values['mode'], 'mode', MODES) if 'mode' in values else MODES[0]
    dark = darkness(picture)
    if negate:
        dark = 1 - dark
    if mode == 'raw':  # a value is the occupancy in percent, above 100 it is unknown
        value = np.round(255 * (1 - dark))
        dark = np.where(value <= 100, value / 100, 0.0)
    free = file.number(values['free_thresh'], 'free_thresh', 0.0, 1.0) \
        if 'free_thresh' in values else 0.196
    across = max(1, round(SPECK / scale))
    unknown = binary_opening((dark >= free) & (dark <= limit), np.ones((across, across)))
    walls, known, place, remarks = _straight(path, dark, ~unknown, limit, scale,
                                             (origin[0], origin[1], origin[2]))
    return _plan(path, walls, known, scale, place, with_doors, remarks)


def _image(file: YamlFile, node: yaml.Node) -> Path:
    """The picture of a map, in its folder; there also if it names one of another machine."""
    text, folder = file.text(node, 'image'), file.path.parent
    picture = folder / (Path(text).name if Path(text).is_absolute() else text)
    if folder.resolve() not in picture.resolve().parents:
        raise file.fail(node, f'the image "{text}" is not in the folder of the map')
    return picture


def is_map(path: Path) -> bool:
    """Whether a YAML file is a map of map_server."""
    lines = read_bytes(path)[:4096].splitlines()
    return any(line.startswith(b'resolution:') for line in lines)


def _straight(path: Path, dark: np.ndarray, known: np.ndarray, limit: float, scale: float,
              origin: Origin) -> tuple[np.ndarray, np.ndarray, Origin, list[str]]:
    """Dark and known pixels, turned so that walls are along x and y; where they are then."""
    degrees = turn_of(cleaned_walls(np.asarray(dark > limit), scale))
    if not degrees:
        return np.asarray(dark > limit), known, origin, []
    middle = scale * np.array(dark.shape[::-1]) / 2
    dark = straightened(dark, degrees, 0.0)
    known = straightened(known.astype(float), degrees, 0.0) > 0.5
    x, y, yaw = origin
    corner = turned((middle[0], middle[1]), radians(degrees),
                    *(-scale * np.array(dark.shape[::-1]) / 2))
    x, y = turned((x, y), yaw, *corner)
    return (np.asarray(dark > limit), known, (x, y, yaw + radians(degrees)),
            [f'{path}: its walls are turned by {degrees:.1f} degrees'])


def _plan(path: Path, dark: np.ndarray, known: np.ndarray, scale: float,
          origin: Origin, with_doors: bool, said: Sequence[str]) -> Plan:
    """Rooms are where it is known."""
    if max(dark.shape) * scale > FARTHEST:
        raise Failure(f'{path}: is {max(dark.shape) * scale:.0f} m wide at {scale:g} m a pixel, '
                      f'at most {FARTHEST:g} m are read')
    walls = cleaned_walls(dark, scale)
    remarks: list[str] = []
    storey = _storey(path, walls, known, scale, with_doors, remarks)
    islands: list[Island] = []
    for thin in (False, True):  # a gap beside a table is no door that would make a chair a wall
        found = find_islands(walls, scale, storey, thin)
        for rows, columns in found:
            walls[rows, columns] = False
        if found:
            remarks.clear()
            storey = _storey(path, walls, known, scale, with_doors, remarks)
        islands += found
    pieces = [_piece(rows, columns, scale) for rows, columns in islands]
    storey.pieces = [piece for piece in pieces if room_at(storey, (piece.x, piece.y))]
    if storey.pieces:
        remarks.append(f'{path}: {len(storey.pieces)} things that touch no wall are furniture, '
                       f'boxes {FURNITURE_HEIGHT:g} m high')
    thick = thick_spots(walls, scale)
    if thick:
        remarks.append(f'{path}: {len(thick)} dark spots at walls are read as wall, the largest '
                       f'{max(thick):.1f} m wide; furniture there needs a gap to its wall')
    if not storey.rooms:
        remarks.append(f'{path}: no space of {LEAST_ROOM:g} m2 is closed by walls, so that there '
                       'are no rooms; check --scale')
    storey.walls += [_over(opening) for opening in storey.openings]
    _move(storey, origin)
    return finish(Plan(slug(path.name.partition('.')[0], 'plan'), [storey],
                       remarks=[*said, *remarks]))


def _storey(path: Path, dark: np.ndarray, known: np.ndarray, scale: float, with_doors: bool,
            remarks: list[str]) -> Storey:
    """Walls, openings and rooms between dark pixels."""
    boxes = straight_walls(dark, scale)
    if not boxes:
        raise Failure(f'{path}: has no walls: nothing dark is {LEAST_WALL:g} m long; check the '
                      'scale')
    if len(boxes) > WALLS:
        raise Failure(f'{path}: has more than {WALLS} walls; it is not a floor plan')
    storey = Storey(0, 'Ground floor', 0.0, HEIGHT)
    for west, south, east, north in boxes:
        storey.walls.append(_wall(west * scale - SEAM, south * scale - SEAM, east * scale + SEAM,
                                  north * scale + SEAM))
    gaps = _doors(storey.walls)
    storey.openings = gaps if with_doors else [
        replace(gap, kind='opening', leaves=()) for gap in gaps]
    storey.rooms = rooms_of(storey, HEIGHT, (), (known, scale))
    parting = [o for o in storey.openings if len(set(map(id, sides(o, storey)))) > 1]
    if len(parting) < len(storey.openings):
        remarks.append(f'{path}: {len(storey.openings) - len(parting)} gaps of {NARROW:g} to '
                       f'{WIDE:g} m lead from a room into itself and are no doors')
        storey.openings = parting
        storey.rooms = rooms_of(storey, HEIGHT, (), (known, scale))
    return storey


def find_islands(dark: np.ndarray, scale: float, storey: Storey, thin: bool) -> list[Island]:
    """The rows and columns of dark things that are as large as furniture and touch no wall; of one
    in another one only the outer. A room with a door of its own is none, nor is a `thin` thing
    at a door: that is a wall between two."""
    labels, count = label(dark, np.ones((3, 3)))
    is_wall = np.zeros(count + 1, bool)
    for opening in storey.openings:
        ends = [_labels_at(labels, opening.point(u, 0.0), scale)
                for u in (-opening.width / 2, opening.width / 2)]
        is_wall[list(ends[0] | ends[1] if thin else ends[0] & ends[1])] = True
    found: list[Island] = []
    for number, (rows, columns) in enumerate(_slices(labels, count), 1):
        low, high = sorted((s.stop - s.start) * scale for s in (rows, columns))
        is_wall[number] |= high > FURNITURE[1] or (low < LEAST_WALL and high > LONGEST_THIN)
        if not is_wall[number] and high >= FURNITURE[0] and (low <= THICKEST) == thin:
            found.append((rows, columns))
    apart = [each for each in found if not is_wall[np.unique(labels[each])].any()]
    return [each for each in apart if not any(_is_within(each, other) for other in apart)]


def thick_spots(dark: np.ndarray, scale: float) -> list[float]:
    """The widths (m) of spots that are thicker than walls and as large as furniture, filled or as
    outlines at walls."""
    labels, count = label(~dark)
    pockets = np.bincount(labels.ravel(), minlength=count + 1) * scale ** 2 < LEAST_ROOM
    across = round(THICKEST / scale) + 1
    filled = dark | pockets[labels]
    labels, count = label(binary_opening(filled, np.ones((across, across))))
    widths = [max(s.stop - s.start for s in where) * scale for where in _slices(labels, count)]
    return [width for width in widths if width <= FURNITURE[1]]


def _labels_at(labels: np.ndarray, point: Point, scale: float) -> set[int]:
    """What is within BESIDE of a point."""
    columns, rows = (slice(max(0, int((v - BESIDE) / scale)), int((v + BESIDE) / scale) + 1)
                     for v in point)
    return set(np.unique(labels[rows, columns]).tolist()) - {0}


def _is_within(inner: Island, outer: Island) -> bool:
    return inner != outer and all(o.start <= i.start and i.stop <= o.stop
                                  for i, o in zip(inner, outer))


def _piece(rows: slice, columns: slice, scale: float) -> Piece:
    return Piece('furniture', (columns.start + columns.stop) / 2 * scale,
                 (rows.start + rows.stop) / 2 * scale, 0.0, 0.0,
                 (rows.stop - rows.start) * scale, (columns.stop - columns.start) * scale,
                 FURNITURE_HEIGHT)


def _move(storey: Storey, origin: Origin) -> None:
    """Turns and shifts a storey that was read in the picture's frame."""
    x, y, yaw = origin

    def moved(point: Point) -> Point:
        return turned((x, y), yaw, *point)

    storey.walls = [replace(wall, start=moved(wall.start), end=moved(wall.end))
                    for wall in storey.walls]
    for i, opening in enumerate(storey.openings):
        at = moved((opening.x, opening.y))
        storey.openings[i] = replace(opening, x=at[0], y=at[1], yaw=opening.yaw + yaw)
    for i, piece in enumerate(storey.pieces):
        at = moved((piece.x, piece.y))
        storey.pieces[i] = replace(piece, x=at[0], y=at[1], yaw=piece.yaw + yaw)
    storey.rooms = [replace(room, polygon=tuple(map(moved, room.polygon)),
                            holes=tuple(tuple(map(moved, hole)) for hole in room.holes))
                    for room in storey.rooms]


def cleaned_walls(dark: np.ndarray, scale: float) -> np.ndarray:
    """The dark pixels without noise: specks are removed, holes of a pixel or two filled."""
    closed = binary_closing(np.pad(dark, 3), np.ones((3, 3)))[3:-3, 3:-3]
    opened = closed if scale >= 0.03 else binary_opening(closed, np.ones((2, 2)))
    labels, count = label(opened, np.ones((3, 3)))
    kept = np.zeros(count + 1, bool)
    rows, columns = np.nonzero(labels)
    index = labels[rows, columns]
    for values in (rows, columns):
        low = np.full(count + 1, 1 << 30)
        high = np.full(count + 1, -1)
        np.minimum.at(low, index, values)
        np.maximum.at(high, index, values)
        kept |= (high - low + 1) * scale >= LEAST_WALL
    kept[0] = False
    return np.asarray(kept[labels])


def straight_walls(dark: np.ndarray, scale: float) -> list[Box]:
    """In pixels: runs along x and y, their edges straightened."""
    found: list[Box] = []
    left = dark.copy()
    least = max(2, round(LEAST_WALL / scale))
    for upright in (False, True):
        cells = left.T if upright else left
        runs = binary_opening(cells, np.ones((1, least)))
        labels, count = label(runs)
        for k, where in enumerate(_slices(labels, count), 1):
            part = labels[where] == k
            for row, column, high, wide in _bands(part):
                south, west = where[0].start + row, where[1].start + column
                found.append((south, west, south + high, west + wide) if upright
                             else (west, south, west + wide, south + high))
        cells &= ~runs
    for row, column, high, wide in rectangles(left):
        if max(high, wide) >= least or min(high, wide) * scale >= LEAST_STUB:
            found.append((column, row, column + wide, row + high))
    return _joined(found, dark.shape)


def _joined(boxes: list[Box], shape: tuple[int, ...]) -> list[Box]:
    """The boxes, longer by a pixel or two where another one begins so near to an end."""
    walls = np.zeros(shape, bool)
    for west, south, east, north in boxes:
        walls[south:north, west:east] = True
    found = []
    for west, south, east, north in boxes:
        wide, high = east - west, north - south
        left, right = _nearby(walls[south:north], west, east) if 2 * wide >= high else (0, 0)
        below, above = _nearby(walls[:, west:east].T, south, north) if 2 * high >= wide else (0, 0)
        found.append((west - left, south - below, east + right, north + above))
    return found


def _nearby(lines: np.ndarray, low: int, high: int) -> tuple[int, int]:
    """How many pixels before `low` and after `high` the next wall is; 0 where it is not near."""
    before, after = lines[:, :low][:, ::-1][:, :JOINT + 1], lines[:, high:high + JOINT + 1]
    return (int(before.any(axis=0).argmax()) if before.any() else 0,
            int(after.any(axis=0).argmax()) if after.any() else 0)


def _slices(labels: np.ndarray, count: int) -> list[tuple[slice, slice]]:
    from scipy.ndimage import find_objects
    return [where for where in find_objects(labels, count) if where is not None]


def _bands(part: np.ndarray) -> list[tuple[int, int, int, int]]:
    """A run's rectangles: one if it is nearly straight, otherwise those that cover it."""
    filled = part.mean()
    if filled > 0.8:
        rows = np.nonzero(part.mean(axis=1) >= 0.5)[0]
        if len(rows):
            return [(int(rows[0]), 0, int(rows[-1] - rows[0] + 1), part.shape[1])]
    return rectangles(part)


def _wall(west: float, south: float, east: float, north: float) -> Wall:
    wide, high = east - west, north - south
    x, y = (west + east) / 2, (south + north) / 2
    if wide >= high:
        return Wall((west, y), (east, y), high, 0.0, HEIGHT)
    return Wall((x, south), (x, north), wide, 0.0, HEIGHT)


def _doors(walls: list[Wall]) -> list[Opening]:
    """Gaps of 0.7 to 1.1 m between two walls in one line, and between a wall's end and a face."""
    found = []
    for along in (0, 1):
        spans = []
        for wall in walls:
            run = 0 if abs(wall.end[0] - wall.start[0]) >= abs(wall.end[1] - wall.start[1]) else 1
            half = wall.thickness / 2
            low, high = sorted((wall.start[along], wall.end[along]))
            across = wall.start[1 - along]
            if run == along:
                spans.append((low, high, across - half, across + half, True))
            else:
                first, last = sorted((wall.start[1 - along], wall.end[1 - along]))
                spans.append((wall.start[along] - half, wall.start[along] + half, first, last,
                              False))
        for low, high, first, last, runs in spans:
            if not runs or last - first > THICKEST:
                continue
            found += _gaps(spans, (low, high, first, last), along)
    return _once(found)


def _gaps(spans: list[tuple[float, float, float, float, bool]],
          wall: tuple[float, float, float, float], along: int) -> list[Opening]:
    """The gaps at both ends of a wall."""
    low, high, first, last = wall
    found = []
    for end, sign in ((high, 1), (low, -1)):
        beyond = [(s[0] - end if sign > 0 else end - s[1]) for s in spans
                  if min(s[3], last) - max(s[2], first) > 0.5 * (last - first)]
        gap = min((g for g in beyond if g > 0.02), default=0.0)
        if NARROW <= gap <= WIDE and not any(-0.02 < g <= 0.02 for g in beyond):
            at, across = end + sign * gap / 2, (first + last) / 2
            x, y = (at, across) if along == 0 else (across, at)
            half = (last - first) / 2
            leaf = Leaf((-gap / 2 + 0.005, -half), gap - 0.01, 0.0, -pi / 2)
            found.append(Opening('door', x, y, 0.0 if along == 0 else pi / 2, gap, 0.0, DOOR_TOP,
                                 (-half, half), (leaf,), source='gap'))
    return found


def _once(openings: list[Opening]) -> list[Opening]:
    kept: list[Opening] = []
    for opening in openings:
        if all(abs(opening.x - o.x) + abs(opening.y - o.y) > 0.3 for o in kept):
            kept.append(opening)
    return kept


def _over(opening: Opening) -> Wall:
    """The wall over a door, from its top to the ceiling."""
    a, b = opening.point(-opening.width / 2, 0.0), opening.point(opening.width / 2, 0.0)
    return Wall(a, b, opening.band[1] - opening.band[0], DOOR_TOP, HEIGHT)
