"""Text files that people write: UTF-8, also with the byte order mark that Windows programs add."""
import codecs
from pathlib import Path

from angen_tools.common.failure import Failure

LONGEST = 40  # characters of a value in an error
LARGEST = 64 << 20  # bytes of a file


def read_bytes(path: Path, most: int = LARGEST) -> bytes:
    """All of a regular file; Failure if it is none, cannot be read or has more bytes."""
    if not path.is_file():
        raise Failure(f'{path}: is not a file that can be read')
    return _read(path, most)


def _read(path: Path, most: int) -> bytes:
    try:
        with path.open('rb') as file:
            data = file.read(most + 1)
    except OSError as error:
        raise Failure(f'{path}: cannot be read: {error.strerror}') from None
    if len(data) > most:
        raise Failure(f'{path}: has more than {most >> 20} MB, the limit for such a file')
    return data


def read_text(path: Path, most: int = LARGEST) -> str:
    """The text of a file; Failure with the line where it is not UTF-8."""
    data = _read(path, most).removeprefix(codecs.BOM_UTF8)
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
