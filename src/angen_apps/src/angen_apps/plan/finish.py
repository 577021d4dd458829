"""Completes a plan that was read: names, uses of rooms, and the main entrance."""
import re
from dataclasses import replace
from math import sin
from typing import Callable, Sequence

import numpy as np
from angen import Grid

from angen_apps.maps.cells import cell_of
from angen_apps.plan.model import Lamp, Opening, Piece, Plan, Point, Room, Storey, Wall
from angen_apps.plan.names import Names, slug, stem, use_by_things, use_of
from angen_apps.plan.nested import cut_out, holds
from angen_apps.plan.passages import passages
from angen_apps.plan.polygons import area, base, hole, overlap
from angen_apps.plan.slabs import CELL, at_edge, filled, raster_of
from angen_apps.plan.travel import sided
from angen_apps.plan.walls import cuts_wall, direction, footprint
from angen_tools.common.geometry import contains, local, turned

WHOLE = 0.9  # share of an opening's width and height: a piece that fills it closes it
JAMB = 0.1  # m from an end of a doorway to a wall beside it
THICK_WALL = 0.5  # m, the same of an opening cut into a wall that is thicker than its frame
NEAR = 0.01  # m between the top of a leaf and a ceiling
LOW = 1.5  # m: a lower leaf is that of a cupboard
AWAY = 0.3  # m from the face of a wall to a place outside
BESIDE = 0.15  # m from the face of a wall to the room beside it
TO_PASS = ('hall', 'landing', 'outdoor', '')


def finish(plan: Plan) -> Plan:
    """Names rooms, openings, furniture and lamps; all names are unique."""
    rooms, doors, windows, pieces, lamps = (Names() for _ in range(5))
    for storey in plan.storeys:
        storey.rooms = cut_out(storey)
        _name_rooms(storey, rooms, plan.remarks)
    for storey in plan.storeys:
        storey.openings = [_below_ceiling(opening, storey, plan)
                           for opening in _apart(storey, plan)]
        storey.openings += passages(storey)
        storey.openings = [_named_opening(
            opening, storey, windows if opening.kind == 'window' else doors)
            for opening in storey.openings]
        storey.openings = [_filled(opening, storey, plan) for opening in storey.openings]
        storey.pieces = [_named_piece(piece, storey, pieces) for piece in storey.pieces]
        storey.lamps = [_named_lamp(lamp, storey, lamps) for lamp in storey.lamps]
    if not plan.entrance:
        plan.entrances = _entrances(plan)
        plan.entrance = plan.entrances[0] if plan.entrances else ''
    return plan


def room_at(storey: Storey, point: Point) -> Room | None:
    """The smallest room around a point of a storey."""
    around = [room for room in storey.rooms if holds(room, point)]
    return min(around, key=lambda room: area(room.polygon)) if around else None


def sides(opening: Opening, storey: Storey) -> tuple[Room | None, Room | None]:
    """The rooms on the two sides of an opening: toward its -y and its +y."""
    found = []
    for edge, sign in ((opening.band[0], -1), (opening.band[1], 1)):
        room = None
        for away in (BESIDE, 2 * BESIDE, 0.02, THICK_WALL):
            room = room or room_at(storey, opening.point(0.0, edge + sign * away))
        found.append(room)
    return found[0], found[1]


def _name_rooms(storey: Storey, names: Names, remarks: list[str]) -> None:
    named = []
    for room in storey.rooms:
        things = {piece.thing for piece in storey.pieces
                  if holds(room, (piece.x, piece.y))}
        use = room.use or use_of(room.name) or use_by_things(things - {''})
        text = slug(room.name, use if use != 'other' else 'room')
        named.append((room, use, text))
    for room, use, text in named:
        made = replace(room, use=use, name=names.take(text, storey.number))
        storey.rooms[storey.rooms.index(room)] = made
        if room.name and not slug(room.name, ''):  # its letters are none that names can have
            remarks.append(f'the room "{room.name}" is called {made.name}')


