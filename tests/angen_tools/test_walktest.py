"""angen walktest: its plan, and what it makes of good and bad detectors."""
import csv
import math

import pytest

from angen_tools import cli, walktest
from angen_tools.walktest_plan import Area, boundary, cells, crossings, walk
from angen_tools.walktest_words import PROFILES

SMALL = {'major': Area(5.0, 60.0), 'radial': Area(3.0, 60.0), 'minor': Area(2.0, 60.0),
         'close': Area(2.0, 60.0)}


def test_cells_fill_the_area_and_no_more():
    area = Area(6.0, 90.0)
    places = cells(area, 0.5)
    assert len(places) * 0.25 == pytest.approx(math.pi / 4 * (36 - 0.25), rel=0.06)
    assert all(area.holds(*place) for place in places)
    assert len(set(places)) == len(places)


def test_a_walk_crosses_every_cell_at_its_speed_and_stops_at_the_edges():
    probes = crossings(Area(4.0, 90.0), 1.0, 'across')
    way = walk(probes, 0.5, 2.0)
    for probe in probes:
        assert probe.ends - probe.begins == pytest.approx(2.0)
        middle = [(a + b) / 2 for a, b in zip(probe.start, probe.end)]
        assert middle == pytest.approx(probe.place)
    assert all(b.begins - a.ends >= 2.0 for a, b in zip(probes, probes[1:]))
    times = [point[0] for point in way.waypoints]
    assert times == sorted(set(times)) and way.duration == times[-1]


def test_towards_is_from_far_to_near():
    for probe in crossings(Area(4.0, 90.0), 1.0, 'towards'):
        assert probe.start[0] > probe.end[0] and probe.start[1] == probe.end[1]


def test_boundary_walks_end_inside():
    area = Area(8.0, 90.0)
    probes = boundary(area, 2.0, 3.0)
    assert len(probes) == 7
    for probe in probes:
        assert math.hypot(*probe.place) == pytest.approx(8.0)
        assert math.hypot(*probe.end) < 8.0 < math.hypot(*probe.start)
        assert math.dist(probe.start, probe.end) == pytest.approx(3.0)


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


def test_says_what_is_wrong_with_its_words(capsys):
    for words in (['--profile', 'iso'], ['--profile', 'nema-wd7', '--model', 'magic'],
                  ['--profile', 'nema-wd7', '--turn', 'left']):
        with pytest.raises(SystemExit) as end:
            cli.run(['walktest', *words])
        assert end.value.code == 2
    assert cli.run(['walktest', '--profile', 'nema-wd7', '--set', 'colour=red']) == 1
    assert "no parameter 'colour'" in capsys.readouterr().err
