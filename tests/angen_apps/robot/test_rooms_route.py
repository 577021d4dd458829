"""A route through the rooms of a home that has neither robot nor person."""
from math import pi
from pathlib import Path

import angen

from angen_apps.plan.apartment import apartment
from angen_apps.plan.finish import finish
from angen_apps.plan.model import Leaf, Opening, Plan, Room, Storey, Wall
from angen_apps.plan.writer import write_world
from angen_apps.robot.rooms_route import prepare
from angen_apps.robot.route_file import default_route, read_route
from angen_tools.common.home import Home


def test_a_home_by_seed_gets_a_waypoint_in_each_room_a_robot_and_a_person(tmp_path: Path) -> None:
    path = tmp_path / 'home.world'
    write_world(apartment(1, 1, 3), path, 'none')
    route, world, survey = prepare(None, path, tmp_path / 'out')
    home = Home.of_world(angen.World(str(path)))
    assert survey is not None and list(survey.maps) == [0]
    assert sorted(w.name for w in route.waypoints) == sorted(room.name for room in home.rooms)
    for waypoint in route.waypoints:
        room = home.room_at(*waypoint.at, 0.5)
        assert room is not None and room.name == waypoint.name
    poses = {kind: pose for kind, _, _, pose in angen.World(str(world)).entities()}
    assert 'drive' in poses and route.elevator is None
    person = home.room_at(*poses['person'][:2], 0.5)
    assert person is not None and person.name == route.waypoints[-1].name
    assert route.speed == read_route(default_route()).speed


def test_the_main_entrance_stays_shut_where_its_leaf_would_fill_the_hall(tmp_path: Path) -> None:
    corners = [(0.0, 0.0), (7.0, 0.0), (7.0, 1.2), (0.0, 1.2)]
    walls = [*zip(corners, corners[1:] + corners[:1]), ((1.5, 0.0), (1.5, 1.2))]
    band = (-0.05, 0.05)
    front = Opening('door', 2.5, 0.0, 0.0, 0.9, 0.0, 2.1, band,
                    (Leaf((-0.445, 0.0), 0.89, 0.0, pi / 2),))
    arch = Opening('opening', 1.5, 0.6, pi / 2, 0.9, 0.0, 2.1, band)
    rooms = [Room(name, use, ((x, 0.0), (x + wide, 0.0), (x + wide, 1.2), (x, 1.2)), 0.0, 2.5)
             for name, use, x, wide in (('store', 'other', 0.0, 1.5), ('hall', 'hall', 1.5, 5.5))]
    storey = Storey(0, 'ground', 0.0, 2.5, rooms=rooms, openings=[front, arch],
                    walls=[Wall(a, b, 0.1, 0.0, 2.5) for a, b in walls])
    path = tmp_path / 'home.world'
    plan = finish(Plan('home', [storey]))
    write_world(plan, path, 'none')
    assert plan.entrance == 'hall0' and not plan.remarks
    route, _, _ = prepare(None, path, tmp_path / 'out')
    assert {waypoint.name for waypoint in route.waypoints} == {'hall0', 'store0'}
