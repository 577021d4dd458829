"""Furniture by rules: what residents need first, each piece with its back to a wall, nothing in
a door's swing, chairs at tables, ways free."""
from dataclasses import dataclass, replace
from functools import cached_property
from math import cos, hypot, pi, sin
from random import Random
from typing import Callable, Iterator, Sequence

import numpy as np
from scipy.ndimage import distance_transform_edt, label

from angen_apps.plan.finish import room_at
from angen_apps.plan.model import Opening, Piece, Plan, Point, Room, Storey
from angen_apps.plan.names import Names, stem
from angen_apps.plan.polygons import base, hole, overlap, to_segments
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import bounds, turned

# thing: model, width, depth, height
PIECES = {'bed': ('bed', 1.6, 2.04, 0.9), 'nightstand': ('nightstand', 0.45, 0.4, 0.5),
          'wardrobe': ('wardrobe', 1.2, 0.6, 2.1), 'desk': ('desk', 1.2, 0.7, 0.75),
          'chair': ('chair', 0.45, 0.45, 0.9), 'sofa': ('sofa', 1.9, 0.9, 0.85),
          'armchair': ('armchair', 0.85, 0.85, 0.85), 'tv': ('tv', 1.1, 0.3, 0.7),
          'bookshelf': ('bookshelf', 0.9, 0.35, 1.9), 'stove': ('stove', 0.6, 0.6, 0.9),
          'sink': ('washbasin', 0.6, 0.5, 0.9), 'fridge': ('fridge', 0.65, 0.65, 1.8),
          'table': ('table', 1.0, 0.7, 0.75), 'toilet': ('toilet', 0.4, 0.65, 0.8),
          'shower': ('', 0.85, 0.85, 2.0), 'cabinet': ('cabinet', 0.8, 0.4, 1.2),
          'washing_machine': ('washing_machine', 0.6, 0.6, 0.85)}
Things = dict[str, tuple[str, ...]]
NEEDED: Things = {
    'bedroom': ('bed', 'wardrobe'), 'living': ('sofa', 'dining', 'tv'),
    'kitchen': ('stove', 'sink', 'fridge'), 'work': ('study',),
    'bathroom': ('shower', 'toilet', 'sink', 'washing_machine')}
WANTED: Things = {
    'bedroom': ('nightstand', 'study'), 'living': ('armchair', 'bookshelf'),
    'kitchen': ('cabinet', 'breakfast'), 'work': ('bookshelf', 'armchair')}
# in a home without a living room
NEEDED_ALONE: Things = {
    'bedroom': ('bed', 'wardrobe', 'armchair'), 'kitchen': ('stove', 'sink', 'fridge', 'dining')}
WANTED_ALONE: Things = {'bedroom': ('tv', 'nightstand'), 'kitchen': ('cabinet',)}
# thing: another that it stands near to, or faces at a distance in m before that
BESIDE = {'nightstand': ('bed', 0.0), 'sink': ('stove', 0.0), 'fridge': ('sink', 0.0),
          'cabinet': ('sink', 0.0), 'tv': ('sofa', 2.5), 'armchair': ('tv', 2.0)}
NEAR = 0.3  # m; places that differ by less are as near
TABLES = ('table', 'desk')  # used from their chairs
GAP = 0.02  # m to the wall, and between a table and its chairs
FRONT = 0.65  # m before a piece that stay free
SITTER = 0.5  # m of a toilet's width that no other piece is in: who sits there is 0.48 m wide
WAY = 0.8  # m that ways are wide
PAST = 0.36  # m from an open leaf to the middle of who gets past it
REACH = 0.8  # m from the middle of a way to what it leads to
INSIDE, CLOSE = 0.42, 0.1  # m from a wall to who comes in by its door, and from there to a way
BEFORE = 0.35  # m from a piece to its user
CELL = 0.05
STEP = 0.15  # m between the places along a wall that are tried
TRIES = 40  # arrangements of a room
VARIANTS = 8  # plans of a seed
SLEEPERS = 2  # by bedroom
MOST_CHAIRS = 4


def furnished(plan_of: Callable[[str], Plan], seed: int) -> Plan:
    """The first variant of a plan that has what its residents need in each storey.

    `plan_of` makes a variant by its key. Failure if something does not fit in any of them.
    """
    for variant in range(VARIANTS):
        key = f'{seed} variant {variant}' if variant else str(seed)
        plan = plan_of(key)
        missing = [text for storey in plan.storeys
                   for text in furnish(storey, Random(f'{key} furniture {storey.number}'))]
        if not missing:
            return plan
    raise Failure(f'seed {seed}: no place for {"; ".join(missing)}; take another seed')


