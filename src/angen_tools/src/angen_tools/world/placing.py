"""Poses of sensors in the apartments: the source's own places first, then a lattice in each room.

Meters and radians. Each room has a stream of random numbers for each kind of sensor, so that the
sensors of one kind move none of another, and more sensors move none that exist already.
"""
from dataclasses import dataclass
from functools import cache
from itertools import islice, zip_longest
from math import atan2, hypot, pi
from random import Random
from typing import Iterator

from angen_models import plan, world
from angen_models.furniture import pieces
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import bounds, to_segment, turned

KINDS = ('pir', 'switch', 'luminosity', 'contact')
LATTICE = 0.25  # between sensors of one kind in a room
WALL_GAP = 0.2
LAMP_GAP = 0.3
SWITCH_HEIGHT = 2.2
CHAIR_LATTICE = 0.55
CHAIR_REACH = 0.31  # half a chair's diagonal, and a little air
DOOR_REACH = 1.12  # reach of a leaf that swings, from the middle of its opening
PERSON_REACH = 0.4
ROBOT_REACH = 0.25
Pose = tuple[float, float, float, float, float, float]
Spot = tuple[str, str, Pose]  # model, ending of the name or whole name, pose
PIECES = pieces()


@dataclass(frozen=True)
class Placement:
    """A block of worlds/models that holds one sensor; the sensor has the block's name."""
    kind: str
    model: str
    name: str
    pose: Pose


def placements(kind: str, count: int, floors: int, seed: int, elevator: bool = False
               ) -> list[Placement]:
    """The first `count` sensors of a kind; Failure if there is no room for them.

    Sensors are added room by room: first at the places where the building has them, then, again
    room by room, at free places.
    """
    found = list(islice(_all(kind, floors, seed, elevator), count))
    if len(found) < count:
        room = 'a floor has room for' if floors == 1 else f'{floors} floors have room for'
        raise Failure(f'{room} {len(found)} {kind} sensors, not {count}; give more --floors')
    return found


def floors_for(kind: str, count: int, least: int) -> int:
    """The number of floors, at least `least`, that `count` sensors of a kind need."""
    floors = least
    while sum(1 for _ in islice(_all(kind, floors, 0, False), count)) < count:
        floors += 1
    return floors


def _all(kind: str, floors: int, seed: int, elevator: bool) -> Iterator[Placement]:
    rooms = [(room, floor) for floor in range(floors) for room in plan.ROOMS]
    if kind == 'contact' and elevator:
        x, y = plan.ELEVATOR
        yield Placement(kind, 'elevator', 'elevator', (x, y, 0.0, 0.0, 0.0, 0.0))
    for of_plan in (True, False):
        lists = [_spots(kind, room, floor, seed, of_plan) for room, floor in rooms]
        for turn in zip_longest(*lists):
            yield from (placement for placement in turn if placement is not None)


def _spots(kind: str, room: str, floor: int, seed: int, of_plan: bool) -> list[Placement]:
    if of_plan:
        spots = _planned(kind, room, floor)
    else:
        rng = Random(f'{seed} {kind} {room} {floor}')
        spots = (_free_chairs if kind == 'contact' else _lattice)(kind, room, floor, rng)
    return [Placement(kind, model, name, pose) for model, name, pose in spots]


def _planned(kind: str, room: str, floor: int) -> list[Spot]:
    z = floor * plan.STOREY
    if kind == 'switch':
        return [('optical_switch', f'{room}_switch{floor}', world.switch_pose(room, floor))]
    if kind == 'pir':
        return [('pir', f'{room}_pir{floor}_{suffix}',
                 (x, y, z + plan.PIR_HEIGHT, 0.0, plan.PIR_PITCH, yaw))
                for suffix, (x, y, yaw) in zip('ab', plan.PIRS[room])]
    if kind == 'luminosity':
        x, y, yaw = plan.LUX[room]
        return [('luminosity_sensor', f'{room}_lux{floor}',
                 (x, y, z + plan.LUX_HEIGHT, 0.0, plan.LUX_PITCH, yaw))]
    return [piece for piece in world.furniture_in(room, floor) if has_contact(piece[0])]


def has_contact(model: str) -> bool:
    """Whether a piece of furniture holds a contact sensor."""
    return bool(PIECES[model].touch)


