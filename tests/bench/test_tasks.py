"""The rows of the tasks in imported homes."""
import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from angen_bench import tasks

SAID = ('angen: the robot does not reach attic\nangen: seek   5 %  the building is surveyed\n'
        'angen: x.yaml:3: rule a is left out: the home has no stove/*\n')


@pytest.mark.parametrize('answer, row', [
    ({'waypoints': 3, 'distance_m': 12.4, 'time_s': 60.2, 'collisions': 1},
     {'simulated s': 60, 'result': '3 of 5 rooms, 12 m, 1 collisions', 'left out': 2}),
    ({'found': True, 'room': 'hall', 'time_s': 9.0, 'collisions': 0},
     {'simulated s': 9, 'result': 'found in hall, 0 collisions', 'left out': 2}),
    ({'found': False, 'room': '', 'time_s': 600, 'collisions': 0},
     {'simulated s': 600, 'result': 'no person found, 0 collisions', 'left out': 2}),
    ([{'rule': 'a'}], {'simulated s': 3600, 'result': '1 warnings', 'left out': 2})])
def test_a_task_is_judged_by_its_answer(answer: object, row: dict[str, object]) -> None:
    assert tasks.judged(json.dumps(answer), SAID) == row


def test_a_task_without_an_answer_is_judged_by_its_last_line() -> None:
    found = tasks.judged('', SAID + 'angen: the robot is stuck at 1.00, 2.00 on floor 0\n')
    assert found['result'] == 'the robot is stuck at 1.00, 2.00 on floor 0'


def test_each_row_is_said_when_its_task_has_ended(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(tasks, 'cases', lambda *_: [SimpleNamespace(name='flat')])
    monkeypatch.setattr(tasks, 'import_case',
                        lambda *_: SimpleNamespace(path=tmp_path / 'flat.world'))
    said: list[str] = []

    def run(words: list[str], out: Path) -> dict[str, object]:
        said.append(capfd.readouterr().err)
        return {'ended': 'done', 'wall s': 3}

    monkeypatch.setattr(tasks, 'run', run)
    rows = tasks.measure(tmp_path)
    assert [row['task'] for row in rows] == ['demo', 'seek', 'care']
    assert 'plan flat, task demo, ended done, wall s 3' in said[1]
