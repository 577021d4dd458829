"""Sensors of a home by rules: the sensors of each room, and their heights."""
from math import atan2, hypot, pi

import numpy as np
from lxml import etree

from angen_apps.plan.travel import Obstacle
from angen_apps.plan.model import Point, Room
from angen_apps.plan.polygons import reach_of, signed_area
from angen_models.world import include
from angen_tools.common.geometry import bounds, center, contains, turned

PIR_HEIGHT = 2.2
PIR_PITCH = 0.25  # rad down
LUX_HEIGHT = 2.2
OFF_WALL = 0.12  # m of a sensor from the corner's walls
CASAS_HEIGHT = 0.02  # m under the ceiling
SIGHT = 1.0  # m that a sensor sees at least
LEAST_ROOM = 1.0  # m2: smaller rooms get one PIR


def place(world: etree._Element, room: Room, stem: str, number: str, solids: list[Obstacle],
          kind: str) -> None:
    """Appends a room's sensors. `kind`: seed or casas, as --sensors has it."""
    middle = _middle(room)
    top = room.floor + room.ceiling
    if kind == 'casas':
        include(world, 'pir_casas', f'{stem}_pir{number}',
                (*_rounded(middle), round(top - CASAS_HEIGHT, 4), 0, round(pi / 2, 6), 0))
        return
    height = min(PIR_HEIGHT, room.ceiling - 0.15)
    corners = _opposite(room, solids, room.floor + height)
    for letter, (x, y, yaw) in zip('ab', corners):
        include(world, 'pir', f'{stem}_pir{number}_{letter}',
                (*_rounded((x, y)), round(room.floor + height, 4), 0, PIR_PITCH, round(yaw, 5)))
    if corners:
        x, y, yaw = corners[-1]
        include(world, 'luminosity_sensor', f'{stem}_lux{number}',
                (*_rounded(turned((x, y), yaw, 0.25, 0.0)),
                 round(room.floor + min(LUX_HEIGHT, room.ceiling - 0.15), 4), 0, 0.5,
                 round(yaw, 5)))


def _rounded(point: Point) -> Point:
    return round(point[0], 4), round(point[1], 4)


def _middle(room: Room) -> Point:
    """A point well inside a room."""
    found = center(room.polygon)
    if contains(room.polygon, *found):
        return found
    spots = _corners(room)
    return max(spots, key=lambda spot: spot[3])[:2] if spots else room.polygon[0]


def _corners(room: Room) -> list[tuple[float, float, float, float]]:
    """x, y inside each corner, the yaw of its bisector, and how far the polygon is in sight."""
    points = list(room.polygon)
    if signed_area(points) < 0:
        points.reverse()
    found = []
    edges = np.hstack([points, np.roll(points, -1, axis=0)])
    for before, here, after in zip([points[-1], *points[:-1]], points, [*points[1:], points[0]]):
        ax, ay = before[0] - here[0], before[1] - here[1]
        bx, by = after[0] - here[0], after[1] - here[1]
        a, b = hypot(ax, ay), hypot(bx, by)
        if min(a, b) < 0.3 or bx * ay - by * ax <= 0:  # short edges, corners that stick in
            continue
        yaw = atan2(ay / a + by / b, ax / a + bx / b)
        x, y = (here[0] + OFF_WALL * (ax / a + bx / b), here[1] + OFF_WALL * (ay / a + by / b))
        if contains(points, x, y):
            found.append((x, y, yaw, reach_of(x, y, yaw, edges, 30.0)))
    return found


def _opposite(room: Room, solids: list[Obstacle], z: float
              ) -> list[tuple[float, float, float]]:
    """Two corners far apart from which the room is in sight; one if there is no second."""
    area = bounds(room.polygon)
    solids = [o for o in solids if o.bottom < z < o.top and o.is_near(area, SIGHT)]

    def is_free(x: float, y: float, yaw: float) -> bool:
        for ahead in (0.0, 0.1, 0.3, 0.6, SIGHT):
            if any(contains(o.corners, *turned((x, y), yaw, ahead, 0.0)) for o in solids):
                return False
        return True

    size = min(area[2] - area[0], area[3] - area[1])
    spots = [spot for spot in _corners(room) if spot[3] > min(SIGHT, 0.8 * size)
             and is_free(*spot[:3])]
    if len(spots) < 2:
        return [spot[:3] for spot in spots]
    pairs = [(hypot(a[0] - b[0], a[1] - b[1]), -i, -j) for i, a in enumerate(spots)
             for j, b in enumerate(spots) if i < j]
    _, i, j = max(pairs)
    return [spots[-i][:3], spots[-j][:3]]
