"""Builds the SDF of a sensor of any kind in the catalog."""
from typing import Sequence

from lxml import etree

from angen_tools.common.angle import in_radians
from angen_tools.common.catalog import Plugin, has_parameter, kind_of, parameters
from angen_tools.common.clock import in_seconds
from angen_tools.common.failure import Failure
from angen_tools.common.nearest import did_you_mean
from angen_tools.world import models, sdf

Setting = tuple[str, str]  # key, value
# Parameters that SDF has for every sensor; all others are in the plug-in.
SENSOR_KEYS = ('update_rate', 'ray/', 'contact/', 'camera/')
PLAIN = {'rad': in_radians, 's': in_seconds}  # by unit, the number of a word with another unit
COLLISION = 'contact/collision'  # the parameter of kinds that sense contacts of their link


def senses_contacts(kind: Plugin) -> bool:
    """Whether a kind watches collisions of the link that it is on."""
    return has_parameter(kind, COLLISION)


def needs_link(kind: Plugin) -> bool:
    """Whether a kind is mounted on a link of another model and has no model of its own."""
    return bool(kind['sensor_type']) and not kind['models']


def build(kind_name: str, name: str, settings: Sequence[Setting], lone: bool) -> etree._Element:
    """A static <sdf> model `name` with one sensor of a kind, or if `lone` its <sensor> alone.

    It comes from the kind's model; a kind without one has a link with nothing but the sensor.
    Failure if a key of `settings` is unknown, a value is not XML, or a sensor that needs a link
    is not lone.
    """
    kind = kind_of(kind_name)
    if needs_link(kind) and not lone:
        raise Failure(f'a {kind_name} sensor needs a link: give --on MODEL::LINK')
    root = _from_model(kind, settings) if kind['models'] else _made(kind)
    sensor = root.find('.//sensor')
    if lone:
        for collision in sensor.findall(COLLISION):  # its own model's
            collision.getparent().remove(collision)
    _apply(sensor, kind_name, settings)
    if lone:
        sensor.set('name', name)
        return sensor
    root.find('model').set('name', name)
    return root


def _from_model(kind: Plugin, settings: Sequence[Setting]) -> etree._Element:
    """The model that holds a sensor of a kind; its parameters may choose another than the first."""
    given = set(settings)
    chosen = next((entry for entry in kind['models'] if (entry['parameter'], entry['value'])
                   in given), kind['models'][0])
    path = models.find(f'model://{chosen["model"]}')
    if path is None:
        raise Failure(f'model://{chosen["model"]}, the model of a {kind["kind"]}, is not found; '
                      'set ANGEN_MODEL_PATH to the folder that contains it')
    root = sdf.read(path)
    if root.find('model') is None or root.find('.//sensor') is None:
        raise Failure(f'{path}: has no <model> with a <sensor>')
    return root


def _made(kind: Plugin) -> etree._Element:
    """A static model with one link that carries the sensor."""
    root = etree.Element('sdf', version='1.6')
    model = etree.SubElement(root, 'model', name=kind['kind'])
    etree.SubElement(model, 'static').text = 'true'
    link = etree.SubElement(model, 'link', name='link')
    sensor = etree.SubElement(link, 'sensor', name=kind['kind'],
                              type=kind['sensor_type'] or 'custom')
    etree.SubElement(sensor, 'always_on').text = 'true'
    etree.SubElement(sensor, 'update_rate').text = f'{kind["rate"]:g}'
    if senses_contacts(kind):
        etree.SubElement(sensor, 'contact')
    etree.SubElement(sensor, 'plugin', name=kind['kind'], filename=kind['library'])
    return root


def _apply(sensor: etree._Element, kind: str, settings: Sequence[Setting]) -> None:
    known = parameters(kind)
    written: set[str] = set()
    for given, value in settings:
        key = _full_key(given, list(known))
        if not key:
            raise Failure(f"a {kind} sensor has no parameter '{given}'; "
                          + did_you_mean(given, known, f'angen spawn {kind} --help'))
        many = 'any number of times' in known[key]['type']
        if key in written and not many:
            raise Failure(f"'{given}' is set twice")
        value = PLAIN.get(known[key]['unit'], str)(value)
        at = sensor if key.startswith(SENSOR_KEYS) else sensor.find('plugin')
        try:
            _write(at, key, value, many and key in written)
        except ValueError:
            raise Failure(f"the value of '{given}' has characters that XML forbids") from None
        written.add(key)


def _full_key(given: str, known: list[str]) -> str | None:
    """The known key that is `given`, or the only one that ends with it."""
    if given in known:
        return given
    ends = [key for key in known if key.endswith('/' + given)]
    return ends[0] if len(ends) == 1 else None


def _write(at: etree._Element, key: str, value: str, add: bool) -> None:
    *folders, leaf = key.split('/')
    for tag in folders:
        found = at.find(tag)
        at = etree.SubElement(at, tag) if found is None else found
    element = None if add else at.find(leaf)
    if element is None:
        element = etree.SubElement(at, leaf)
    element.text = value
