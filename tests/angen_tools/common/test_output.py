"""Tables for people and for pipes."""
import io
import os
import subprocess
import sys

import pytest

from angen_tools.common.output import console, number, plain, table

ROWS = [('long', 'x' * 200, '1'), ('s', '[red]yy[/red] :smile:', '22')]


def test_columns_are_aligned_and_lines_have_no_blanks_at_their_end() -> None:
    assert plain(table(('A', 'B'), [('long', 'x'), ('s', 'yy')])) == 'A     B\nlong  x\ns     yy'


def test_numbers_can_stand_at_the_right() -> None:
    assert plain(table(('A', 'N'), [('a', '1'), ('b', '22')], right=('N',))) == (
        'A   N\na   1\nb  22')


@pytest.mark.parametrize('environment', [{}, {'COLUMNS': '20'}, {'FORCE_COLOR': '1'},
                                         {'TERM': 'xterm-256color', 'COLUMNS': '80'}])
def test_a_pipe_gets_each_row_whole_on_a_line_of_its_own(environment: dict[str, str]) -> None:
    code = ('import sys; sys.path.insert(0, sys.argv[1]); from test_output import ROWS; '
            'from angen_tools.common.output import show, table; show(table(("A", "B", "C"), ROWS))')
    printed = subprocess.run([sys.executable, '-c', code, os.path.dirname(__file__)], text=True,
                             env={**os.environ, **environment}, capture_output=True, check=True)
    lines = printed.stdout.splitlines()
    assert [line.split() for line in lines[1:]] == [' '.join(row).split() for row in ROWS]
    assert '\x1b' not in printed.stdout


def test_a_terminal_gets_its_width_and_loses_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('TERM', 'xterm')  # a dumb one has 80 columns
    text = io.StringIO()
    console(text, width=60, force_terminal=True, color_system=None).print(
        table(('A', 'B'), [('a', 'x' * 200)]))
    assert text.getvalue().count('x') == 200
    assert max(len(line) for line in text.getvalue().splitlines()) == 60


def test_a_live_table_has_one_line_a_row() -> None:
    text = io.StringIO()
    console(text, width=60, force_terminal=True, color_system=None).print(
        table(('A', 'B'), [('a', 'x' * 200), ('b', 'y')], one_line=True))
    assert [line.split()[0] for line in text.getvalue().splitlines()] == ['A', 'a', 'b']


def test_numbers_are_never_minus_zero() -> None:
    assert [number(v) for v in (-0.001, 1.005, -2.0)] == ['0.00', '1.00', '-2.00']
