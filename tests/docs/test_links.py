"""Links within the repository lead to files and headings that exist, and each page is linked."""
import re
from pathlib import Path

import pytest

from tests.docs.pages import PAGES, REFERENCE, ROOT, blocks

LINK = re.compile(r'\]\(([^)\s]+)\)|^\[[^]]+\]: (\S+)$', re.MULTILINE)


def anchors(page: Path) -> set[str]:
    headings = re.findall(r'^#+ (.*)$', page.read_text(), re.MULTILINE)
    return {re.sub(r'[^\w\- ]', '', heading.lower()).replace(' ', '-') for heading in headings}


def targets(page: Path) -> list[tuple[Path, str]]:
    found = [inline or defined for inline, defined in LINK.findall(page.read_text())]
    links = [link for link in found if '://' not in link]
    return [((page.parent / path).resolve() if path else page, anchor)
            for path, _, anchor in (link.partition('#') for link in links)]


@pytest.mark.parametrize('page', [*PAGES, *sorted(REFERENCE.glob('*.md'))],
                         ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    for path, anchor in targets(page):
        assert path.exists(), path
        assert not anchor or anchor in anchors(path), f'{path}#{anchor}'


def test_each_page_is_linked_from_the_readme() -> None:
    linked = {path for path, _ in targets(ROOT / 'README.md')}
    assert not {*PAGES, REFERENCE / 'README.md'} - linked - {ROOT / 'README.md'}


@pytest.mark.parametrize('page', [page for page in PAGES if page.parent != ROOT],
                         ids=lambda page: str(page.relative_to(ROOT)))
def test_it_begins_with_a_command_and_lists_its_limitations(page: Path) -> None:
    text = page.read_text()
    assert re.match(r'# .+\n', text)
    assert blocks(page)[0].startswith('./angen ')
    assert re.search(r'^## (.*[Ll]imitations$|.*\b(not|cannot)\b)', text, re.MULTILINE)
