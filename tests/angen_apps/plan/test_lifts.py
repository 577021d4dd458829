"""Elevators of plans."""
from math import hypot, pi
from pathlib import Path
from typing import Callable

import angen
import pytest

from angen_apps.plan.apartment import apartment
from angen_apps.plan.finish import finish
from angen_apps.plan.lifts import around_pits, shaft, with_shafts
from angen_apps.plan.model import Lift, Plan, Room, Storey, Wall
from angen_apps.plan.tower import building
from angen_apps.plan.writer import write_world
from angen_apps.residents.floors import Floors
from angen_tools.common.geometry import bounds
from angen_tools.common.home import Home


def test_one_waits_outside_of_a_large_cabin_that_is_in_its_room(tmp_path: Path) -> None:
    corners = ((0.0, 0.0), (12.0, 0.0), (12.0, 12.0), (0.0, 12.0))
    storeys = [Storey(number, f'L{number}', z, 3.0, rooms=[Room('hall', 'hall', corners, z, 2.5)],
                      walls=[Wall(a, b, 0.1, z, z + 2.5) for a, b in
                             zip(corners, corners[1:] + corners[:1])])
               for number, z in ((0, 0.0), (1, 3.0))]
    plan = finish(Plan('hall', storeys, lifts=[Lift('lift', 6.0, 6.0, 0.0, 2.5, 2.9, (0, 1))]))
    write_world(plan, tmp_path / 'hall.world', 'none')
    elevator, = Home.of_world(angen.World(str(tmp_path / 'hall.world'))).elevators
    assert [landing.room for landing in elevator.landings] == ['hall0', 'hall1']
    for landing in elevator.landings:
        away = hypot(landing.pose[0] - 6.0, landing.pose[1] - 6.0)
        assert away == pytest.approx(2.9 / 2 + 0.9, abs=0.1)


def drawn(lifts: list[Lift], walled: tuple[int, ...] = (0, 1, 2)) -> Plan:
    corners = ((0.0, 0.0), (8.0, 0.0), (8.0, 6.0), (0.0, 6.0))
    return Plan('home', [Storey(number, f'L{number}', 3.0 * number, 3.0, 0.49, walls=[
        Wall(a, b, 0.1, 3.0 * number, 3.0 * number + 2.5)
        for a, b in zip(corners, corners[1:] + corners[:1])] if number in walled else [])
        for number in (0, 1, 2)], lifts=lifts)


def test_a_lift_that_is_drawn_gets_a_shaft_where_it_stops() -> None:
    plan = drawn([Lift('Elevator A', 9.1, 3.0, pi, 1.58, 1.5, (1, 0), front=0.98),
                  Lift('Elevator A', 9.1, -3.0, 0.0, 1.58, 1.5, (1, 2), front=0.98)], (0, 1))
    with_shafts(plan)
    assert [(lift.name, lift.stops) for lift in plan.lifts] == [('elevator_a', (0, 1)),
                                                                ('elevator_a_b', (1, 2))]
    first, second, third = plan.storeys
    assert [len(storey.cutouts) for storey in plan.storeys] == [1, 2, 1]
    assert len(first.walls) == 4 + 3 and len(second.walls) == 4 + 3 + 4 and len(third.walls) == 4
    door = first.openings[0]  # in the east wall
    assert (door.x, door.y, door.kind) == (pytest.approx(8.0), pytest.approx(3.0), 'opening')
    again = [len(storey.walls) for storey in plan.storeys]
    with_shafts(plan)
    assert [len(storey.walls) for storey in plan.storeys] == again


def test_a_lift_with_a_shaft_of_its_own_stays_as_it_is() -> None:
    lift = Lift('Lift 1', 4.0, 3.0, 0.0, 1.5, 1.5, (0, 1, 2))
    plan = drawn([lift])
    plan.storeys[0].cutouts.append(shaft(lift))
    with_shafts(plan)
    assert plan.lifts == [lift] and not plan.storeys[0].openings


@pytest.mark.parametrize('make, sizes', [(apartment, (1, 2, 7)), (building, (1, 2, 2, 4))])
def test_the_ground_before_a_home_with_a_lift_is_level_with_its_floor(
        make: Callable[..., Plan], sizes: tuple[int, ...], tmp_path: Path) -> None:
    """People come and go by its main entrance, and its cabin comes down to that floor."""
    write_world(make(*sizes), tmp_path / 'home.world', 'none')
    world = angen.World(str(tmp_path / 'home.world'))
    home = Home.of_world(world)
    floors = Floors(angen.World(str(tmp_path / 'home.world')), home)
    assert floors.barred == {}
    (x, y), storey = floors.porch()
    assert storey == 0 and home.room_at(x, y, 0.5) is None
    for floor in (1, 0):
        world.command('elevator', 'elevator', f'Floor{floor}')
        world.run(20.0)
        assert world.device('elevator', 'elevator')['position'] == pytest.approx(3.0 * floor,
                                                                                 abs=0.005)


def test_ground_is_left_out_below_each_lift_only() -> None:
    plan = drawn([Lift('a', 2.0, 2.0, 0.0, 1.5, 1.5, (0, 1)),
                  Lift('b', 2.5, 5.0, pi / 2, 1.5, 1.5, (0, 1))])
    areas = around_pits(plan, 3.0)

    def covered(x: float, y: float) -> int:
        return sum(w < x < e and s < y < n for w, s, e, n in areas)

    pits = [bounds(shaft(lift)) for lift in plan.lifts]
    whole = sum((e - w) * (n - s) for w, s, e, n in areas + pits)
    assert whole == pytest.approx(14.0 * 12.0)
    assert [covered(lift.x, lift.y) for lift in plan.lifts] == [0, 0]
    assert [covered(*at) for at in ((2.3, 3.4), (-2.9, -2.9), (10.9, 8.9), (2.3, -1.0))] == 4 * [1]
