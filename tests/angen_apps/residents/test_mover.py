"""Residents on their way, and where they can be in a home."""
from __future__ import annotations

import datetime
import math
from dataclasses import replace
from pathlib import Path
from random import Random

import numpy as np

from angen_apps.data.site import Site, apartment as furnished
from angen_apps.imports.sweethome import read_sweethome
from angen_apps.plan.apartment import apartment
from angen_apps.plan.writer import write_world
from angen_apps.residents import places
from angen_apps.residents.activities import Step
from angen_apps.residents.floors import BODY
from angen_apps.residents.household import Household
from angen_apps.residents.places import Places, Spot
from angen_apps.residents.profiles import read
from angen_apps.residents.resident import Resident
from angen_bench.homes import examples

WORLD = Path(__file__).resolve().parents[3] / 'worlds/angen.world'


def home_of(path: Path) -> tuple[Site, Household, Resident]:
    site = Site(path, 3, placed=False)
    household = Household(site.simulator, site.floors, 3, 'home', datetime.date(2026, 3, 23))
    anna = Resident(household, 'anna', 0, read('worker'))
    household.residents.append(anna)
    return site, household, anna


def test_no_place_is_inside_of_an_open_leaf(tmp_path):
    furnished(tmp_path / 'home.world')
    site, _, _ = home_of(tmp_path / 'home.world')
    door = next(d for d in site.home.doors if (d.kind, d.name) == ('door', 'kitchen0'))
    x, y = door.pose[0] - door.width / 2, door.pose[1]  # its hinge; it opens into the kitchen
    floors = site.floors
    for along in (0.3, 0.5, 0.7):
        for away in (-BODY + 0.1, 0.0, BODY - 0.1):
            assert not floors.is_free((x + away, y - along), 0)
    rooms = {floors.room_name(*site.floors.spots(r.name, 1, Random(1))[0], 0)
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
            goal = site.floors.spots(room.name, 1, Random(2))[0]
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


def test_no_one_sits_where_a_table_covers_the_seat(tmp_path):
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


def test_a_thing_that_cannot_be_reached_is_no_place_but_its_room_may_be(tmp_path, monkeypatch):
    furnished(tmp_path / 'home.world')
    site, _, _ = home_of(tmp_path / 'home.world')
    monkeypatch.setattr(site.floors, 'near', lambda *_: None)
    assert Places(site.floors).spots(Step(at=('fridge',))) == []
    spots = Places(site.floors).spots(Step(at=('fridge',), room='kitchen'))
    assert spots and all(spot.room == 'kitchen0' and not spot.thing for spot in spots)


WALLS = ((0, 0, 800, 0), (800, 0, 800, 400), (800, 400, 0, 400), (0, 400, 0, 0),
         (0, 250, 500, 250), (500, 0, 500, 400))
ROOMS = {'Kitchen': (0, 0, 500, 250), 'Hall': (0, 250, 500, 400), 'Living': (500, 0, 800, 400)}
DOORS = {'Front door': (0, 325, 1.5708), 'Door': (250, 250, 3.1416),
         'Inner door': (500, 325, 1.5708)}


def narrow(folder: Path) -> Path:
    """A home whose kitchen door opens into a narrow hall, between its entrance and living room."""
    xml = ''.join('<wall xStart="%d" yStart="%d" xEnd="%d" yEnd="%d" thickness="20"/>' % wall
                  for wall in WALLS)
    for name, (west, north, east, south) in ROOMS.items():
        corners = ((west, north), (east, north), (east, south), (west, south))
        xml += f'<room name="{name}">' + ''.join(
            f'<point x="{x}" y="{y}"/>' for x, y in corners) + '</room>'
    for name, (x, y, angle) in DOORS.items():
        xml += (f'<doorOrWindow catalogId="door" name="{name}" x="{x}" y="{y}" angle="{angle}" '
                'width="90" depth="20" height="210"><sash xAxis="0.015" yAxis="0.5" width="0.97" '
                'startAngle="0" endAngle="1.5707964"/></doorOrWindow>')
    (folder / 'home.xml').write_text(f'<home>{xml}</home>')
    write_world(read_sweethome(folder / 'home.xml'), folder / 'home.world', 'none')
    return folder / 'home.world'


def test_a_door_whose_leaf_closes_off_a_hall_is_always_shut(tmp_path):
    site, household, anna = home_of(narrow(tmp_path))
    assert site.floors.reached == {'hall0', 'kitchen0', 'living0'}
    anna.profile = replace(anna.profile, closes_doors=0.0)
    kitchen = household.places.free('kitchen', Random(1), 1)[0]
    found = []

    def script():
        anna.enter(kitchen)
        for goal in ((6.5, -2.0), kitchen.stand):
            yield from anna.go(goal, 0)
            yield anna.now + 6.0
            found.append((anna.arrived, {name: site.simulator.state('door', name)['mode']
                                         for name in ('kitchen0', 'living0')}))

    household.add(script())
    household.run(120.0)
    assert found == [(True, {'kitchen0': 'CLOSED', 'living0': 'OPEN'})] * 2


def test_no_gap_between_the_leaves_of_a_double_door_is_in_the_way(tmp_path):
    path = narrow(tmp_path)
    xml = (tmp_path / 'home.xml').read_text()
    sash = xml[xml.rindex('<sash'):xml.rindex('</doorOrWindow>')]
    leaves = (sash.replace('0.97', '0.47') + sash.replace('0.97', '0.47').replace(
        'xAxis="0.015"', 'xAxis="0.985"').replace('startAngle="0"', 'startAngle="3.1415927"'))
    (tmp_path / 'home.xml').write_text(xml.replace(sash, leaves))
    write_world(read_sweethome(tmp_path / 'home.xml'), path, 'none')
    site, household, anna = home_of(path)
    modes: dict[str, str] = {}

    def script():
        anna.enter(Spot((6.5, -2.0), 0, 0.0, 'living0'))
        yield from anna.go((3.5, -3.25), 0)
        modes.update({name: site.simulator.state('door', name)['mode']
                      for name in ('living_left0', 'living_right0')})

    household.add(script())
    household.run(40.0)
    assert anna.arrived and modes == {'living_left0': 'OPEN', 'living_right0': 'OPEN'}


def test_a_resident_waits_for_another_one_who_is_in_the_way(tmp_path):
    site, household, anna = home_of(narrow(tmp_path))
    bert = Resident(household, 'bert', 1, read('retired'))
    household.residents.append(bert)
    hall = Spot((2.5, -3.25), 0, 0.0, 'hall0')
    far = Spot((6.5, -2.0), 0, 0.0, 'living0')

    def stays():
        bert.enter(hall)
        yield 120.0
        yield from bert.go((1.0, -1.0), 0)

    def goes():
        anna.enter(Spot((0.6, -3.25), 0, 0.0, 'hall0'))
        yield from anna._reach(far, 'relax')

    household.add(stays())
    household.add(goes())
    household.run(220.0)
    anna.diary.end(household.now)
    phases = [i.phase for i in anna.diary.closed]
    assert anna.arrived and phases == ['goes', 'waits', 'goes']
    assert not any(i.note for i in anna.diary.closed)


def test_a_resident_whom_a_chair_shuts_in_gets_out():
    site, household, anna = home_of(WORLD)
    site.world.set_state('kitchen_chair0_b', [0.9, 1.25, 0.0, 0.0, 0.0, 0.4])

    def script():
        anna.enter(Spot((0.39, 1.5), 0, 0.0, 'kitchen0'))  # between a table and a wall
        yield from anna.go((2.25, 1.04), 0)

    household.add(script())
    household.run(200.0)
    assert anna.arrived and math.dist(anna.at, (2.25, 1.04)) < 0.1


def test_people_without_a_place_of_their_own_are_not_all_at_one(tmp_path):
    _, household, _ = home_of(narrow(tmp_path))
    places = household.places
    assert places.anywhere() == places.anywhere()
    assert len({places.anywhere(Random(seed)).stand for seed in range(5)}) > 2


def test_no_place_on_the_floor_is_chosen_where_somebody_is(tmp_path):
    _, household, anna = home_of(narrow(tmp_path))
    bert = Resident(household, 'bert', 1, read('retired'))
    household.residents.append(bert)
    here, there = (Spot((x, -3.25), 0, 0.0, 'hall0') for x in (2.5, 4.0))
    bert.enter(here)
    assert anna._choose([here, there]) == there and bert._choose([here, there]) == here


def test_unreachable_rooms_are_no_places(tmp_path):
    path = narrow(tmp_path)
    xml = (tmp_path / 'home.xml').read_text()
    kitchen = xml[xml.index('<doorOrWindow', xml.index('Front door')):]
    kitchen = kitchen[:kitchen.index('</doorOrWindow>') + len('</doorOrWindow>')]
    (tmp_path / 'home.xml').write_text(xml.replace(kitchen, ''))
    write_world(read_sweethome(tmp_path / 'home.xml'), path, 'none')
    site, household, anna = home_of(path)
    assert site.floors.reached == {'hall0', 'living0'}
    assert not household.places.rooms_of('kitchen') and household.places.rooms_of('hall')
    assert not household.places.free('kitchen', Random(1), 1)
    assert anna.leaves_out['dress'] == 'no wardrobe and no bed in reach'


def test_a_door_that_opens_too_little_is_a_wall(tmp_path):
    path = narrow(tmp_path)
    xml = (tmp_path / 'home.xml').read_text()
    chest = ('<pieceOfFurniture name="Chest" x="230" y="330" width="30" depth="90" height="90"/>'
             '</home>')  # stops its leaf at about 45 degrees
    (tmp_path / 'home.xml').write_text(xml.replace('</home>', chest))
    plan = read_sweethome(tmp_path / 'home.xml')
    write_world(plan, path, 'none')
    assert any('degrees only' in remark for remark in plan.remarks), plan.remarks
    site, _, _ = home_of(path)
    assert 'kitchen0' not in site.floors.reached


def test_who_sleeps_on_the_floor_leaves_others_a_way(tmp_path, monkeypatch):
    _, household, _ = home_of(narrow(tmp_path))
    hall = next(room for room in household.home.rooms if room.name == 'hall0')
    beds = list(household.places._beds(hall))
    grid = household.floors.grids[0]
    x, y = np.meshgrid(grid.x, grid.y)
    for across, divides in ((-3.25, True), (-3.6, False)):
        assert places._divides(household.floors.free[0], x - 2.5, y - across, 0.0) == divides
    spots = household.places.on_floor
    assert {spot.room for spot in spots[:2]} == {'kitchen0'}  # the largest
    assert any(not divides for _, _, divides in beds) and len(spots) > 4
    monkeypatch.setattr(places, 'MOST', 3)  # residents
    assert Places(household.floors).on_floor == spots[:3]


def test_a_room_drawn_over_another_one_takes_its_floor(tmp_path):
    path = narrow(tmp_path)
    text = path.read_text()
    room = text[text.index('<angen:room name="living0">'):]
    room = room[:room.index('</angen:room>') + len('</angen:room>')]
    assert 'living' in room
    path.write_text(text.replace(room, room + room.replace('living0', 'whole0')))
    site, _, _ = home_of(path)
    rooms = {room.name: room for room in site.home.rooms}
    floors = [site.floors.floor_of(rooms[name]).any() for name in ('living0', 'whole0')]
    assert sorted(floors) == [False, True]
    x, y = site.floors.spots(next(n for n in ('living0', 'whole0')
                                  if site.floors.floor_of(rooms[n]).any()), 1, Random(1))[0]
    assert site.floors.floor_of(site.home.room_at(x, y, 0.1)).any()


def test_a_second_door_to_the_outside_is_a_wall(tmp_path):
    """In this home its leaf is in the way, too."""
    (tmp_path / 'home.xml').write_bytes(examples()['1BedroomApartmentWithRoundWall'])
    write_world(read_sweethome(tmp_path / 'home.xml'), tmp_path / 'home.world', 'none')
    site, household, anna = home_of(tmp_path / 'home.world')
    porch, storey = site.floors.porch()

    def script():
        anna.enter(Spot((0.45, -5.0), storey, 0.0, ''))
        yield from anna.go(porch, storey)

    household.add(script())
    household.run(120.0)
    assert anna.arrived
