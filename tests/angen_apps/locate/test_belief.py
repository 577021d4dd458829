from dataclasses import replace
from math import cos, exp, isnan, pi, sin

import numpy as np
import pytest

from angen_apps.locate.belief import Belief, Evidence, Model
from angen_apps.locate.site import Site, make_site
from angen_apps.robot.entities import Entity
from angen_tools.common.failure import Failure
from angen_tools.common.home import Door, Elevator, Home, Landing, Room

HALL, STUDY, DEN = ((0.0, 4.0), (4.1, 8.0), (8.1, 12.0))


def described(*doors: Door) -> Home:
    """Three rooms of 4 x 4 m in a row."""
    rooms = [Room(name, 'other', 0, [(x0, 0.0), (x1, 0.0), (x1, 4.0), (x0, 4.0)], [], 0.0, 3.0,
                  4 * (x1 - x0), False)
             for name, (x0, x1) in (('hall0', HALL), ('study0', STUDY), ('den0', DEN))]
    return Home(rooms=rooms, doors=list(doors))


def door(name: str, a: str, b: str, kind: str = 'door') -> Door:
    return Door(name, kind, (a, b), 0.9, 2.0, (0.0, 0.0, 0.0, 0.0))


def sensor(kind: str, name: str, at: tuple[float, float, float], yaw: float = 0.0) -> Entity:
    room = described().room_at(*at)
    return Entity(kind, name, name, (*at, 0.0, 0.0, sin(yaw / 2), cos(yaw / 2)),
                  room=room.name if room else '')


def home(*more: Entity) -> Site:
    """With doors between them, a PIR in each and a reader in the first."""
    things = [sensor('pir', f'{name}_pir0_a', (x, 0.1, 2.3), 1.57)
              for name, x in (('hall', 2), ('study', 6), ('den', 10))]
    things += [sensor('rfid', 'gate', (0.1, 2.0, 2.0))]
    return make_site(described(door('study0', 'hall0', 'study0'), door('den0', 'den0', 'study0')),
                     [*things, *more])


def read(tag: str, distance: float = 2.0) -> Evidence:
    return Evidence(reads={'gate': {tag: distance}})


def silent(**more) -> Evidence:
    return Evidence(reads={'gate': {}}, **more)


def test_rooms_are_joined_by_doors_and_openings():
    assert home().ways == [(0, 1, 'study0'), (1, 2, 'den0')]
    site = make_site(described(door('front', '', 'hall0'),
                               door('pane', 'hall0', 'study0', 'window'),
                               door('arch', 'study0', 'hall0', 'opening')), [])
    assert site.ways == [(0, 1, '')]


def test_an_elevator_joins_its_landings():
    lift = Elevator('lift', (0.0,) * 6 + (1.0,),
                    [Landing(i, name, (0.0,) * 4) for i, name in enumerate(('hall0', '', 'den0'))])
    assert make_site(replace(described(), elevators=[lift]), []).ways == [(0, 2, '')]


def test_a_sensor_in_a_wall_is_in_its_room():
    site = home(sensor('pir', 'wall', (2.0, -0.05, 1.0)), sensor('pir', 'out', (2, -1, 1)))
    assert site.of_kind('pir') == {'hall_pir0_a': 0, 'study_pir0_a': 1, 'den_pir0_a': 2, 'wall': 0}


def test_a_home_without_rooms_cannot_be_located_in():
    with pytest.raises(Failure, match='angen:room'):
        make_site(Home(), [])


def test_without_evidence_a_belief_spreads_as_its_rates_say():
    joined = replace(described(door('arch', 'hall0', 'study0', 'opening')),
                     rooms=described().rooms[:2])
    belief = Belief(make_site(joined, []), Model(leaves=0.15))
    belief.chances['a'] = np.array([1.0, 0.0])
    for _ in range(40):
        belief.step(Evidence(), 0.05)
    # in steps of 0.05 s a share of 1 - exp(-0.15 * 0.05) moves each way
    stays = 2 * exp(-0.15 * 0.05) - 1
    assert belief.chances['a'][0] == pytest.approx(0.5 * (1 + stays ** 40), rel=1e-9)


def test_a_tag_that_is_read_is_in_the_readers_room_and_at_its_distance():
    belief = Belief(home())
    for _ in range(3):
        belief.step(read('a'))
    answer, = belief.answers()
    assert (answer.tag, answer.room) == ('a', 'hall0') and answer.chance > 0.9
    # the middle of a half circle: 2 r / pi before the reader
    radius = (2.0 ** 2 - 1.0) ** 0.5
    assert answer.at[0] - 0.1 == pytest.approx(2 * radius / pi, abs=0.15)
    assert answer.at[1] == pytest.approx(2.0, abs=0.1)


def test_unread_tags_are_not_named_and_lost_ones_are_unknown():
    belief = Belief(home())
    belief.step(silent(motion={'hall_pir0_a': True}))
    assert belief.answers() == []
    belief.step(read('a'))
    for _ in range(600):
        belief.step(Evidence())
    answer, = belief.answers()
    assert answer.room == '' and isnan(answer.at[0])


def test_motion_leads_a_tag_through_open_doors():
    belief = Belief(home())
    for _ in range(4):
        belief.step(read('a'))
    for room in ('study', 'den'):
        for _ in range(12):
            belief.step(silent(motion={f'{name}_pir0_a': name == room
                                       for name in ('hall', 'study', 'den')}))
        assert belief.answers()[0].room == f'{room}0'


def test_a_shut_door_holds_a_tag():
    def after(is_open: bool) -> float:
        belief = Belief(home())
        for _ in range(4):
            belief.step(read('a'))
        for _ in range(4):
            belief.step(silent(open={'study0': is_open},
                               motion={'hall_pir0_a': False, 'study_pir0_a': True,
                                       'den_pir0_a': False}))
        return belief.chances['a'][1]

    assert after(True) > 0.6 > 0.4 > after(False)


def test_what_another_explains_is_no_evidence():
    lone, accompanied = Belief(home()), Belief(home())
    for _ in range(4):
        lone.step(read('a'))
        accompanied.step(read('a'))
    accompanied.chances['b'] = np.array([0.001, 0.998, 0.001])
    for belief in (lone, accompanied):
        belief.step(silent(motion={'hall_pir0_a': False, 'study_pir0_a': True}))
    assert accompanied.chances['a'][1] < 0.7 * lone.chances['a'][1]


def test_a_mat_says_in_which_room_somebody_is():
    site = home(sensor('pressure', 'mat', (6.0, 2.0, 0.0)))
    belief = Belief(site)
    belief.step(read('a'))
    for _ in range(3):
        belief.step(silent(pressed={'mat': True}))
    assert belief.answers()[0].room == 'study0'
