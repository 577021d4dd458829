"""The box around a world, by its angen_msgs/Scene."""
from itertools import product
from typing import Any

import numpy as np

from angen_tools.common.geometry import rotation

BUILDING = ('walls', 'floors', 'ceilings', 'elevators')  # groups of its markers
AROUND = ('ground', 'people', 'robots')  # groups that do not bound a world
CORNERS = np.array(list(product((-0.5, 0.5), repeat=3)))
EMPTY = np.array([[-2.0, -2.0, 0.0], [2.0, 2.0, 2.0]])  # m, of a world without shapes


def bounds(scene: Any) -> np.ndarray:
    """Lowest and greatest x y z of its buildings, or of all where there are none."""
    groups = [link.group.partition(' ')[0] for link in scene.links]
    for counts in (lambda group: group in BUILDING, lambda group: group not in AROUND):
        points = [_points(scene, shape) for shape in scene.shapes if counts(groups[shape.link])]
        if any(map(len, points)):
            every = np.concatenate(points)
            return np.array([every.min(axis=0), every.max(axis=0)])
    return EMPTY


def _points(scene: Any, shape: Any) -> np.ndarray:
    """The points of a shape, in the world: the corners of its box, or a mesh's vertices."""
    points = CORNERS * (shape.size.x, shape.size.y, shape.size.z)
    if shape.type == shape.MESH:
        points = np.array(scene.meshes[shape.mesh].vertices, dtype=float).reshape(-1, 3)
    for pose in (shape.pose, scene.links[shape.link].pose):
        at = pose.position
        points = points @ rotation(pose.orientation).T + (at.x, at.y, at.z)
    return points
