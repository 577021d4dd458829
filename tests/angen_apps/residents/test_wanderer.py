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
    place_robot(site, site.floors.spots('kitchen0', 1, Random(1))[0])
    household = Household(site.simulator, site.floors, 3, 'home', datetime.date(2026, 3, 23))
    spots = [Spot(point, room.storey, site.home.elevation(room.storey), room.name)
             for room in site.home.rooms if room.name in site.floors.reached
             for point in site.floors.spots(room.name, 1, Random(room.name))]
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
    while len(rooms) < 4 or storeys != {0, 1} or stood <= 150:
        assert household.now < 600.0
        household.run(household.now + 1.0)
        before = anna.at
        anna.look()
        stood += before == anna.at
        rooms.add(anna.room)
        storeys.add(anna.storey)
        z = site.simulator.body('anna').z
        assert math.isclose(z, site.home.elevation(anna.storey), abs_tol=0.05) or anna.walks


def test_no_leaf_is_turned_toward_a_robot(tmp_path: Path) -> None:
    site, household, anna = household_of(tmp_path)
    door = next(d for d in site.home.doors if d.kind == 'door' and 'kitchen0' in d.rooms)
    goal = site.floors.spots('kitchen0', 1, Random(1))[0]
    before = site.floors.near(*door.pose[:2], 0.0)
    place_robot(site, before)
    household.run(1.0)
    anna.vanish()
    anna.enter(Spot(site.floors.spots('hall0', 1, Random(2))[0], 0, 0.0, 'hall0'))
    process = anna.go(goal, 0)
    while anna.now < 15.0:
        household.simulator.run(next(process) - anna.now)
        assert site.simulator.state('door', door.name)['mode'] == 'CLOSED'
    assert not household.robot_near(*goal, 1.0)
    place_robot(site, site.floors.spots('bedroom0', 1, Random(1))[0])
    for wakes in process:
        household.simulator.run(max(wakes - anna.now, 0.001))
    assert anna.arrived and anna.room == 'kitchen0'


def test_the_elevator_is_left_to_a_robot_beside_it(tmp_path: Path) -> None:
    site, household, anna = household_of(tmp_path)
    household.run(1.0)
    lift, = site.home.elevators
    x, y, z, _ = lift.landings[0].pose
    anna.vanish()
    anna.enter(Spot((x, y), 0, z, ''))
    place_robot(site, lift.pose[:2])
    process = anna.go(site.floors.spots('hall1', 1, Random(1))[0], 1)
    assert next(process) == anna.now + 1.0  # it looks again
    assert site.simulator.state('elevator', lift.name)['mode'] == 'IDLE'


def test_an_elevator_that_another_called_away_is_called_again(tmp_path: Path) -> None:
    site, household, anna = household_of(tmp_path)
    household.run(1.0)
    lift, = site.home.elevators
    anna.vanish()
    anna.enter(Spot(site.floors.spots('hall0', 1, Random(1))[0], 0, 0.0, ''))
    called = False
    for wakes in anna.go(site.floors.spots('hall1', 1, Random(1))[0], 1):
        household.simulator.run(max(wakes - anna.now, 0.001))
        if not called and site.simulator.state('elevator', lift.name)['mode'] != 'IDLE':
            site.world.command('elevator', lift.name, 'Floor1')
            called = True
    assert called and anna.arrived and anna.room == 'hall1'
