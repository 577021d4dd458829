"""A recording keeps all changes with their times, by the names of links."""
from typing import Any

import numpy as np
from angen_apps.web.store import Row
from angen_apps.web.timeline import CHUNK, Timeline


def scene(revision: int, *models: str) -> dict[str, Any]:
    return {'revision': revision, 'lights': [{'name': 'lamp'}],
            'links': [{'model': model, 'name': 'link'} for model in models]}


def moved(store: Timeline, revision: int, time: float, link: int, x: float) -> None:
    store.put_changes(revision, np.array([link], np.uint32),
                      np.array([x, 0, 0, 0, 0, 0, 1], np.float32), np.array([], np.uint32),
                      np.array([], np.float32), time)


def row(text: str, stamp: float) -> Row:
    return ('lamp', 'a', text, False, stamp, [1.0])


def entries(store: Timeline) -> list[Any]:
    found, seen = [], 0
    while True:
        update = store.since(seen)
        found += update.parts.get('timeline', [])
        seen = update.version
        if not update.more:
            return found


def test_every_change_is_kept() -> None:
    store = Timeline()
    store.put_scene(scene(1, 'a', 'b'), 1)
    for i in range(2 * CHUNK + 5):
        moved(store, 1, i * 0.1, 1, float(i))
    kept = entries(store)
    assert [entry[3][0] for entry in kept] == [float(i) for i in range(2 * CHUNK + 5)]
    assert {tuple(entry[2]) for entry in kept} == {(1,)}


def test_a_link_keeps_its_number_when_models_go() -> None:
    store = Timeline()
    store.put_scene(scene(1, 'gone', 'stays'), 1)
    moved(store, 1, 1.0, 1, 1.0)
    moved(store, 2, 2.0, 0, 2.0)  # before its scene
    store.put_scene(scene(2, 'stays'), 2)
    moved(store, 2, 3.0, 0, 3.0)
    kept = entries(store)
    assert len({tuple(entry[2]) for entry in kept}) == 1
    assert [(entry[1], entry[3][0]) for entry in kept] == [(1.0, 1.0), (2.0, 2.0), (3.0, 3.0)]
    number, = kept[0][2]
    shown = store.scene
    assert shown is not None and shown['ids'] == [number]


def test_rows_are_kept_where_they_changed() -> None:
    store = Timeline()
    for stamp, text in enumerate(('off', 'off', 'on', 'on', 'off')):
        store.put_rows([row(text, float(stamp))], stamp == 0)
    assert [(entry[1], entry[4]) for entry in entries(store)] == [
        (0.0, 'off'), (2.0, 'on'), (4.0, 'off')]


def test_parts_come_with_the_entries_before_them() -> None:
    store = Timeline()
    store.put('line', {'end': 1.0})
    for i in range(CHUNK + 1):
        store.add_event([float(i), 'x'])
    store.put('line', {'end': 1.0, 'loaded': 1.0})
    first = store.since(0)
    assert first.more and 'line' not in first.parts
    assert store.since(first.version).parts['line']['loaded'] == 1.0
