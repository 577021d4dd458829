"""The pages of the documentation and the blocks in them."""
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = ROOT / 'docs/reference'  # written by docs/tables.py
PAGES = [*sorted(page for page in (ROOT / 'docs').rglob('*.md') if page.parent != REFERENCE),
         ROOT / 'README.md', ROOT / 'CONTRIBUTING.md', ROOT / 'worlds/README.md']


def blocks(page: Path, language: str = '') -> list[str]:
    """The text of each block that is fenced with ```language."""
    found = re.findall(r'^```(\w*)\n(.*?)^```', page.read_text(), re.MULTILINE | re.DOTALL)
    return [text for name, text in found if name == language]


def files(page: Path) -> dict[str, str]:
    """The blocks that a line such as `~/shelf/model.sdf`: introduces, by that path."""
    return dict(re.findall(r'^`([^`\n]+)`:\n\n```\w+\n(.*?)^```', page.read_text(),
                           re.MULTILINE | re.DOTALL))
