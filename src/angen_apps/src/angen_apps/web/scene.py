"""angen_msgs/Scene as the page reads it."""
from __future__ import annotations

import base64
from typing import Any

import numpy as np


def rounded(values: Any, digits: int = 4) -> list[float]:
    """Numbers of few digits, which JSON has in few bytes."""
    return [round(float(value), digits) for value in values]


def pose(message: Any) -> list[float]:
    """x y z qx qy qz qw."""
    at, turn = message.position, message.orientation
    return rounded((at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w), 5)


def color(message: Any) -> list[float]:
    return rounded((message.r, message.g, message.b, message.a), 3)


def packed(values: Any, kind: str) -> str:
    """An array in base64, little-endian."""
    return base64.b64encode(np.asarray(values).astype(kind).tobytes()).decode()


def as_dict(scene: Any) -> dict[str, Any]:
    """A Scene message, ready for JSON."""
    return {
        'revision': scene.revision,
        'links': [{'model': link.model, 'name': link.name, 'group': link.group,
                   'moves': bool(link.moves), 'pose': pose(link.pose)} for link in scene.links],
        'shapes': [{'type': shape.type, 'link': shape.link, 'mesh': shape.mesh,
                    'pose': pose(shape.pose), 'color': color(shape.color),
                    'size': rounded((shape.size.x, shape.size.y, shape.size.z))}
                   for shape in scene.shapes],
        'meshes': [{'vertices': packed(mesh.vertices, '<f4'),
                    'triangles': packed(mesh.triangles, '<u4')} for mesh in scene.meshes],
        'lights': [{'name': light.name, 'model': light.model, 'link': light.link,
                    'sun': bool(light.directional), 'pose': pose(light.pose),
                    'color': color(light.color)} for light in scene.lights],
        'sensors': [{'kind': sensor.kind, 'name': sensor.name, 'link': sensor.link,
                     'pose': pose(sensor.pose), 'rays': sensor.rays,
                     'yaw': rounded((sensor.min_yaw, sensor.max_yaw)),
                     'pitch': rounded((sensor.min_pitch, sensor.max_pitch)),
                     'range': round(float(sensor.range), 3)} for sensor in scene.sensors],
    }
