"""Reads written data by readers that follow the published formats and share no code."""
import csv
import datetime
import gzip
import re
import xml.etree.ElementTree as xml
from dataclasses import replace

import pytest

from angen_apps.data.formats import FORMATS
from angen_apps.data.recorder import Event
from angen_tools.common.failure import Failure
from tests.angen_apps.data.synthetic import data, doing


def test_aruba_has_tabs_six_digits_and_one_space_before_begin_and_end(tmp_path):
    [path] = FORMATS['casas'](tmp_path, data())
    lines = path.read_text().splitlines()
    assert lines[0] == '2026-03-23\t00:00:00.000000\tT001\t21.5'
    assert lines[1] == '2026-03-23\t00:00:03.250000\tM001\tON\tSleeping begin'
    assert lines[3].startswith('2026-03-23\t00:01:44.000001\tI001\tPRESENT\tEating begin')
    pattern = re.compile(r'\d{4}-\d\d-\d\d\t\d\d:\d\d:\d\d\.\d{6}\t[MDTI]\d{3}\t'
                         r'(ON|OFF|OPEN|CLOSE|PRESENT|ABSENT|\d+(\.[05])?)'
                         r'(\t[A-Za-z0-9_]+ (begin|end))?')
    assert all(pattern.fullmatch(line) for line in lines)
    turns = [line.split('\t')[4] for line in lines if line.count('\t') == 4]
    assert turns == ['Sleeping begin', 'Sleeping end', 'Eating begin', 'Eating end']


def test_of_several_residents_labels_say_whose_they_are(tmp_path):
    [path] = FORMATS['casas'](tmp_path, data(2))
    assert 'R1_Sleeping begin' in path.read_text()


def test_labels_of_who_comes_home_alternate(tmp_path):
    whole = data()
    whole.truth[:] = [doing(0, 100, 'anna', 'leave', 'away'),
                      doing(100, 103, 'anna', 'eat', 'goes'), doing(103, 300, 'anna', 'eat'),
                      doing(300, 86400, 'anna', 'read', 'goes')]
    times = (101.0, 102.0, 150.0, 159.0, 161.0, 200.0, 290.0, 400.0)
    whole.events[:] = [Event(at, 'M001', value, 'anna', 'eat', 'motion')
                       for at, value in zip(times, 4 * ('ON', 'OFF'))]
    [path] = FORMATS['casas'](tmp_path, whole)
    turns = [(line.split('\t')[1], line.split('\t')[4]) for line in path.read_text().splitlines()
             if line.count('\t') == 4]
    assert turns == [('00:01:41.000000', 'Enter_Home begin'), ('00:02:39.000000', 'Enter_Home end'),
                     ('00:02:41.000000', 'Eating begin'), ('00:04:50.000000', 'Eating end')]


def test_newer_columns_label_each_event(tmp_path):
    [path] = FORMATS['casas-columns'](tmp_path, data())
    rows = list(csv.DictReader(path.open(), delimiter='\t'))
    assert rows[4]['Sensor'] == 'M001' and rows[4]['Activity'] == 'Eating'
    assert rows[4]['SensorType'] == 'Control4-Motion' and rows[4]['Resident'] == 'anna'
    assert rows[4]['Translate01'] == 'kitchen' and rows[4]['Message'] == 'ON'


def test_aras_has_a_line_a_second_of_22_numbers(tmp_path):
    paths = FORMATS['aras'](tmp_path, data(2))
    names = (tmp_path / 'aras/columns.txt').read_text().splitlines()
    column = next(int(n.split('\t')[0]) - 1 for n in names if '\tM001\t' in n)
    lines = [list(map(int, line.split(' '))) for line in paths[-1].read_text().splitlines()]
    assert len(lines) == 86400 and {len(line) for line in lines} == {22}
    assert [s for s in range(86400) if lines[s][column]] == [3, 4, 5, 150, 151]
    assert lines[50][20:] == [11, 18] and lines[120][20:] == [4, 18]  # asleep, breakfast; reads
    assert lines[40000][20] == 2  # going out
    many = data(2)
    many.residents.append(('clara', 'child'))
    with pytest.raises(Failure, match='aras has 2 residents, the home has 3'):
        FORMATS['aras'](tmp_path, many)


