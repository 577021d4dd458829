"""The scene of a world as the page reads it."""
import base64
from typing import Any

import numpy as np

from angen_tools.common.output import with_each
from angen_tools.session.messages import seven
from angen_tools.session.world import Entity


def packed(value: Any) -> Any:
    """Numbers of few digits, which JSON has in few bytes; arrays in base64, little-endian."""
    return with_each(value, _packed)


def _packed(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return base64.b64encode(value.astype(value.dtype.newbyteorder('<')).tobytes()).decode()
    return round(value, 5) if isinstance(value, float) else value


def of_entity(entity: Entity) -> dict[str, Any]:
    """A device or sensor, ready for JSON."""
    return {'kind': entity.kind, 'name': entity.name, 'model': entity.model, 'topic': entity.topic,
            'type': entity.type, 'room': entity.room, 'pose': packed(entity.pose)}


def _color(message: Any) -> list[float]:
    return [message.r, message.g, message.b, message.a]


def as_dict(scene: Any) -> dict[str, Any]:
    """A Scene message as `angen.World.scene` has it."""
    return {
        'revision': scene.revision,
        'links': [{'model': link.model, 'name': link.name, 'group': link.group,
                   'moves': bool(link.moves), 'pose': seven(link.pose)} for link in scene.links],
        'shapes': [{'type': shape.type, 'link': shape.link, 'mesh': shape.mesh,
                    'pose': seven(shape.pose), 'color': _color(shape.color),
                    'size': [shape.size.x, shape.size.y, shape.size.z]}
                   for shape in scene.shapes],
        'meshes': [{'vertices': np.array(mesh.vertices, np.float32),
                    'triangles': np.array(mesh.triangles, np.uint32)} for mesh in scene.meshes],
        'lights': [{'name': light.name, 'model': light.model, 'link': light.link,
                    'sun': bool(light.directional), 'pose': seven(light.pose),
                    'color': _color(light.color)} for light in scene.lights],
        'sensors': [{'kind': sensor.kind, 'name': sensor.name, 'link': sensor.link,
                     'pose': seven(sensor.pose), 'rays': sensor.rays,
                     'yaw': [sensor.min_yaw, sensor.max_yaw],
                     'pitch': [sensor.min_pitch, sensor.max_pitch], 'range': sensor.range}
                    for sensor in scene.sensors],
    }
