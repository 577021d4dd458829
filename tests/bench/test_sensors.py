"""The cases of a bench."""
import pytest

from angen_bench import commands
from angen_bench import sensors as bench
from angen_tools.common.failure import Failure


def test_all_kinds_are_benched_one_after_the_other() -> None:
    groups = bench.cases('added', 'all', [10, 0, 10])
    assert [g[0].kind for g in groups] == list(commands.KINDS)
    assert all([c.count for c in g] == [0, 10] for g in groups)


def test_both_modes_follow_each_other() -> None:
    groups = bench.cases('both', 'all', [0, 5])
    assert [(g[0].mode, g[0].kind) for g in groups] == [
        (mode, kind) for mode in ('added', 'deployed') for kind in commands.KINDS]


def test_desired_asks_for_all_that_the_building_needs() -> None:
    case, = bench.cases('desired', 'all', [2])[0]
    assert case.counts == {'pir': 24, 'luminosity': 12, 'switch': 12, 'contact': 19}
    models = [s.model for s in case.sensors()]
    assert models.count('chair') == 12 and models.count('elevator') == 1
    assert sum('table' in m or m == 'desk' for m in models) == 6
    with pytest.raises(Failure, match='1 or more'):
        bench.cases('desired', 'all', [0, 1])
