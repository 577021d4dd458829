"""The rules file: its meaning, and the errors of a wrong one."""
import math
import re
from dataclasses import replace
from pathlib import Path

import pytest

from angen_apps.care.membership import Trapezoid
from angen_apps.care.rules import Rules
from angen_apps.care.rules_file import read_rules
from angen_apps.care.sources import at_home, check_sources
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home, Room, Thing

ROOT = Path(__file__).resolve().parents[3]
RIGHT = '''starts: 6:00
signals:
  moves: {of: [pir/a_*, pir/b], is: motion}
  away: {of: pir/b, is: motion, until_elsewhere: pir/*}
rules:
  - name: quiet
    reason: nobody moves
    at: sofa
    when:
      - moves
      - {not: away, for: [1 h, 90 min]}
      - {is: moves, began: 22:00 to 6:00}
      - {time: [21:30, 22:30, 5:30, 6:30]}
'''


def rules_of(folder: Path, text: str) -> Rules:
    file = folder / 'my.yaml'
    file.write_text(text)
    return read_rules(file)


def test_a_file_is_read_as_written(tmp_path: Path) -> None:
    rules = rules_of(tmp_path, RIGHT)
    assert rules.starts == 6 * 3600
    assert rules.signals['moves'].of == ('pir/a_*', 'pir/b')
    assert rules.signals['away'].elsewhere == ('pir/*',)
    rule, = rules.rules
    assert (rule.name, rule.at, rule.threshold, rule.product) == ('quiet', 'sofa', 0.5, False)
    plain, lasting, began, time = rule.when
    assert (plain.signal, plain.negated, plain.lasting) == ('moves', False, None)
    assert lasting.negated and lasting.lasting == Trapezoid(3600, 5400, math.inf, math.inf)
    hour = 3600.0
    assert began.began == Trapezoid(22 * hour, 22 * hour, 30 * hour, 30 * hour, 24 * hour)
    assert time.time == Trapezoid(21.5 * hour, 22.5 * hour, 29.5 * hour, 30.5 * hour, 24 * hour)


@pytest.mark.parametrize('old, new, line, part', [
    ('starts: 6:00', 'starts: 6 am', 1, "'6 am' is not a time of day; write it as 22:30"),
    ('starts:', 'start:', 1, "'start' is not known in a rules file; did you mean starts"),
    ('is: motion}\n  away', 'is: moving}\n  away', 3,
     "kind pir has no state 'moving'; did you mean motion?"),
    ('pir/b, is', 'pri/b, is', 4, "no states of kind 'pri'; did you mean pir"),
    ('pir/b]', 'pir]', 3, "'pir' is not KIND/NAME, as pir/kitchen_pir0_a"),
    ('of: pir/b, ', '', 4, "signal 'away' has no of"),
    ('is: motion, until', 'is: motion, tag: anna, until', 4, 'only rfid/NAME reads a tag'),
    ('    reason: nobody moves\n', '', 6, 'a rule has no reason'),
    ('name: quiet', 'name: all', 6, "cannot be called 'all'"),
    ('- moves', '- move', 10, "there is no signal 'move'; did you mean moves"),
    ('not: away', 'no: away', 11, "'no' is not known in a condition; did you mean not"),
    ('[1 h, 90 min]', '[90 min, 1 h]', 11, 'the durations of for must rise'),
    ('[1 h, 90 min]', '[1 h]', 11, 'for has 1 corners, must have 2 or 4'),
    ('[1 h, 90 min]', '1 hour', 11, "'1 hour' is not a duration; write it as 90 s"),
    ('22:00 to 6:00', '22:00', 12, "began is '22:00'; write it as 22:00 to 6:00"),
    ('[21:30, 22:30, 5:30, 6:30]', '[21:30, 22:30, 5:30, 22:00]', 13, 'more than 24 hours'),
    ('{time: [', '{is: moves, time: [', 13, "one of 'is', 'not' and 'time'"),
    ('    at: sofa\n', '    threshold: 2\n', 8, 'threshold is 2, must be 0.01 to 1'),
    ('    at: sofa\n', '    and: mean\n', 8, "and is 'mean'; did you mean"),
    ('rules:', 'rules: [', 6, 'is not YAML'),
])
def test_a_wrong_file_is_reported_by_line(old: str, new: str, line: int, part: str, tmp_path: Path
                                          ) -> None:
    assert RIGHT.count(old) == 1
    with pytest.raises(Failure) as caught:
        rules_of(tmp_path, RIGHT.replace(old, new))
    assert str(caught.value).startswith(f'{tmp_path}/my.yaml:{line}: ')
    assert part in str(caught.value)


