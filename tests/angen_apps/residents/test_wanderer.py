"""One who walks from room to room, and how residents let a robot pass."""
from __future__ import annotations

import datetime
import math
from pathlib import Path
from random import Random

import pytest

from angen_apps.data.site import Site
from angen_apps.plan.apartment import apartment
from angen_apps.plan.writer import write_world
from angen_apps.residents import wanderer
from angen_apps.residents.household import Household
from angen_apps.residents.places import Spot
from angen_apps.residents.profiles import Profile
from angen_apps.residents.wanderer import Wanderer
from angen_apps.robot.planner import Point

PROFILE = Profile('wanderer', 0.8, {}, {}, (), {}, {}, closes_doors=0.6)
ROBOT = '<sdf version="1.6"><include><uri>model://turtlebot</uri></include></sdf>'


def household_of(folder: Path) -> tuple[Site, Household, Wanderer]:
    """A home of two storeys with a robot in its kitchen, and one who walks among all its rooms."""
    write_world(apartment(1, 2, 7), folder / 'two.world')
    site = Site(folder / 'two.world', 3, placed=False)
    place_robot(site, site.ground.spots('kitchen0', 1, Random(1))[0])
    household = Household(site.simulator, site.ground, 3, 'home', datetime.date(2026, 3, 23))
    spots = [Spot(point, room.storey, site.ground.elevation(room.storey), room.name)
             for room in site.home.rooms if room.name in site.ground.reached
             for point in site.ground.spots(room.name, 1, Random(room.name))]
    return site, household, Wanderer(household, 'anna', PROFILE, spots)


def place_robot(site: Site, at: Point) -> None:
    if 'turtlebot' in site.world.models:
        site.world.delete('turtlebot')
    site.world.spawn(ROBOT, 'turtlebot', (*at, 0.001, 0.0, 0.0, 0.0))


def test_a_wanderer_gets_to_rooms_of_both_storeys_and_stays(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(wanderer, 'OTHER_STOREY', 0.6)
    site, household, anna = household_of(tmp_path)
    rooms, storeys, stood = set(), set(), 0
    for second in range(1, 600):
        household.run(float(second))
        before = anna.at
        anna.look()
        stood += before == anna.at
        rooms.add(anna.room)
        storeys.add(anna.storey)
        z = site.simulator.body('anna').z
        assert math.isclose(z, site.ground.elevation(anna.storey), abs_tol=0.05) or anna.walks
    assert len(rooms) >= 4 and storeys == {0, 1}
    assert stood > 150


def test_no_leaf_is_turned_toward_a_robot(tmp_path: Path) -> None:
    site, household, anna = household_of(tmp_path)
    door = next(d for d in site.home.doors if d.kind == 'door' and 'kitchen0' in d.rooms)
    away = site.ground.spots('kitchen0', 1, Random(1))[0]
    place_robot(site, site.ground.near(*door.pose[:2], 0.0))
    household.run(1.0)
    process = anna._open(door)
    for _ in range(3):
        household.simulator.run(next(process) - anna.now)
        assert site.simulator.state('door', door.name)['mode'] == 'CLOSED'
    assert not household.doorway_free(*door.pose[:2], 0, 'anna')
    place_robot(site, away)
    household.simulator.run(next(process) - anna.now)
    assert site.simulator.state('door', door.name)['mode'] == 'OPENING'


def test_the_elevator_is_left_to_a_robot_beside_it(tmp_path: Path) -> None:
    site, household, anna = household_of(tmp_path)
    household.run(1.0)
    ride = site.ground.lift(0, 1)
    assert ride is not None
    anna.vanish()
    anna.enter(Spot(ride.waits, 0, 0.0, ''))
    place_robot(site, ride.cabin)
    process = anna._ride(1)
    assert next(process) == anna.now + 1.0  # it looks again
    assert site.simulator.state('elevator', ride.name)['mode'] == 'IDLE'


def test_an_elevator_that_another_called_away_is_called_again(tmp_path: Path) -> None:
    site, household, anna = household_of(tmp_path)
    household.run(1.0)
    lift = site.home.elevators[0].name
    process = anna._call(lift, 1)
    wakes = next(process)
    site.world.command('elevator', lift, 'Floor0')
    while wakes is not None and anna.now < 120.0:
        household.simulator.run(max(wakes - anna.now, 0.001))
        wakes = next(process, None)
    assert anna._opened
    assert site.simulator.state('elevator', lift)['target_floor'] == 1
