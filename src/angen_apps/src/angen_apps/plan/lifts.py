"""Lifts: cabin, shaft doors and stops as a model with Angen's elevator plug-in."""
from dataclasses import replace
from math import pi, sin
from typing import Sequence

from lxml import etree

from angen_apps.plan.model import Lift, Opening, Plan, Point, Storey, Wall
from angen_apps.plan.names import Names, slug
from angen_apps.plan.walls import cuts_wall, direction, footprint
from angen_models.sdf import (Part, add, add_fixed, add_joint, add_link, add_plugin, add_pose,
                              new_model, spanned)
from angen_tools.common.geometry import bounds, contains, local, turned

STEEL = (0.7, 0.72, 0.75)
CLEAR = 2.1  # m, height of the doorway
TOP = 2.29  # m, of the cabin
GAP = 0.002
THICK = 0.2  # m, the walls of a shaft
THIN = 1e-3  # m: ground that is narrower is left out
CEILING = 2.5  # m over a floor without walls
CABIN_SILL = 0.04  # m that the cabin's floor reaches before the cabin, under its doors
LANDING_DOOR = 0.06  # m before the cabin
BESIDE = 0.03  # m between the cabin and the walls beside it
HOLE = 0.06  # m between the cabin and the floors beside it, whose edges are in cells of 5 cm
FRONT = 0.1  # m before the cabin at which a landing's floor begins
DOORS = 0.12  # m before the cabin for its doors and those of the landings
Area = tuple[float, float, float, float]
ASKEW = 0.2  # sine of twice the angle at which a wall is not along or across a cabin


def shaft(lift: Lift) -> tuple[Point, ...]:
    """The hole in floors and ceilings for the cabin and its doors."""
    half_x, half_y = lift.depth / 2 + HOLE, lift.width / 2 + HOLE
    front = front_of(lift)
    return tuple(turned((lift.x, lift.y), lift.yaw, u, v)
                 for u, v in ((-half_x, -half_y), (front, -half_y), (front, half_y),
                              (-half_x, half_y)))


def with_shafts(plan: Plan) -> None:
    """Adds the shafts of lifts that have none yet, as of one that was drawn: where it stops, its
    doorway is in the wall before it, or in one of its own."""
    built = [any(contains(cutout, lift.x, lift.y) for storey in plan.storeys
                 for cutout in storey.cutouts) for lift in plan.lifts]
    names = Names()
    for lift, has_shaft in zip(plan.lifts, built):
        if has_shaft:
            names.take(lift.name)
    for i, lift in enumerate(plan.lifts):
        if built[i]:
            continue
        stops = sorted((storey for storey in plan.storeys if storey.number in lift.stops),
                       key=lambda storey: storey.elevation)
        plan.lifts[i] = replace(lift, name=names.take(slug(lift.name, 'elevator')),
                                stops=tuple(storey.number for storey in stops))
        at = turned((lift.x, lift.y), lift.yaw, front_of(lift) + DOORS, 0.0)
        for storey in stops:
            top = max((wall.top for wall in storey.walls), default=storey.elevation + CEILING)
            add_shaft(storey, lift, at, (lift.depth + 0.2, lift.width + 0.12), top)
            if not any(cuts_wall(storey.openings[-1], wall) for wall in storey.walls):
                v = lift.width / 2 + 0.06 + THICK / 2
                right, left = (turned(at, lift.yaw, 0.0, side) for side in (-v, v))
                storey.walls.append(Wall(right, left, THICK, storey.elevation, top))


