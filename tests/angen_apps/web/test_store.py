"""Each browser gets what changed since it got some last, and only the newest of it."""
import struct
from typing import Any

import numpy as np
from angen_apps.web.store import LEVELS, PICTURE, POSES, Row, Store

SCENE: dict[str, Any] = {'revision': 7, 'links': [{}, {}, {}], 'shapes': []}


def row(name: str, text: str, stamp: float = 1.0) -> Row:
    return ('lamp', name, text, False, stamp, [1.0])


def moved(store: Store, revision: int, poses: dict[int, float],
          levels: dict[int, float] | None = None) -> None:
    levels = levels or {}
    store.put_changes(revision, np.array(list(poses), np.uint32),
                      np.repeat(np.array(list(poses.values()), np.float32), 7),
                      np.array(list(levels), np.uint32),
                      np.array(list(levels.values()), np.float32))


def values(blob: bytes, width: int) -> tuple[int, int, dict[int, float]]:
    """Kind, scene and the first of each link's numbers, read without the store's code."""
    kind, scene, count = struct.unpack_from('<III', blob)
    indices = struct.unpack_from(f'<{count}I', blob, 12)
    numbers = struct.unpack_from(f'<{count * width}f', blob, 12 + 4 * count)
    assert len(blob) == 12 + 4 * count * (1 + width)
    return kind, scene, dict(zip(indices, numbers[::width]))


def test_a_slow_browser_gets_one_pose_for_many() -> None:
    store = Store()
    store.put_scene(SCENE, 7)
    seen = store.since(0).version
    for i in range(1000):
        moved(store, 7, {1: float(i)})
    update = store.since(seen)
    assert [values(blob, 7) for blob in update.blobs] == [(POSES, 1, {1: 999.0})]
    assert not store.since(update.version)


def test_only_changes_are_sent() -> None:
    store = Store()
    store.put_scene(SCENE, 7)
    moved(store, 7, {0: 0.0, 1: 1.0, 2: 2.0}, {0: 0.25, 1: 0.5})
    first = store.since(0)
    assert [values(first.blobs[0], 7), values(first.blobs[1], 1)] == [
        (POSES, 1, {0: 0.0, 1: 1.0, 2: 2.0}), (LEVELS, 1, {0: 0.25, 1: 0.5})]
    moved(store, 7, {2: 5.0})
    second = store.since(first.version)
    assert [values(blob, 7) for blob in second.blobs] == [(POSES, 1, {2: 5.0})]
    assert second.parts == {}


def test_the_same_scene_is_not_sent_again() -> None:
    store = Store()
    store.put_scene(SCENE, 7)
    seen = store.since(0).version
    store.put_scene(dict(SCENE), 7)  # its topic was subscribed again
    assert not store.since(seen)
    store.put_scene({**SCENE, 'links': [{}, {}]}, 7)
    assert store.since(seen).parts == {'scene': 2}


def test_poses_that_come_before_their_scene_wait_for_it() -> None:
    store = Store()
    store.put_scene(SCENE, 7)
    seen = store.since(0).version
    moved(store, 8, {1: 3.0})
    assert store.since(seen).blobs == []
    store.put_scene({**SCENE, 'revision': 8}, 8)
    update = store.since(seen)
    assert update.parts['scene'] == 2
    assert [values(blob, 7) for blob in update.blobs] == [(POSES, 2, {1: 3.0})]


def test_rows_come_newest_state_only() -> None:
    store = Store()
    store.put_rows([row('a', 'off'), row('b', 'off')], True)
    first = store.since(0)
    assert first.parts['complete'] and len(first.parts['rows']) == 2
    store.put_rows([row('a', 'on 1')], False)
    store.put_rows([row('a', 'on 2')], False)
    second = store.since(first.version)
    assert second.parts['rows'] == [row('a', 'on 2')] and not second.parts['complete']
    store.put_rows([row('b', 'gone is a')], True)
    third = store.since(second.version)
    assert third.parts['complete'] and [one[1] for one in third.parts['rows']] == ['b']


def test_an_equal_part_is_not_sent_again() -> None:
    store = Store()
    store.put('stats', {'time': 1.0})
    version = store.since(0).version
    store.put('stats', {'time': 1.0})
    assert not store.since(version)
    store.put('stats', {'time': 2.0})
    assert store.since(version).parts == {'stats': {'time': 2.0}}
    assert store.since(version, hidden=('stats',)).parts == {}


def test_events_are_kept_in_order_and_bounded() -> None:
    store = Store()
    for i in range(2000):
        store.add_event(i)
    update = store.since(0)
    assert update.parts['events'] == list(range(1500, 2000))
    store.add_event('news')
    assert store.since(update.version).parts['events'] == ['news']


def test_pictures_are_sent_to_their_subscribers() -> None:
    store = Store()
    store.put_named(PICTURE, 'picture:käse', b'jpeg')
    assert store.since(0).blobs == []
    blob, = store.since(0, ['picture:käse']).blobs
    kind, length = struct.unpack_from('<II', blob)
    assert (kind, blob[8:8 + length].decode()) == (PICTURE, 'picture:käse')
    assert blob[8 + (length + 3) // 4 * 4:] == b'jpeg'


def test_each_change_is_announced() -> None:
    calls: list[int] = []
    store = Store(lambda: calls.append(1))
    store.put('stats', 1)
    store.put_rows([], True)
    store.add_event(1)
    store.put_scene(SCENE, 7)
    moved(store, 7, {1: 1.0})
    assert len(calls) == 5
