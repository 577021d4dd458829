"""Things that are used: a cup, a table with load cells, the soil of a plant, an RFID gate."""
from pathlib import Path

from lxml import etree

from angen_models.catalog import STEEL
from angen_models.devices import add_sensor, write_static
from angen_models.furniture import OAK, legs
from angen_models.sdf import (Color, Part, add, add_link, add_plugin, add_pose, add_thing,
                              new_model, numbers, spanned, write_model)

STONEWARE: Color = (0.82, 0.3, 0.2)
FEET = ("leg_front_left", "leg_front_right", "leg_back_left", "leg_back_right")
TABLE_MASS = 6.0        # kg
CELL_NOISE = 0.005      # kg: 0.01 % of a cell of 50 kg
ADXL345_NOISE = 0.029   # m/s2: 0.75 LSB of 3.9 mg


def write_things(models: Path) -> None:
    """Writes every model of this module under models."""
    write_cup(models)
    write_weighing_table(models)
    # a long-range antenna that looks along x
    write_static(models, "rfid_gate", "RFID gate",
                 "A long-range reader for a doorway: tags that it sees within 5 m and 120 degrees.",
                 "reader",
                 [spanned("antenna", (-0.04, -0.15, -0.15), (-0.005, 0.15, 0.15), collide=False)],
                 "librfid_reader.so", sensor=("rfid", 10), max_range=5.0)


def write_cup(models: Path) -> None:
    """Writes models/cup: origin at its foot; it pours over its lip towards x."""
    root, model = new_model("cup")
    handle = [spanned(name, low, high, material=STONEWARE, collide=False) for name, low, high in (
        ("handle", (-0.066, -0.006, 0.02), (-0.058, 0.006, 0.075)),
        ("handle_low", (-0.06, -0.006, 0.02), (-0.04, 0.006, 0.03)),
        ("handle_high", (-0.06, -0.006, 0.065), (-0.04, 0.006, 0.075)))]
    cup = Part("cup", (0.041, 0.093), (0, 0, 0.0465), material=STONEWARE, mass=0.35)
    inside = Part("inside", (0.037, 0.001), (0, 0, 0.0935), material=(0.2, 0.1, 0.05),
                  collide=False)
    body = add_link(model, "body", [cup, inside, *handle])
    sensor = add_sensor(body, "accelerometer", "imu", 10)
    add_pose(sensor, (0, 0, 0.004))
    add_plugin(sensor, "accelerometer", "libaccelerometer.so", link="body",
               noise_stddev=ADXL345_NOISE)
    add_plugin(model, "cup", "libcup.so", radius=0.037, height=0.085, floor=0.008)
    write_model(root, models, "Cup",
                "A stoneware cup of 0.35 kg that holds 365 ml, with an accelerometer in its "
                "bottom. Served by libcup.so.")


def write_weighing_table(models: Path) -> None:
    """Writes models/weighing_table: 0.45 x 0.45 x 0.5 m on four load cells."""
    root, model = new_model("weighing_table")
    top = spanned("top", (-0.225, -0.225, 0.47), (0.225, 0.225, 0.5), mass=TABLE_MASS * 0.8,
                  material=OAK)
    body = add_link(model, "body", [top, *legs(0.215, 0.215, 0.04, 0.47, TABLE_MASS * 0.05, STEEL)])
    sensor = add_sensor(body, "cells", "contact", 10)
    contact = add(sensor, "contact")
    for foot in FEET:
        add(contact, "collision", f"{foot}_collision")
    add_plugin(sensor, "load_cells", "libload_cells.so", tare=TABLE_MASS, noise_stddev=CELL_NOISE)
    add_thing(model, "table")
    write_model(root, models, "Weighing table",
                "A side table of 6 kg on four load cells: the weight of the things on it, and "
                "where. Served by libload_cells.so.")


def add_tag(block: etree._Element, place: tuple[float, float, float]) -> None:
    """Fastens an RFID tag to an <include> or an <actor>, at a place in its frame."""
    add_plugin(block, "tag", "librfid_tag.so", position=numbers(*place))
