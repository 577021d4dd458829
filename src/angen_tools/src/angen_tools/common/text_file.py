"""Text files that people write: UTF-8, also with the byte order mark that Windows programs add."""
from __future__ import annotations

import codecs
from pathlib import Path

from angen_tools.common.failure import Failure

LONGEST = 40  # characters of a value in an error


def read_text(path: Path) -> str:
    """The text of a file; Failure with the line where it is not UTF-8."""
    try:
        data = path.read_bytes().removeprefix(codecs.BOM_UTF8)
    except OSError as error:
        raise Failure(f'{path}: cannot be read: {error.strerror}') from None
    try:
        return data.decode()
    except UnicodeDecodeError as error:
        line = data.count(b'\n', 0, error.start) + 1
        raise Failure(f'{path}:{line}: a byte that is not UTF-8; save the file as UTF-8') from None


def separator_hint(line: str) -> str:
    """For the end of an error at the first line of a CSV file whose values another character than
    a comma separates, as in spreadsheets of some languages; else ''."""
    for mark, name in ((';', 'semicolons'), ('\t', 'tabs')):
        if mark in line and ',' not in line:
            return f'; its values are separated by {name}, must be by commas'
    return ''


def shortened(text: str) -> str:
    """A value for an error."""
    return text if len(text) <= LONGEST else text[:LONGEST - 3] + '...'
