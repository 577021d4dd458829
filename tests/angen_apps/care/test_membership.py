"""Degrees of membership, durations and times of day."""
import pytest

from angen_tools.common.clock import duration, show_duration, show_time, time_of_day
from angen_apps.care.membership import Trapezoid, around

H = 3600.0


@pytest.mark.parametrize('value, degree', [
    (0.0, 0.0), (1.0, 0.0), (1.5, 0.5), (2.0, 1.0), (3.0, 1.0), (4.0, 0.75), (7.0, 0.0),
    (9.0, 0.0)])
def test_a_trapezoid_rises_and_falls(value: float, degree: float) -> None:
    assert Trapezoid(1.0, 2.0, 3.0, 7.0).degree(value) == pytest.approx(degree)


def test_upright_edges_belong_to_it() -> None:
    assert [Trapezoid(600.0, 600.0).degree(t) for t in (599.9, 600.0, 1e9)] == [0.0, 1.0, 1.0]
    window = around((0.0, 0.0, 6 * H, 6 * H), 24 * H)
    assert [window.degree(h * H) for h in (0.0, 3.0, 6.0, 6.01, 23.99)] == [1.0, 1.0, 1.0, 0, 0]


@pytest.mark.parametrize('hour, degree', [
    (21.0, 0.0), (22.0, 0.5), (22.5, 1.0), (0.0, 1.0), (5.5, 1.0), (6.25, 0.25), (12.0, 0.0)])
def test_a_night_includes_midnight(hour: float, degree: float) -> None:
    night = around([21.5 * H, 22.5 * H, 5.5 * H, 6.5 * H], 24 * H)
    assert night.degree(hour * H) == pytest.approx(degree)


def test_times_are_read_as_they_are_written() -> None:
    assert [duration(text) for text in ('90 s', '10min', '1 h 30 min', '1.5h', '1 d')] == [
        90.0, 600.0, 5400.0, 5400.0, 86400.0]
    assert [time_of_day(text) for text in ('0:00', '6:05:30', '24:00')] == [0.0, 21930.0, 86400.0]
    assert [show_duration(s) for s in (0.4, 90.0, 3600.0, 90061.0)] == [
        '0 s', '1 min 30 s', '1 h', '1 d 1 h']
    assert [show_time(s) for s in (0.0, 86399.0, 93784.0)] == [
        '00:00:00', '23:59:59', '+1 d 02:03:04']


@pytest.mark.parametrize('text', ['10', 'ten min', '10 min or so', '', '-5 s'])
def test_a_wrong_duration_is_reported(text: str) -> None:
    with pytest.raises(ValueError, match='write it as 90 s, 10 min or 1 h 30 min'):
        duration(text)


@pytest.mark.parametrize('text', ['6', '25:00', '24:01', '6:60', '6.30', 'noon'])
def test_a_wrong_time_of_day_is_reported(text: str) -> None:
    with pytest.raises(ValueError, match='write it as 22:30'):
        time_of_day(text)
