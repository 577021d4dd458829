"""The small sensors of the catalog, and their surroundings."""
from math import pi
from pathlib import Path

from lxml import etree

from angen_models.devices import add_ray, add_sensor, write_static
from angen_models.sdf import (Color, Part, add, add_fixed, add_home, add_joint, add_link,
                              add_plugin, add_pose, add_thing, new_model, numbers, spanned,
                              write_model)

GREY: Color = (0.35, 0.36, 0.38)
STEEL: Color = (0.75, 0.75, 0.78)
REED_GAP = 0.012        # from the reed to the magnet where a leaf is shut
WINDOW = (1.0, 1.2)     # width and height of its opening


def write_catalog(models: Path) -> None:
    """Writes every model of this module under models."""
    write_proximity(models)
    write_pressure_mat(models)
    write_window(models)
    write_wall_cabinet(models)
    write_smart_plug(models)
    write_daylight(models)
    _write_on_walls(models)


def _write_on_walls(models: Path) -> None:
    """Writes what hangs on a wall or lies flat; x into the room, or up."""
    write_static(models, "rfid_reader", "RFID reader",
                 "Reads tags that it sees within 2 m and 120 degrees.", "reader",
                 [spanned("antenna", (-0.04, -0.12, -0.12), (-0.005, 0.12, 0.12), collide=False)],
                 "librfid_reader.so", sensor=("rfid", 10), max_range=2.0)
    write_static(models, "rfid_tag", "RFID tag",
                 "A card that an RFID reader reads by its model's name.", "card",
                 [spanned("card", (-0.043, -0.027, 0.0), (0.043, 0.027, 0.001),
                          material=(0.2, 0.55, 0.75), collide=False)], "librfid_tag.so", "tag")
    write_static(models, "heater", "Heater",
                 "An electric convector of 1 kW, off at the start.", "heater", [
                     spanned("body", (0.02, -0.3, 0.1), (0.12, 0.3, 0.5)),
                     spanned("grille", (0.03, -0.28, 0.5), (0.11, 0.28, 0.505), material=GREY,
                             collide=False),
                     spanned("foot_left", (0.0, 0.2, 0.0), (0.16, 0.24, 0.1), material=GREY),
                     spanned("foot_right", (0.0, -0.24, 0.0), (0.16, -0.2, 0.1), material=GREY)],
                 "libheater.so", thing="heater", power=1000)
    # a button, and its chime 0.8 m above it
    write_static(models, "doorbell", "Doorbell",
                 "A button and its chime, which microphones hear.", "doorbell", [
                     spanned("plate", (0.0, -0.03, -0.05), (0.012, 0.03, 0.05), material=STEEL,
                             collide=False),
                     Part("button", (0.012, 0.006), (0.015, 0, 0), (0, pi / 2, 0), collide=False),
                     spanned("chime", (0.0, -0.07, 0.75), (0.04, 0.07, 0.85), collide=False)],
                 "libdoorbell.so", position="0.04 0 0.8")
    write_static(models, "barometer", "Barometer",
                 "The pressure of the air at its height, with the noise of a BMP280.", "box",
                 [spanned("box", (0.0, -0.02, -0.02), (0.015, 0.02, 0.02), collide=False)],
                 "libbarometer.so", sensor=("barometer", 1), noise_stddev=1.3)
    write_static(models, "warm_surface", "Warm surface",
                 "A panel of 0.6 x 0.6 m whose temperature is commanded.", "panel",
                 [spanned("panel", (0.0, -0.3, -0.3), (0.02, 0.3, 0.3), same=True)],
                 "libwarm_surface.so")
    for kind in ("temperature", "humidity"):
        write_static(models, f"{kind}_sensor", f"{kind.capitalize()} sensor",
                     f"The {kind} of the air in its room, 1 Hz.", "sensor",
                     [spanned("housing", (-0.02, -0.03, -0.03), (-0.002, 0.03, 0.03),
                              collide=False)], f"lib{kind}_sensor.so", sensor=(kind, 1))