def add_shaft(storey: Storey, lift: Lift, at: Point, inner: tuple[float, float], top: float
              ) -> None:
    """Appends doorway, walls and hole of a lift's shaft. Its doorway is in a wall at a point, its
    `inner` depth and width (m) are behind that wall."""
    z, end, side = storey.elevation, -inner[0] - 0.3, inner[1] / 2 + THICK / 2
    right, left, back_right, back_left = (turned(at, lift.yaw, u, v) for u in (0.0, end)
                                          for v in (-side, side))
    storey.openings.append(Opening('opening', *at, lift.yaw + pi / 2, 1.16, z, z + 2.12,
                                   (-THICK / 2, THICK / 2), source='shaft'))
    storey.walls += [Wall(a, b, THICK, z, top) for a, b in (
        (right, back_right), (left, back_left), (back_right, back_left))]
    storey.cutouts.append(shaft(lift))


def around_pits(plan: Plan, margin: float) -> list[Area]:
    """The ground of a plan and `margin` (m) around it, but for what is below its lifts, as
    rectangles (west, south, east, north)."""
    west, south, east, north = bounds(
        [point for storey in plan.storeys for room in storey.rooms for point in room.polygon]
        + [wall.start for storey in plan.storeys for wall in storey.walls]
        + [(lift.x, lift.y) for lift in plan.lifts])
    pits = [[round(edge, 4) for edge in bounds(shaft(lift))] for lift in plan.lifts]
    west, south, east, north = (round(edge, 4) for edge in (west, south, east, north))
    edges = sorted({west - margin, east + margin, *(x for pit in pits for x in pit[::2])})
    found: list[Area] = []
    for low, high in zip(edges, edges[1:]):
        if high - low < THIN:
            continue
        y = south - margin
        for _, bottom, _, top in sorted((pit for pit in pits if pit[0] < high and pit[2] > low),
                                        key=lambda pit: pit[1]):
            if bottom > y + THIN:
                found.append((low, y, high, bottom))
            y = max(y, top)
        found.append((low, y, high, north + margin))
    return found


def front_of(lift: Lift) -> float:
    """The distance from the cabin's middle to the floor of a landing."""
    return max(lift.front, lift.depth / 2 + FRONT)


def fitted(lift: Lift, walls: Sequence[Wall]) -> Lift:
    """The lift with its cabin shrunk to fit between the walls of its shaft."""
    half_x, half_y = lift.depth / 2, lift.width / 2
    front, back, left, right = half_x, -half_x, half_y, -half_y
    for wall in walls:
        if abs(sin(2 * (direction(wall) - lift.yaw))) > ASKEW:
            continue
        corners = [local((lift.x, lift.y), lift.yaw, corner) for corner in footprint(wall)]
        (low_u, high_u), (low_v, high_v) = ((min(c), max(c)) for c in zip(*corners))
        if low_v < half_y and high_v > -half_y:
            if low_u > half_x / 3:
                front = min(front, low_u - DOORS)
            elif high_u < -half_x / 3:
                back = max(back, high_u + BESIDE)
        if low_u < half_x and high_u > -half_x:
            if low_v > half_y / 3:
                left = min(left, low_v - BESIDE)
            elif high_v < -half_y / 3:
                right = max(right, high_v + BESIDE)
    x, y = turned((lift.x, lift.y), lift.yaw, (front + back) / 2, (left + right) / 2)
    return replace(lift, x=x, y=y, depth=front - back, width=left - right)


