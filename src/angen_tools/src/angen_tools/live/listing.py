"""angen list: the contents of the world."""
from typing import Any

from angen_tools.common.catalog import kinds
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import yaw
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.output import RenderableType, as_json, table
from angen_tools.session import Entity
from angen_tools.session.live import Live


def list_entities(kind: str, json: bool) -> RenderableType:
    """All entities of the world, or those of one kind."""
    every = Live().entities()
    known = {entity.kind for entity in every} | set(kinds()) | {'model'}
    if kind and kind not in known:
        raise Failure(f"there is no kind '{kind}'; "
                      + did_you_mean(kind, known, 'angen plugins'))
    chosen = [entity for entity in every if kind in ('', entity.kind)]
    if json:
        return as_json([_as_dict(entity) for entity in chosen])
    return table(('NAME', 'KIND', 'MODEL', 'ROOM', 'X', 'Y', 'Z', 'YAW', 'TOPIC'),
                 (_row(entity) for entity in chosen))


def _row(entity: Entity) -> list[str]:
    numbers = [f'{round(v, 3) + 0.0:g}' for v in (*entity.pose[:3], yaw(*entity.pose[3:]))]
    return [entity.name, entity.kind, entity.model, entity.room, *numbers, entity.topic]


def _as_dict(entity: Entity) -> dict[str, Any]:
    return {'name': entity.name, 'kind': entity.kind, 'model': entity.model, 'room': entity.room,
            'topic': entity.topic, 'type': entity.type,
            'pose': {'position': entity.pose[:3], 'orientation': entity.pose[3:]}}
