"""The fronts of furniture that people open, and where their leaves swing."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from angen_apps.robot.planner import Door as Leaf
from angen_tools.common.home import Thing

NEAR, ABOVE = 0.9, 2.2  # m from a thing to the hinge of its front
UPRIGHT = 0.97  # |z| of the axis of a leaf that turns aside


class Fronts:
    """The fronts of a world's furniture."""

    def __init__(self, world: Any) -> None:
        self._hinges: dict[str, np.ndarray] = {}
        self._leaves: dict[str, Leaf] = {}
        shapes = world.shapes
        for _, name, model, _ in world.entities('cabinet'):
            joint = world.joint(f'{model}::front')
            self._hinges[name] = joint['anchor']
            if joint['type'] == 'revolute' and abs(joint['axis'][2]) > UPRIGHT:
                corners = np.vstack([shape[4] for shape in shapes
                                     if shape[:2] == (model, joint['child'])])
                self._leaves[name] = _leaf(name, joint, corners)

    def of(self, thing: Thing) -> str | None:
        """The front of a thing: the nearest one within reach, of two above each other the lower."""
        x, y, z = thing.pose[:3]
        near = sorted((round(math.dist(hinge[:2], (x, y)), 3), float(hinge[2]), name)
                      for name, hinge in self._hinges.items() if abs(hinge[2] - z) < ABOVE)
        return near[0][2] if near and near[0][0] < NEAR else None

    def leaf(self, thing: Thing) -> Leaf | None:
        """The leaf of its front; None if it has none, or one that does not turn aside."""
        return self._leaves.get(self.of(thing) or '')


def _leaf(name: str, joint: dict[str, Any], corners: np.ndarray) -> Leaf:
    hinge, (low, high) = joint['anchor'], joint['limits']
    across = corners[:, :2] - hinge[:2]
    far = across[np.hypot(*across.T).argmax()]
    turns = math.copysign(1.0, joint['axis'][2])
    shut = math.atan2(far[1], far[0]) - turns * joint['position']
    return Leaf(name, (float(hinge[0]), float(hinge[1])), shut,
                shut + turns * (high if high > -low else low), float(np.hypot(*far)),
                float(corners[:, 2].max()), bottom=float(corners[:, 2].min()))
