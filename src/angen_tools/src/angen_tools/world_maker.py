"""Writes a world of stacked flats with as many sensors of each kind as wanted."""
from __future__ import annotations

from pathlib import Path
from typing import Mapping

from .failure import Failure
from .placing import KINDS, Placement, generator, has_contact, placements


def apartment(floors: int, counts: Mapping[str, int], seed: int, elevator: bool = False
              ) -> list[Placement]:
    """The sensors of such a world; `counts` by kind. Failure where there is no room for them.

    The elevator holds a contact sensor, which counts.
    """
    if elevator and not counts.get('contact'):
        raise Failure('the elevator holds a contact sensor: give --contact 1 or more with it')
    return [placement for kind in KINDS
            for placement in placements(kind, counts.get(kind, 0), floors, seed, elevator)]


def write_apartment(path: Path, floors: int, counts: Mapping[str, int], seed: int,
                    elevator: bool = False) -> int:
    """Writes the world to a file; returns how many sensors it holds.

    Flats with doors, lamps, furniture and the person who walks on floor 0. Chairs and tables hold
    the contact sensors, so there are only as many as `counts` asks for. The same arguments give the
    same bytes. Failure where there is no room for the sensors.
    """
    plan, blocks = generator('plan'), generator('world')
    sensors = apartment(floors, counts, seed, elevator)
    root, world = blocks.new_world('apartment')
    blocks.add_world_plugins(world)
    for floor in range(floors):
        blocks.comment(world, f'floor {floor}')
        blocks.include(world, 'apartment', f'apartment{floor}',
                       (0, 0, floor * plan.STOREY, 0, 0, 0))
        blocks.add_devices(world, floor)
        for room in plan.FURNITURE:
            for model, name, pose in blocks.furniture_in(room, floor):
                if not has_contact(model):
                    blocks.include(world, model, name, pose)
    for kind in KINDS:
        blocks.comment(world, f'{kind}: {counts.get(kind, 0)}')
        for sensor in sensors:
            if sensor.kind == kind:
                blocks.include(world, sensor.model, sensor.name, sensor.pose)
    blocks.add_person(world)
    blocks.add_state(world, 'apartment')
    generator('sdf').write(root, path)
    return len(sensors)