def add_lift(world: etree._Element, plan: Plan, lift: Lift) -> None:
    """Appends the model of a lift, its cabin at rest at its lowest stop."""
    heights = [next(s.elevation for s in plan.storeys if s.number == stop) for stop in lift.stops]
    rises = [round(height - heights[0], 4) for height in heights]
    _, model = new_model(lift.name)
    add_pose(model, (round(lift.x, 4), round(lift.y, 4), round(heights[0], 4)),
             (0, 0, round(lift.yaw, 6)))
    half_x, half_y = lift.depth / 2, lift.width / 2
    doorway = min(lift.doorway, half_y - 0.02)  # half of it on each side, and room to slide
    roof = spanned('shaft_roof', (-half_x, -half_y, rises[-1] + 2.7),
                   (half_x, half_y, rises[-1] + 2.78), mass=50.0, collide=False)
    fixed = [part for i, rise in enumerate(rises) for part in _landing(lift, i, rise, doorway)]
    add_link(model, 'base', [roof, *fixed])
    add_fixed(model, 'base_to_world', 'world', 'base')
    add_link(model, 'cabin', _cabin(half_x, half_y))
    add_joint(model, 'lift', 'prismatic', 'base', 'cabin', (0, 0, 1),
                     limits={'lower': 0, 'upper': max(rises[-1], 0.01), 'effort': 20000,
                             'velocity': 2}, dynamics={'damping': 10, 'friction': 0})
    for side, sign in (('left', 1), ('right', -1)):
        _slider(model, f'cabin_door_{side}', 'cabin', sign, doorway, half_x + 0.005, 0.0)
    for i, rise in enumerate(rises):
        for side, sign in (('left', 1), ('right', -1)):
            _slider(model, f'landing_door_{i}_{side}', 'base', sign, doorway,
                    half_x + LANDING_DOOR, rise)
    plugin = add_plugin(model, 'elevator_controller', 'libros_plugin.so', p=200, i=200,
                               d=25, max_velocity=1.0, max_acceleration=0.5)
    for rise in rises:
        add(plugin, 'stop', rise)
    world.append(model)


def _landing(lift: Lift, index: int, rise: float, doorway: float) -> list[Part]:
    """A sill up to the landing's floor, and the walls that close the shaft around the doorway."""
    half_x, half_y, front = lift.depth / 2, lift.width / 2, front_of(lift)
    face, edge = half_x + LANDING_DOOR + 0.035, doorway / 2 + 0.01
    found = [spanned(f'sill_{index}', (half_x + CABIN_SILL + 0.012, -half_y, rise - 0.06),
                     (front, half_y, rise), material=STEEL, mass=20.0)]
    for side, low, high in (('left', edge, half_y), ('right', -half_y, -edge)):
        found.append(spanned(f'jamb_{side}_{index}', (face, low, rise),
                             (face + 0.02, high, rise + TOP),
                             material=STEEL, mass=10.0))
    found.append(spanned(f'lintel_{index}', (face, -edge, rise + CLEAR),
                         (face + 0.02, edge, rise + TOP), material=STEEL, mass=5.0))
    return found


def _cabin(half_x: float, half_y: float) -> list[Part]:
    """Floor, back, sides and roof; the front is open."""
    wall = 0.03
    return [
        spanned('floor', (-half_x, -half_y, -0.06), (half_x + CABIN_SILL, half_y, 0.0),
                mass=40.0),
        spanned('back', (-half_x, -half_y, 0.0), (-half_x + wall, half_y, 2.25), mass=12.0,
                material=STEEL),
        spanned('side_left', (-half_x + wall, half_y - wall, 0.0), (half_x, half_y, 2.25),
                mass=12.0, material=STEEL),
        spanned('side_right', (-half_x + wall, -half_y, 0.0), (half_x, -half_y + wall, 2.25),
                mass=12.0, material=STEEL),
        spanned('roof', (-half_x, -half_y, 2.25), (half_x, half_y, TOP), mass=14.0),
    ]


def _slider(model: etree._Element, name: str, parent: str, sign: int, doorway: float, x: float,
            rise: float) -> None:
    far = round(doorway / 2 + 0.02, 4)
    low, high = sorted((sign * GAP, sign * far))
    panel = spanned('panel', (x, low, 0.008), (x + 0.03, high, CLEAR + 0.03),
                    material=STEEL, mass=8.0)
    add_link(model, f'{name}_panel', [panel], at=(0, 0, rise))
    add_joint(model, name, 'prismatic', parent, f'{name}_panel', (0, sign, 0),
              limits={'lower': 0, 'upper': far, 'effort': 100, 'velocity': 1},
              dynamics={'damping': 2, 'friction': 0.5})
