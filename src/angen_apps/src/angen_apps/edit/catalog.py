"""What one can put into a home: furniture, sensors, and what their fields of view are."""
from dataclasses import asdict, dataclass, replace
from math import isfinite, pi
from typing import Any

from lxml import etree

from angen_apps.plan.furnished import PIECES
from angen_apps.plan.overlays import FAR, WITH_FIELD
from angen_apps.plan.sensors import PIR_HEIGHT, PIR_PITCH
from angen_models.world import include, new_world
from angen_tools.common.catalog import angen_module

# further furniture: name: thing, model, shape, width, depth, height
MORE = {'bathtub': ('bathtub', 'bathtub', 'box', 1.7, 0.75, 0.55),
        'double wardrobe': ('wardrobe', 'wardrobe', 'box', 2.0, 0.6, 2.2),
        'single bed': ('bed', 'bed', 'box', 0.9, 2.04, 0.9),
        'dining table': ('table', 'table', 'box', 1.6, 0.9, 0.75),
        'round table': ('table', '', 'cylinder', 0.9, 0.9, 0.75),
        'dishwasher': ('dishwasher', '', 'box', 0.6, 0.6, 0.85),
        'dresser': ('cabinet', 'dresser', 'box', 1.0, 0.5, 0.8),
        'counter': ('cabinet', '', 'box', 1.2, 0.6, 0.9),
        'heater': ('', 'heater', 'box', 1.0, 0.12, 0.6),
        'plant': ('plant', '', 'cylinder', 0.4, 0.4, 1.0),
        'rug': ('', '', 'flat', 2.0, 1.4, 0.01),
        'box': ('', '', 'box', 0.5, 0.5, 0.5)}


@dataclass(frozen=True)
class Seeing:
    """A model of a sensor: its place, and the field that it sees (rad, m; 0: none)."""

    name: str
    model: str
    kind: str
    height: float  # m over the floor; 0: at the ceiling
    pitch: float = 0.0
    right: float = 0.0
    left: float = 0.0
    far: float = 0.0


SENSORS = (Seeing('motion sensor', 'pir', 'pir', PIR_HEIGHT, PIR_PITCH),
           Seeing('motion sensor at the ceiling', 'pir_casas', 'pir', 0.0, round(pi / 2, 6)),
           Seeing('light sensor', 'luminosity_sensor', 'luminosity', 2.2, 0.5),
           Seeing('camera', 'camera', 'camera', 2.3, 0.3),
           Seeing('temperature sensor', 'temperature_sensor', 'temperature', 1.5),
           Seeing('humidity sensor', 'humidity_sensor', 'humidity', 1.5),
           Seeing('microphone', 'microphone', 'microphone', 1.5),
           Seeing('light barrier', 'optical_switch', 'switch', 0.4),
           Seeing('distance sensor', 'proximity', 'proximity', 0.5))


def catalog() -> dict[str, Any]:
    """For the page; loads a world with each sensor."""
    pieces = [{'name': name.replace('_', ' '), 'thing': name, 'model': model,
               'shape': 'tray' if name == 'shower' else 'box', 'width': wide, 'depth': deep,
               'height': high} for name, (model, wide, deep, high) in PIECES.items()]
    pieces += [{'name': name, 'thing': thing, 'model': model, 'shape': shape, 'width': wide,
                'depth': deep, 'height': high}
               for name, (thing, model, shape, wide, deep, high) in MORE.items()]
    return {'pieces': pieces, 'sensors': [asdict(each) for each in _with_fields()]}


def _with_fields() -> list[Seeing]:
    root, world = new_world('sensors')
    for i, sensor in enumerate(SENSORS):
        include(world, sensor.model, sensor.model, (10 * i, 0, 2, 0, 0, 0))
    made = angen_module().World.from_text(etree.tostring(root, encoding='unicode'))
    names = {model: (kind, name) for kind, name, model, _ in made.entities()}
    found = []
    for sensor in SENSORS:
        kind, name = names.get(sensor.model, ('', ''))
        field = made.field_of_view(kind, name) if kind in WITH_FIELD else None
        if field:
            right, left, far = (float(value) for value in field)
            sensor = replace(sensor, right=round(right, 4), left=round(left, 4),
                             far=far if isfinite(far) else FAR)
        found.append(sensor)
    return found
