"""angen spawn, delete, save: the contents of the world."""
import math
from pathlib import Path
from typing import Any, Callable, Sequence

import numpy as np
from lxml import etree

from angen_tools.common.catalog import kind_of, kinds, simulator
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.geometry import turned, yaw
from angen_tools.common.nearest import did_you_mean
from angen_tools.session.live import Live
from angen_tools.world import models, sdf, sensor
from angen_tools.world.free_place import free_place

SEAT_AIR = 0.001  # m over the seat, where a sitter comes to be
LEANS = 0.05  # rad: a model that leans by more is not a seat
SHANKS = 0.31  # m ahead of a sitter's middle: they hang before the seat
PART = 1.9  # m: a wall or floor is as long and as wide or high
SITTER_WIDTH = 0.3  # m: nearer than this two do not sit


def model_source(what: str) -> str:
    """A model:// address as it is, of a name alone where a model has it, a path made absolute;
    Failure if there cannot be a model."""
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
    world = Live()
    chosen = pose if pose is not None else free_place(_saved(world))
    world.spawn(name, source, chosen)
    where = '' if pose is not None else f' at {" ".join(f"{part:g}" for part in chosen[:3])}'
    return {'name': name, 'kind': 'model', 'source': source, 'pose': list(chosen),
            'text': f'spawned the model {name} from {source}{where}'}


def _in_order(source: str, name: str) -> str:
    """The model to spawn; Failure if source and name are swapped."""
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
    world = Live()
    if on and sensor.senses_contacts(kind_of(kind)) and element.find(sensor.COLLISION) is None:
        _watch_all(world, element, on)
    world.spawn(name, sdf.text(element), pose, on)
    topic = next((entity.topic for entity in world.entities(kind) if entity.name == name), '')
    return {'name': name, 'kind': kind, 'topic': topic, 'on': on, 'pose': list(pose),
            'text': f'spawned the {kind} {name}{" on " + on if on else ""}, see {topic}'}


def seat_sitter(name: str, chair: str) -> dict[str, Any]:
    """Seats a person of 75 kg on an upright model with a seat; returns the result."""
    world = Live()
    places = {entity.name: entity.pose for entity in world.entities('model')}
    if chair not in places:
        raise Failure(f"no model named '{chair}'; "
                      + did_you_mean(chair, places, 'angen list --kind model'))
    seat = models.seat_of(_saved(world), chair)
    if seat is None:
        raise Failure(f"'{chair}' has no box seat_collision to sit on, as a chair or a sofa has")
    x, y, z, *turn = places[chair]
    if 1 - 2 * (turn[0] * turn[0] + turn[1] * turn[1]) < math.cos(LEANS):
        raise Failure(f"'{chair}' is not upright")
    heading = yaw(*turn)
    ahead = seat[0] + max(0.0, seat[3] / 2 - SHANKS)
    x, y = turned((x, y), heading, ahead, seat[1])
    z += seat[2] + SEAT_AIR
    for other, place in places.items():
        if other != chair and math.dist((x, y, z), place[:3]) < SITTER_WIDTH:
            raise Failure(f"on '{chair}' is '{other}'")
    world.spawn(name, 'model://sitter', (x, y, z, 0.0, 0.0, heading))
    return {'name': name, 'kind': 'sitter', 'on': chair, 'pose': [x, y, z, 0.0, 0.0, heading],
            'text': f'seated {name}, 75 kg, on {chair}'}


def delete(names: Sequence[str], ask: Callable[[str], bool] | None = None) -> list[str]:
    """Deletes models or sensors from the world, in order; stops at the first that cannot be, and
    at walls and floors if the answer of `ask` is no."""
    world = Live()
    done: list[str] = []
    for name in names:
        try:
            _must_be_there(world, name)
            if ask and _is_structure(world, name) and not ask(
                    f"'{name}' has walls or floors of the home; delete it?"):
                raise Failure(f"'{name}' is not deleted")
            world.delete(name)
        except Failure as error:
            raise Failure(f'{error}{"; deleted before: " + ", ".join(done) if done else ""}') \
                from None
        done.append(name)
    return done


def _is_structure(world: Live, name: str) -> bool:
    """Whether a model has parts as large as walls and floors, and is no thing of the home."""
    if any(thing.name == name for thing in world.home.things):
        return False
    with simulator() as angen:
        copy = angen.World.from_text(world.save(), allow_paths=True)
        return any(np.sort(np.ptp(corners, axis=0))[1:].min() > PART
                   for model, _, _, moves, corners in copy.shapes
                   if model == name and not moves and len(corners))


def _must_be_there(world: Live, name: str) -> None:
    """Failure if there is no model or sensor of that name."""
    devices = kinds('device')
    entities = world.entities()
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
    if path.is_dir() or not path.absolute().parent.is_dir():
        raise Failure(f'{path}: cannot be written; give a file in a folder that exists')
    xml = Live().save()
    try:
        root = etree.fromstring(xml.encode())
    except etree.XMLSyntaxError as error:
        raise Failure(f'the simulator sent a world that is not XML: {error}') from None
    models = len(root.xpath('world/model | world/include | world/actor'))
    write_text(path, xml)
    return {'file': str(path), 'models': models, 'text': f'saved {models} models to {path}'}


def _saved(world: Live) -> etree._Element:
    return etree.fromstring(world.save().encode())


def _watch_all(world: Live, element: etree._Element, on: str) -> None:
    """Lets a contact sensor watch every collision of its link."""
    contact = element.find('contact')
    if contact is None:
        contact = etree.SubElement(element, 'contact')
    # Where there are none, the simulator reports the error in `on`.
    for name in models.collisions(_saved(world), on):
        etree.SubElement(contact, 'collision').text = name
