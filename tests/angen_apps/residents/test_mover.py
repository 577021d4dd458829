"""Residents on their way: past leaves that stand open, and by elevator."""
from __future__ import annotations

import datetime
import math
from pathlib import Path
from random import Random

from angen_apps.data.site import Site, apartment as furnished
from angen_apps.plan.apartment import apartment
from angen_apps.plan.writer import write_world
from angen_apps.residents.activities import Step
from angen_apps.residents.ground import BODY
from angen_apps.residents.household import Household
from angen_apps.residents.places import Places, Spot
from angen_apps.residents.profiles import read
from angen_apps.residents.resident import Resident

LEAF = 0.9  # m


def home_of(path: Path) -> tuple[Site, Household, Resident]:
    site = Site(path, 3, placed=False)
    household = Household(site.simulator, site.ground, 3, 'home', datetime.date(2026, 3, 23))
    anna = Resident(household, 'anna', 0, read('worker'))
    household.residents.append(anna)
    return site, household, anna


def test_no_place_is_inside_of_a_leaf_that_stands_open(tmp_path):
    furnished(tmp_path / 'home.world')
    site, _, _ = home_of(tmp_path / 'home.world')
    door = next(d for d in site.home.doors if (d.kind, d.name) == ('door', 'kitchen0'))
    x, y = door.pose[0] - door.width / 2, door.pose[1]  # its hinge; it opens into the kitchen
    ground = site.ground
    for along in (0.3, 0.5, 0.7):
        for away in (-BODY + 0.1, 0.0, BODY - 0.1):
            assert not ground.planners[0].is_free((x + away, y - along))
    rooms = {ground.room_name(*site.ground.spots(r.name, 1, Random(1))[0], 0)
             for r in site.home.rooms if r.storey == 0 and r.use != 'outdoor'}
    assert {'kitchen0', 'livingroom0', 'bedroom0', 'bathroom0', 'workroom0'} <= rooms


def test_a_resident_rides_the_elevator_up_and_down(tmp_path):
    write_world(apartment(1, 2, 7), tmp_path / 'two.world')
    site, household, anna = home_of(tmp_path / 'two.world')
    seen = []

    def script():
        anna.enter(household.places.anywhere())
        for storey in (1, 0):
            room = next(r for r in site.home.rooms if (r.storey, r.use) == (storey, 'bathroom'))
            goal = site.ground.spots(room.name, 1, Random(2))[0]
            yield from anna.go(goal, storey)
            seen.append((anna.arrived, storey, math.dist(anna.at, goal), anna.room == room.name,
                         site.simulator.body('anna').z))

    household.add(script())
    household.run(400.0)
    floors = {s.number: s.elevation for s in site.home.storeys}
    assert len(seen) == 2 and {storey for _, storey, *_ in seen} == {0, 1}
    for arrived, storey, away, inside, z in seen:
        assert arrived and inside and away < 0.2 and abs(z - floors[storey]) < 0.02
    assert not household.held


def test_who_is_blocked_shuts_leaves_that_nobody_holds(tmp_path):
    furnished(tmp_path / 'home.world')
    site, household, anna = home_of(tmp_path / 'home.world')
    doors = ('kitchen0', 'bathroom0', 'bedroom0')
    for door in doors:
        site.world.command('door', door, 'Open')
    household.run(6.0)
    place = {d.name: d.pose for d in site.home.doors if d.kind == 'door'}
    x, y = ((place['kitchen0'][i] + place['bathroom0'][i]) / 2 for i in (0, 1))
    at = site.ground.near(x, y, 0.0)
    anna.enter(Spot(at, 0, 0.0, 'entrance0'))
    held = [door for door in doors if math.dist(at, place[door][:2]) < 2.5][0]
    household.take(('door', held), 'bert')
    anna._shut_around()
    household.run(household.now + 8.0)
    for door in doors:
        near = door != held and math.dist(at, place[door][:2]) < 2.5
        assert site.simulator.state('door', door)['mode'] == ('CLOSED' if near else 'OPEN'), door


def test_nobody_sits_where_a_table_covers_the_seat(tmp_path):
    path = tmp_path / 'home.world'
    furnished(path)
    _, household, _ = home_of(path)
    chairs = household.places.spots(Step(at=('chair',), posture='sit'))
    x, y, z = chairs[0].place.pose[:3]
    board = (f'<model name="board"><static>true</static><pose>{x} {y} {z + 0.3} 0 0 0</pose>'
             '<link name="l"><collision name="c"><geometry><box><size>0.5 0.5 0.03</size></box>'
             '</geometry></collision></link></model>')
    path.write_text(path.read_text().replace('</world>', board + '</world>'))
    _, household, _ = home_of(path)
    left = household.places.spots(Step(at=('chair',), posture='sit'))
    assert {c.key for c in chairs} - {c.key for c in left} == {chairs[0].key}


def test_who_cannot_get_near_a_thing_stands_in_its_room(tmp_path, monkeypatch):
    furnished(tmp_path / 'home.world')
    site, _, _ = home_of(tmp_path / 'home.world')
    monkeypatch.setattr(site.ground, 'near', lambda *_: None)
    spots = Places(site.ground).spots(Step(at=('fridge',)))
    assert spots and all(spot.room == 'kitchen0' and not spot.thing for spot in spots)
