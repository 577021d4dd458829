"""Damaged files of a home's data: one line with the file and the line."""
from __future__ import annotations

import gzip
import json
from pathlib import Path
from typing import Any

import pytest

from angen_apps.data.tables import EVENTS, TRACK, rows
from angen_apps.data.validate import validate
from angen_tools.common.failure import Failure

LAYOUT: dict[str, Any] = {
    'start': '2026-03-02T00:00:00', 'days': 1, 'residents': [{'name': 'ann', 'speed': 1.0}],
    'rooms': [], 'doors': [], 'landings': [], 'things': [], 'sensors': []}


@pytest.mark.parametrize('layout, what', [
    ({'x': 1}, 'layout.json has no start'),
    ([], 'layout.json must be an object'),
    ({**LAYOUT, 'days': 'two'}, 'layout.json: days is two, which cannot be read'),
    ({**LAYOUT, 'days': float('nan')}, 'layout.json: days is nan'),
    ({**LAYOUT, 'start': 5}, 'layout.json: start is 5'),
    ({**LAYOUT, 'residents': [{'name': 'ann'}]}, 'layout.json: residents has no speed'),
    ({**LAYOUT, 'rooms': {}}, 'layout.json: rooms must be a list'),
    ({**LAYOUT, 'doors': [{'name': 'a', 'kind': 'door', 'width': 1, 'rooms': [], 'pose': [None]}]},
     'pose is None')])
def test_a_damaged_layout(layout: Any, what: str, tmp_path: Path) -> None:
    (tmp_path / 'layout.json').write_text(json.dumps(layout))
    with pytest.raises(Failure, match=what):
        validate(tmp_path)


def track(folder: Path, text: str) -> Path:
    path = folder / 'track.csv.gz'
    path.write_bytes(gzip.compress(text.encode()))
    return path


@pytest.mark.parametrize('text, what', [
    ('time,resident,x,y\n', ':1: has no column storey'),
    ('', ':1: has no column time'),
    ('time,resident,x,y,storey\n1,ann,2,3,0\n2,ann,nan,3,0\n', ':3: x is nan'),
    ('time,resident,x,y,storey\n1,ann,2\n', ':2: y is None'),
    ('time,resident,x,y,storey\n1,ann,2,3,first\n', ':2: storey is first'),
    ('time,resident,x,y,storey\n' + 'x' * 100_000, ':2: has a line of more than')])
def test_a_damaged_table(text: str, what: str, tmp_path: Path) -> None:
    path = track(tmp_path, text)
    with pytest.raises(Failure, match=f'{path}{what}'):
        list(rows(path, TRACK))


def test_a_torn_file(tmp_path: Path) -> None:
    path = track(tmp_path, 'time,resident,x,y,storey\n' + '1,ann,2,3,0\n' * 1000)
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(Failure, match='cannot be read'):
        list(rows(path, TRACK))


def test_a_line_of_gigabytes_takes_little_memory(tmp_path: Path) -> None:
    import tracemalloc
    path = tmp_path / 'events.csv.gz'
    with gzip.open(path, 'wb', 1) as file:
        for _ in range(200):
            file.write(bytes(1 << 20))
    tracemalloc.start()
    with pytest.raises(Failure, match=':1: has a line of more than'):
        list(rows(path, EVENTS))
    assert tracemalloc.get_traced_memory()[1] < 10e6
    tracemalloc.stop()
