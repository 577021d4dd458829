"""Lifts: cabin, shaft doors and stops as a model with Angen's elevator plug-in."""
from __future__ import annotations

from lxml import etree

from angen_apps.plan.model import Lift, Plan
from angen_tools.world.placing import generator

STEEL = (0.7, 0.72, 0.75)
CLEAR = 2.1  # m, height of the doorway
GAP = 0.002
MASS = 1.0  # kg/kg: scales nothing, the cabin's own masses are below


def add_lift(world: etree._Element, plan: Plan, lift: Lift) -> None:
    """Appends the model of a lift, its cabin at rest at its lowest stop."""
    blocks = generator('sdf')
    heights = [next(s.elevation for s in plan.storeys if s.number == stop) for stop in lift.stops]
    root, model = blocks.new_model(lift.name)
    blocks.add_pose(model, (round(lift.x, 4), round(lift.y, 4), round(heights[0], 4)),
                    (0, 0, round(lift.yaw, 6)))
    half_x, half_y = lift.depth / 2, lift.width / 2
    top = heights[-1] - heights[0]
    roof = blocks.spanned('shaft_roof', (-half_x, -half_y, top + 2.7),
                          (half_x, half_y, top + 2.78), mass=50.0, collide=False)
    blocks.add_link(model, 'base', [roof])
    blocks.add_fixed(model, 'base_to_world', 'world', 'base')
    blocks.add_link(model, 'cabin', _cabin(half_x, half_y))
    blocks.add_joint(model, 'lift', 'prismatic', 'base', 'cabin', (0, 0, 1),
                     limits={'lower': 0, 'upper': round(max(top, 0.01), 4), 'effort': 20000,
                             'velocity': 2}, dynamics={'damping': 10, 'friction': 0})
    doorway = min(lift.width - 0.2, 1.2)
    for side, sign in (('left', 1), ('right', -1)):
        _slider(model, f'cabin_door_{side}', 'cabin', sign, doorway, half_x + 0.005, 0.0)
    for i, height in enumerate(heights):
        for side, sign in (('left', 1), ('right', -1)):
            _slider(model, f'landing_door_{i}_{side}', 'base', sign, doorway, half_x + 0.06,
                    height - heights[0])
    steps = [b - a for a, b in zip(heights, heights[1:])]
    blocks.add_plugin(model, 'elevator_controller', 'libros_plugin.so', p=200, i=200, d=25,
                      floor_height=round(sum(steps) / len(steps), 4) if steps else 3,
                      floors=len(lift.stops), max_velocity=1.0, max_acceleration=0.5)
    root.remove(model)
    world.append(model)


def _cabin(half_x: float, half_y: float) -> list[object]:
    """Floor, back, sides and roof; the front is open."""
    box = generator('sdf').spanned
    wall = 0.03
    return [
        box('floor', (-half_x, -half_y, -0.06), (half_x, half_y, 0.0), mass=40.0),
        box('back', (-half_x, -half_y, 0.0), (-half_x + wall, half_y, 2.25), mass=12.0,
            material=STEEL),
        box('side_left', (-half_x + wall, half_y - wall, 0.0), (half_x, half_y, 2.25), mass=12.0,
            material=STEEL),
        box('side_right', (-half_x + wall, -half_y, 0.0), (half_x, -half_y + wall, 2.25),
            mass=12.0, material=STEEL),
        box('roof', (-half_x, -half_y, 2.25), (half_x, half_y, 2.29), mass=14.0),
    ]


def _slider(model: etree._Element, name: str, parent: str, sign: int, doorway: float, x: float,
            height: float) -> None:
    blocks = generator('sdf')
    far = doorway / 2 + 0.02
    low, high = sorted((sign * GAP, sign * far))
    panel = blocks.spanned('panel', (x, low, 0.008), (x + 0.03, high, CLEAR + 0.03),
                           material=STEEL, mass=8.0)
    blocks.add_link(model, f'{name}_panel', [panel], at=(0, 0, round(height, 4)))
    blocks.add_joint(model, name, 'prismatic', parent, f'{name}_panel', (0, sign, 0),
                     limits={'lower': 0, 'upper': round(far, 4), 'effort': 100, 'velocity': 1},
                     dynamics={'damping': 2, 'friction': 0.5})
