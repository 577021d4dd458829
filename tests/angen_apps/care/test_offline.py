"""The shipped rules on the shipped days, simulated."""
from dataclasses import replace
from pathlib import Path

import pytest

from angen_apps.imports.sweethome import read_sweethome
from angen_apps.plan.writer import write_world
from angen_bench import homes
from angen_tools.common.clock import DAY, time_of_day
from angen_tools.offline.day import read_day
from angen_apps.care.offline import Watched
from angen_apps.care.report import warnings_of
from angen_apps.care.rules_file import read_rules
from angen_tools.session import Event

ROOT = Path(__file__).resolve().parents[3]
MINUTE = 60.0


def lived(name: str) -> Watched:
    """A day of worlds/care."""
    rules = read_rules(ROOT / 'src/angen_apps/config/care.yaml')
    watched = Watched(rules, ROOT / f'worlds/care/{name}.world', 1)
    watched.run(DAY, read_day(ROOT / f'worlds/care/{name}.csv', watched.engine.starts))
    return watched


@pytest.fixture(scope='module')
def wrong() -> Watched:
    return lived('wrong')


def of_day(watched: Watched, clock: str) -> float:
    return (time_of_day(clock) - watched.rules.starts) % DAY


def test_each_rule_warns_of_its_fault(wrong: Watched) -> None:
    raised = {warning.rule.name: warning for warning in warnings_of(wrong.engine)}
    expected = {'fridge_left_open': ('7:28', '7:40'), 'forbidden_zone': ('9:00', '9:05'),
                'stove_left_on': ('12:25', '12:50'), 'no_motion': ('1:00', '2:10'),
                'door_at_night': ('2:10', '2:20'), 'long_in_bathroom': ('3:10', '3:45')}
    assert len(warnings_of(wrong.engine)) == 6 and set(raised) == set(expected)
    for name, (begin, end) in expected.items():
        assert abs(raised[name].raised - of_day(wrong, begin)) < MINUTE, name
        assert abs((raised[name].ended or 0.0) - of_day(wrong, end)) < MINUTE, name
    assert raised['stove_left_on'].degree == pytest.approx(0.5, abs=0.01)


def test_a_room_is_empty_when_its_sensors_detect_no_one(wrong: Watched) -> None:
    stove = next(w for w in warnings_of(wrong.engine) if w.rule.name == 'stove_left_on')
    still = max(event.time for event in wrong.events if event.event == 'still'
                and event.source.startswith('kitchen_pir0') and event.time < stove.raised)
    assert stove.raised == pytest.approx(still + 10 * MINUTE, abs=1.5)


def test_an_ordinary_day_has_no_warning() -> None:
    ordinary = lived('ordinary')
    assert warnings_of(ordinary.engine) == []
    happened = {(event.kind, event.event) for event in ordinary.events}
    assert happened >= {('pir', 'motion'), ('door', 'opened'), ('reed', 'opened'),
                        ('stove', 'on'), ('person', 'walks')}
    assert _longest_pause(ordinary.events) < 12 * 60 * MINUTE


def _longest_pause(events: list[Event]) -> float:
    times = [event.time for event in events if event.event == 'motion']
    return max(b - a for a, b in zip(times, times[1:]))


def test_the_day_does_not_depend_on_how_it_is_cut(monkeypatch: pytest.MonkeyPatch,
                                                  wrong: Watched) -> None:
    monkeypatch.setattr('angen_apps.care.offline.SLICE', 7.3)
    rules = wrong.rules
    again = Watched(rules, ROOT / 'worlds/care/wrong.world', 1)
    again.run(2 * 60 * MINUTE, read_day(ROOT / 'worlds/care/wrong.csv', again.engine.starts))
    until = again.time
    assert [c for c in again.changes if c.time < until - 1] == [
        c for c in wrong.changes if c.time < until - 1]


def test_residents_live_in_an_imported_home(tmp_path: Path) -> None:
    """Rules by use of rooms get their signals from people who live there by habits."""
    (tmp_path / 'studio.xml').write_bytes(homes.examples()['Studio'])
    write_world(read_sweethome(tmp_path / 'studio.xml'), tmp_path / 'studio.world', 'seed')
    rules = replace(read_rules(ROOT / 'src/angen_apps/config/care.yaml'), starts=12.0 * 3600)

    empty = Watched(rules, tmp_path / 'studio.world', 1)
    empty.run(1500, [])
    assert not any(event.event == 'motion' for event in empty.events)
    lived, rooms = Watched(rules, tmp_path / 'studio.world', 1, ('retired',)), set()
    while not rooms >= {'bathroom', 'hall', 'kitchen'}:
        assert lived.time < 1500
        lived.run(lived.time + 60, [])
        rooms |= {event.source.partition('_pir')[0] for event in lived.events
                  if event.event == 'motion'}
