"""A search in a home of Sweet Home 3D, where people and robots meet at close quarters."""
from __future__ import annotations

from pathlib import Path

from angen_apps.imports.sweethome import read_sweethome
from angen_apps.plan.writer import write_world
from angen_apps.seek.command import seek
from angen_bench import homes


def test_a_person_nearer_than_the_camera_sees_is_found(tmp_path: Path) -> None:
    """At the start somebody is 0.6 m before the robot, who lets it pass, and waits for it."""
    (tmp_path / 'studio.xml').write_bytes(homes.examples()['Studio'])
    world = tmp_path / 'studio.world'
    write_world(read_sweethome(tmp_path / 'studio.xml'), world, 'seed')
    assert seek(None, world, 2, True, 30.0, tmp_path / 'out', False) == 0
    assert (tmp_path / 'out/search.png').stat().st_size > 10_000
