"""Comments of the code begin with their subject, and say if and instead of."""
import io
import re
import tokenize
from pathlib import Path

import pytest

from tests.docs.pages import ROOT

SOURCES = sorted(path for path in (ROOT / 'src').rglob('*')
                 if path.suffix in ('.h', '.cpp', '.py') and 'vendor' not in path.parts)
BEGINS = re.compile(r'(of|that|as|which|these|those)\b', re.IGNORECASE)
WORDS = re.compile(r'\bin place of\b|\b(none|null|empty) where\b', re.IGNORECASE)
OPENS = re.compile(r'(?<![:"\'/])//+<?!? ?')


def in_cpp(path: Path) -> list[tuple[int, bool, str]]:
    """Line, whether the line has nothing else, and text of each comment."""
    found = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        opens = OPENS.search(line)
        if opens and line[:opens.start()].count('"') % 2 == 0:
            found.append((number, not line[:opens.start()].strip(), line[opens.end():]))
    return found


def in_python(path: Path) -> list[tuple[int, bool, str]]:
    tokens = tokenize.generate_tokens(io.StringIO(path.read_text()).readline)
    return [(token.start[0], not token.line[:token.start[1]].strip(), token.string.lstrip('# '))
            for token in tokens if token.type == tokenize.COMMENT]


def comments(path: Path) -> list[tuple[int, str]]:
    """The comments of a source; lines that continue one are a part of it."""
    joined: list[tuple[int, str]] = []
    last = -1
    for number, alone, text in in_python(path) if path.suffix == '.py' else in_cpp(path):
        if alone and number == last + 1:
            joined[-1] = joined[-1][0], f'{joined[-1][1]} {text}'
        else:
            joined.append((number, text))
        last = number
    return joined


@pytest.mark.parametrize('folder', sorted({path.relative_to(ROOT).parts[1] for path in SOURCES}))
def test_comments_are_sentences(folder: str) -> None:
    wrong = [f'{path.relative_to(ROOT)}:{number}: {text}' for path in SOURCES
             if path.relative_to(ROOT).parts[1] == folder for number, text in comments(path)
             if BEGINS.match(text) or WORDS.search(text)]
    assert not wrong, '\n'.join(wrong)
