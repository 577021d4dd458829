"""Writes a world of stacked apartments with a number of sensors of each kind."""
from copy import deepcopy
from pathlib import Path
from typing import Mapping, Sequence

from lxml import etree

from angen_models import plan, world as blocks
from angen_models.sdf import numbers
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.world import sdf
from angen_tools.world.models import find
from angen_tools.world.placing import KINDS, Placement, has_contact, placements

FOREVER = 1e6  # s that the robot keeps to its last order


def apartment(floors: int, counts: Mapping[str, int], seed: int, elevator: bool = False
              ) -> list[Placement]:
    """The sensors of such a world; `counts` by kind. Failure if there is no room for them.

    The contact sensor of the elevator is one of `contact`.
    """
    if elevator and not counts.get('contact'):
        raise Failure('the elevator has a contact sensor: give --contact 1 or more with it')
    return [placement for kind in KINDS
            for placement in placements(kind, counts.get(kind, 0), floors, seed, elevator)]


def write_apartment(path: Path, floors: int, counts: Mapping[str, int], seed: int,
                    elevator: bool = False, mover: str = 'person', one_link: bool = False) -> int:
    """Writes the world to a file; returns the number of its sensors.

    Apartments with doors, lamps, furniture and, on floor 0, the `mover`: person, robot or nobody.
    Chairs and tables hold the contact sensors, so there are only as many as `counts` has. With
    `one_link` all others of a KIND are at the same places on one link of the model KIND_sensors,
    without housings, and are called KIND_sensors_NAME. The same arguments give the same bytes.
    Failure if there is no room for the sensors.
    """
    sensors = apartment(floors, counts, seed, elevator)
    root, world = blocks.new_world('apartment')
    blocks.add_world_plugins(world)
    blocks.add_home_site(world)
    for floor in range(floors):
        blocks.comment(world, f'floor {floor}')
        blocks.include(world, 'apartment', f'apartment{floor}',
                       (0, 0, floor * plan.STOREY, 0, 0, 0))
        blocks.add_devices(world, floor)
        for room in plan.FURNITURE:
            for model, name, pose in blocks.furniture_in(room, floor):
                if not has_contact(model):
                    blocks.include(world, model, name, pose)
    for kind in KINDS:
        blocks.comment(world, f'{kind}: {counts.get(kind, 0)}')
        own = [sensor for sensor in sensors if sensor.kind == kind]
        if one_link and own and kind != 'contact':
            world.append(_all_on_one_link(kind, own))
            continue
        for sensor in own:
            blocks.include(world, sensor.model, sensor.name, sensor.pose)
    if mover == 'person':
        blocks.add_person(world)
    elif mover == 'robot':
        _add_robot(world)
    blocks.add_state(world, 'apartment')
    write_text(path, f'<?xml version="1.0"?>\n{sdf.text(root)}')
    return len(sensors)


def block(model: str) -> etree._Element:
    """The <model> of worlds/models."""
    path = find(f'model://{model}')
    if path is None:
        raise Failure(f'model://{model} is not found')
    return sdf.read(path).find('model')


def put(element: etree._Element, *pose: float) -> None:
    """Gives a model or a sensor its pose."""
    place = etree.Element('pose')
    place.text = numbers(*pose)
    element.insert(0, place)


def _all_on_one_link(kind: str, sensors: Sequence[Placement]) -> etree._Element:
    """A static <model> of one link with those sensors at their blocks' origins."""
    blocks = {sensor.model: block(sensor.model).find('.//sensor') for sensor in sensors}
    model = etree.Element('model', name=f'{kind}_sensors')
    etree.SubElement(model, 'static').text = 'true'
    link = etree.SubElement(model, 'link', name='link')
    for sensor in sensors:
        element = deepcopy(blocks[sensor.model])
        element.set('name', sensor.name)
        put(element, *sensor.pose)
        link.append(element)
    return model


def _add_robot(world: etree._Element) -> None:
    """A TurtleBot without sensors of its own, at the start of its round."""
    x, y, _ = plan.ROUND
    model = block('turtlebot')
    for link in model.iterfind('link'):
        for sensor in link.findall('sensor'):
            link.remove(sensor)
    put(model, x, y, 0.001, 0, 0, 0)
    world.append(model)
    plugin = world.find("plugin[@name='robot_controller']")
    etree.SubElement(plugin, 'commandTimeout').text = f'{FOREVER:g}'
