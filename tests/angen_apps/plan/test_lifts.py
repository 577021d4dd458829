"""Elevators of plans."""
from __future__ import annotations

from math import hypot, pi
from pathlib import Path

import angen
import pytest

from angen_apps.plan.finish import finish
from angen_apps.plan.lifts import shaft, with_shafts
from angen_apps.plan.model import Lift, Plan, Room, Storey, Wall
from angen_apps.plan.writer import write_world
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