def write_proximity(models: Path) -> None:
    """Writes models/proximity: an ultrasonic ranger whose two eyes look along x."""
    root, model = new_model("proximity", static=True)
    eyes = [Part(f"eye_{side}", (0.008, 0.012), (-0.006, y, 0), (0, pi / 2, 0), material=STEEL,
                 collide=False) for side, y in (("left", 0.013), ("right", -0.013))]
    board = spanned("board", (-0.02, -0.023, -0.01), (-0.012, 0.023, 0.01),
                    material=(0.1, 0.25, 0.5), collide=False)
    link = add_link(model, "sensor", [board, *eyes], moves=False)
    sensor = add_sensor(link, "proximity", "ray", 10)
    add(sensor, "visualize", "true")
    add_ray(sensor, (5, 0.13), (5, 0.13), (0.02, 4.0), 0.002)
    add_plugin(sensor, "proximity", "libgazebo_ros_range.so", radiation="ultrasound")
    write_model(root, models, "Proximity sensor",
                "The nearest thing within 15 degrees, 0.02 to 4 m, 10 Hz, looking along x. "
                "Served by libgazebo_ros_range.so.")


def write_pressure_mat(models: Path) -> None:
    """Writes models/pressure_mat: 0.9 x 0.6 m, 5 mm high, origin at its middle on the floor."""
    root, model = new_model("pressure_mat", static=True)
    mat = spanned("mat", (-0.45, -0.3, 0.0), (0.45, 0.3, 0.005), material=GREY)
    link = add_link(model, "mat", [mat], moves=False)
    sensor = add_sensor(link, "pressure", "contact", 1)
    add(add(sensor, "contact"), "collision", "mat_collision")
    add_plugin(sensor, "pressure_mat", "libpressure_mat.so", threshold=10)
    write_model(root, models, "Pressure mat",
                "A mat of 0.9 x 0.6 m that fires above 10 kg. Served by libpressure_mat.so.")


def add_reed(base: etree._Element, place: tuple[float, float, float], leaf: str,
             magnet: tuple[float, float, float]) -> None:
    """Appends a reed contact at a place of the base, and its magnet on a leaf."""
    sensor = add_sensor(base, "reed", "custom", 1)
    add_pose(sensor, place)
    add_plugin(sensor, "reed", "libreed_contact.so", magnet_link=leaf, magnet=numbers(*magnet))


def write_window(models: Path) -> None:
    """Writes models/window: origin on the hinge at the sill, x along the shut sash.

    It fits an opening of 1.0 x 1.2 m in a wall 0.1 m thick; the sash opens towards -y.
    """
    width, height = WINDOW
    root, model = new_model("window")
    trim = {"material": (0.93, 0.93, 0.92), "mass": 0.3, "collide": False}
    frame = [
        spanned("left", (-0.05, 0.003, -0.05), (-0.005, 0.06, height + 0.05), **trim),
        spanned("right", (width - 0.005, 0.003, -0.05), (width + 0.04, 0.06, height + 0.05),
                **trim),
        spanned("sill", (-0.005, 0.003, -0.05), (width - 0.005, 0.06, -0.005), **trim),
        spanned("head", (-0.005, 0.003, height), (width - 0.005, 0.06, height + 0.05), **trim),
    ]
    sash = [
        spanned("pane", (0.0, 0.0, 0.005), (width - 0.01, 0.04, height - 0.005), mass=18.0,
                material=(0.55, 0.68, 0.8)),
        spanned("handle", (width - 0.07, -0.05, height / 2 - 0.06),
                (width - 0.045, 0.0, height / 2 + 0.06), mass=0.2, material=STEEL, collide=False),
    ]
    base = add_link(model, "base", frame)
    magnet = (width - 0.07, -0.008, height - 0.012)
    add_reed(base, (magnet[0], magnet[1], magnet[2] + REED_GAP), "pane", magnet)
    add_fixed(model, "base_to_world", "world", "base")
    add_link(model, "pane", sash)
    add_joint(model, "sash", "revolute", "base", "pane", (0, 0, 1),
              limits={"lower": -1.57, "upper": 0.001, "effort": 200, "velocity": 3},
              dynamics={"damping": 0.2, "friction": 0.1})
    add_thing(model, "window")
    write_model(root, models, "Window",
                "A hinged window for an opening of 1.0 x 1.2 m, 18 kg, with a reed contact; opens "
                "from 0 to -1.57 rad towards its -y. Served by libdoor_world_plugin.so.")


