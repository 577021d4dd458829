"""The rule engine: events in, warnings out."""
from pathlib import Path

import pytest

from angen_apps.care.engine import ACKNOWLEDGED, ENDED, RAISED
from tests.angen_apps.care.homes import MIN, H, Home, rule

STOVE = rule('stove', 'stove on', '{not: kitchen used, for: 10 min}')


def test_both_conditions_have_to_hold(tmp_path: Path) -> None:
    home = Home(tmp_path, STOVE)
    home.until(20 * MIN)
    assert home.events() == []  # no person there, but the stove is off
    home.at(20 * MIN, 'pir/kitchen_a', 'motion')
    home.at(21 * MIN, 'plug/stove0', 'on')
    home.at(22 * MIN, 'pir/kitchen_b', 'motion')
    home.at(23 * MIN, 'pir/kitchen_a', 'still')
    home.at(24 * MIN, 'pir/kitchen_b', 'still')
    home.until(33.9 * MIN)
    assert home.events() == []
    home.until(40 * MIN)
    assert home.events() == [(34 * MIN, 'stove', RAISED)]


def test_a_warning_ends_with_its_condition_and_comes_again(tmp_path: Path) -> None:
    home = Home(tmp_path, STOVE)
    home.at(1.0, 'plug/stove0', 'on')
    home.until(11 * MIN)
    home.at(12 * MIN, 'pir/kitchen_a', 'motion')
    home.at(13 * MIN, 'pir/kitchen_a', 'still')
    home.until(30 * MIN)
    assert home.events() == [(10 * MIN, 'stove', RAISED), (12 * MIN, 'stove', ENDED),
                             (23 * MIN, 'stove', RAISED)]


def test_an_acknowledged_warning_is_reported_once_and_ends(tmp_path: Path) -> None:
    home = Home(tmp_path, STOVE)
    assert home.engine.acknowledge('stove') == []
    home.at(1.0, 'plug/stove0', 'on')
    home.until(11 * MIN)
    change, = home.engine.acknowledge('all')
    assert (change.event, change.warning.acknowledged) == (ACKNOWLEDGED, 11 * MIN)
    assert home.engine.acknowledge('stove') == []
    home.until(12 * MIN)
    home.at(12 * MIN, 'plug/stove0', 'off')
    assert [event for _, _, event in home.events()] == [RAISED, ENDED]
    assert home.engine.past[0].acknowledged == 11 * MIN


def test_it_matters_when_something_began(tmp_path: Path) -> None:
    home = Home(tmp_path, rule('night', '{is: door open, began: 0:00 to 6:00}'), starts='22:00')
    home.at(1 * H, 'door/entrance0', 'opening')  # 23:00
    home.until(5 * H)
    assert home.events() == []
    home.at(5 * H, 'door/entrance0', 'closed')
    home.at(5.5 * H, 'door/entrance0', 'opening')
    home.at(5.5 * H + 3, 'door/entrance0', 'opened')
    assert home.events() == [(5.5 * H, 'night', RAISED)]


@pytest.mark.parametrize('way, degree', [('min', 0.5), ('product', 0.25)])
def test_degrees_are_joined(way: str, degree: float, tmp_path: Path) -> None:
    home = Home(tmp_path, rule(
        'bath', '{is: in the bathroom, for: [30 min, 50 min]}', '{time: [1:00, 3:00, 5:00, 6:00]}',
        more=f'    and: {way}\n    threshold: 0.2\n'), starts='1:20')
    home.at(0.5, 'pir/bath', 'motion')
    home.at(40.0, 'pir/bath', 'still')
    now = 40 * MIN + 0.5
    home.until(now)
    found = home.engine.degree(home.engine.rules.rules[0], now)
    assert found == pytest.approx(degree, abs=1e-3)  # half of each: 40 min; 2:00


def test_the_threshold_decides(tmp_path: Path) -> None:
    condition = '{is: door open, for: [0 s, 100 s]}'
    home = Home(tmp_path, rule('low', condition, more='    threshold: 0.2\n')
                + rule('high', condition, more='    threshold: 0.9\n'))
    home.at(10.0, 'door/entrance0', 'opened')
    home.until(200.0)
    assert home.events() == [(30.0, 'low', RAISED), (100.0, 'high', RAISED)]
    assert home.changes[0].degree == pytest.approx(0.2)
    assert home.changes[0].warning.detail == 'door open since 00:00:10, 20 s (0.20)'


def test_a_warning_is_on_time_between_two_steps(tmp_path: Path) -> None:
    home = Home(tmp_path, rule('open', '{is: door open, for: 1 min}'))
    home.at(0.3, 'door/entrance0', 'opened')
    home.until(100.0)
    (time, *_), = home.events()
    assert time == pytest.approx(60.3, abs=1e-5)


def test_it_does_not_matter_how_time_is_cut(tmp_path: Path) -> None:
    lists = []
    for cut in (0.3, 7.0, 1e6):
        home = Home(tmp_path, STOVE)
        home.at(1.25, 'plug/stove0', 'on')
        time = 0.0
        while time < 900.0:
            time += cut
            home.until(min(time, 900.0))
        home.at(901.5, 'pir/kitchen_a', 'motion')
        lists.append(home.events())
    assert lists[0] == lists[1] == lists[2] == [(600.0, 'stove', RAISED), (901.5, 'stove', ENDED)]


def test_an_event_that_comes_late_counts_from_its_own_time(tmp_path: Path) -> None:
    home = Home(tmp_path, rule('open', '{is: door open, for: 1 min}'))
    home.until(100.0)
    home.at(50.0, 'door/entrance0', 'opened')
    assert home.events() == []
    home.until(120.0)
    assert home.events() == [(110.0, 'open', RAISED)]


def test_the_curve_keeps_every_corner(tmp_path: Path) -> None:
    home = Home(tmp_path, rule('open', '{is: door open, for: [10 s, 20 s]}'))
    home.at(10.0, 'door/entrance0', 'opened')
    home.until(60.0)
    home.at(60.5, 'door/entrance0', 'closed')
    home.until(90.0)
    line = home.engine.curves['open'].line()
    for point in ((20.0, 0.0), (30.0, 1.0), (60.0, 1.0), (60.5, 0.0), (90.0, 0.0)):
        assert any(corner == pytest.approx(point, abs=1e-5) for corner in line), point
