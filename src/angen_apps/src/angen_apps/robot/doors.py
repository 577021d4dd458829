"""The doors of a building, as its home and its devices describe them."""
import math
from typing import Any, Mapping

from angen_apps.robot.planner import Door
from angen_tools.common.home import Door as Described


def door_of(described: Described, state: Mapping[str, Any]) -> Door:
    """A door by its description and the state of its device, which has a hinge if its leaf turns.
    Of a leaf that slides only the place when it is shut is known."""
    x, y, z, yaw = described.pose
    top = z + described.height
    if 'hinge' in state:
        x, y, _ = state['hinge']
        return Door(described.name, (x, y), state['shut'], state['shut'] + state['opens'],
                    state['width'], top, described.partner, bottom=z)
    half = described.width / 2
    end = (x - half * math.cos(yaw), y - half * math.sin(yaw))
    return Door(described.name, end, yaw, yaw, described.width, top, described.partner, True, z)
