"""Devices and sensors of a world, with their floors."""
from dataclasses import dataclass

import numpy as np

from angen_apps.robot.pilot import Pose
from angen_tools import session
from angen_tools.common.geometry import rotation_of, yaw


@dataclass(frozen=True)
class Entity(session.Entity):
    """A model, device or sensor on a floor."""

    floor: int = 0

    @property
    def place(self) -> np.ndarray:
        """x, y, z, m."""
        return np.array(self.pose[:3])

    @property
    def rotation(self) -> np.ndarray:
        """The 3 x 3 matrix from its frame to the world."""
        return rotation_of(*self.pose[3:])

    @property
    def flat(self) -> Pose:
        """The pose from above."""
        return Pose(self.pose[0], self.pose[1], yaw(*self.pose[3:]))


def entities_of(world: session.World) -> list[Entity]:
    """The entities of a world."""
    home = world.home
    return [Entity(**vars(entity), floor=home.storey_at(entity.pose[2]))
            for entity in world.entities()]
