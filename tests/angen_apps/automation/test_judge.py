"""Expectations over time lines that are written here, judged by hand."""
from dataclasses import replace
from pathlib import Path
from random import Random
from types import SimpleNamespace
from typing import Any

import pytest

from angen_apps.automation.bench import Record
from angen_apps.automation.claims import Lines, both, inverse, parsed, total, union
from angen_apps.automation.judge import judge
from angen_apps.automation.scenario import read_scenario

HEAD = 'start: 2026-03-23 21:00\nlasts: 1000 s\nautomation: x.yaml\nexpect:\n  - {%s}\n'
LINES = {('light.hall', ''): [(0.0, 'off'), (101.5, 'on'), (300.0, 'off'), (504.0, 'on'),
                              (600.0, 'off')],
         ('sensor.lux', ''): [(0.0, '5'), (250.0, '30'), (450.0, '4')],
         ('anna', ''): [(0.0, 'bedroom||lie'), (100.0, 'hall||stand'), (200.0, '||'),
                        (500.0, 'hall||stand'), (900.0, 'bedroom||stand')]}


def record(folder: Path, text: str, cut: str = '') -> Record:
    path = folder / 's.yaml'
    path.write_text(HEAD % text)
    lines: Any = {key: list(line) for key, line in LINES.items()}
    thing = SimpleNamespace(thing=SimpleNamespace(key=('lamp', 'hall')))
    home: Any = SimpleNamespace(since=21 * 3600.0)
    entities: Any = SimpleNamespace(find=lambda _: thing)
    return Record(read_scenario(path), home, Lines(lines, ['anna'], 1000.0, 21 * 3600.0),
                  {'lamp/hall': [(0.0, '0'), (101.5, '60'), (300.0, '0'), (504.0, '60'),
                                 (600.0, '0')]}, entities, cut=cut)


@pytest.mark.parametrize('text, outcome, detail', [
    ('expect: light.hall is on, within: 2 s, of: anyone in hall', 'failed', '1 of 2 times not'),
    ('expect: light.hall is on, within: 5 s, of: anyone in hall', 'passed', '2 times'),
    ('expect: light.hall is on, within: 2 s, of: anyone in hall, while: sensor.lux above 4.5',
     'passed', '1 times'),
    ('expect: light.hall is on, within: 2 s, of: anna in kitchen', 'not judged', 'never began'),
    ('never: light.hall is off and anna in hall, for: 2 s', 'failed', '2 times, 5 min 4 s'),
    ('never: light.hall is on and nobody in hall, for: 100 s', 'passed', ''),
    ('never: light.hall is on and nobody in hall, for: 99 s', 'failed', '1 times, 1 min 40 s'),
    ('always: light.hall is on, while: anna in hall, for: 5 s', 'failed', '1 times, 5 min'),
    ('always: light.hall is on, while: anna in cellar', 'not judged', 'never held'),
    ('never: anna awake in bedroom, while: "time 21:00 to 21:01"', 'passed', 'in 1 min'),
    ('never: light.hall is on, while: "time 21:05 to 21:10"', 'failed', '1 times, 1 min 36 s'),
    ('at_most: 4, changes_of: light.hall', 'passed', '4'),
    ('at_most: 3, changes_of: light.hall', 'failed', '4'),
    ('at_most: 2, changes_of: light.hall, per: 200 s', 'passed', '2'),
    ('at_most: 1, changes_of: light.hall, per: 200 s', 'failed', '2'),
    ('at_least: 2, times: light.hall is on', 'passed', '2'),
    ('at_most: 5 min, time_of: light.hall is on', 'passed', '4 min 55 s'),
    ('at_most: 4 min, time_of: light.hall is on', 'failed', '4 min 55 s'),
    ('at_most: 5 Wh, energy_of: light.hall', 'passed', '4.908 Wh'),
    ('at_most: 4.9 Wh, energy_of: light.hall', 'failed', '4.908 Wh')])
def test_verdicts(tmp_path: Path, text: str, outcome: str, detail: str) -> None:
    """294.5 s of 60 W are 4.908 Wh."""
    verdict, = judge(record(tmp_path, text))
    assert (verdict.outcome, detail in verdict.detail) == (outcome, True), verdict.detail


@pytest.mark.parametrize('limit, outcome', [('12.4', 'failed'), ('12.6', 'passed')])
def test_the_span_with_the_most_energy_may_end_with_a_change(tmp_path: Path, limit: str,
                                                             outcome: str) -> None:
    """450 s that end at 800 s have 150 s of 60 W and 300 s of 120 W, 12.5 Wh; those that begin
    at 200 or 500 s have 10 Wh."""
    told = record(tmp_path, f'at_most: {limit} Wh, energy_of: light.hall, per: 450 s')
    watts = [(0.0, '0'), (200.0, '60'), (500.0, '120'), (800.0, '0')]
    verdict, = judge(replace(told, watts={'lamp/hall': watts}))
    assert verdict.outcome == outcome and '12.5 Wh' in verdict.detail


def test_a_cut_run_passes_nothing(tmp_path: Path) -> None:
    """What has failed before has failed."""
    texts = {'at_most: 4, changes_of: light.hall': 'not judged',
             'never: anna in kitchen': 'not judged',
             'at_most: 3, changes_of: light.hall': 'failed',
             'at_least: 9, times: light.hall is on': 'not judged'}
    for text, outcome in texts.items():
        verdict, = judge(record(tmp_path, text, cut='Ctrl-C'))
        assert verdict.outcome == outcome and ('Ctrl-C' in verdict.detail) == (outcome != 'failed')


def test_spans_are_as_their_points() -> None:
    """Unions, intersections and complements of random spans, against each whole second."""
    numbers = Random(5)
    for _ in range(50):
        sets = [{t for t in range(60) if numbers.random() < 0.5} for _ in range(2)]
        one, other = ([(t, t + 1.0) for t in sorted(each)] for each in sets)
        one, other = union([one]), union([other])
        for found, points in ((both(one, other), sets[0] & sets[1]),
                              (union([one, other]), sets[0] | sets[1]),
                              (inverse(one, 60.0), set(range(60)) - sets[0])):
            assert total(found) == len(points)
            assert {t for t in range(60) if any(a <= t < b for a, b in found)} == points
            assert all(b < c for (_, b), (c, _) in zip(found, found[1:]))


@pytest.mark.parametrize('text', ['light is on', 'light.x', 'light.x is', 'anna on x',
                                  'x.y below z', 'time 25:00 to 26:00'])
def test_what_is_no_claim(text: str) -> None:
    with pytest.raises(ValueError):
        parsed(text)
    assert replace(parsed('light.x is not on and anna awake in y').parts[0]).negated
