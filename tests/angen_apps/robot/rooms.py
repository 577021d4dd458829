"""Two rooms with a door, as a map."""
import math

import numpy as np
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED
from angen_apps.robot.planner import Door

# shut across the doorway; opens into the right room
DOOR = Door('d', (2.0, 0.5), math.pi / 2, 0.0, 1.0)


def two_rooms(floor: int = 0) -> Grid:
    """4 m x 2 m, with walls all round and one at x = 2 that has a doorway from y = 0.5 to 1.5."""
    cells = np.full((40, 80), FREE, np.int8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    cells[:10, 40] = cells[30:, 40] = OCCUPIED
    return Grid(cells, (0.0, 0.0), 0.05, floor)
