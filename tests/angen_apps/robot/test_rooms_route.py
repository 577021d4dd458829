"""A route through the rooms of a home that has neither robot nor person."""
from __future__ import annotations

from pathlib import Path

import angen

from angen_apps.plan.apartment import apartment
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