def write_wall_cabinet(models: Path) -> None:
    """Writes models/wall_cabinet: origin at its lower left corner on the wall; faces -y.

    Seen from the front the hinge is on the left; x runs along the front.
    """
    wide, deep, high, thick = 0.6, 0.3, 0.7, 0.018
    white: Color = (0.92, 0.9, 0.86)
    root, model = new_model("wall_cabinet")
    board = {"mass": 2.0, "material": white}
    case = [
        spanned("back", (0.0, -thick, 0.0), (wide, 0.0, high), **board),
        spanned("left", (0.0, -deep, 0.0), (thick, -thick, high), **board),
        spanned("right", (wide - thick, -deep, 0.0), (wide, -thick, high), **board),
        spanned("bottom", (thick, -deep, 0.0), (wide - thick, -thick, thick), **board),
        spanned("top", (thick, -deep, high - thick), (wide - thick, -thick, high), **board),
        spanned("shelf", (thick, -deep + 0.03, 0.34), (wide - thick, -thick, 0.355), **board),
    ]
    front = [
        spanned("panel", (0.0, -thick, 0.002), (wide, 0.0, high - 0.002), mass=4.0,
                material=(0.65, 0.47, 0.28)),
        spanned("knob", (wide - 0.06, -thick - 0.025, 0.1), (wide - 0.04, -thick, 0.12), mass=0.05,
                material=STEEL, collide=False),
    ]
    base = add_link(model, "base", case)
    hinge = (0.0, -deep - 0.002, 0.0)
    magnet = (wide - 0.05, 0.0, high - 0.05)     # on the back of the panel
    add_reed(base, (magnet[0], hinge[1] + REED_GAP, magnet[2]), "panel", magnet)
    add_fixed(model, "base_to_world", "world", "base")
    add_link(model, "panel", front, at=hinge)
    add_joint(model, "front", "revolute", "base", "panel", (0, 0, 1),
              limits={"lower": -1.57, "upper": 0.001, "effort": 50, "velocity": 3},
              dynamics={"damping": 0.05, "friction": 0.05})
    add_plugin(model, "cabinet_controller", "libdoor_world_plugin.so", p=20, i=20, d=4,
               brake_torque=1, latch_torque=10, edge_force_max=40)
    add_thing(model, "cabinet")
    write_model(root, models, "Wall cabinet",
                "A cabinet of 0.6 x 0.3 x 0.7 m with a hinged front and a reed contact. "
                "Served by libdoor_world_plugin.so.")


def smart_plug(name: str, load: str, **parameters: float) -> etree._Element:
    """Returns the model of a round plug on a wall, x into the room, that feeds `load`."""
    _, model = new_model(name, static=True)
    body = Part("body", (0.028, 0.06), (0.03, 0, 0), (0, pi / 2, 0), collide=False)
    button = Part("button", (0.006, 0.004), (0.061, 0, 0.012), (0, pi / 2, 0), collide=False,
                  material=(0.2, 0.7, 0.3))
    link = add_link(model, "plug", [body, button], moves=False)
    sensor = add_sensor(link, "plug", "custom", 1)
    add_plugin(sensor, "smart_plug", "libsmart_plug.so", load=load, **parameters)
    return model


def write_smart_plug(models: Path) -> None:
    """Writes models/smart_plug, without a load."""
    root = smart_plug("smart_plug", "").getparent()
    write_model(root, models, "Smart plug",
                "Reports the power and energy of the device that its <load> names. "
                "Served by libsmart_plug.so.")


def write_daylight(models: Path) -> None:
    """Writes models/daylight_window: a pane of 1.4 x 1.0 m on a wall, its back to it, x inwards."""
    root, model = new_model("daylight_window", static=True)
    pane = spanned("pane", (-0.004, -0.7, -0.5), (-0.002, 0.7, 0.5), material=(0.7, 0.85, 1.0),
                   collide=False)
    link = add_link(model, "pane", [pane], moves=False)
    light = add(link, "light", name="sky", type="point")
    add(light, "direction", "1 0 0")
    add_home(light, "rectangle", "1.4 1")
    add_plugin(model, "daylight", "libdaylight_plugin.so", area=1.4)
    add_thing(model, "window")
    write_model(root, models, "Window as a source of daylight",
                "A pane of 1.4 x 1.0 m that scatters the light of an overcast sky into the room. "
                "Served by libdaylight_plugin.so.")
