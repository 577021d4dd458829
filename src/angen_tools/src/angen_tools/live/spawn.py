"""angen spawn, delete, save: the contents of the world."""
from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any, Sequence

from lxml import etree

from angen_tools.common.catalog import kind_of, kinds
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.geometry import quaternion, yaw_of
from angen_tools.common.nearest import did_you_mean
from angen_tools.live.client import Client
from angen_tools.world import models, sdf, sensor
from angen_tools.world.free_place import free_place

SEAT_AIR = 0.001  # m over the seat, where a sitter comes to be
LEANS = 0.05  # rad: a model that leans by more is not a seat
SHANKS = 0.31  # m ahead of a sitter's middle: they hang before the seat
SITTER_WIDTH = 0.3  # m: nearer than this two do not sit


def model_source(what: str) -> str:
    """A model:// address as it is, of a name alone where a model has it, a path made absolute;
    Failure where there cannot be a model."""
    if not what:
        raise Failure("'': is not a model; give a path or model://NAME")
    if '://' in what:
        if not what.startswith('model://') or what == 'model://':
            raise Failure(f"'{what}' is not a model; give a path or model://NAME")
        return what
    path = Path(what).absolute()
    if not path.exists():
        known = models.addresses()
        if f'model://{what}' in known:
            return f'model://{what}'
        if '/' not in what and (not path.suffix or f'model://{path.stem}' in known):
            raise Failure(f"'{what}' is neither a file nor a model; "
                          + did_you_mean(f'model://{path.stem}', known))
    if path.is_dir():
        if not any((path / name).exists() for name in ('model.config', 'model.sdf')):
            raise Failure(f'{what}: has no model.config and no model.sdf')
    elif sdf.read(path).tag not in ('sdf', 'model', 'include', 'robot'):
        raise Failure(f'{what}:1: is not a model; its root must be <sdf> (or <robot>, URDF)')
    return str(path)


def spawn_model(source: str, name: str, pose: Sequence[float] | None) -> dict[str, Any]:
    """Adds a model at `pose` (x y z roll pitch yaw in the world), or at a place that is free;
    returns the result."""
    source = _in_order(source, name)
    client = Client()
    chosen = pose if pose is not None else free_place(_saved(client))
    call_spawn(client, name, source, '', chosen)
    where = '' if pose is not None else f' at {" ".join(f"{part:g}" for part in chosen[:3])}'
    return {'name': name, 'kind': 'model', 'source': source, 'pose': list(chosen),
            'text': f'spawned the model {name} from {source}{where}'}


def _in_order(source: str, name: str) -> str:
    """The model to spawn; Failure where source and name are swapped."""
    try:
        return model_source(source)
    except Failure:
        if f'model://{name}' not in models.addresses():
            raise
        raise Failure(f"'{source}' is not a model; did you mean spawn model {name} {source}?"
                      ) from None


def spawn_sensor(kind: str, name: str, pose: Sequence[float], on: str,
                 settings: list[tuple[str, str]]) -> dict[str, Any]:
    """Adds a sensor on a link, or as a static model of its own; returns the result.

    `pose` is x y z roll pitch yaw in the link's frame, or in the world.
    """
    element = sensor.build(kind, name, settings, bool(on))
    client = Client()
    if on and sensor.senses_contacts(kind_of(kind)) and element.find(sensor.COLLISION) is None:
        _watch_all(client, element, on)
    call_spawn(client, name, sdf.text(element), on, pose)
    topic = next((entity.topic for entity in client.entities(kind) if entity.name == name), '')
    return {'name': name, 'kind': kind, 'topic': topic, 'on': on, 'pose': list(pose),
            'text': f'spawned the {kind} {name}{" on " + on if on else ""}, see {topic}'}


