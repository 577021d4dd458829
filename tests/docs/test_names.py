"""Names in code font exist: paths, tests, classes, functions, subcommands of angen.

C++ tests are named after their sources, or CONTRIBUTING.md names them as tests across files.
"""
import functools
import re
from pathlib import Path

import pytest

from angen_tools.cli import main as cli
from tests.docs.pages import PAGES, ROOT, files

TESTS = sorted((ROOT / 'tests').glob('angen_*/*/*_test.cpp'))
PACKAGES = (ROOT / 'src/angen_sim', ROOT / 'src/angen_gazebo')
ACROSS = set(re.findall(r'`(\w+/\w+)_test`', (ROOT / 'CONTRIBUTING.md').read_text()))
FOLDERS = ('bench', 'docs', 'examples', 'launch', 'src', 'tests', 'worlds')
OURS = re.compile(r'.*\.(cpp|h|py|msg|srv|yaml|apt|in)')  # names of files
PLACEHOLDER = re.compile(r'\b([xX](_\w+|Msg)?|NAME|KIND|TARGET|FILE)\b')


@pytest.mark.parametrize('test', TESTS, ids=lambda path: f'{path.parent.name}/{path.stem}')
def test_a_test_has_the_name_of_its_source(test: Path) -> None:
    name = test.stem.removesuffix('_test')
    module = ROOT / 'src' / test.parent.parent.name / test.parent.name
    assert any(module.rglob(f'{name}.*')) != (f'{test.parent.name}/{name}' in ACROSS)


def test_the_tests_across_files_exist() -> None:
    assert len(ACROSS) > 3
    assert ACROSS <= {f'{test.parent.name}/{test.stem.removesuffix("_test")}' for test in TESTS}


@functools.cache
def sources() -> list[Path]:
    """All files but pages, and but the tests of pages, which contain names of nothing."""
    below = [path for folder in FOLDERS for path in (ROOT / folder).rglob('*') if path.is_file()]
    return [path for path in [*below, *ROOT.glob('*')] if path.is_file() and path.suffix != '.md'
            and not {'__pycache__', '.git'} & set(path.parts)
            and ROOT / 'tests/docs' not in path.parents]


@functools.cache
def words() -> list[set[str]]:
    """The identifiers of each source."""
    return [set(re.findall(r'\w+', path.read_text(errors='ignore'))) for path in sources()
            if path.stat().st_size < 1_000_000]


def occur(name: str) -> bool:
    """One source has all parts of a name such as Simulation::leap."""
    return any(found.issuperset(name.split('::')) for found in words())


@functools.cache
def file_names() -> set[str]:
    return {path.name for path in sources()} | {path.stem for path in sources()}


def is_path(span: str) -> bool:
    first, slash, _ = span.partition('/')
    module = any((package / first).is_dir() for package in PACKAGES) and bool(OURS.fullmatch(span))
    return bool(slash and (first in FOLDERS or module)
                and re.fullmatch(r'[\w.*/-]+', span) and not PLACEHOLDER.search(span))


def exists(path: str) -> bool:
    return any(any(folder.glob(path.rstrip('/'))) for folder in (ROOT, *PACKAGES))


def unknown(span: str, own: set[str]) -> list[str]:
    """Names in a span in code font that do not exist; `own` are files that its page makes."""
    if span in own:
        return []
    if is_path(span):
        return [] if exists(span) else [span]
    wrong = []
    command = re.match(r'(?:\./)?angen ([a-z][\w-]+)', span)
    if command and command.group(1) not in subcommands():
        wrong.append(command.group())
    if re.fullmatch(r'\w+_test|test_\w+(\.py)?', span) and not (
            span in file_names() or occur(span)):
        wrong.append(span)
    if re.fullmatch(r'[\w-]+\.\w+', span) and OURS.fullmatch(span) and span not in file_names():
        wrong.append(span)
    names = re.findall(r'\b[A-Z][a-z]+[A-Z]\w*|\w+(?:::\w+)+|\bk[A-Z]\w+', span)
    return wrong + [name for name in names if not occur(name) and not PLACEHOLDER.search(name)]


@functools.cache
def subcommands() -> set[str]:
    """The commands of ./angen, which begin a case of the script, and of angen."""
    script = re.findall(r'^  ([a-z -|]+)\)', (ROOT / 'angen').read_text(), re.MULTILINE)
    return {word for words in script for word in re.split(r'[ |]+', words)} | set(
        cli.make_parser()._subparsers._group_actions[0].choices)


def spans(page: Path) -> list[str]:
    text = re.sub(r'^```.*?^```', '', page.read_text(), flags=re.MULTILINE | re.DOTALL)
    return re.findall(r'`([^`\n]+)`', text)


@pytest.mark.parametrize('page', PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_what_a_page_names_exists(page: Path) -> None:
    own = {Path(path).name for path in files(page)}
    assert not [name for span in spans(page) for name in unknown(span, own)]


@pytest.mark.parametrize('span', [
    'tests/angen_sim/sim/leaping_test.cpp', 'metering_test', 'test_nothing.py', 'sim/nothing.h',
    'angen fly', 'Simulation::fly', 'FlyingCarpet', 'nothing.cpp'])
def test_a_name_of_nothing_is_found(span: str) -> None:
    assert unknown(span, set())


@pytest.mark.parametrize('span', [
    'tests/angen_sim/sim/meter_test.cpp', 'meter_test', 'test_physics.py', 'sim/simulation.h',
    'angen check FILE', './angen run world:=FILE', 'Simulation::leap', 'MoverIndex',
    'tests/angen_tools/'])
def test_a_name_that_exists_is_not(span: str) -> None:
    assert not unknown(span, set())
