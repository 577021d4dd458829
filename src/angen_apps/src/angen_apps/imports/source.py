"""Files that a home is imported from: bounded reading, and errors with file and line."""
import codecs
import math
import re
import zipfile
from pathlib import Path

from lxml import etree

from angen_tools.common.failure import Failure
from angen_tools.common.text_file import read_bytes, shortened
from angen_tools.common.xml_file import parse_xml

LARGEST_XML = 32 << 20  # bytes of Home.xml
MEMBERS = 10_000  # files in a zip
FARTHEST = 500.0  # m from the origin of a plan
HOME = 'Home.xml'
DECLARATION = re.compile(r'<\?xml[^>]*\?>')  # with an encoding
OLD = 'Home'


class Xml:
    """An XML document whose attributes are checked where they are read."""

    def __init__(self, name: str, data: bytes) -> None:
        self.name = name
        self.root = parse_xml(name, data, remove_comments=True, remove_pis=True)

    def fail(self, element: etree._Element, what: str) -> Failure:
        return Failure(f'{self.name}:{element.sourceline}: {what}')

    def number(self, element: etree._Element, key: str, default: float | None = None,
               low: float = -math.inf, high: float = math.inf) -> float:
        """A finite number within bounds, as it is in the file."""
        text = element.get(key)
        if text is None:
            if default is None:
                raise self.fail(element, f'<{element.tag}> has no {key}; it needs a number')
            return default
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise self.fail(element, f'{key} of <{element.tag}> is "{shortened(text)}", must be a '
                            'finite number')
        if not low <= value <= high:
            raise self.fail(element, f'{key} of <{element.tag}> is {shortened(text)}, must be '
                            f'{low:g} to {high:g}')
        return value

    def length(self, element: etree._Element, key: str, default: float | None = None,
               low: float = -FARTHEST, high: float = FARTHEST) -> float:
        """A length given in cm, in m."""
        given = None if default is None else default * 100
        return self.number(element, key, given, low * 100, high * 100) / 100


def home_xml(path: Path) -> Xml:
    """Home.xml of a .sh3d file, or the file itself if it is XML."""
    data = read_bytes(path)
    if not data.startswith(b'PK'):
        data = _utf8(path, data)
        if data.lstrip()[:1] != b'<':
            raise Failure(f'{path}: is neither a .sh3d file (a zip) nor Home.xml')
        return Xml(str(path), data)
    if data.count(b'PK\1\2') > MEMBERS:
        raise Failure(f'{path}: has more than {MEMBERS} files in it')
    return Xml(f'{path}/{HOME}', _utf8(path, _member(path)))


def _utf8(path: Path, data: bytes) -> bytes:
    """A text that begins with the mark of its encoding, in UTF-8."""
    try:
        if data[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
            return DECLARATION.sub('', data.decode('utf-16')).encode()
        return data.removeprefix(codecs.BOM_UTF8)
    except UnicodeDecodeError as error:
        raise Failure(f'{path}: is not UTF-16, as it begins: {error.reason}') from None


def _member(path: Path) -> bytes:
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            if HOME not in names:
                if OLD in names:
                    raise Failure(f'{path}: has no {HOME}, only the format before Sweet Home 3D '
                                  '5.3; open it with 5.3 or later and save it')
                raise Failure(f'{path}: has no {HOME}; it is not a home of Sweet Home 3D')
            with archive.open(HOME) as file:
                data = file.read(LARGEST_XML + 1)
    except Failure:
        raise
    except Exception as error:  # zipfile and zlib raise many kinds for torn files
        raise Failure(f'{path}: is a damaged zip file: {error or type(error).__name__}') from None
    if len(data) > LARGEST_XML:
        raise Failure(f'{path}/{HOME}: has more than {LARGEST_XML >> 20} MB')
    return data


def root_of(xml: Xml, tag: str) -> etree._Element:
    if xml.root.tag != tag:
        raise xml.fail(xml.root, f'begins with <{xml.root.tag}>, must be <{tag}>')
    return xml.root
