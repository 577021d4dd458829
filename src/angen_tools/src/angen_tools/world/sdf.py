"""Builds, edits and checks the SDF that the angen command sends. Lengths in m, angles in rad."""
from __future__ import annotations

import math
from copy import deepcopy
from pathlib import Path

from lxml import etree

from angen_tools.common.catalog import known_parameters
from angen_tools.common.failure import Failure

# The model in worlds/models that each kind of sensor is taken from.
BLOCKS = {'pir': 'pir', 'switch': 'optical_switch', 'luminosity': 'luminosity_sensor',
          'camera': 'camera', 'proximity': 'proximity', 'pressure': 'pressure_mat',
          'rfid': 'rfid_reader', 'plug': 'smart_plug', 'temperature': 'temperature_sensor',
          'humidity': 'humidity_sensor'}
PYROELECTRIC = 'pir_pyroelectric'  # of a pir with --set model=pyroelectric
TOUCHED = ('contact', 'pressure')  # watch collisions of the link that they are on
# Parameters that SDF has for every sensor; all others stand in the plug-in.
SENSOR_KEYS = ('update_rate', 'ray/', 'contact/', 'camera/')
# Kinds that sit on a link of something else and have no model of their own.
PARTS = {
    'contact': '''<sensor name="contact" type="contact">
  <always_on>true</always_on>
  <update_rate>1</update_rate>
  <contact/>
  <plugin name="bumper" filename="libgazebo_ros_bumper.so"/>
</sensor>''',
    'reed': '''<sensor name="reed" type="custom">
  <always_on>true</always_on>
  <update_rate>1</update_rate>
  <plugin name="reed" filename="libreed_contact.so"/>
</sensor>'''}
KINDS = (*BLOCKS, *PARTS)


def parse_pose(text: str) -> tuple[float, ...]:
    """The six numbers of "x y z" or "x y z roll pitch yaw"; ValueError says what is wrong."""
    words = text.replace(',', ' ').split()
    if len(words) not in (3, 6):
        raise ValueError(f"the pose '{text}' has {len(words)} numbers; give \"x y z\" or "
                         '"x y z roll pitch yaw" in m and rad')
    numbers = []
    for word in words:
        try:
            numbers.append(float(word))
        except ValueError:
            raise ValueError(f"the pose holds '{word}', which is not a number") from None
        if not math.isfinite(numbers[-1]):
            raise ValueError(f"the pose holds '{word}', which is not finite")
    return tuple(numbers + [0.0] * (6 - len(numbers)))


def check_name(name: str) -> str:
    """The name, if a model or sensor can have it; ValueError says why not."""
    try:
        name.encode()
    except UnicodeEncodeError:
        raise ValueError(f'the name {ascii(name)} is not UTF-8') from None
    if not name.strip():
        raise ValueError('the name is empty; give one, as kitchen_pir')
    if '::' in name or '/' in name or name != name.strip() or not name.isprintable():
        raise ValueError(f"the name {name!r} holds what names cannot: '::', '/', control "
                         'characters or blanks at an end')
    return name


def check_link(link: str) -> str:
    """MODEL::LINK; ValueError where it is none."""
    parts = link.split('::')
    if len(parts) < 2 or not all(parts):
        raise ValueError(f"'{link}' is not a link; give it as MODEL::LINK")
    return link


def parse_settings(items: list[str]) -> list[tuple[str, str]]:
    """(key, value) of each KEY=VALUE; ValueError where one is none."""
    pairs = []
    for item in items:
        key, equals, value = item.partition('=')
        if not equals or not key.strip():
            raise ValueError(f"'{item}' sets nothing; give it as KEY=VALUE")
        pairs.append((key.strip().strip('/'), value.strip()))
    return pairs


def read(path: Path) -> etree._Element:
    """The root element of an XML file; Failure with file and line where it is none."""
    try:
        return etree.parse(str(path), etree.XMLParser(remove_blank_text=True,
                                                      resolve_entities=False)).getroot()
    except OSError:
        raise Failure(f'{path}: cannot be read') from None
    except etree.XMLSyntaxError as error:
        raise Failure(f'{path}:{error.lineno}: {error.msg}') from None


def text(element: etree._Element) -> str:
    """The element as indented text."""
    element = deepcopy(element)
    etree.indent(element)
    return etree.tostring(element, encoding='unicode', pretty_print=True)


def build_sensor(kind: str, name: str, settings: list[tuple[str, str]], lone: bool, blocks: Path
                 ) -> etree._Element:
    """A static <sdf> model `name` with one sensor of `kind`, or if `lone` its <sensor> alone.

    `blocks` is the folder of the models in BLOCKS.

    Failure where a key of `settings` is unknown, a value is not XML, or a sensor of PARTS is not
    lone.
    """
    if kind in PARTS:
        if not lone:
            raise Failure(f'a {kind} sensor sits on a link: give --on MODEL::LINK')
        root = sensor = etree.fromstring(PARTS[kind])
    else:
        block = PYROELECTRIC if ('model', 'pyroelectric') in settings else BLOCKS[kind]
        root = read(blocks / block / 'model.sdf')
        sensor = root.find('.//sensor')
        root.find('model').set('name', name)
    if lone:
        for collision in sensor.findall('contact/collision'):  # its own model's
            collision.getparent().remove(collision)
    if settings:
        _apply(sensor, kind, settings)
    if lone:
        sensor.set('name', name)
        return sensor
    return root


def _apply(sensor: etree._Element, kind: str, settings: list[tuple[str, str]]) -> None:
    known = known_parameters(kind)
    written: set[str] = set()
    for given, value in settings:
        key = _full_key(given, list(known))
        if not key:
            raise Failure(f"a {kind} sensor has no parameter '{given}'; known are "
                          f'{", ".join(known)}')
        many = 'any number of times' in known[key]['type']
        if key in written and not many:
            raise Failure(f"'{given}' is set twice")
        at = sensor if key.startswith(SENSOR_KEYS) else sensor.find('plugin')
        try:
            _write(at, key, value, many and key in written)
        except ValueError:
            raise Failure(f"the value of '{given}' holds characters that XML cannot") from None
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
