"""The plans of situations: who is where, the way, and the outcome in its color."""
from pathlib import Path

import pytest

from angen_apps.situations import command, figure, stage
from angen_apps.situations.stage import Outcome
from angen_tools.cli import main as cli
from angen_tools.common.files import pyplot


def test_a_way_is_that_of_the_row() -> None:
    row, = command.rows('an adult walks across at 2 m')
    part, = stage.parts_of(row)
    way = figure._way(part)
    assert way[0, :2] == pytest.approx((2.0, -1.5)) and way[-1, :2] == pytest.approx(
        (2.0, 1.5), abs=0.11)


def test_a_failure_is_red_and_has_the_expectation(tmp_path: Path) -> None:
    row, = command.rows('behind a wardrobe')
    made, axis = pyplot().subplots()
    outcomes = [Outcome(row, 'pyroelectric', got, 1e-4, 3e-4) for got in ('still', 'motion')]
    figure._draw_row(axis, outcomes, tmp_path / 'row.world')
    shown = {text.get_text(): text.get_color() for text in axis.texts}
    assert shown['pyroelectric: still, 100 µV'] == figure.PASSED
    assert shown['pyroelectric: motion, 100 µV; expected still'] == figure.FAILED
    assert {'adult', 'box', 'detector'} <= shown.keys()
    pyplot().close(made)


def test_the_command_draws_its_rows(tmp_path: Path) -> None:
    path = tmp_path / 'plan.png'
    assert cli.run(['situations', '--only', 'sits still at 3 m', '--plan', str(path)]) == 0
    assert path.read_bytes().startswith(b'\x89PNG')
