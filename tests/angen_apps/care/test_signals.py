"""Signals: their state, by the events of sensors."""
from pathlib import Path

import pytest

from angen_apps.care.states import STATES
from tests.angen_apps.care.homes import Home, rule

RULES = rule('r', 'stove on')


def test_any_of_the_sensors_counts(tmp_path: Path) -> None:
    home = Home(tmp_path, RULES)
    used = home.engine.signals['kitchen used']
    for time, name, event, on in ((1.0, 'a', 'motion', True), (2.0, 'b', 'motion', True),
                                  (3.0, 'a', 'still', True), (4.0, 'b', 'still', False)):
        home.at(time, f'pir/kitchen_{name}', event)
        assert used.on == on
    assert used.since == 4.0


def test_somebody_is_where_the_last_motion_was(tmp_path: Path) -> None:
    home = Home(tmp_path, RULES)
    there = home.engine.signals['in the bathroom']
    home.at(1.0, 'pir/kitchen_a', 'motion')
    assert not there.on
    home.at(2.0, 'pir/bath', 'motion')
    home.at(3.0, 'pir/kitchen_a', 'still')
    home.at(9.0, 'pir/bath', 'still')
    assert there.on and there.since == 2.0
    home.at(10.0, 'pir/kitchen_b', 'motion')
    assert not there.on


def test_a_tag_is_distinguished_from_others(tmp_path: Path) -> None:
    home = Home(tmp_path, RULES)
    read = home.engine.signals['anna read']
    home.at(1.0, 'rfid/gate', 'read', 'bob')
    assert not read.on
    home.at(2.0, 'rfid/gate', 'read', 'anna, robot')
    home.at(3.0, 'rfid/gate', 'lost', 'bob, robot')
    assert read.on
    home.at(4.0, 'rfid/gate', 'lost', 'anna')
    assert not read.on


def test_it_begins_with_the_summaries(tmp_path: Path) -> None:
    home = Home(tmp_path, RULES, {
        'plug/stove0': 'heater/stove0  1200.0 W  0 J', 'pir/kitchen_a': 'MOTION',
        'pir/kitchen_b': 'still', 'door/entrance0': 'AJAR  -0.30 rad',
        'rfid/gate': 'anna bob  0.80 1.20 m'})
    assert {name for name, signal in home.engine.signals.items() if signal.on} == {
        'stove on', 'kitchen used', 'door open', 'anna read'}
    nothing = Home(tmp_path, RULES, {
        'plug/stove0': 'heater/stove0  0.0 W  100 J', 'door/entrance0': 'CLOSED  0.00 rad',
        'rfid/gate': 'none  none'})
    assert not any(signal.on for signal in nothing.engine.signals.values())


@pytest.mark.parametrize('kind, state, summary, holds', [
    ('lamp', 'on', 'on  40 %  8.0 W', True), ('lamp', 'on', 'off  0 %  0.0 W', False),
    ('appliance', 'on', 'off  30 %  0.5 W', False), ('plug', 'on', 'lamp/l  0.04 W  0 J', True),
    ('plug', 'on', 'lamp/l  (no such load)  0.0 W  10 J', False),
    ('stove', 'hot', 'off  HOT  70 °C  0 W', True), ('stove', 'hot', 'on  30 °C  900 W', False),
    ('person', 'walks', 'WALKING  1.00 2.00 0.00 m', True)])
def test_states_are_found_in_summaries(kind: str, state: str, summary: str, holds: bool) -> None:
    assert STATES[kind][state].matches(summary) == holds


def test_a_sensor_that_is_deleted_detects_nothing(tmp_path: Path) -> None:
    home = Home(tmp_path, RULES)
    home.at(1.0, 'pir/kitchen_a', 'motion')
    home.at(2.0, 'world/kitchen_a', 'deleted')
    assert not home.engine.signals['kitchen used'].on
