"""Reads and writes SDF, and the words of the angen command for it. Lengths in m, angles in rad."""
import math
from copy import deepcopy
from pathlib import Path

from lxml import etree

from angen_tools.common.angle import radians
from angen_tools.common.text_file import read_bytes
from angen_tools.common.verbs import comma_hint, number
from angen_tools.common.xml_file import parse_xml


def parse_pose(text: str) -> tuple[float, ...]:
    """The six numbers of "x y z" or "x y z roll pitch yaw", of which angles may be in degrees, as
    90deg; ValueError names the error."""
    words = text.replace(',', ' ').split()
    if len(words) not in (3, 6):
        raise ValueError(f"the pose '{text}' has {len(words)} numbers; give \"x y z\" or "
                         f'"x y z roll pitch yaw" in m and rad{comma_hint(text)}')
    numbers = []
    for place, word in enumerate(words):
        numbers.append(number(word) if place < 3 else radians(word))
        if not math.isfinite(numbers[-1]):
            what = 'a number' if math.isnan(numbers[-1]) else 'finite'
            raise ValueError(f"the pose contains '{word}', which is not {what}")
    return tuple(numbers + [0.0] * (6 - len(numbers)))


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
            raise ValueError(f"'{item}' is not a setting; give it as KEY=VALUE")
        pairs.append((key.strip().strip('/'), value.strip()))
    return pairs


def read(path: Path) -> etree._Element:
    """The root element of an XML file; Failure with file and line where it is none."""
    return parse_xml(str(path), read_bytes(path), remove_blank_text=True)


def text(element: etree._Element) -> str:
    """The element as indented text."""
    element = deepcopy(element)
    etree.indent(element)
    return etree.tostring(element, encoding='unicode', pretty_print=True)
