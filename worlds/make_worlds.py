#!/usr/bin/env python3
"""Writes models/* (all but their meshes), angen.world and empty.world by the package angen_models.

    python3 worlds/make_worlds.py                 write everything
    python3 worlds/make_worlds.py --list-doors    where to spawn the six doors of a floor
"""
import argparse
from pathlib import Path

from angen_models import (aliases, appliances, building, catalog, devices, elevator, furniture,
                          openers, plan, things, world)
from angen_models.care import write_days
from angen_models.sdf import numbers

HERE = Path(__file__).resolve().parent


def write_all(folder: Path) -> None:
    """Writes every model and both worlds under folder."""
    models = folder / "models"
    building.write_apartment(models)
    for room in plan.ROOMS:
        building.write_door(models, room)
    elevator.write_elevator(models)
    devices.write_lamp(models)
    devices.write_pir(models, "pir", nods=False)
    devices.write_pir(models, "pir_nodding", nods=True)
    devices.write_pyroelectric(models)
    devices.write_switch(models)
    devices.write_luminosity(models)
    devices.write_camera(models)
    devices.write_sitter(models)
    devices.write_turtlebot(models)
    catalog.write_catalog(models)
    openers.write_openers(models)
    appliances.write_appliances(models)
    things.write_things(models)
    for name, piece in furniture.pieces().items():
        furniture.write_piece(models, name, piece)
    aliases.write_aliases(models)
    world.write_angen(folder)
    world.write_empty(folder)
    write_days(folder / "care")


def main() -> None:
    """Writes the worlds, or lists the doors' poses on a floor."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0],
                                     epilog="example: python3 worlds/make_worlds.py --list-doors")
    parser.add_argument("--folder", type=Path, default=HERE, help="where to write (worlds/)")
    parser.add_argument("--list-doors", action="store_true",
                        help="print model and pose (x y z roll pitch yaw) of each door, and end")
    parser.add_argument("--floor", type=int, default=0, help="the floor to list (0)")
    options = parser.parse_args()
    if options.list_doors:
        for room in plan.ROOMS:
            pose = numbers(*world.door_pose(room, options.floor))
            print(f"model://{room}_door {room}_door{options.floor} \"{pose}\"")
        return
    write_all(options.folder)


if __name__ == "__main__":
    main()
