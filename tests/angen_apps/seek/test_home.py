"""A search in a home of Sweet Home 3D, where people and robots meet at close quarters."""
from pathlib import Path

import numpy as np

from angen_apps.imports.sweethome import read_sweethome
from angen_apps.plan.writer import write_world
from angen_apps.seek.command import seek, survey
from angen_bench import homes


def test_a_person_close_before_the_robot_is_found(tmp_path: Path) -> None:
    """At the start a person stands 1 m before the robot, whose camera sees 0.7 m of it."""
    (tmp_path / 'studio.xml').write_bytes(homes.examples()['Studio'])
    world = tmp_path / 'studio.world'
    write_world(read_sweethome(tmp_path / 'studio.xml'), world, 'seed')
    assert seek(None, world, 44, True, 30.0, tmp_path / 'out', False) == 0
    assert (tmp_path / 'out/search.png').stat().st_size > 10_000


def test_the_search_is_indoors(tmp_path: Path) -> None:
    """Beside the oblique wall of this home the free ground outside is larger than any room."""
    name = '1BedroomApartmentWithRoundWall'
    (tmp_path / 'home.xml').write_bytes(homes.examples()[name])
    write_world(read_sweethome(tmp_path / 'home.xml'), tmp_path / 'home.world', 'seed')
    home, _, _ = survey(None, tmp_path / 'home.world', tmp_path / 'out')
    assert len(home.at) > 20
    rooms = home.described.rooms
    away = np.array([min(0.0 if room.contains(x, y) else room.distance(x, y) for room in rooms)
                     for x, y in home.at])
    assert away.max() < 0.3
