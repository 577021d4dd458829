"""angen check: whether a world file loads."""
from __future__ import annotations

from angen_tools.common.catalog import angen_module


def check_world(path: str) -> tuple[list[str], str]:
    """Loads a world without ROS: (one line for each thing that is wrong, what is in it)."""
    angen = angen_module()
    try:
        world = angen.World(path)
    except angen.Error as error:
        return str(error).splitlines(), ''
    return [], (f'{path}: nothing is wrong; {len(world.models)} models, {len(world.devices())} '
                f'devices, {len(world.sensors())} sensors')
