"""Due times of measurements, and the choice of sensors to subscribe to."""
import pytest

from angen_bench.measure import due, spread


@pytest.mark.parametrize('rate,begin,end,expected',
                         [(10, 0.0, 1.0, 10), (10, 0.95, 2.05, 11), (1, 0.999, 1.0, 1),
                          (1, 1.0, 1.999, 0), (10, 3.0, 3.0, 0), (10, 0.3, 0.6, 3)])
def test_readings_due_are_counted(rate: float, begin: float, end: float, expected: int) -> None:
    assert due(rate, begin, end) == expected


def test_listeners_are_spread() -> None:
    sensors = list(range(95))
    assert spread(sensors, 10) == list(range(0, 95, 10))
    assert spread(sensors[:4], 10) == sensors[:4] and spread([], 10) == []
