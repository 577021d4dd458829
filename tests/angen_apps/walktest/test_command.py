"""Walk tests that PIRs pass and fail."""
import csv
import math

import pytest

from angen_apps.cli.walktest import PROFILES
from angen_apps.walktest import command as walktest
from angen_apps.walktest.plan import Area
from angen_tools.cli import main as cli

SMALL = {'major': Area(5.0, 60.0), 'radial': Area(3.0, 60.0), 'minor': Area(2.0, 60.0),
         'close': Area(2.0, 60.0)}


def run(tmp_path, model='pyroelectric', settings=(), turn=0.0, profile='iec63180'):
    """The verdict on a detector that covers little, and its CSV's rows."""
    tested = walktest.detector(model, settings, turn)
    tested = walktest.Detector(tested.model, tested.xml, tested.height, tested.yaw, SMALL)
    passed = walktest.run(profile, tested, tmp_path)
    assert (tmp_path / f'walktest_{profile}_{model}.png').stat().st_size > 10_000
    with (tmp_path / f'walktest_{profile}_{model}.csv').open(encoding='utf-8') as file:
        return passed, list(csv.DictReader(file))


@pytest.mark.parametrize('profile', PROFILES)
def test_a_pyroelectric_pir_passes(tmp_path, profile):
    passed, rows = run(tmp_path, profile=profile)
    assert passed and {row['detected'] for row in rows} >= {'yes'}


def test_one_that_looks_at_the_wall_fails_everywhere(tmp_path):
    passed, rows = run(tmp_path, turn=math.pi)
    assert not passed and all(row['detected'] == 'no' for row in rows)


def test_one_with_half_its_zones_taped_over_fails_on_that_side(tmp_path):
    passed, rows = run(tmp_path, settings=[('tape', '0 3.14 -1.57 1.57')])
    left = [row for row in rows if float(row['y']) > 0.6 and row['test'] == 'tangential']
    right = [row for row in rows if float(row['y']) < -0.6 and row['test'] == 'tangential']
    assert not passed
    assert all(row['detected'] == 'no' for row in left)
    assert all(row['detected'] == 'yes' for row in right)


def test_range_differences_fail(tmp_path):
    passed, rows = run(tmp_path, model='range_difference')
    assert not passed and any(row['detected'] == 'yes' for row in rows)


def test_wrong_arguments_are_reported(capsys):
    for words in (['--profile', 'iso'], ['--profile', 'nema-wd7', '--model', 'magic'],
                  ['--profile', 'nema-wd7', '--turn', 'left']):
        with pytest.raises(SystemExit) as end:
            cli.run(['walktest', *words])
        assert end.value.code == 2
    assert cli.run(['walktest', '--profile', 'nema-wd7', '--set', 'colour=red']) == 1
    assert "no parameter 'colour'" in capsys.readouterr().err


def test_an_error_of_its_world_is_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(walktest, 'room', lambda *_: '<sdf version="1.6"><world name="walktest"/>')
    assert cli.run(['walktest', '--profile', 'nema-wd7', '--out', str(tmp_path)]) == 1
    said = capsys.readouterr().err
    assert said.startswith('angen: <text>:1: ') and said.count('\n') == 1