def furnish(storey: Storey, dice: Random) -> list[str]:
    """Places the pieces of each room, and returns the needed ones that have no place, as texts.

    A room that lacks one keeps the arrangement with the fewest missing.
    """
    names = Names()
    kept_free = [(_kept_free(o), o.bottom - storey.elevation if o.kind == 'window' else 0.0)
                 for o in storey.openings]
    uses = [room.use for room in storey.rooms]
    alone = 'living' not in uses
    needed = NEEDED | NEEDED_ALONE if alone else NEEDED
    wanted = WANTED | WANTED_ALONE if alone else WANTED
    homes = max(1, uses.count('kitchen'))
    chairs = min(MOST_CHAIRS, SLEEPERS * uses.count('bedroom') // homes)
    missing = []
    for room in storey.rooms:
        doors = [(o, side) for o in storey.openings if o.kind != 'window' for side in (-1, 1)
                 if room_at(storey, _before(o, side, 0.1)) is room]
        floor = _Floor(room, [_before(o, side, INSIDE) for o, side in doors],
                       [leaf for o, _ in doors for leaf in _open_leaves(o)], kept_free, chairs)
        if not _ways_are_free(floor, []):
            missing.append(f'a way between the doors in {room.name}')
        placed, absent = _arranged(floor, needed.get(room.use, ()), wanted.get(room.use, ()), dice)
        missing += [f'{thing} in {room.name}' for thing in absent]
        for piece in placed:
            name = names.take(f'{stem(room.name)}_{piece.thing}', storey.number)
            storey.pieces.append(replace(piece, name=name))
    return missing


@dataclass(frozen=True)
class _Floor:
    """A room, the places of who comes in by its doors, their open leaves from hinge to edge, areas
    that stay free of things above a height over the floor, and the number of chairs at its table.
    """

    room: Room
    inside: list[Point]
    leaves: list[tuple[Point, Point]]
    kept_free: list[tuple[list[Point], float]]
    chairs: int

    @cached_property
    def cells(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """x and y of the columns and rows of its cells, and where one is clear of open leaves."""
        west, south, east, north = bounds(self.room.polygon)
        x = np.arange(west + CELL / 2, east, CELL)
        y = np.arange(south + CELL / 2, north, CELL)[:, None]
        clear = np.ones((len(y), len(x)), bool)
        for hinge, edge in self.leaves:
            clear &= to_segments(x, y, hinge, edge) >= PAST
        return x, y, clear


def _arranged(floor: _Floor, needed: Sequence[str], wanted: Sequence[str], dice: Random
              ) -> tuple[list[Piece], list[str]]:
    """The pieces of a room, and the needed things that have no place."""
    best: tuple[list[Piece], list[str]] = ([], list(needed))
    for _ in range(TRIES):
        placed: list[Piece] = []
        absent = [thing for thing in needed if not _placed(floor, thing, placed, dice)]
        if not best[0] or len(absent) < len(best[1]):
            best = placed, absent
        if not absent:
            break
    for thing in wanted:
        _placed(floor, thing, best[0], dice)
    return best


def _placed(floor: _Floor, thing: str, placed: list[Piece], dice: Random) -> bool:
    """Adds a thing with what belongs to it at the first free place: near what it belongs to, or
    else in a random order."""
    places = list(_places(floor.room, thing, floor.chairs))
    dice.shuffle(places)
    other, ahead = BESIDE.get(thing, ('', 0.0))
    for near in (piece for piece in placed if piece.thing == other):
        x, y = turned((near.x, near.y), near.yaw, ahead, 0.0)
        places.sort(key=lambda pieces: hypot(pieces[0].x - x, pieces[0].y - y) // NEAR)
    for pieces in places:
        if _fits(floor, pieces, placed) and _ways_are_free(floor, [*placed, *pieces]):
            placed += pieces
            return True
    return False


def _places(room: Room, thing: str, chairs: int) -> Iterator[list[Piece]]:
    """A thing, with what belongs to it, at each place along each wall of a room."""
    west, south, east, north = bounds(room.polygon)
    for group in _groups(thing, chairs):
        deep, wide = group[0].depth, group[0].width
        for x, y, yaw, length in ((west, south, pi / 2, east - west),
                                  (east, south, pi, north - south),
                                  (east, north, -pi / 2, east - west),
                                  (west, north, 0.0, north - south)):
            ends = wide / 2 + GAP, length - wide / 2 - GAP
            if ends[1] < ends[0]:
                continue
            steps = int((ends[1] - ends[0]) / STEP)
            for along in (*ends, *(ends[0] + (i + 1) * STEP for i in range(steps))):
                places = [turned((x, y), yaw, deep / 2 + GAP + piece.x, piece.y - along)
                          for piece in group]
                yield [replace(piece, x=round(at[0], 3), y=round(at[1], 3), z=room.floor,
                               yaw=yaw + piece.yaw) for at, piece in zip(places, group)]


def _groups(thing: str, chairs: int) -> list[list[Piece]]:
    """Arrangements of a thing with what belongs to it; x is away from the wall."""
    if thing == 'study':
        desk = _piece('desk')
        return [[desk, _chair(_seat(desk.depth), 0.0, pi)]]
    if thing not in ('dining', 'breakfast'):
        return [[_piece(thing)]]
    table = _piece('table')
    count = chairs if thing == 'dining' else min(2, chairs)
    long, short = table.width, table.depth
    at_ends = [_chair(0.0, side * _seat(long), -side * pi / 2) for side in (1, -1)]
    ahead = [_chair(_seat(short), y, pi) for y in ((-0.25, 0.25) if count > 1 else (0.0,))]
    beside = [_chair(x, side * _seat(short), -side * pi / 2)
              for x in ((0.0,) if count < 3 else (-0.25, 0.25)) for side in (1, -1)]
    return [[table, *[*at_ends, *ahead][:count]],
            [replace(table, depth=long, width=short), *beside[:count]]]


def _seat(length: float) -> float:
    """The distance from the middle of a table, along which it has that length, to its chair."""
    return length / 2 + GAP + PIECES['chair'][2] / 2


def _piece(thing: str) -> Piece:
    model, wide, deep, high = PIECES[thing]
    return Piece('', 0.0, 0.0, 0.0, 0.0, wide, deep, high, thing, model,
                 'tray' if thing == 'shower' else 'box', source=thing)


def _chair(x: float, y: float, yaw: float) -> Piece:
    return replace(_piece('chair'), x=x, y=y, yaw=yaw)


def _kept_free(opening: Opening) -> list[tuple[float, float]]:
    """A rectangle on both sides of an opening that stays free."""
    reach = opening.width + 0.1 if opening.kind != 'window' else opening.width + 0.05
    return hole(opening, 0.1, reach)


def _before(door: Opening, side: int, away: float) -> Point:
    """The point before the middle of a door, on its side -1 or 1, so far from its wall."""
    return door.point(0.0, door.band[0] - away if side < 0 else door.band[1] + away)


def _open_leaves(door: Opening) -> list[tuple[Point, Point]]:
    """The hinge and the far edge of each leaf of a door that turns, as it is open."""
    hinges = [(door.point(*leaf.hinge), leaf) for leaf in door.leaves if leaf.turn]
    return [(hinge, turned(hinge, door.yaw + leaf.shut + leaf.turn, leaf.width, 0.0))
            for hinge, leaf in hinges]


def _front(piece: Piece) -> float:
    """The depth of the floor before a piece that stays free, in m: a table's are its chairs'."""
    return 0.0 if piece.thing in (*TABLES, 'chair') else FRONT


def _with_user(piece: Piece) -> Piece:
    """A piece as wide as who uses it."""
    return replace(piece, width=max(piece.width, SITTER)) if piece.thing == 'toilet' else piece


def _fits(floor: _Floor, pieces: list[Piece], placed: list[Piece]) -> bool:
    """Whether pieces are within the room, clear of swings and of what is placed already."""
    west, south, east, north = bounds(floor.room.polygon)
    for piece in pieces:
        outline = base(piece)
        if any(not (west < x < east and south < y < north) for x, y in outline):
            return False
        if any(overlap(outline, area) > 0 for area, above in floor.kept_free
               if piece.height > above):
            return False
        piece = _with_user(piece)
        if any(overlap(base(piece, _front(piece)), base(other)) > -0.03
               or overlap(base(piece), base(other, _front(other))) > -0.03
               for other in map(_with_user, placed)):
            return False
    return True


def _ways_are_free(floor: _Floor, pieces: list[Piece]) -> bool:
    """Whether ways lead from each door to the user of each piece, past open leaves."""
    x, y, clear = floor.cells
    free = np.ones(clear.shape, bool)
    for piece in pieces:
        c, s = cos(piece.yaw), sin(piece.yaw)
        dx, dy = x - piece.x, y - piece.y
        free &= ~((np.abs(dx * c + dy * s) < piece.depth / 2)
                  & (np.abs(dy * c - dx * s) < piece.width / 2))
    padded = np.pad(free, 1)
    labels, _ = label(clear & (distance_transform_edt(padded)[1:-1, 1:-1] * CELL >= WAY / 2))
    goals = [(point, CLOSE) for point in floor.inside]
    goals += [(_user(piece), REACH) for piece in pieces if piece.thing not in TABLES]
    found = set()
    for (gx, gy), reach in goals:
        near = np.hypot(x - gx, y - gy) + 1e6 * (labels == 0)
        if near.min() > reach:
            return False
        found.add(int(labels.flat[int(near.argmin())]))
    return len(found) <= 1


def _user(piece: Piece) -> tuple[float, float]:
    """The point to whose surroundings a way leads: before a piece, or a chair itself."""
    ahead = 0.0 if piece.thing == 'chair' else piece.depth / 2 + BEFORE
    return turned((piece.x, piece.y), piece.yaw, ahead, 0.0)
