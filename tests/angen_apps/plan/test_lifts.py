"""Elevators of plans."""
from __future__ import annotations

from math import hypot
from pathlib import Path

import angen
import pytest

from angen_apps.plan.finish import finish
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
