"""Homes by seed: sizes by the stated sources, and nothing wrong in the world."""
from pathlib import Path

import pytest

from angen_apps.plan.apartment import CEILING, apartment
from angen_apps.plan.polygons import area
from angen_apps.plan.writer import world_of
from angen_bench import homes
from angen_tools.common.geometry import bounds
from angen_tools.world import sdf


@pytest.mark.parametrize('seed', range(30))
def test_rooms_are_as_large_as_the_standard_asks(seed: int) -> None:
    rooms = 1 + seed % 5
    plan = apartment(rooms, 1, seed)
    assert CEILING >= 2.3
    assert len(plan.all_rooms()) == rooms + 3
    bedrooms = sorted((area(room.polygon), room) for room in plan.all_rooms()
                      if room.use == 'bedroom')
    assert bedrooms[-1][0] >= 11.5
    for size, room in bedrooms:
        west, south, east, north = bounds(room.polygon)
        assert size >= 7.5 and min(east - west, north - south) >= 2.15


def test_the_same_seed_gives_the_same_bytes_and_another_one_another_home() -> None:
    first, again, other = (sdf.text(world_of(apartment(3, 2, seed), 'seed')[0])
                           for seed in (5, 5, 6))
    assert first == again and first != other


@pytest.mark.parametrize('seed', [4, 7])  # five rooms, and two storeys
def test_a_home_has_no_finding_its_doors_open_and_its_rooms_are_reached(seed: int, tmp_path: Path
                                                                        ) -> None:
    assert homes.examine_seed(seed, tmp_path) == []


@pytest.mark.parametrize('storeys', [1, 2])
def test_the_main_entrance_is_a_door(storeys: int) -> None:
    plan = apartment(3, storeys, 7)
    doors = {opening.name for opening in plan.all_openings() if opening.leaves}
    assert plan.entrance in doors  # and not the way into the elevator's shaft