def test_a_rule_has_one_name(tmp_path: Path) -> None:
    twice = RIGHT + RIGHT[RIGHT.index('  - name'):]
    with pytest.raises(Failure, match="my.yaml:14: rule 'quiet' is given twice; .* in line 6"):
        rules_of(tmp_path, twice)


def test_unknown_names_are_reported(tmp_path: Path) -> None:
    rules = rules_of(tmp_path, RIGHT)
    check_sources(rules, {'pir/a_1', 'pir/b'}, {'sofa'})
    with pytest.raises(Failure, match=r"my.yaml:3: signal 'moves': the world has no pir/a_\*; "
                                      'did you mean pir/ab or pir/b'):
        check_sources(rules, {'pir/ab', 'pir/b', 'door/x'}, {'sofa'})
    with pytest.raises(Failure, match="my.yaml:6: rule 'quiet': no source is named 'sofa'; did you "
                                      'mean sofa0'):
        check_sources(rules, {'pir/a_1', 'pir/b'}, {'sofa0'})


def test_the_shipped_rules_are_right() -> None:
    rules = read_rules(ROOT / 'src/angen_apps/config/care.yaml')
    assert len(rules.rules) == 6


SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
HOME = Home(start='2026-03-21T07:30:00', rooms=[
    Room(name, use, 0, SQUARE, [], 0.0, 2.5, 16.0, False)
    for name, use in (('a', 'kitchen'), ('b', 'kitchen'), ('c', 'bathroom'))])
ROOMS = {'pir/p1': 'a', 'pir/p2': 'b', 'pir/p3': 'c', 'rfid/r': 'a'}


def by_room(folder: Path, room: str) -> Rules:
    text = f"signals:\n  moves: {{of: pir/*, in: {room}, is: motion}}\nrules:\n" \
        "  - {name: r, reason: x, when: [moves]}\n"
    return at_home(rules_of(folder, text), HOME, ROOMS, ROOMS)


@pytest.mark.parametrize('room, of', [('kitchen', ('pir/p1', 'pir/p2')), ('c', ('pir/p3',)),
                                      ('[bathroom, a]', ('pir/p1', 'pir/p3'))])
def test_a_signal_means_the_sensors_in_rooms_of_a_name_or_use(tmp_path: Path, room: str,
                                                              of: tuple[str, ...]) -> None:
    assert by_room(tmp_path, room).signals['moves'].of == of


def test_the_home_says_when_the_day_begins_unless_the_rules_do(tmp_path: Path) -> None:
    assert by_room(tmp_path, 'a').starts == 7.5 * 3600
    assert at_home(rules_of(tmp_path, RIGHT), HOME, ROOMS, ROOMS).starts == 6 * 3600


@pytest.mark.parametrize('signal, why', [
    ('{of: pir/*, in: hall, is: motion}', 'the home has no hall'),
    ('{of: stove/*, is: on}', r'the home has no stove/\*'),
    ("{of: 'door/{entrance}', is: open}", 'the home has no main entrance')])
def test_a_rule_is_left_out_where_the_home_has_nothing_for_it(
        tmp_path: Path, signal: str, why: str) -> None:
    text = f"signals:\n  moves: {{of: pir/*, is: motion}}\n  other: {signal}\nrules:\n" \
        "  - {name: r, reason: x, when: [moves]}\n  - {name: q, reason: x, when: [other]}\n"
    rules = at_home(rules_of(tmp_path, text), HOME, ROOMS, ROOMS)
    assert [rule.name for rule in rules.rules] == ['r']
    assert re.search(f'my.yaml:6: rule q is left out: {why}', rules.left_out[0])


def test_the_entrance_and_a_place_by_its_type(tmp_path: Path) -> None:
    text = "signals:\n  opened: {of: 'door/{entrance}', is: open}\nrules:\n" \
        "  - {name: r, reason: x, at: fridge, when: [opened]}\n"
    fridge = Thing('cooler3', 'fridge', 'a', [0.0] * 7, [])
    home = replace(HOME, entrance='front', things=[fridge])
    rules = at_home(rules_of(tmp_path, text), home, {}, {'door/front', 'door/back'})
    assert rules.signals['opened'].of == ('door/front',)
    assert rules.rules[0].at == 'cooler3'
    archway = at_home(rules_of(tmp_path, text), home, {}, {'door/back'})
    assert 'rule r is left out: the main entrance front is no device' in archway.left_out[0]


def test_an_unknown_room_is_rejected(tmp_path: Path) -> None:
    with pytest.raises(Failure, match="my.yaml:2: .*no room 'kitchn'; did you mean kitchen"):
        by_room(tmp_path, 'kitchn')
