"""Apartment buildings: each apartment has all its rooms, and the elevator serves all storeys."""
from collections import Counter
from pathlib import Path

import angen
from angen_apps.plan.apartment import RISE
from angen_apps.plan.finish import sides
from angen_apps.plan.tower import building
from angen_apps.plan.writer import world_of
from angen_bench import homes
from angen_tools.world import sdf

STOREYS, APARTMENTS = 3, 3
USES = Counter({'bedroom': 1, 'kitchen': 1, 'bathroom': 1, 'hall': 1})


def test_each_apartment_has_its_rooms_windows_and_a_door_to_the_corridor() -> None:
    plan = building(1, STOREYS, APARTMENTS, 4)
    for storey in plan.storeys:
        for letter in 'abc':
            rooms = [room for room in storey.rooms
                     if room.name.endswith(f'_{letter}{storey.number}')]
            assert Counter(room.use for room in rooms) == USES
        joined = [sides(opening, storey) for opening in storey.openings]
        doors = [pair for pair in joined if f'corridor{storey.number}' in [
            room.name for room in pair if room is not None]]
        assert sum(None not in pair for pair in doors) == APARTMENTS
        assert sum(opening.kind == 'window' and None in pair
                   for opening, pair in zip(storey.openings, joined)) == 3 * APARTMENTS
    assert plan.entrance == 'corridor0'
    assert plan.lifts[0].stops == (0, 1, 2) and plan.remarks == []


def test_the_same_seed_gives_the_same_bytes() -> None:
    first, again, other = (sdf.text(world_of(building(1, 2, 2, seed), 'seed')[0])
                           for seed in (5, 5, 6))
    assert first == again and first != other


def test_it_has_no_finding_its_doors_open_and_its_rooms_are_reached(tmp_path: Path) -> None:
    plan = building(1, STOREYS, APARTMENTS, 4)
    path = tmp_path / 'building.world'
    assert homes.examine_plan(plan, path, 4 * APARTMENTS + 1) == []
    world = angen.World(str(path))
    for floor in (2, 1):
        world.command('elevator', 'elevator', f'Floor{floor}')
        world.run(20.0)
        state = world.device('elevator', 'elevator')
        assert state['floor'] == floor
        assert abs(state['position'] - RISE * floor) < 0.005
