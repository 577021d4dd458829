"""Furniture by rules: each piece with its back to a wall, nothing in a door's swing, ways free."""
from __future__ import annotations

from dataclasses import replace
from math import cos, pi, sin
from random import Random

import numpy as np
from scipy.ndimage import distance_transform_edt, label

from angen_apps.plan.finish import room_at, stem
from angen_apps.plan.model import Opening, Piece, Room, Storey
from angen_apps.plan.names import Names
from angen_apps.plan.polygons import bounds, overlap, rectangle

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
ROOMS = {'bedroom': ('bed', 'wardrobe', 'nightstand', 'desk'),
         'living': ('sofa', 'tv', 'bookshelf', 'armchair', 'table'),
         'kitchen': ('stove', 'sink', 'fridge', 'table', 'cabinet'),
         'bathroom': ('toilet', 'sink', 'shower', 'washing_machine'),
         'work': ('desk', 'bookshelf', 'armchair'), 'hall': ()}
GAP = 0.02  # m to the wall
FRONT = 0.65  # m before a piece that stay free
BODY = 0.27  # m: a person's half width and a margin; the robot is narrower
CELL = 0.05
TRIES = 60


def furnish(storey: Storey, dice: Random) -> None:
    """Places the pieces of each room; a piece without room is left out."""
    names = Names()
    swings = [_kept_free(opening) for opening in storey.openings]
    for room in storey.rooms:
        doors = [o for o in storey.openings if o.kind != 'window'
                 and any(room_at(storey, o.point(0.0, side)) is room
                         for side in (o.band[0] - 0.1, o.band[1] + 0.1))]
        placed: list[Piece] = []
        for thing in ROOMS.get(room.use, ()):
            for _ in range(TRIES):
                piece = _at_a_wall(room, thing, dice)
                if piece is not None and _fits(piece, placed, swings) \
                        and _ways_are_free(room, [*placed, piece], doors):
                    placed.append(piece)
                    break
        for piece in placed:
            name = names.take(f'{stem(room.name)}_{piece.thing}', storey.number)
            storey.pieces.append(replace(piece, name=name))


def _kept_free(opening: Opening) -> list[tuple[float, float]]:
    """A rectangle on both sides of an opening that stays free."""
    reach = opening.width + 0.1 if opening.kind != 'window' else opening.width + 0.05
    return rectangle(opening.x, opening.y, opening.yaw,
                     (-opening.width / 2 - 0.1, opening.band[0] - reach),
                     (opening.width / 2 + 0.1, opening.band[1] + reach))


def _at_a_wall(room: Room, thing: str, dice: Random) -> Piece | None:
    model, wide, deep, high = PIECES[thing]
    west, south, east, north = bounds(room.polygon)
    side = dice.randrange(4)
    along = (east - west) if side % 2 == 0 else (north - south)
    if along < wide + 2 * GAP:
        return None
    at = dice.choice((wide / 2 + GAP, along - wide / 2 - GAP,
                      dice.uniform(wide / 2 + GAP, along - wide / 2 - GAP)))
    away = deep / 2 + GAP
    x, y, yaw = ((west + at, south + away, pi / 2), (east - away, south + at, pi),
                 (west + at, north - away, -pi / 2), (west + away, south + at, 0.0))[side]
    return Piece('', round(x, 3), round(y, 3), room.floor, yaw, wide, deep, high, thing, model,
                 'tray' if thing == 'shower' else 'box', source=thing)


def _outline(piece: Piece, front: float = 0.0) -> list[tuple[float, float]]:
    return rectangle(piece.x, piece.y, piece.yaw, (-piece.depth / 2, -piece.width / 2),
                     (piece.depth / 2 + front, piece.width / 2))


def _fits(piece: Piece, placed: list[Piece], swings: list[list[tuple[float, float]]]) -> bool:
    if any(overlap(_outline(piece), swing) > 0 for swing in swings):
        return False
    return not any(overlap(_outline(piece, FRONT), _outline(other)) > -0.03
                   or overlap(_outline(piece), _outline(other, FRONT)) > -0.03
                   for other in placed)


def _ways_are_free(room: Room, pieces: list[Piece], doors: list[Opening]) -> bool:
    """Whether a person gets from each door to the front of each piece."""
    west, south, east, north = bounds(room.polygon)
    x = np.arange(west + CELL / 2, east, CELL)
    y = np.arange(south + CELL / 2, north, CELL)
    free = np.ones((len(y), len(x)), bool)
    for piece in pieces:
        c, s = cos(piece.yaw), sin(piece.yaw)
        dx, dy = x[None] - piece.x, y[:, None] - piece.y
        free &= ~((np.abs(dx * c + dy * s) < piece.depth / 2)
                  & (np.abs(dy * c - dx * s) < piece.width / 2))
    padded = np.pad(free, 1)
    labels, _ = label(distance_transform_edt(padded)[1:-1, 1:-1] * CELL > BODY)
    goals = [(d.x, d.y) for d in doors] + [
        (p.x + (p.depth / 2 + 0.35) * cos(p.yaw), p.y + (p.depth / 2 + 0.35) * sin(p.yaw))
        for p in pieces]
    found = set()
    for gx, gy in goals:
        near = np.hypot(x[None] - gx, y[:, None] - gy) + 1e6 * (labels == 0)
        if near.min() > 0.75:
            return False
        found.add(int(labels.flat[int(near.argmin())]))
    return len(found) <= 1
