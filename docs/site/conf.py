"""The pages as a site with search, by Sphinx: ./angen docs. Its menu is the README's lists."""
import os
import re
from pathlib import Path
from typing import Any, Iterator

from pygments.lexers import TextLexer

ROOT = Path(__file__).resolve().parents[2]
LINK = re.compile(r'\[([^]]+)\]\(([^)#\s]+\.md)\)')
ANY_LINK = re.compile(r'\[([^]]+)\]\(([^)#\s]+)\)')
LIST = re.compile(r'^(Devices|Sensors): (.*?)\.\n\n', re.MULTILINE | re.DOTALL)

project = 'Angen'
version = release = os.environ['ANGEN_VERSION']
extensions = ['myst_parser']
include_patterns = ['README.md', 'CHANGELOG.md', 'CONTRIBUTING.md', 'docs/**.md',
                    'worlds/README.md']
root_doc = 'README'
myst_heading_anchors = 4
html_theme = 'furo'
html_title = f'Angen {version}'
html_static_path = [str(Path(__file__).with_name('site.css'))]
html_css_files = ['site.css']
html_copy_source = False
pygments_style, pygments_dark_style = 'default', 'native'
highlight_language = 'none'


def menu(readme: str) -> Iterator[tuple[str, list[str]]]:
    """Each list of the README with its pages, without the suffix."""
    for part in readme.split('## Documentation')[1].split('\n\n'):
        heading = re.match(r'\| ([^|]+?) \|', part)
        if heading:
            yield heading[1], pages(part)
    for name, links in LIST.findall(readme):
        yield name, pages(links)
    yield 'reference', ['docs/reference/README']


def pages(text: str) -> list[str]:
    return [path.removesuffix('.md') for _, path in LINK.findall(text)]


def without_folders(text: str, page: Path) -> str:
    """The text without links to folders, which have no page."""
    def shown(link: re.Match[str]) -> str:
        return link[1] if (page.parent / link[2]).is_dir() else link[0]
    return ANY_LINK.sub(shown, text)


def add_menu(_: Any, name: str, source: list[str]) -> None:
    """Adds hidden lists of pages, out of which Sphinx makes its menu and the order of pages."""
    source[0] = without_folders(source[0], ROOT / f'{name}.md')
    if name == root_doc:
        source[0] += ''.join(
            f'\n```{{toctree}}\n:hidden:\n:caption: {heading.capitalize()}\n\n'
            + '\n'.join(f'/{page}' for page in listed) + '\n```\n'
            for heading, listed in menu(source[0]))
    elif name == 'docs/reference/README':
        source[0] += '\n```{toctree}\n:hidden:\n:glob:\n\n*\n```\n'


def setup(app: Any) -> None:
    app.add_lexer('csv', TextLexer)
    app.connect('source-read', add_menu)
