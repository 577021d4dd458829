"""The elevator: cabin, cabin doors and the landing doors that guard the shaft."""
from pathlib import Path

from lxml import etree

from angen_models import plan
from angen_models.devices import add_sensor
from angen_models.sdf import (Part, Vector, add, add_fixed, add_joint, add_link, add_plugin,
                              new_model, spanned, write_model)

STEEL = (0.7, 0.72, 0.75)
HALF = 0.83             # half the cabin's outer width and depth
FRONT = 0.835           # the sill: 15 mm from the landing's edge at 0.85
CLEAR_HEIGHT = 2.25
STROKE = 0.52           # each door's travel; the doorway is 1.0 m wide
FLOORS = 2


def cabin_collisions() -> list[Part]:
    """Returns the cabin's boxes, about 84 kg: back open, front open between the two returns."""
    inner, back, face = HALF - 0.03, -HALF, 0.785

    def box(name: str, low: Vector, high: Vector, mass: float) -> Part:
        return spanned(name, low, high, mass=mass, show=False)

    return [
        box("floor", (back, -HALF, -0.06), (FRONT, HALF, 0.0), 34.0),
        box("side_left", (back, inner, 0.0), (face, HALF, CLEAR_HEIGHT), 12.0),
        box("side_right", (back, -HALF, 0.0), (face, -inner, CLEAR_HEIGHT), 12.0),
        box("roof", (back, -HALF, CLEAR_HEIGHT), (face, HALF, CLEAR_HEIGHT + 0.04), 14.0),
        box("return_left", (face - 0.03, 0.5, 0.0), (face, inner, CLEAR_HEIGHT), 4.0),
        box("return_right", (face - 0.03, -inner, 0.0), (face, -0.5, CLEAR_HEIGHT), 4.0),
        box("header", (face - 0.03, -0.5, 2.1), (face, 0.5, CLEAR_HEIGHT), 2.0),
        box("kickboard", (back, -inner, 0.0), (back + 0.02, inner, 0.1), 2.0),
    ]


def _panel(sign: int, x0: float, x1: float) -> list[Part]:
    """Returns a sliding panel on the +y (sign 1) or -y side, shut."""
    near, far = sign * 0.002, sign * STROKE
    return [spanned("panel", (x0, min(near, far), 0.008), (x1, max(near, far), 2.13),
                    material=STEEL, mass=8.0)]


def _add_slider(model: etree._Element, name: str, parent: str, sign: int, parts: list[Part],
                height: float) -> None:
    add_link(model, f"{name}_panel", parts, at=(0, 0, height))
    add_joint(model, name, "prismatic", parent, f"{name}_panel", (0, sign, 0),
              limits={"lower": 0, "upper": STROKE, "effort": 100, "velocity": 1},
              dynamics={"damping": 2, "friction": 0.5})


def _base_parts() -> list[Part]:
    """Returns the fixed parts: two guide rails (looks) and the shaft's roof, clear of walls."""
    top = plan.CABIN_TRAVEL * (FLOORS - 1) + 3.7
    rails = [spanned(f"rail_{side}", (-0.05, y - 0.03, -0.15), (0.05, y + 0.03, top),
                     material=(0.3, 0.3, 0.32), mass=20.0, collide=False)
             for side, y in (("left", 0.95), ("right", -0.95))]
    roof = spanned("shaft_roof", (-0.845, -1.095, top), (0.895, 1.095, top + 0.08), mass=50.0)
    return rails + [roof]


def write_elevator(models: Path) -> None:
    """Writes models/elevator: origin at the cabin's middle on floor 0, doors towards +x."""
    root, model = new_model("elevator")
    add_link(model, "base", _base_parts())
    add_fixed(model, "base_to_world", "world", "base")

    looks = Part("cabin", mesh="model://elevator/meshes/cabin.dae", material=None)
    cabin = add_link(model, "cabin", cabin_collisions() + [looks])
    sensor = add_sensor(cabin, "floor_contact", "contact", 1)
    add(add(sensor, "contact"), "collision", "floor_collision")
    add_plugin(sensor, "bumper", "libgazebo_ros_bumper.so", noise_stddev=0.5)
    add_joint(model, "lift", "prismatic", "base", "cabin", (0, 0, 1),
              limits={"lower": 0, "upper": plan.CABIN_TRAVEL * (FLOORS - 1), "effort": 10000,
                      "velocity": 2},
              dynamics={"damping": 10, "friction": 0})

    for side, sign in (("left", 1), ("right", -1)):
        _add_slider(model, f"cabin_door_{side}", "cabin", sign, _panel(sign, 0.795, 0.825), 0.0)
    for floor in range(FLOORS):
        for side, sign in (("left", 1), ("right", -1)):
            _add_slider(model, f"landing_door_{floor}_{side}", "base", sign,
                        _panel(sign, 0.86, 0.89), floor * plan.STOREY)

    add_plugin(model, "elevator_controller", "libros_plugin.so", p=200, i=200, d=25,
               floor_height=plan.STOREY, floors=FLOORS, max_velocity=1.0, max_acceleration=0.5)
    write_model(root, models, "Elevator",
                "Cabin of 100 kg between two floors 4 m apart, with cabin and landing doors. "
                "Served by libros_plugin.so.")
