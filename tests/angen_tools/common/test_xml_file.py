"""XML is measured before it is parsed."""
import time
from typing import Callable

import pytest

from angen_tools.common.failure import Failure
from angen_tools.common.xml_file import parse_xml

LIMIT = 2.0  # s of CPU time
BOMB = b'<!DOCTYPE a [\n<!ENTITY b "bbbb">]>\n<a>&b;</a>'


def attributes(count: int, before: bytes = b'') -> bytes:
    return b'<a ' + before + b' '.join(b'b%d="1"' % i for i in range(count)) + b'/>'


def defaults(count: int) -> bytes:
    listed = b'\n'.join(b'b%d CDATA "1"' % i for i in range(count))
    return b'<!DOCTYPE a [<!ATTLIST a ' + listed + b'>]><a/>'


@pytest.mark.parametrize('make, what', [  # made when they are parsed: they have up to 32 MB
    (lambda: attributes(80_000), 'f:1: has an element with more than 100 attributes'),
    (lambda: b'<a>\n' + attributes(101, b"c='>' d='\"'") + b'</a>',
     'f:2: has an element with more than'),
    (lambda: attributes(2_000_000), 'f:1: has an element with more than 100 attributes'),
    (lambda: b'<a>' + b'<b/>' * 8_000_000 + b'</a>',
     'f:1: has more than 400000 elements or comments'),
    (lambda: b'<a>\n' + b'<b/>\n' * 100_001 + b'</a>', 'f:100001: has more than 100000 elements'),
    (lambda: b'<a>\n' + attributes(51) * 4000 + b'</a>',
     'f:2: has more than 100000 elements or comments'),
    (lambda: BOMB, 'f:2: declares entities or attributes; write them out'),
    (lambda: defaults(80_000), 'f:1: declares entities or attributes; write them out'),
    (lambda: b'<a>' * 300 + b'</a>' * 300, 'f:1: is not XML: Excessive depth'),
    (lambda: b'<a>\n<b></a>', 'f:2: is not XML: Opening and ending tag mismatch'),
    (lambda: b'<?xml version="1.0" encoding="latin-1"?><a b="\xfc"/>',
     'f:1: is not XML: Input is not pro'),
    (lambda: '<a/>'.encode('utf-16'), 'f:1: is not XML'),
    (lambda: b'', 'f:1: is not XML: Document is empty')])
def test_what_is_not_parsed(make: Callable[[], bytes], what: str) -> None:
    data = make()
    began = time.process_time()
    with pytest.raises(Failure, match=f'^{what}'):
        parse_xml('f', data)
    assert time.process_time() - began < LIMIT


def test_attributes_of_comments_and_texts_do_not_count() -> None:
    rule = b'=' * 500
    root = parse_xml('f', b'\xef\xbb\xbf<a b="' + rule + b'"><!-- ' + b'c = 1, ' * 500
                     + b"don't -->" + b'd=2 ' * 500 + b'<e f="\xc3\xbc"/></a>')
    assert root.get('b') == rule.decode() and root.find('e').get('f') == 'ü'


def test_gazebos_values_without_quotes_are_measured() -> None:
    assert parse_xml('f', b'<a b=1><c/></a>', recover=True).tag == 'a'
    with pytest.raises(Failure, match='more than 100 attributes'):
        parse_xml('f', attributes(80_000).replace(b'"', b''), recover=True)
