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
    assert realism.durations(stream)['Sleeping'] == [86403.0]
    file.write_text('hello\n')
    with pytest.raises(Failure, match=r'aruba\.txt:1: is not an event'):
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
