"""What angen bench soak says of samples."""
from __future__ import annotations

from typing import Sequence

from angen_tools.bench.soak import Sample, grown, things


def samples(memory: Sequence[float]) -> list[Sample]:
    return [Sample(10 * i, mb, 20, 5) for i, mb in enumerate(memory)]


def test_memory_may_grow_while_it_warms_up() -> None:
    assert grown(samples([40.0 + min(i, 19) for i in range(100)])) == []


def test_memory_may_vary() -> None:
    assert grown(samples([60.0 + 10 * (i % 2) for i in range(100)])) == []


def test_memory_that_grows_on_is_reported() -> None:
    said, = grown(samples([60.0 + 0.05 * i for i in range(100)]))
    assert said.startswith('memory has grown from 61') and 'by more than 2 MB' in said


def test_every_kind_of_sensor_is_spawned() -> None:
    from angen_tools.common.catalog import kinds
    assert set(kinds('sensor')) <= {thing.kind for thing in things()}
    assert {'lamp', 'door', 'elevator'} <= {thing.kind for thing in things()}


def test_the_models_of_the_catalog_exist() -> None:
    from angen_tools.world import models
    missing = [thing.what for thing in things()
               if thing.what.startswith('model://') and not models.find(thing.what)]
    assert missing == []