def _points(room: str, step: float, gap: float) -> list[tuple[float, float]]:
    """A lattice over a room, `gap` off its walls' faces."""
    x0, y0, x1, y1 = plan.ROOMS[room]
    gap += plan.WALL / 2
    columns, rows = (int((b - a - 2 * gap) / step + 1e-9) + 1 for a, b in ((x0, x1), (y0, y1)))
    return [(round(x0 + gap + step * i, 4), round(y0 + gap + step * k, 4))
            for i in range(columns) for k in range(rows)]


def _lattice(kind: str, room: str, floor: int, rng: Random) -> list[Spot]:
    """Sensors under the ceiling that face the middle of the room, more or less."""
    model, short, height, pitch = {
        'pir': ('pir', 'pir', plan.PIR_HEIGHT, plan.PIR_PITCH),
        'switch': ('optical_switch', 'switch', SWITCH_HEIGHT, 0.0),
        'luminosity': ('luminosity_sensor', 'lux', plan.LUX_HEIGHT, plan.LUX_PITCH),
    }[kind]
    taken = [pose[:2] for _, _, pose in _planned(kind, room, 0)]
    lamp = plan.LAMPS[room]
    points = [(x, y) for x, y in _points(room, LATTICE, WALL_GAP)
              if hypot(x - lamp[0], y - lamp[1]) > LAMP_GAP
              and all(hypot(x - u, y - v) > LATTICE / 2 for u, v in taken)]
    rng.shuffle(points)
    x0, y0, x1, y1 = plan.ROOMS[room]
    spots = []
    for i, (x, y) in enumerate(points):
        yaw = atan2((y0 + y1) / 2 - y, (x0 + x1) / 2 - x) + rng.uniform(-0.4, 0.4)
        pose = (x, y, height + floor * plan.STOREY, 0.0, pitch, round(yaw, 4))
        spots.append((model, f'{room}_{short}{floor}_{i + 1}', pose))
    return spots


def _free_chairs(_kind: str, room: str, floor: int, rng: Random) -> list[Spot]:
    """Chairs that are free of furniture, of doors that swing and of movers."""
    points = list(_free_points(room, floor == 0))
    rng.shuffle(points)
    return [('chair', f'{room}_seat{floor}_{i + 1}',
             (x, y, floor * plan.STOREY + 0.001, 0.0, 0.0, round(rng.randrange(4) * pi / 2, 4)))
            for i, (x, y) in enumerate(points)]


@cache
def _free_points(room: str, ground_floor: bool) -> list[tuple[float, float]]:
    boxes = [_footprint(*piece) for piece in world.furniture_in(room, 0)]
    doors = [turned((x, y), yaw, 0.5, 0.0) for x, y, yaw in plan.DOORS.values()]
    way = list(zip(plan.WALK, plan.WALK[1:])) if ground_floor else []
    x, y, radius = plan.ROUND
    middle, reach = (x, y + radius), radius + ROBOT_REACH + CHAIR_REACH if ground_floor else 0.0
    return [point for point in _points(room, CHAIR_LATTICE, CHAIR_REACH)
            if all(_outside(point, box) > CHAIR_REACH for box in boxes)
            and all(hypot(point[0] - x, point[1] - y) > DOOR_REACH + CHAIR_REACH for x, y in doors)
            and all(to_segment(point, a, b) > PERSON_REACH + CHAIR_REACH for a, b in way)
            and hypot(point[0] - middle[0], point[1] - middle[1]) > reach]


def _footprint(model: str, _name: str, pose: Pose) -> tuple[float, float, float, float]:
    """x0, y0, x1, y1 of a piece of furniture along the walls."""
    parts = PIECES[model].parts
    corners = []
    for part in parts:
        half = [v / 2 for v in part.size] if len(part.size) == 3 else [part.size[0]] * 2
        for sx, sy in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
            corners.append(turned(pose[:2], pose[5], part.at[0] + sx * half[0],
                                  part.at[1] + sy * half[1]))
    return bounds(corners)


def _outside(point: tuple[float, float], box: tuple[float, float, float, float]) -> float:
    """The distance of a point from a box, 0 inside."""
    return hypot(max(box[0] - point[0], 0.0, point[0] - box[2]),
                 max(box[1] - point[1], 0.0, point[1] - box[3]))
