"""Situations before a PIR: the table itself, a quick part of it, and how the command ends."""
import json
import math
from pathlib import Path

import pytest

from angen_apps.situations import command, figures, stage
from angen_apps.situations.cast import BEGINS, part_of
from angen_apps.situations.stage import Outcome
from angen_tools.cli import main as cli

# One of each sort, of the shortest.
QUICK = ('an adult walks across at 2 m', 'stands still at 3 m', 'sits down at 3 m',
         'falls aside at 5 m', 'crawls across at 3 m', 'a cat sleeps', 'a mouse runs',
         'as warm as the room sways', 'it sways before a cold pane', 'a fan heater glows',
         'a radiator warms', 'behind a pane of glass', 'behind a wardrobe',
         'a robot carries a pot')


def test_the_table_is_whole() -> None:
    rows, sources = command.rows(), command.sources()
    assert len(rows) >= 60 and len({row.scene for row in rows}) == len(rows)
    for row in rows:
        assert {row.expect, row.expect_range or 'still'} <= {'motion', 'still'}, row.scene
        assert row.source in sources and row.why and row.mount in stage.MOUNTS
        assert all(part_of(entry, 'part', 295.15) for entry in row.cast)
    expected = [row.expect for row in rows]
    assert min(expected.count(word) for word in ('motion', 'still')) > 25


@pytest.mark.parametrize('words', QUICK)
def test_a_situation_is_as_expected(words: str) -> None:
    row, = command.rows(words)
    for model in command.MODELS:
        if row.expected(model):
            outcome = stage.play(row, model)
            assert outcome.passed, outcome


def test_clothing_of_a_room_of_22_degrees_is_that_of_the_person() -> None:
    assert figures.clothing(295.15) == pytest.approx(299.0, abs=0.2)
    assert figures.skin(295.15) == 307.0


def test_a_figure_takes_the_postures_of_its_script() -> None:
    """The head of a person who sits down is where trigonometry says."""
    row, = command.rows('sits down at 2 m')
    world = stage.world_of(row, stage.parts_of(row))
    links = world.links
    waist, knee = (links.index(f'cast0::{name}') for name in ('waist', 'knee_left'))
    world.run(BEGINS - 0.5)
    assert world.link_poses[waist][:3] == pytest.approx([2.0, 0.0, figures.HIP], abs=0.01)
    world.run(3.0)
    assert world.link_poses[waist][:3] == pytest.approx([2.4, 0.0, 0.52], abs=0.01)
    assert world.link_poses[knee][2] == pytest.approx(
        0.52 - figures.THIGH * math.cos(1.45), abs=0.02)


def outcome(got: str) -> Outcome:
    return Outcome(command.rows('stands still at 3 m')[0], 'pyroelectric', got, 1e-4, 3e-4)


@pytest.mark.parametrize('got, code', [('still', 0), ('motion', 1), ('early', 1)])
def test_a_row_that_fails_ends_the_command_with_1(monkeypatch: pytest.MonkeyPatch, got: str,
                                                  code: int,
                                                  capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(command, 'play', lambda row, model: outcome(got))
    assert cli.run(['situations', '--only', 'stands still at 3 m', '--json']) == code
    first = json.loads(capsys.readouterr().out)[0]
    assert first['expected'] == 'still' and first['got'] == got and first['passed'] is (code == 0)
    assert cli.run(['situations', '--only', 'stands still at 3 m']) == code
    printed = capsys.readouterr().out
    assert ('FAIL' in printed) is (code == 1) and '\x1b' not in printed


def test_writes_the_table_into_a_page(monkeypatch: pytest.MonkeyPatch, tmp_path: Path,
                                      capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(command, 'play', lambda row, model: outcome('motion'))
    page = tmp_path / 'page.md'
    page.write_text('# Page\n<!-- situations -->\nold\n<!-- end -->\nrest\n')
    words = ['situations', '--only', 'stands still at 3 m', '--page', str(page)]
    assert cli.run(words) == 1
    text = page.read_text()
    assert '**FAIL: motion**' in text and 'old' not in text and text.endswith('rest\n')
    page.write_text('# Page\n')
    assert cli.run(words) == 1
    assert 'has no <!-- situations -->' in capsys.readouterr().err
