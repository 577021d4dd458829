"""The output of care, and the commands of a day."""
import csv
from pathlib import Path

import pytest

from angen_tools.offline.day import read_day
from angen_apps.care.report import line_of, warnings_of, write, write_events
from angen_tools.session import Event
from tests.angen_apps.care.homes import H, Home, rule


@pytest.fixture
def home(tmp_path: Path) -> Home:
    made = Home(tmp_path, rule('open', '{is: door open, for: [1 min, 2 min]}')
                + rule('night', '{time: 22:00 to 6:00}', 'stove on'), starts='23:00')
    made.at(600.0, 'door/entrance0', 'opened')
    made.until(1 * H)
    made.changes += made.engine.acknowledge('open')
    made.at(2 * H, 'door/entrance0', 'closed')
    made.until(3 * H)
    return made


def rows(path: Path) -> list[dict[str, str]]:
    with path.open() as file:
        return list(csv.DictReader(file))


def test_a_line_has_time_rule_and_reason(home: Home) -> None:
    assert [line_of(change, 23 * H) for change in home.changes] == [
        '23:11:30  open raised, degree 0.50: so it is (door open since 23:10:00, 1 min 30 s '
        '(0.50))', '+1 d 00:00:00  open acknowledged', '+1 d 01:00:00  open ended']


def test_files_hold_every_warning(home: Home, tmp_path: Path) -> None:
    write(home.engine, tmp_path)
    warning, = rows(tmp_path / 'warnings.csv')
    assert (warning['rule'], warning['raised'], warning['degree'], warning['acknowledged'],
            warning['ended']) == ('open', '690.000', '0.500', '3600.000', '7200.000')
    write_events([Event(600.0, 'entrance0', 'door', 'opened'),
                  Event(7200.0, 'entrance0', 'door', 'closed')], home.changes, tmp_path)
    assert [(row['time'], row['source'], row['kind'], row['event'])
            for row in rows(tmp_path / 'events.csv')] == [
        ('600', 'entrance0', 'door', 'opened'),
        ('690', 'open', 'care', 'warning'),
        ('3600', 'open', 'care', 'acknowledged'),
        ('7200', 'entrance0', 'door', 'closed'),
        ('7200', 'open', 'care', 'ended')]


def test_a_warning_that_lasts_has_no_end(tmp_path: Path) -> None:
    lasting = Home(tmp_path, rule('open', 'door open'))
    lasting.at(5.0, 'door/entrance0', 'opened')
    write(lasting.engine, tmp_path)
    warning, = warnings_of(lasting.engine)
    assert warning.ended is None and rows(tmp_path / 'warnings.csv')[0]['ended'] == ''


def test_commands_come_in_the_order_of_the_day(tmp_path: Path) -> None:
    path = tmp_path / 'day.csv'
    path.write_text('time,target,command\n# at night\n5:30,door/a,Close\n6:10,lamp/b,Dim 40\n')
    first, second = read_day(path, 6 * H)
    assert (first.time, first.kind, first.name, first.text) == (600.0, 'lamp', 'b', 'Dim 40')
    assert second.time == 23.5 * H and second.where == f'{path}:3'
