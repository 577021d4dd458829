"""Rooms with walls around them that are drawn within another room: holes in that one."""
from dataclasses import replace
from math import ceil, cos, hypot, sin
from typing import Sequence

import numpy as np

from angen_apps.plan.model import Point, Room, Storey
from angen_apps.plan.polygons import area, inside
from angen_apps.plan.walls import direction
from angen_tools.common.geometry import bounds, contains, edges

STEP = 0.1  # m between the places of an edge that are tried
AT_WALL = 0.1  # m from a wall's face
WALLED = 0.8  # share of the edges of a room that walls, doors and windows enclose
SMALLER = 0.9  # share of the area of the room around it
LEVEL = 0.3  # m between floors of one level


def holds(room: Room, point: Point) -> bool:
    """Whether a place is in a room and not in a hole of it."""
    return contains(room.polygon, *point, room.holes)


def cut_out(storey: Storey) -> list[Room]:
    """The rooms of a storey; those around others have holes for these."""
    found = []
    for room in storey.rooms:
        within = [other for other in storey.rooms if _is_within(other, room)
                  and _is_walled(other, storey)]
        outermost = [one for one in within
                     if not any(_is_within(one, other) for other in within)]
        found.append(replace(room, holes=(*room.holes, *(one.polygon for one in outermost))))
    return found


def _is_within(room: Room, other: Room) -> bool:
    west, south, east, north = bounds(room.polygon)
    x0, y0, x1, y1 = bounds(other.polygon)
    if (west < x0 or south < y0 or east > x1 or north > y1 or abs(room.floor - other.floor) > LEVEL
            or area(room.polygon) > SMALLER * area(other.polygon)):
        return False
    return bool(inside(other.polygon, *_edge_places(room.polygon), other.holes).all())


def _edge_places(polygon: Sequence[Point]) -> tuple[np.ndarray, np.ndarray]:
    places = []
    for (ax, ay), (bx, by) in edges(polygon):
        count = ceil(hypot(bx - ax, by - ay) / STEP)
        places += [(ax + (bx - ax) * (i + 0.5) / count, ay + (by - ay) * (i + 0.5) / count)
                   for i in range(count)]
    x, y = np.array(places).T
    return x, y


def _is_walled(room: Room, storey: Storey) -> bool:
    x, y = _edge_places(room.polygon)
    walled = np.zeros(len(x), bool)
    for wall in storey.walls:
        yaw, dx, dy = direction(wall), x - wall.start[0], y - wall.start[1]
        along, away = dx * cos(yaw) + dy * sin(yaw), np.abs(dy * cos(yaw) - dx * sin(yaw))
        walled |= ((along > -AT_WALL) & (along < wall.length + AT_WALL)
                   & (away < wall.thickness / 2 + AT_WALL))
    return bool(walled.mean() >= WALLED)