def test_kasteren_has_pairs(tmp_path):
    FORMATS['kasteren'](tmp_path, data())
    rows = [line.split('\t') for line in
            (tmp_path / 'kasteren/sensors.txt').read_text().splitlines()]
    ids = {line.split('\t')[1]: line.split('\t')[0] for line in
           (tmp_path / 'kasteren/sensor_names.txt').read_text().splitlines()}
    seat = next(row for row in rows if row[2] == ids['I001'])
    clock = '%d-%b-%Y %H:%M:%S'
    assert datetime.datetime.strptime(seat[0], clock) == datetime.datetime(2026, 3, 23, 0, 1, 44)
    assert datetime.datetime.strptime(seat[1], clock) == datetime.datetime(2026, 3, 23, 0, 3, 19)
    assert seat[3] == '1'
    acts = (tmp_path / 'kasteren/activities_anna.txt').read_text().splitlines()
    assert [line.split('\t')[2] for line in acts] == ['10', '1']  # to bed, leaves the house


def test_openshs_has_a_line_a_second_with_activity_and_time(tmp_path):
    [path] = FORMATS['openshs'](tmp_path, data())
    rows = list(csv.DictReader(path.open()))
    assert len(rows) == 86400 and list(rows[0])[-2:] == ['Activity', 'timestamp']
    assert rows[4]['kitchen_M001'] == '1' and rows[7]['kitchen_M001'] == '0'
    assert rows[50]['Activity'] == 'sleep' and rows[120]['Activity'] == 'eat'
    assert rows[-1]['timestamp'] == '2026-03-23 23:59:59'


def test_the_long_table_and_power_are_the_same_bytes_again(tmp_path):
    for folder in ('a', 'b'):
        for name in ('csv', 'power'):
            FORMATS[name](tmp_path / folder, data())
    for name in ('events.csv.gz', 'power.csv.gz'):
        assert (tmp_path / 'a' / name).read_bytes() == (tmp_path / 'b' / name).read_bytes()
    rows = list(csv.DictReader(gzip.open(tmp_path / 'a/events.csv.gz', 'rt')))
    assert len(rows) == 8 and rows[3]['cause'] == 'seat' and rows[3]['resident'] == 'anna'
    watts = list(csv.DictReader(gzip.open(tmp_path / 'a/power.csv.gz', 'rt')))
    assert len(watts) == 86400 and sum(float(row['mains']) for row in watts) == 60.0 * 9
    zone = datetime.timezone.utc
    at = datetime.datetime.fromtimestamp(int(watts[11]['time']), zone)
    assert at == datetime.datetime(2026, 3, 23, 0, 0, 11, tzinfo=zone)
    assert watts[11]['lamp/kitchen'] == '60' and watts[10]['lamp/kitchen'] == '0'


def test_xes_is_xml_whose_starts_complete(tmp_path):
    [path] = FORMATS['xes'](tmp_path, data())
    space = {'x': 'http://www.xes-standard.org/'}
    traces = xml.parse(path).getroot().findall('x:trace', space)
    turns: dict = {}
    for event in traces[0].findall('x:event', space):
        values = {part.get('key'): part.get('value') for part in event}
        turns.setdefault(values['concept:name'], []).append(values['lifecycle:transition'])
    assert turns == {name: ['start', 'complete'] for name in ('sleep', 'eat', 'leave')}


def test_parquet_reports_a_missing_package_or_is_read_again(tmp_path):
    try:
        import pyarrow.parquet
    except ImportError:
        with pytest.raises(Failure, match='parquet needs pyarrow'):
            FORMATS['parquet'](tmp_path, data())
        return
    [path] = FORMATS['parquet'](tmp_path, data())
    table = pyarrow.parquet.read_table(path)
    assert table.num_rows == 8 and table.schema.field('time').type == pyarrow.timestamp('us')
    assert table['time'][3].as_py() == datetime.datetime(2026, 3, 23, 0, 1, 44, 1)
    assert table['resident'].to_pylist()[:2] == [None, 'anna']
    empty = replace(data(), events=[])
    assert pyarrow.parquet.read_table(*FORMATS['parquet'](tmp_path, empty)).schema == table.schema
