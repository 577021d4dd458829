"""Reads plans that are pictures: scans, drawings, and the maps of map_server (map.yaml)."""
from dataclasses import replace
from math import radians
from pathlib import Path
from typing import Sequence

import numpy as np
import yaml
from scipy.ndimage import binary_opening, label

from angen_apps.imports.flood import rooms_of
from angen_apps.imports.gaps import DOOR_TOP, NARROW, THICKEST, WIDE, doors
from angen_apps.imports.raster import (darkness, reduced, straightened, threshold, turn_of,
                                       without_noise, without_specks)
from angen_apps.imports.source import FARTHEST
from angen_apps.imports.strokes import (LEAST_WALL, areas, by_label, cleaned_walls, slices,
                                        straight_walls)
from angen_apps.plan.finish import finish, room_at, sides
from angen_apps.plan.model import Opening, Piece, Plan, Point, Storey, Wall
from angen_apps.plan.names import slug
from angen_apps.plan.polygons import area
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import bounds, turned
from angen_tools.common.text_file import read_bytes
from angen_tools.common.yaml_file import Entries, YamlFile

HEIGHT = 2.5  # m
FURNITURE = 0.4, 3.0  # m of the longer side: smaller things are text and pillars
LONGEST_THIN = 1.0  # m of a thing thinner than LEAST_WALL: a longer one is a free-standing wall
FURNITURE_HEIGHT = 0.75  # m
BESIDE = 0.15  # m from a doorway to the wall that ends at it
LEAST_SHARE = 0.2  # least part of the floor between walls that rooms have
LEAST_ROOM = 1.0  # m2: a smaller space that is closed is the inside of a thing
SPECK = 0.3  # m of a map that are unknown: smaller specks are in a room
FINEST = 0.02  # m a pixel: finer pictures are read by blocks of pixels
FINE = 0.035  # m a pixel: thin walls have several pixels across
WALLS = 20_000
MODES = ('trinary', 'scale', 'raw')  # map_server's modes; walls are the same in the first two
UPRIGHT = 'the picture is put upright'
SEAM = 1e-4  # m that walls overlap, so that no seam is between them
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
    limit = threshold(path, dark)
    if scale >= FINE:
        dark = without_specks(dark, limit)
    walls, known, _, remarks = _straight(path, dark, np.ones(dark.shape, bool), limit, scale,
                                         (0.0, 0.0, 0.0))
    del dark  # what follows takes as much memory
    if remarks:  # the page is put upright
        known[:] = True
        remarks = [f'{remarks[0]}; {UPRIGHT}']
    return _plan(path, walls, known, scale, (0.0, 0.0, 0.0), with_doors, remarks)


def read_map(path: Path, with_doors: bool) -> Plan:
    """The plan of a map of map_server: its picture, resolution, origin and thresholds."""
    file = YamlFile(path)
    if file.root is None or not hasattr(file.root, 'value'):
        raise file.fail(file.root, 'is not a map: it needs image, resolution and origin')
    values = Entries((key.value, node) for key, node in file.root.value if hasattr(key, 'value'))
    for key in ('image', 'resolution', 'origin'):
        if key not in values:
            raise file.fail(file.root, f'has no {key}; a map needs image, resolution and origin')
    picture = _image(file, values['image'])
    scale = file.number(values['resolution'], 'resolution', 1e-4, 10.0)
    origin = [file.number(node, 'origin', -FARTHEST, FARTHEST)
              for node in file.list(values['origin'], 'origin')]
    if len(origin) != 3:
        raise file.fail(values['origin'], 'origin must be [x, y, yaw]')
    limit = values.of('occupied_thresh', file.number, 0.65, 0.0, 1.0)
    mode = values.of('mode', file.choice, MODES[0], MODES)
    dark = darkness(picture)
    if values.of('negate', file.number, 0.0, 0, 1) == 1:
        dark = 1 - dark
    if mode == 'raw':  # a value is the occupancy in percent, above 100 it is unknown
        value = np.round(255 * (1 - dark))
        dark = np.where(value <= 100, value / 100, 0.0)
    free = values.of('free_thresh', file.number, 0.196, 0.0, 1.0)
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
    known = straightened(known.astype(np.float32), degrees, 0.0) > 0.5
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
    _check_rooms(path, storey)
    storey.walls += [_over(opening) for opening in storey.openings]
    _move(storey, origin)
    return finish(Plan(slug(path.name.partition('.')[0], 'plan'), [storey],
                       remarks=[*said, *remarks]))


def _check_rooms(path: Path, storey: Storey) -> None:
    """Failure if rooms are not a fair share of the floor between the outermost walls."""
    x0, y0, x1, y1 = bounds(point for wall in storey.walls for point in (wall.start, wall.end))
    closed = sum(area(room.polygon) for room in storey.rooms)
    if closed < LEAST_SHARE * (x1 - x0) * (y1 - y0) or not storey.rooms:
        raise Failure(f'{path}: its walls close {closed:.1f} m2 of the {(x1 - x0) * (y1 - y0):.1f} '
                      'm2 between the outermost of them; draw walls as filled dark lines, without '
                      'gaps wider than doors, and check --scale')


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
    gaps = doors(storey.walls)
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
    for number, (rows, columns) in enumerate(slices(labels, count), 1):
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
    pockets = areas(labels, count) * scale ** 2 < LEAST_ROOM
    across = round(THICKEST / scale) + 1
    filled = dark | by_label(pockets, labels)
    labels, count = label(binary_opening(filled, np.ones((across, across))))
    widths = [max(s.stop - s.start for s in where) * scale for where in slices(labels, count)]
    return [width for width in widths if width <= FURNITURE[1]]


def _labels_at(labels: np.ndarray, point: Point, scale: float) -> set[int]:
    """The pixels within BESIDE of a point."""
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


def _wall(west: float, south: float, east: float, north: float) -> Wall:
    wide, high = east - west, north - south
    x, y = (west + east) / 2, (south + north) / 2
    if wide >= high:
        return Wall((west, y), (east, y), high, 0.0, HEIGHT)
    return Wall((x, south), (x, north), wide, 0.0, HEIGHT)


def _over(opening: Opening) -> Wall:
    """The wall over a door, from its top to the ceiling."""
    a, b = opening.point(-opening.width / 2, 0.0), opening.point(opening.width / 2, 0.0)
    return Wall(a, b, opening.band[1] - opening.band[0], DOOR_TOP, HEIGHT)
