"""angen list and plugins: what there is."""
from __future__ import annotations

import json
import math
from typing import Any, Iterable

from .catalog import angen_module, plugins
from .client import Client
from .failure import Failure

KINDS = ('model', 'door', 'elevator', 'lamp', 'drive', 'person', 'window', 'cabinet', 'heater',
         'climate', 'battery', 'tag',
         'pir', 'switch', 'luminosity', 'contact', 'lidar', 'camera', 'depth', 'proximity',
         'pressure', 'reed', 'rfid', 'plug', 'temperature', 'humidity')


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Lines with aligned columns, without a newline at the end."""
    lines = [list(head), *(list(row) for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    return '\n'.join('  '.join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip()
                     for line in lines)


def number(value: float, places: int = 2) -> str:
    """The number with so many places, never as -0."""
    return f'{round(value, places) + 0.0:.{places}f}'


def yaw(q: Any) -> float:
    """Rotation about z of a geometry_msgs/Quaternion, in rad."""
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def list_entities(kind: str, as_json: bool) -> str:
    """What is in the world, or what of it is of one kind."""
    every = Client().entities()
    kinds = {entity.kind for entity in every}
    if kind and kind not in kinds.union(KINDS):
        raise Failure(f"there is no kind '{kind}'; known are {', '.join(sorted(kinds))}")
    chosen = [entity for entity in every if kind in ('', entity.kind)]
    if as_json:
        return json.dumps([_as_dict(entity) for entity in chosen], indent=1, ensure_ascii=False)
    return table(('NAME', 'KIND', 'MODEL', 'X', 'Y', 'Z', 'YAW', 'TOPIC'),
                 (_row(entity) for entity in chosen))


def _row(entity: Any) -> list[str]:
    at = entity.pose.position
    numbers = [f'{round(v, 3) + 0.0:g}' for v in (at.x, at.y, at.z, yaw(entity.pose.orientation))]
    return [entity.name, entity.kind, entity.model, *numbers, entity.topic]


def _as_dict(entity: Any) -> dict[str, Any]:
    at, turn = entity.pose.position, entity.pose.orientation
    return {'name': entity.name, 'kind': entity.kind, 'model': entity.model, 'topic': entity.topic,
            'type': entity.type,
            'pose': {'position': [at.x, at.y, at.z],
                     'orientation': [turn.x, turn.y, turn.z, turn.w]}}


def list_plugins(as_json: bool) -> str:
    """The catalog: every plug-in on the path with its parameters. Needs no simulator."""
    if as_json:
        return json.dumps(plugins(), indent=1, ensure_ascii=False)
    return '\n\n'.join(_plugin(plugin) for plugin in plugins())


def _plugin(plugin: dict[str, Any]) -> str:
    rows = [('  ' + p['path'], p['default'], p['unit'], p['type'], p['doc'])
            for p in plugin['params']]
    head = f'{plugin["kind"]}  {plugin["library"]}  {plugin["doc"]}'
    return f'{head}\n{table(("  PARAMETER", "DEFAULT", "UNIT", "TYPE", "MEANING"), rows)}'


def check_world(path: str) -> tuple[list[str], str]:
    """Loads a world without ROS: (one line for each thing that is wrong, what is in it)."""
    angen = angen_module()
    try:
        world = angen.World(path)
    except angen.Error as error:
        return str(error).splitlines(), ''
    return [], (f'{path}: nothing is wrong; {len(world.models)} models, {len(world.devices())} '
                f'devices, {len(world.sensors())} sensors')
