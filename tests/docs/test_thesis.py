"""docs/thesis.md has a row for each section, figure and appendix, whose command runs."""
import re
from typing import Iterator

import pytest

from tests.docs.pages import PAGES, ROOT
from tests.docs.test_commands import LEFT_OUT, Terminal, steps

PAGE = (ROOT / 'docs/thesis.md').read_text()
SECTIONS = '''1.1 1.1.1 1.2 1.3 1.4 1.5 2.1 2.2 2.2.1 2.2.2 2.3 2.3.1 2.3.2 2.3.3 2.4 2.5 2.5.1
2.5.2 2.5.3 2.6 3.1 3.2 3.2.1 3.3 3.3.1 3.3.1.1 3.3.1.2 3.3.2 3.3.2.1 3.3.2.2 3.3.3 3.3.3.1
3.3.3.2 3.4 3.4.1 3.4.2
3.5 3.5.1 3.5.2 3.5.2.1 3.5.2.2 3.5.3 3.5.3.1 3.5.3.2 3.5.4 3.5.4.1 3.5.4.2 3.5.5 3.5.5.1
3.5.5.2 4.1 4.1.1 4.2 4.3 4.3.1 4.3.2 4.4 5.1 5.2'''.split()
FIGURES = ['1.1', '2.1', '2.2', '2.3', *(f'3.{k}' for k in range(1, 17)),
           *(f'4.{k}' for k in range(1, 15))]
APPENDICES = '''A A.1 A.1.1 B B.1 B.1.1 B.1.2 B.1.3 C C.0.4 C.0.5 C.0.6 C.0.7 C.0.8 C.1 D D.0.1
D.0.2 D.0.3 D.0.4 D.0.5'''.split()
# Hands, minutes, or another simulator than the one that runs.
NOT_HERE = re.compile(r'\./angen (run|demo|bench|build)|rosrun angen_tools drive_base')


def rows(heading: str) -> list[list[str]]:
    """The cells of the table below a heading."""
    text = PAGE.split(f'## {heading}\n', 1)[1].split('\n## ')[0]
    lines = [line for line in text.splitlines() if line.startswith('| ')]
    return [[cell.strip() for cell in line.strip('|').split(' | ')] for line in lines[1:]]


ROWS = [row for heading in ('Sections', 'Figures', 'Appendices') for row in rows(heading)]
COMMANDS = list(dict.fromkeys(row[2].strip('`') for row in ROWS))
FIGURE = 'python3 docs/thesis_figures.py -o out '  # and a name: one run draws all, with one start
OF_PAGES = {line.strip() for page in PAGES for _, text in steps(page) for line in text.splitlines()}


@pytest.mark.parametrize('heading, numbers', [
    ('Sections', SECTIONS), ('Figures', FIGURES), ('Appendices', APPENDICES)])
def test_each_has_a_row(heading: str, numbers: list[str]) -> None:
    found = [number for row in rows(heading) for number in row[0].split(', ')]
    assert sorted(found) == sorted(numbers)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row[0])
def test_each_row_has_a_command_and_a_page(row: list[str]) -> None:
    assert len(row) == 4
    assert re.fullmatch(r'`[^`]+`', row[2])
    assert re.fullmatch(r'(\[[^]]+\](, (?=\[))?)+', row[3])
    for name in re.findall(r'\[([^]]+)\]', row[1] + row[3]):
        assert f'\n[{name}]: ' in PAGE


@pytest.fixture(scope='module')
def terminal(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Terminal]:
    made = Terminal(tmp_path_factory.mktemp('checkout'))
    yield made
    made.end()


def commands() -> list[str]:
    here = [command for command in COMMANDS
            if not NOT_HERE.match(command) and command not in OF_PAGES]
    names = [command.removeprefix(FIGURE) for command in here if command.startswith(FIGURE)]
    return [FIGURE + ' '.join(names),
            *(command for command in here if not command.startswith(FIGURE))]


@pytest.mark.ros
@pytest.mark.parametrize('command', commands())
def test_its_command_runs(command: str, terminal: Terminal) -> None:
    if not command.startswith(FIGURE):  # those need no simulator
        terminal.simulate('')
    terminal.run(command)


def test_what_is_left_out_is_run_elsewhere() -> None:
    """Tests of pages leave the same out; ./angen run is what every one of them starts."""
    left = [command for command in COMMANDS if NOT_HERE.match(command)]
    assert 5 <= len(left) <= 10
    for command in left:
        assert LEFT_OUT.match(command) or command.startswith('./angen run'), command