def seat_sitter(name: str, chair: str) -> dict[str, Any]:
    """Seats a person of 75 kg on an upright model with a seat; returns the result."""
    client = Client()
    places = {entity.name: entity.pose for entity in client.entities('model')}
    if chair not in places:
        raise Failure(f"no model named '{chair}'; "
                      + did_you_mean(chair, places, 'angen list --kind model'))
    seat = models.seat_of(_saved(client), chair)
    if seat is None:
        raise Failure(f"'{chair}' has no box seat_collision to sit on, as a chair or a sofa has")
    at, turn = places[chair].position, places[chair].orientation
    if 1 - 2 * (turn.x * turn.x + turn.y * turn.y) < math.cos(LEANS):
        raise Failure(f"'{chair}' is not upright")
    heading = yaw_of(turn)
    ahead = seat[0] + max(0.0, seat[3] / 2 - SHANKS)
    x = at.x + ahead * math.cos(heading) - seat[1] * math.sin(heading)
    y = at.y + ahead * math.sin(heading) + seat[1] * math.cos(heading)
    z = at.z + seat[2] + SEAT_AIR
    for other, place in places.items():
        there = place.position
        if other != chair and math.dist((x, y, z), (there.x, there.y, there.z)) < SITTER_WIDTH:
            raise Failure(f"on '{chair}' is '{other}'")
    call_spawn(client, name, 'model://sitter', '', (x, y, z, 0.0, 0.0, heading))
    return {'name': name, 'kind': 'sitter', 'on': chair, 'pose': [x, y, z, 0.0, 0.0, heading],
            'text': f'seated {name}, 75 kg, on {chair}'}


def delete(names: Sequence[str]) -> list[str]:
    """Deletes models or sensors from the world, in order; stops at the first that cannot be."""
    from angen_msgs.srv import Delete
    client = Client()
    done: list[str] = []
    for name in names:
        try:
            _must_be_there(client, name)
            client.call('/angen/delete', Delete, name=name)
        except Failure as error:
            raise Failure(f'{error}{"; deleted before: " + ", ".join(done) if done else ""}') \
                from None
        done.append(name)
    return done


def _must_be_there(client: Client, name: str) -> None:
    """Failure where there is no model or sensor of that name."""
    devices = kinds('device')
    entities = client.entities()
    names = [entity.name for entity in entities if entity.kind not in devices]
    if name in names:
        return
    owner = next((entity for entity in entities if entity.name == name), None)
    if owner is not None:
        raise Failure(f"'{name}' is a {owner.kind} of the model {owner.model}; delete that")
    raise Failure(f"no model or sensor named '{name}'; "
                  + did_you_mean(name, names, 'angen list'))


def save(path: Path) -> dict[str, Any]:
    """Writes the current world to a file, all of it or nothing; returns the result."""
    from angen_msgs.srv import Save
    if path.is_dir() or not path.absolute().parent.is_dir():
        raise Failure(f'{path}: cannot be written; give a file in a folder that exists')
    xml = Client().call('/angen/save', Save).xml
    try:
        root = etree.fromstring(xml.encode())
    except etree.XMLSyntaxError as error:
        raise Failure(f'the simulator sent a world that is not XML: {error}') from None
    models = len(root.xpath('world/model | world/include | world/actor'))
    write_text(path, xml)
    return {'file': str(path), 'models': models, 'text': f'saved {models} models to {path}'}


def call_spawn(client: Client, name: str, xml: str, on: str, pose: Sequence[float]) -> None:
    """Calls /angen/spawn; pose is x y z roll pitch yaw (m, rad). Failure if it is rejected."""
    from geometry_msgs.msg import Point, Pose, Quaternion

    from angen_msgs.srv import Spawn
    place = Pose(Point(*pose[:3]), Quaternion(*quaternion(*pose[3:])))
    try:
        client.call('/angen/spawn', Spawn, name=name, xml=xml, on=on, pose=place)
    except Failure as error:  # the text that was built has lines that no user has seen
        raise Failure(re.sub(r'\(text\):\d+: ', '', str(error))) from None


def _saved(client: Client) -> etree._Element:
    from angen_msgs.srv import Save
    return etree.fromstring(client.call('/angen/save', Save).xml.encode())


def _watch_all(client: Client, element: etree._Element, on: str) -> None:
    """Lets a contact sensor watch every collision of its link."""
    contact = element.find('contact')
    if contact is None:
        contact = etree.SubElement(element, 'contact')
    # Where there are none, the simulator reports the error in `on`.
    for name in models.collisions(_saved(client), on):
        etree.SubElement(contact, 'collision').text = name
