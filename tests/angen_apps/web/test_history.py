"""The readings of a run are kept within bounds, without the loss of a peak."""
import csv
import io
import json
import sys
from typing import Any

import pytest

from angen_apps.web import history as module
from angen_apps.web.history import LEAST, MOST, History, numbers
from tests.angen_apps.web.test_server import Running, run

FIELDS = {'lux': [{'name': 'illuminance', 'type': 'number', 'unit': 'lx'},
                  {'name': 'fault', 'type': 'flag', 'unit': ''}]}


def test_older_readings_get_fewer_and_peaks_stay() -> None:
    history = History()
    for i in range(20_000):
        history.put('lux', 'a', i / 10, [500.0 if i == 100 else i % 7, None])
    times, values = history.of('lux', 'a', 0)
    assert MOST / 2 < len(times) <= MOST and times == sorted(times)
    assert (times[0], times[-1], max(values), min(values)) == (0.0, 1999.9, 500.0, 0.0)
    assert times[values.index(500.0)] == 10.0
    assert times[-1000:] == pytest.approx([i / 10 for i in range(19_000, 20_000)])
    assert history.of('lux', 'a', 1) == history.of('lux', 'b', 0) == ([], [])


def test_a_level_line_has_two_ends() -> None:
    history = History()
    for i in range(100):
        history.put('lux', 'a', float(i), [5.0])
    history.put('lux', 'a', 50.0, [7.0])  # older than the last
    history.put('lux', 'a', 100.0, [6.0])
    assert history.of('lux', 'a', 0) == ([0.0, 99.0, 100.0], [5.0, 5.0, 6.0])


def test_memory_is_bounded_for_many_sensors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, 'TOTAL', 10_000)
    history = History()
    for i in range(600):
        for name in range(100):
            history.put('lux', str(name), float(i), [float(i % 3), float(i % 2)])
    assert 200 * LEAST / 2 < len(history) <= 200 * LEAST
    size = sum(sys.getsizeof(one.times) + sys.getsizeof(one.values)
               for one in history._series.values())
    assert size < 200 * LEAST * 16 * 2


def test_memory_is_bounded_while_sensors_come_and_go(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, 'SERIES', 10)
    history = History()
    for name in range(1000):
        history.put('lux', str(name), 1.0, [1.0, 2.0])
    assert len(history._series) == 10
    assert history.of('lux', '999', 1) == ([1.0], [2.0])


def test_the_table_names_fields_and_units() -> None:
    history = History()
    history.put('lux', 'old, "one"', 1.5, [20.25, 1.0])
    history.put('unknown', 'b', 2.0, [3.0])
    rows = list(csv.DictReader(io.StringIO(''.join(history.table(FIELDS)))))
    assert [list(row.values()) for row in rows] == [
        ['1.5', 'lux', 'old, "one"', 'illuminance', '20.25', 'lx'],
        ['1.5', 'lux', 'old, "one"', 'fault', '1', ''], ['2', 'unknown', 'b', '0', '3', '']]
    history.clear()
    assert list(history.table(FIELDS)) == ['time,kind,name,field,value,unit\n']


def test_fields_with_values() -> None:
    assert numbers({}) == []
    assert [field['name'] for field in numbers({'fields': [
        {'name': 'a', 'type': 'flag'}, {'name': 'b', 'type': 'text'},
        {'name': 'c', 'type': 'number'}]})] == ['a', 'c']


def test_the_server_gives_what_it_has() -> None:
    async def test(server: Running) -> None:
        store: Any = server.source.store
        store.put_rows([('lamp', 'k', 'ON', False, 2.0, [0.5])], True)
        store.put_rows([('lamp', 'k', '', False, 3.0, [0.7])], False)  # no reading
        store.put_rows([('lamp', 'k', 'ON', False, 4.0, [0.9])], False)
        path = '/history.json?kind=lamp&name=k&field='
        assert json.loads((await server.get(f'{path}level'))[1]) == {'t': [2, 4], 'v': [0.5, 0.9]}
        for wrong in ('', 'color', '%00'):
            assert (await server.get(f'{path}{wrong}'))[0] == 404
        assert (await server.get('/history.json?kind=x'))[0] == 404
        assert (await server.get('/readings.csv'))[1].splitlines() == [
            'time,kind,name,field,value,unit', '2,lamp,k,level,0.5,%', '4,lamp,k,level,0.9,%']
    run(test, kinds={'lamp': {'fields': [{'name': 'level', 'type': 'number', 'unit': '%'}]}})
