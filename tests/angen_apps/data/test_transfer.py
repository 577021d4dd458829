"""A classifier that learns in one home and is tested in another."""
from __future__ import annotations

import datetime
import random
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from angen_apps.data import realism, transfer
from angen_tools.common.failure import Failure

pytestmark = pytest.mark.skipif(find_spec('sklearn') is None, reason='needs scikit-learn')
# activity, its sensors, first hour and hours
DAY = (('Sleeping', (1, 2), 0, 7), ('Meal_Preparation', (3, 4), 7, 1), ('Relax', (5,), 8, 4),
       ('Meal_Preparation', (3, 4), 12, 1), ('Relax', (5, 6), 13, 8), ('Sleeping', (1, 2), 21, 3))


def home(path: Path, days: int, first: int, shuffled: bool = False) -> Path:
    """A home whose sensors are numbered from `first`; if shuffled its labels mean nothing."""
    numbers = random.Random(first)
    lines = []
    for day in range(days):
        names = [name for name, *_ in DAY]
        if shuffled:
            numbers.shuffle(names)
        for name, (_, sensors, hour, hours) in zip(names, DAY):
            begin = datetime.datetime(2026, 3, 2 + day, hour)
            at = sorted(numbers.sample(range(60, hours * 3600 - 60), 30 * hours))
            for i, second in enumerate(at):
                label = ' begin' if i == 0 else ' end' if i == len(at) - 1 else ''
                time = begin + datetime.timedelta(seconds=second)
                lines.append(f'{time}.5\tM{first + numbers.choice(sensors):03d}\t'
                             f'{"ON" if i % 2 == 0 else "OFF"}'
                             + (f'\t{name}{label}' if label else ''))
    path.write_text('\n'.join(lines) + '\n')
    return path


def rooms(path: Path, first: int) -> Path:
    use = ('bedroom', 'bedroom', 'kitchen', 'kitchen', 'living', 'living')
    path.write_text(''.join(f'M{first + i:03d},{one}\n' for i, one in enumerate(use, 1)))
    return path


def test_what_holds_in_one_home_is_known_in_another(tmp_path, monkeypatch):
    monkeypatch.setattr(transfer, 'WINDOWS', 2000)
    monkeypatch.setattr(transfer, 'TREES', 10)
    real = home(tmp_path / 'real.txt', 5, 20)
    uses = transfer._uses
    monkeypatch.setattr(transfer, '_uses', lambda path, listed: uses(path, listed) or (
        uses(path, rooms(tmp_path / 'ours.csv', 40)) if path.name.startswith('ours') else {}))
    for listed in (rooms(tmp_path / 'rooms.csv', 20), None):  # given, and by the labels
        ours = dict(transfer.transfer([home(tmp_path / 'ours.txt', 3, 40)], real, listed))
        assert ours['ours'] > 0.9 and ours['ours and 10% of these days'] > 0.9, ours
        assert ours['commonest activity'] < 0.4
    nothing = home(tmp_path / 'ours_shuffled.txt', 3, 40, shuffled=True)
    assert dict(transfer.transfer([nothing], real, listed))['ours'] < 0.7


def test_features_do_not_depend_on_how_many_sensors_see_the_same(tmp_path):
    stream = realism.read(home(tmp_path / 'real.txt', 2, 20))
    use = transfer._uses(tmp_path / 'real.txt', rooms(tmp_path / 'rooms.csv', 20))
    twice = realism.Stream(np.repeat(stream.time, 2), [name for one in stream.sensor
                                                       for name in (one, one + 'b')],
                           [one for one in stream.value for _ in range(2)], stream.did)
    use_twice = {**use, **{name + 'b': one for name, one in use.items()}}
    one, two = (transfer.minutes(*args, ['M']).features
                for args in ((stream, use), (twice, use_twice)))
    assert np.allclose(one, two)


def test_macro_f1_is_the_mean_over_the_activities_of_the_test():
    true, said = np.array(['a', 'a', 'b', 'b']), np.array(['a', 'b', 'b', 'b'])
    assert transfer._f1(true, said) == pytest.approx((2 / 3 + 4 / 5) / 2)


@pytest.mark.parametrize('text, message', [
    ('2026-03-02 08:00:00 M001 ON Relax begin\n2026-03-02 09:00:00 M001 OFF Relax end\n',
     r'real\.txt: has labels on 1 day; needs two'),
    ('2026-03-02 08:00:00 M001 ON\n', r'real\.txt: has labels on 0 days; needs two')])
def test_a_file_without_labels_is_said(tmp_path, text, message):
    real = tmp_path / 'real.txt'
    real.write_text(text)
    with pytest.raises(Failure, match=message):
        transfer.transfer([real], real, None)
    with pytest.raises(Failure, match=r'rooms\.csv:2: must be a sensor and one of kitchen'):
        (tmp_path / 'rooms.csv').write_text('M001 kitchen\nM002 garage\n')
        transfer._uses(real, tmp_path / 'rooms.csv')


def test_who_walks_around_is_told_from_who_stays() -> None:
    time = np.array([60.0, 65.0, 70.0, 180.0, 185.0, 190.0])
    stays, walks = (transfer.minutes(
        realism.Stream(time, names, ['ON'] * 6, []), dict.fromkeys(names, 'living'), ['M']).features
        for names in (['M001'] * 6, ['M001'] * 3 + ['M001', 'M002', 'M003']))
    assert (walks[3] > stays[3]).any() and (walks[0] == stays[0]).all()


def test_seats_and_plugs_count_for_as_long_as_they_are_in_use() -> None:
    stream = realism.Stream(np.array([30.0, 60.0, 150.0, 180.0, 195.0]),
                            ['I001', 'I002', 'I001', 'I002', 'S001'],
                            ['PRESENT', 'PRESENT', 'ABSENT', 'ABSENT', 'ON'], [])
    found = transfer._in_use(stream, {'I001': 'living', 'I002': 'kitchen'}, 'I', 4)
    assert found[transfer.USES.index('living')].tolist() == [0.5, 1.0, 0.5, 0.0]
    assert found[transfer.USES.index('kitchen')].tolist() == [0.0, 1.0, 1.0, 0.0]
    plugs = transfer._in_use(stream, {}, 'S', 5)  # of no room, and on until the end
    assert plugs[transfer.USES.index(transfer.OTHER)].tolist() == [0.0, 0.0, 0.0, 0.75, 1.0]
    assert found.sum() == 4.0 and plugs.sum() == 1.75


def test_minutes_of_sensors_that_report_no_movement() -> None:
    stream = realism.Stream(np.array([1.0, 70.0]), ['M001', 'D001'], ['OFF', 'CLOSE'], [])
    made = transfer.minutes(stream, {}, ['M', 'D'])
    assert made.features.shape[0] == transfer.MINUTES and np.isfinite(made.features).all()
