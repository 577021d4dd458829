"""The filter over cells, and the evidence of events."""
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from angen import Grid

from angen_apps.maps.gridmap import FREE
from angen_apps.robot.building import Start
from angen_apps.robot.entities import Entity
from angen_tools.session import Event
from angen_apps.robot.pilot import Pose
from angen_apps.robot.planner import Door
from angen_apps.seek.ambient import Ambient, RobotNow
from angen_apps.seek.belief import LIFT, Belief
from angen_apps.seek.home import Home, Pir
from angen_apps.seek.ways import Ways
from angen_tools.common import home as described

COUNT = 20  # cells in a row, 0.5 m apart; a door between the first and the last ten
DOOR = Door('kitchen0', (5.0, 0.0), np.pi / 2, np.pi, 1.0)


@pytest.fixture
def home() -> Home:
    at = np.array([(0.25 + 0.5 * i, 0.5) for i in range(COUNT)])
    room = (np.arange(COUNT) >= COUNT // 2).astype(int)
    edges = np.array([(i, i + 1) for i in range(COUNT - 1)])
    grid = Grid(np.full((20, 200), FREE, np.int8), (0.0, 0.0), 0.05, 0)
    still = (0.0, 0.0, 0.0, 1.0)
    robot = Entity('drive', 'robot', 'robot', (0.25, 0.5, 0.0, *still))
    entities = [robot, Entity('luminosity', 'kitchen_lux0', 'l', (9.0, 0.5, 2.0, *still)),
                Entity('pressure', 'kitchen_mat0', 'm', (8.0, 0.5, 0.0, *still))]
    start = Start(robot, robot, Pose(0.25, 0.5, 0.0), Pose(0, 0, 0))
    return Home(described.Home(), entities, start, {0: grid},
                {0: grid}, {0: [DOOR]}, {0: grid}, np.zeros(COUNT, int), at, room,
                ['hall0', 'kitchen0'], edges,
                ['kitchen0' if i == COUNT // 2 - 1 else '' for i in range(COUNT - 1)],
                [Pir('hall_pir0', room == 0, np.zeros(COUNT, bool), 0.0),
                 Pir('kitchen_pir0', room == 1, np.zeros(COUNT, bool), 0.0)],
                np.array([2, 17]), np.stack([room == 0, room == 1]), np.zeros(COUNT, bool))


def kitchen(belief: Belief) -> float:
    return belief.rooms()['kitchen0']


def test_motion_says_where_he_is_and_stillness_where_he_does_not_walk(home: Home) -> None:
    belief = Belief(home)
    assert kitchen(belief) == pytest.approx(0.5)
    belief.pir(home.pirs[1], True)
    assert kitchen(belief) > 0.95
    quiet = Belief(home)
    for _ in range(3):
        quiet.pir(home.pirs[1], False)
    assert 0.3 < kitchen(quiet) < 0.45  # he may stand there
    assert quiet.p[1, COUNT // 2:].sum() < 0.1 * quiet.p[0, COUNT // 2:].sum()


def test_the_sum_stays_one_and_nothing_is_ever_ruled_out(home: Home) -> None:
    belief = Belief(home)
    for motion in (True, False) * 20:
        belief.step(None)
        belief.pir(home.pirs[0], motion)
        belief.looked(home.room == 1)
        assert belief.p.sum() == pytest.approx(1.0)
        assert belief.p.min() > 0


def test_a_shut_door_keeps_him_an_open_one_does_not(home: Home) -> None:
    shares = {}
    for name, opened in (('shut', frozenset[str]()), ('open', frozenset({'kitchen0'})),
                         ('unknown', None)):
        belief = Belief(home)
        belief.near(home.room == 0, 1e-6)
        for _ in range(60):
            belief.step(opened)
        shares[name] = kitchen(belief)
    assert shares['shut'] < 0.001 < 0.1 < shares['unknown'] < shares['open'] < 0.5


def test_where_the_robot_looks_he_is_less_probable(home: Home) -> None:
    belief = Belief(home)
    belief.looked(home.room == 0)
    assert 0.7 < kitchen(belief) < 0.95


def robot(home: Home, **more: float) -> RobotNow:
    return replace(RobotNow(0.25, 0.5, 0, last_moved=-100.0), **more)


def test_a_door_that_the_robot_has_not_commanded_is_his(home: Home) -> None:
    opening = Event(10.0, 'kitchen0', 'door', 'opening', '')
    for commanded, near_door in (({}, True), ({('door', 'kitchen0'): 9.0}, False)):
        belief = Belief(home)
        there = robot(home)
        there.commanded = commanded
        Ambient(replace(home, pirs=[]), belief).step([opening], there, 10.0)
        share = belief.cells[home.around(5.0, 0.5, 0, 1.3)].sum()
        assert (share > 0.95) == near_door


def test_a_pir_that_may_see_the_robot_says_nothing(home: Home) -> None:
    motion = [Event(10.0, 'hall_pir0', 'pir', 'motion', '')]
    for last_moved, of_him in ((10.0, False), (-100.0, True)):
        belief = Belief(home)
        Ambient(home, belief).step(motion, robot(home, last_moved=last_moved), 10.0)
        assert (belief.rooms()['hall0'] > 0.9) == of_him


@pytest.mark.parametrize('event', [Event(3.0, 'kitchen_lux0', 'luminosity', 'changed', ''),
                                   Event(3.0, 'kitchen_mat0', 'pressure', 'pressed', '')])
def test_light_and_mats_say_where_he_is(home: Home, event: Event) -> None:
    belief = Belief(home)
    Ambient(replace(home, pirs=[]), belief).step([event], robot(home), 3.0)
    assert kitchen(belief) > 0.95


def test_the_robots_own_weight_on_a_mat_says_nothing(home: Home) -> None:
    belief = Belief(home)
    pressed = Event(3.0, 'kitchen_mat0', 'pressure', 'pressed', '')
    Ambient(replace(home, pirs=[]), belief).step([pressed], robot(home, x=8.2), 3.0)
    assert kitchen(belief) == pytest.approx(0.5)


def test_shut_doors_are_counted(home: Home) -> None:
    ways = Ways(home, None, {})  # type: ignore[arg-type]
    assert ways._doors_between(0, {'kitchen0'}).tolist() == [0, 1]
    assert ways._doors_between(0, set()).tolist() == [0, 0]


def test_an_elevator_costs_no_matrix_of_all_cells(home: Home) -> None:
    count = 4000
    at = np.array([(0.5 * i, 0.5) for i in range(count)])
    edges = np.array([(i, i + 1) for i in range(count - 1)])
    by_lift = np.isin(np.arange(count), [3, count - 1])
    large = replace(home, at=at, room=np.zeros(count, int), edges=edges, by_lift=by_lift,
                    edge_door=[''] * (count - 1))
    tracemalloc.start()
    belief = Belief(large)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 8 * count ** 2 / 10  # bytes
    for _ in range(2):
        belief.weigh(np.where(np.arange(count) == 3, 1.0, 0.0))
    belief.step(None)
    assert belief.p[1, count - 1] == pytest.approx(0.5 * LIFT / 2, rel=0.2)
