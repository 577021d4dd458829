"""Models under the names that the thesis has for them: each takes its parts from one of ours."""
from pathlib import Path

from angen_models import plan
from angen_models.sdf import add, new_model, write_model

VERSION = "1.9"  # SDF's version, the first with <include merge>
SHORT = {"bathroom": "bath", "bedroom": "bed", "livingroom": "living", "workroom": "work"}


def door_alias(room: str, floor: int) -> str:
    """Returns the name of a room's door on a floor, such as bath_door0."""
    return f"{SHORT.get(room, room)}_door{floor}"


def _write_alias(models: Path, name: str, stands_for: str, static: bool = False) -> None:
    root, model = new_model(name, static)
    root.set("version", VERSION)
    add(add(model, "include", merge="true"), "uri", f"model://{stands_for}")
    write_model(root, models, name.replace("_", " ").capitalize(),
                f"model://{stands_for} under the name that it has in the thesis.", VERSION)


def write_aliases(models: Path) -> None:
    """Writes models/apartment_floor0, bath_door0, my_elevator and so on."""
    for floor in range(plan.FLOORS):
        _write_alias(models, f"apartment_floor{floor}", "apartment", static=True)
        for room in plan.ROOMS:
            _write_alias(models, door_alias(room, floor), f"{room}_door")
    _write_alias(models, "my_elevator", "elevator")
