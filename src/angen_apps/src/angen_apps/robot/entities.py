"""Devices and sensors of a world, with the rooms that its home says they are in."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from angen_apps.robot.pilot import Pose
from angen_tools.common.geometry import rotation_of, yaw
from angen_tools.common.home import Home


@dataclass(frozen=True)
class Entity:
    """A device or a sensor: of a sensor its own pose, of a device that of its model."""

    kind: str
    name: str
    model: str
    pose: tuple[float, ...]  # x y z (m) qx qy qz qw, in the world
    topic: str = ''
    floor: int = 0
    room: str = ''

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


def entity_of(message: Any, home: Home) -> Entity:
    """An angen_msgs/Entity."""
    at, turned = message.pose.position, message.pose.orientation
    return Entity(message.kind, message.name, message.model,
                  (at.x, at.y, at.z, turned.x, turned.y, turned.z, turned.w), message.topic,
                  home.storey_at(at.z), message.room)


def entities_of(world: Any) -> list[Entity]:
    """All devices and sensors of an angen.World."""
    home, found = Home.of_world(world), []
    for kind, name, model, pose in world.entities():
        x, y, z, *turned = (float(value) for value in pose)
        found.append(Entity(kind, name, model, (x, y, z, *turned), floor=home.storey_at(z),
                            room=world.room_at(x, y, z)))
    return found
