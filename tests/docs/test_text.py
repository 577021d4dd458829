"""Pages have lines that fit an editor, and describe the present only."""
import re
from pathlib import Path

import pytest

from tests.docs.pages import PAGES, ROOT

LONGEST = 120  # characters; docs/reference/ is generated
PAST = re.compile(r'\b(since then|(?<!is )(?<!are )used to|no longer|formerly|previously|by now|now'
                  r'|today|in earlier versions)\b', re.IGNORECASE)


def is_command_row(line: str) -> bool:
    """A row of a table, which no line break divides, with a command that alone is long."""
    return line.startswith('|') and bool(re.search(r'`[^`]{60,}`', line))


@pytest.mark.parametrize('page', PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_lines_fit(page: Path) -> None:
    assert not [line for line in page.read_text().splitlines()
                if len(line) > LONGEST and not is_command_row(line)]


@pytest.mark.parametrize('page', PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_page_tells_no_history(page: Path) -> None:
    assert not PAST.search(re.sub(r'`[^`\n]+`', '', page.read_text()))