def _apart(storey: Storey, plan: Plan) -> list[Opening]:
    """The openings without those that are drawn over another one; says which are in no wall."""
    found: list[Opening] = []
    for opening in storey.openings:
        what = f'the {opening.kind} "{opening.source}" at {opening.x:.2f} {opening.y:.2f}'
        if any(_is_over(opening, other) for other in found):
            plan.remarks.append(f'{what} is drawn over another one and is left out')
            continue
        if not _has_jambs(opening, storey):
            plan.remarks.append(f'{what} is in no wall')
        found.append(opening)
    return found


def _below_ceiling(opening: Opening, storey: Storey, plan: Plan) -> Opening:
    """The opening; it ends below the ceilings beside it, if its leaves would hit them."""
    ceilings = [room.floor + room.ceiling for room in sides(opening, storey)
                if room is not None and room.has_ceiling]
    ceilings += [other.elevation - other.slab for other in plan.storeys
                 if other.elevation > storey.elevation + 1.0
                 and room_at(other, (opening.x, opening.y)) is not None]
    lowest = min((z for z in ceilings if z > opening.bottom + 0.3), default=opening.top)
    if not opening.leaves or opening.top < lowest + NEAR:
        return opening
    plan.remarks.append(f'the {opening.kind} "{opening.source}" at {opening.x:.2f} '
                        f'{opening.y:.2f} is higher than the ceiling, and ends below it')
    return replace(opening, top=lowest - NEAR)


def _has_jambs(opening: Opening, storey: Storey) -> bool:
    """Whether an opening is cut into a wall, or fills the gap between walls."""
    middle = sum(opening.band) / 2
    ends = [opening.point(sign * opening.width / 2, middle) for sign in (-1, 1)]
    return any(cuts_wall(opening, wall) for wall in storey.walls) or all(
        any(_is_beside(end, wall) for wall in storey.walls) for end in ends)


def _is_beside(point: Point, wall: Wall) -> bool:
    u, v = local(wall.start, direction(wall), point)
    return -JAMB < u < wall.length + JAMB and abs(v) < wall.thickness / 2 + JAMB


def _is_over(opening: Opening, other: Opening) -> bool:
    """Whether the leaves of two openings are in one place: half of the narrower is in the other."""
    if not (opening.leaves and other.leaves):
        return False
    u, v = local((other.x, other.y), other.yaw, (opening.x, opening.y))
    narrow = min(opening.width, other.width)
    shared = (opening.width + other.width) / 2 - abs(u)
    return (shared > narrow / 2 and abs(v) < 0.1 and abs(sin(opening.yaw - other.yaw)) < 0.2
            and opening.bottom < other.top and other.bottom < opening.top)


def _filled(opening: Opening, storey: Storey, plan: Plan) -> Opening:
    """An opening is no way through if a piece of furniture, such as a drawn gate, closes it."""
    if opening.kind != 'opening':
        return opening
    half = WHOLE * opening.width / 2
    across = hole(replace(opening, width=2 * half))
    middle = sum(opening.band) / 2
    ends = [opening.point(sign * half, middle) for sign in (-1, 0, 1)]
    for piece in storey.pieces:
        outline = base(piece)
        tall = min(2.0, opening.top - opening.bottom)
        upright = piece.z < opening.bottom + 0.3 and piece.height > WHOLE * tall
        spans = overlap(across, outline) > 0 and all(
            _is_across(opening, end, outline) for end in ends)
        if upright and spans and not any(piece.tilt):
            plan.remarks.append(f'the opening {opening.name} is closed by the piece '
                                f'"{piece.source or piece.name}"')
            return replace(opening, filled=True)
    return opening


def _is_across(opening: Opening, point: Point, outline: Sequence[Point]) -> bool:
    """Whether a line through the wall at a point crosses an outline."""
    u, _ = local((opening.x, opening.y), opening.yaw, point)
    return any(contains(outline, *opening.point(u, v)) for v in np.arange(
        opening.band[0], opening.band[1] + 0.01, 0.01))


