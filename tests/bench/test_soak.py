"""The verdict of angen bench soak about samples."""
from typing import Sequence

import pytest

from angen_bench import soak
from angen_bench.soak import MASTER, ROUND, Sample, Thing, grown, things
from angen_tools.common.progress import Progress

WARM = 2 * soak.WARM_UP  # samples before the first that counts


class Fake:
    """A home that has what `memory` and `descriptors` say, by the number of the sample."""

    def __init__(self, memory: Sequence[float], descriptors: Sequence[int] = (20,)) -> None:
        self._memory, self._descriptors = list(memory), list(descriptors)
        self._next = 0
        self.lit = False
        self.there: list[str] = []
        self.seen: set[tuple[Thing, bool]] = set()

    def spawn(self, thing: Thing, name: str) -> None:
        self.there.append(name)
        self.seen.add((thing, self.lit))

    def delete(self, name: str) -> None:
        self.there.remove(name)

    def command(self, lit: bool) -> None:
        self.lit = lit

    def rest(self, seconds: float) -> None:
        pass

    def sample(self, cycle: int) -> Sample:
        at = self._next
        self._next += 1
        return Sample(cycle, self._memory[min(at, len(self._memory) - 1)],
                      self._descriptors[min(at, len(self._descriptors) - 1)], 5)

    def registered(self) -> set[str]:
        return {'publishes /x', *self.there}


@pytest.fixture(autouse=True)
def brief(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(soak, 'QUIET', 0.1)


def run(home: Fake, cycles: int) -> tuple[list[Sample], list[str]]:
    with Progress('soak', 0.1) as progress:
        return soak.soak(home, cycles, progress)


def samples(memory: Sequence[float]) -> list[Sample]:
    return [Sample(10 * i, mb, 20, 5) for i, mb in enumerate(memory)]


def test_memory_may_grow_while_it_warms_up() -> None:
    found, wrong = run(Fake([40.0 + min(i, WARM) for i in range(100)]), 1000)
    assert [sample.cycle for sample in found] == list(range(ROUND, 1001, ROUND))
    assert wrong == []


def test_everything_comes_while_lamps_are_lit_before_the_first_sample() -> None:
    home = Fake([40.0])
    run(home, ROUND)
    assert {thing for thing, lit in home.seen if lit} == set(things())


def test_memory_that_seems_to_grow_is_watched_for_as_long_again() -> None:
    kept = WARM + 1000 // ROUND * 3 // 4
    found, wrong = run(Fake([40.0] * kept + [42.0]), 1000)
    assert found[-1].cycle == 2000
    assert wrong == []
    found, wrong = run(Fake([40.0 + 0.15 * i for i in range(100)]), 1000)
    assert found[-1].cycle == 2000
    assert len(wrong) == 1


def test_descriptors_that_stay_are_reported() -> None:
    assert run(Fake([40.0], [20, 25, 25 + MASTER]), 100)[1] == []
    assert run(Fake([40.0], [20] * WARM + [21 + MASTER]), 100)[1] == [
        f'descriptors were {20 + MASTER} and are {21 + MASTER}']


def test_registrations_that_stay_are_reported() -> None:
    class Keeping(Fake):
        def delete(self, name: str) -> None:
            if self._next < WARM or name != 'soak_door':
                super().delete(name)

    assert run(Keeping([40.0]), 100)[1] == ['registrations differ: soak_door']


def test_memory_may_vary() -> None:
    assert grown(samples([60.0 + 10 * (i % 4 == 0) for i in range(100)])) == []


def test_memory_that_grows_on_is_reported() -> None:
    said, = grown(samples([60.0 + 0.05 * i for i in range(100)]))
    assert said.startswith('memory has grown from 63.1 to 64.3 MB')
    assert 'by more than 0.7 MB' in said


def test_memory_returned_for_a_moment_is_no_growth() -> None:
    assert grown(samples([156.1, 152.7, *[155.0] * 10, 152.0, *[155.0] * 7])) == []


def test_memory_that_settles_in_the_first_half_is_no_growth() -> None:
    settling = [153.5, 152.2, 152.2, 155.3, 155.3, 156.3, 156.3, 156.5, 156.5, 156.6]
    settled = [156.6, 156.9, 156.9, 156.9, 156.9, 156.8, 156.8, 156.5, 156.5, 156.6]
    assert grown(samples(settling + settled)) == []


def test_a_leak_of_three_kilobytes_a_cycle_is_found() -> None:
    assert grown(samples([155.0 + 0.003 * 50 * i for i in range(20)]))


def test_every_kind_of_sensor_is_spawned() -> None:
    from angen_tools.common.catalog import kinds
    assert set(kinds('sensor')) <= {thing.kind for thing in things()}
    assert {'lamp', 'door', 'elevator'} <= {thing.kind for thing in things()}


def test_the_models_of_the_catalog_exist() -> None:
    from angen_tools.world import models
    missing = [thing.what for thing in things()
               if thing.what.startswith('model://') and not models.find(thing.what)]
    assert missing == []
