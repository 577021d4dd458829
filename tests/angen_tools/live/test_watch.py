"""The output of angen watch, and its missing rows."""
import subprocess
import sys
from pathlib import Path

import pytest

from angen_tools.common.failure import Failure
from angen_tools.live import watch
from angen_tools.live.summary import Filter, Row

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / 'src/angen_tools/scripts/angen'
ROWS = [Row('lamp', 'kitchen0', 'on  40 %', False, 1.0),
        Row('pir', 'kitchen_pir0', '', False, 0.0, (), 0.1)]


class Scene:
    """A board whose simulated time advances by `step` whenever it receives."""

    def __init__(self, step: float = 0.1, paused: bool = False) -> None:
        self.rows = {(row.kind, row.name): row for row in ROWS}
        self.time, self.paused, self._step = 0.0, paused, step

    def receive(self, limit: float) -> bool:
        self.time += self._step
        return True

    def chosen(self, rule: Filter) -> list[Row]:
        return [row for row in self.rows.values() if rule.passes(row.kind, row.name)]


def once(monkeypatch: pytest.MonkeyPatch, scene: Scene, **words: object) -> tuple[str, str]:
    monkeypatch.setattr(watch, 'Board', lambda world: scene)
    monkeypatch.setattr(watch, 'Live', object)
    shown, missing = watch.watch_once(Filter(**words), json=True)
    return str(shown), missing


def test_a_sensor_has_its_period_for_its_first_reading(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = Scene()
    shown, missing = once(monkeypatch, scene)
    assert 'kitchen_pir0' in shown and '"on  40 %"' in shown
    assert missing == 'no reading of pir kitchen_pir0: their period has passed'
    assert 0.1 + watch.MARGIN < scene.time < 0.1 + watch.MARGIN + 0.2


def test_it_does_not_wait_while_time_is_paused(monkeypatch: pytest.MonkeyPatch) -> None:
    assert 'is paused' in once(monkeypatch, Scene(step=0.0, paused=True))[1]


def test_it_waits_for_the_selection_only(monkeypatch: pytest.MonkeyPatch) -> None:
    shown, missing = once(monkeypatch, Scene(step=0.0), kinds=['lamp'])
    assert missing == '' and 'pir' not in shown


@pytest.mark.parametrize('words, part', [
    ({'names': ['kitchen']}, "no sensor or device named 'kitchen'; did you mean kitchen0"),
    ({'kinds': ['lampp']}, "no kind 'lampp'; did you mean lamp"),
    ({'kinds': ['pir,lamp']}, 'did you mean --kind pir --kind lamp')])
def test_a_filter_must_name_existing_entries(
        monkeypatch: pytest.MonkeyPatch, words: dict[str, object], part: str) -> None:
    with pytest.raises(Failure, match=part):
        once(monkeypatch, Scene(), **words)


def test_a_live_table_needs_a_terminal() -> None:
    done = subprocess.run([sys.executable, str(SCRIPT), 'watch'], text=True, timeout=60,
                          stdin=subprocess.DEVNULL, capture_output=True)
    assert done.returncode == 1 and '--once' in done.stderr and done.stdout == ''
