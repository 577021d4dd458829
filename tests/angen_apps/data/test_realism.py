"""Distances and figures, against closed forms."""
import gzip

import numpy as np
import pytest

from angen_apps.data import realism
from angen_tools.common.failure import Failure


def test_distances_are_those_of_their_definitions():
    assert realism.ks(np.array([1.0, 2, 3, 4]), np.array([3.0, 4, 5, 6])) == 0.5
    assert realism.ks(np.arange(9.0), np.arange(9.0)) == 0


@pytest.mark.parametrize('fraction, separator', [('.250000', '\t'), ('', ' ')])
def test_files_of_casas_are_read_with_tabs_or_blanks(tmp_path, fraction, separator):
    file = tmp_path / 'aruba.txt'
    lines = [('2010-11-04', f'00:03:50{fraction}', 'M003', 'ON', 'Sleeping begin'),
             ('2010-11-04', f'00:03:52{fraction}', 'M003', 'OFF'),
             ('2010-11-05', f'00:03:52{fraction}', 'M004', 'ON'),
             ('2010-11-05', f'00:03:53{fraction}', 'M004', 'OFF', 'Sleeping end')]
    file.write_text('\n'.join(separator.join(line) for line in lines) + '\n')
    stream = realism.read(file)
    found = realism.measures(stream)
    assert found['events a day'] == 2 and found['ON time p50, s'] == 1.5
    assert realism.durations(stream)['sleep'] == [86403.0]
    file.write_text('hello\n')
    with pytest.raises(Failure, match=r'aruba\.txt:1: is not an event'):
        realism.read(file)


@pytest.mark.parametrize('when, what', [
    ('2010-13-45 00:00:00', 'is not a date and time'), ('2010-11-04 25:61:00', 'is not a date'),
    ('9999-12-31 00:00:00', 'must be in the 36525 days from 2010-11-04 on'),
    ('2010-11-03 23:59:59', 'must be in the 36525 days from 2010-11-04 on')])
def test_a_time_of_casas_that_cannot_be(when, what, tmp_path):
    file = tmp_path / 'aruba.txt'
    file.write_text(f'2010-11-04 00:03:50 M003 ON\n{when} M003 OFF\n')
    with pytest.raises(Failure, match=rf'aruba\.txt:2: {when} {what}'):
        realism.read(file)


def test_what_is_outside_comes_first():
    time = np.arange(0, 86400, 1000.0)
    values = ['ON' if i % 2 == 0 else 'OFF' for i in range(len(time))]
    stream = realism.Stream(time, ['M001'] * len(time), values, [])
    verdicts = [row[3] for row in realism.compare(stream, None)]
    assert verdicts[0] != 'within' and verdicts == sorted(verdicts, key=lambda v: v == 'within')


def test_an_activity_lasts_from_its_first_place_to_its_last(tmp_path):
    lines = ['start,end,resident,activity,phase', '0,10,anna,cook,goes', '10,40,anna,cook,does',
             '20,90,bert,cook,does', '40,45,anna,cook,goes', '45,100,anna,cook,does',
             '100,130,anna,eat,goes', '90,95,bert,read,does']
    with gzip.open(tmp_path / 'truth.csv.gz', 'wt') as file:
        file.write('\n'.join(lines) + '\n')
    (tmp_path / 'events.csv.gz').write_bytes(gzip.compress(b'time,sensor,value,room\n'))
    lasted = realism.durations(realism.read(tmp_path))
    assert {name: sorted(times) for name, times in lasted.items()} == {
        'cook': [70.0, 90.0], 'read': [5.0]}


def labeled(tmp_path, *lines):
    """A file of CASAS with these lines: day, time, sensor, value, label."""
    file = tmp_path / 'home.txt'
    file.write_text('\n'.join(f'2026-03-{2 + int(line.split()[0]):02d} ' + line.split(None, 1)[1]
                              for line in lines) + '\n')
    return realism.measures(realism.read(file))


def test_rows_of_labeled_activities_are_those_of_their_definitions(tmp_path):
    found = labeled(
        tmp_path, '0 07:00:00 M001 ON Sleeping begin', '0 07:00:10 M001 OFF Sleeping end',
        '0 08:00:00 M002 ON Meal_Preparation begin', '0 08:00:10 M002 OFF',
        '0 08:01:00 M002 ON', '0 08:02:00 M002 OFF Meal_Preparation end',
        '0 09:00:00 M002 ON Cook begin', '0 09:04:00 M002 OFF Cook end',
        '0 23:00:00 M001 ON Sleeping begin', '1 04:00:00 M001 OFF Sleeping end',
        '1 04:10:00 M001 ON Sleeping begin', '1 09:00:00 M001 OFF Sleeping end',
        '1 14:00:00 M001 ON Sleeping begin', '1 15:00:00 M001 OFF Sleeping end')
    assert found['cook: a day'] == 1.0 and found['cook: median, min'] == 3.0
    assert found['cook: CV of the count a day'] == 1.0  # two on one day, none on the other
    assert found['cook: motion ON a minute'] == pytest.approx(3 / 6)
    # 7:00:10 and 9:00, past a short time awake and a nap
    assert found['getting up: standard deviation, h'] == pytest.approx(1.0, abs=0.002)
    # gaps within: 10, 10, 50, 60, 240 s, 5 h, 4:50 h, 1 h
    assert found['gap in an activity p95, s'] == pytest.approx(
        np.percentile([10, 10, 50, 60, 240, 18000, 17400, 3600], 95))
    assert 'eat: motion ON a minute' not in found


def test_residents_have_labels_and_hours_of_their_own(tmp_path):
    found = labeled(
        tmp_path, '0 05:00:00 M001 ON R1_Sleeping begin', '0 06:00:00 M001 ON R2_Sleeping begin',
        '0 07:00:00 M001 OFF R1_Sleeping end', '0 10:00:00 M001 OFF R2_Sleeping end',
        '1 05:00:00 M001 ON R1_Sleeping begin', '1 06:00:00 M001 ON R2_Sleeping begin',
        '1 07:00:00 M001 OFF R1_Sleeping end', '1 10:00:00 M001 OFF R2_Sleeping end')
    assert found['getting up: standard deviation, h'] == pytest.approx(0.0, abs=1e-6)
    assert found['all: CV of the count a day'] == 0.0


def test_a_reference_without_on_times_is_named(tmp_path):
    own, other = tmp_path / 'own.txt', tmp_path / 'other.txt'
    own.write_text('2026-03-02 07:00:00 M001 ON\n2026-03-02 07:00:09 M001 OFF\n')
    other.write_text('2026-03-02 07:00:00 M001 ON\n2026-03-02 07:00:09 D001 OPEN\n')
    with pytest.raises(Failure, match=r'other\.txt: has no sensor M… with ON and then OFF'):
        realism.compare(realism.read(own), realism.read(other))
