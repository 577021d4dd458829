"""Text files that people write."""
from pathlib import Path

import pytest

from angen_tools.common.failure import Failure
from angen_tools.common.text_file import read_text, separator_hint, shortened


def test_a_byte_order_mark_is_not_text(tmp_path: Path) -> None:
    file = tmp_path / 'day.csv'
    file.write_bytes(b'\xef\xbb\xbftime\r\n')
    assert read_text(file) == 'time\r\n'


def test_the_line_of_another_encoding(tmp_path: Path) -> None:
    file = tmp_path / 'day.csv'
    file.write_bytes('a\nb\nKüche\n'.encode('latin-1'))
    with pytest.raises(Failure, match=r'day\.csv:3: a byte that is not UTF-8; save the file as'):
        read_text(file)


def test_what_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(Failure, match='cannot be read: Is a directory'):
        read_text(tmp_path)
    with pytest.raises(Failure, match='cannot be read: No such file'):
        read_text(tmp_path / 'missing')


def test_another_separator() -> None:
    assert 'semicolons, must be by commas' in separator_hint('time;target;command')
    assert 'tabs' in separator_hint('time\ttarget')
    assert separator_hint('time,target; command') == separator_hint('time') == ''


def test_a_long_value_is_cut() -> None:
    assert shortened('12') == '12' and shortened('9' * 5000) == '9' * 37 + '...'