def _named_opening(opening: Opening, storey: Storey, names: Names) -> Opening:
    """Named after the room to which it leads: not a hall, if it joins one with another room."""
    if opening.name:  # a name that other programs use
        return replace(opening, name=names.take(opening.name))
    beside = [room for room in sides(opening, storey) if room is not None]
    best = sorted(beside, key=lambda room: (room.use in TO_PASS, area(room.polygon)))
    text = stem(best[0].name) if best else slug(opening.source, opening.kind)
    return replace(opening, name=names.take(text, storey.number))


def _named_piece(piece: Piece, storey: Storey, names: Names) -> Piece:
    room = room_at(storey, (piece.x, piece.y))
    what = slug(piece.name or piece.source or piece.thing, 'piece')
    text = f'{stem(room.name)}_{what}' if room is not None else what
    return replace(piece, name=names.take(text, storey.number))


def _named_lamp(lamp: Lamp, storey: Storey, names: Names) -> Lamp:
    room = room_at(storey, (lamp.x, lamp.y))
    text = stem(room.name) if room is not None else slug(lamp.name or lamp.source, 'lamp')
    return replace(lamp, name=names.take(text, storey.number))


def _entrances(plan: Plan) -> list[str]:
    """The names of leaves that may be the main entrance: doors in walls that lead to the outside,
    those that are called so first."""
    found: list[tuple[tuple[bool, bool, bool, float, int], Opening]] = []
    for storey in plan.storeys:
        outside = _outside(storey)
        for i, opening in enumerate(storey.openings):
            if (opening.kind == 'window' or opening.filled
                    or opening.bottom > storey.elevation + 0.35
                    or opening.top - opening.bottom < LOW or not _has_jambs(opening, storey)):
                continue
            beside = sides(opening, storey)
            ends = [opening.point(0.0, edge + sign * AWAY)
                    for edge, sign in zip(opening.band, (-1, 1))]
            out = any(room.use == 'outdoor' if room is not None else outside(end)
                      for room, end in zip(beside, ends))
            inside = [room for room in beside if room is not None and room.use != 'outdoor']
            if not out or not inside:
                continue
            called = bool(re.search('front|entr|main|haus', opening.source.lower()))
            hall = any(room.use in ('hall', 'landing') for room in inside)
            open_way = not opening.leaves  # also that of an elevator's shaft
            found.append(((open_way, not called, not hall, abs(storey.elevation), i), opening))
    return [sided(opening, opening.leaves[0], 0) if len(opening.leaves) > 1 else opening.name
            for _, opening in sorted(found, key=lambda entry: entry[0])]


def _outside(storey: Storey) -> Callable[[Point], bool]:
    """Whether a place is around the walls of a storey, and not enclosed, as in a cupboard."""
    raster = raster_of([corner for wall in storey.walls for corner in footprint(wall)]
                       or [(0.0, 0.0)])
    if raster is None:
        return lambda _: True
    shut = [hole(opening, JAMB, CELL) for opening in storey.openings]
    solid = filled(raster, [*(footprint(wall) for wall in storey.walls), *shut])
    grid = raster.with_cells(np.where(solid, Grid.WALL, Grid.FREE))
    grid.number_parts()
    around = at_edge(grid)

    def is_outside(point: Point) -> bool:
        cell = cell_of(grid, point)
        return cell is None or int(grid.cells[cell]) in around
    return is_outside


def beside_box(storey: Storey, middle: Point, yaw: float, half: float) -> tuple[str, str]:
    """Names of the rooms on both sides of a wall's box that runs along `yaw`."""
    found = []
    for sign in (-1, 1):
        room = room_at(storey, turned(middle, yaw, 0.0, sign * (half + BESIDE)))
        found.append(stem(room.name) if room is not None else 'outside')
    first, second = sorted(found, key=lambda name: (name == 'outside', name))
    return first, second
