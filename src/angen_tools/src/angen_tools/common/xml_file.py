"""XML of others: measured before it is parsed, with the limits of document/xml.cpp, because a
parser takes memory for all of it and compares each attribute of an element with all others."""
import re
from itertools import islice
from typing import Any

from lxml import etree

from angen_tools.common.failure import Failure

ELEMENTS = 100_000  # and comments, and half as many attributes
LONG = 4 << 20  # bytes of a document; a longer one may have four times as many
ATTRIBUTES = 100  # one element's
TAG = re.compile(rb'<(?:[^<>"\']++|"[^"<]*+"|\'[^\'<]*+\')*+')
ATTRIBUTE = re.compile(rb'[^\s=<>"\']\s*=')
DECLARATION = re.compile(rb'<!(?:ENTITY|ATTLIST)')


def parse_xml(name: str, data: bytes, **options: Any) -> etree._Element:
    """The root element; Failure with file and line. `options`: as of etree.XMLParser."""
    _check_size(name, data)
    parser = etree.XMLParser(encoding='utf-8', resolve_entities=False, no_network=True, **options)
    try:
        root: etree._Element = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        what = str(error.msg).partition(', line ')[0]
        raise Failure(f'{name}:{error.lineno or 1}: is not XML: {what}') from None
    return root


def _check_size(name: str, data: bytes) -> None:
    def fail(place: int, what: str) -> Failure:
        return Failure(f'{name}:{data.count(10, 0, place) + 1}: {what}')
    if declaration := DECLARATION.search(data):
        raise fail(declaration.start(), 'declares entities or attributes; write them out')
    most = ELEMENTS * (4 if len(data) > LONG else 1)
    many = f'has more than {most} elements or comments, or twice as many attributes'
    if data.count(b'<') > 2 * most:
        raise fail(0, many)
    elements = attributes = 0
    for tag in TAG.finditer(data):
        own = 0 if tag[0][:2] == b'<!' else sum(
            1 for _ in islice(ATTRIBUTE.finditer(tag[0]), ATTRIBUTES + 1))
        if own > ATTRIBUTES:
            raise fail(tag.start(), f'has an element with more than {ATTRIBUTES} attributes')
        elements += tag[0][:2] != b'</'
        attributes += own
        if elements > most or attributes > 2 * most:
            raise fail(tag.start(), many)
