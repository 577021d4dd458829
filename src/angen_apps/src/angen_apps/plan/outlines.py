"""The shapes of a world seen from above: collisions, and leaves of doors from shut to open."""
from dataclasses import dataclass
from math import cos, sin
from typing import Any, Sequence

import numpy as np
from shapely.geometry import MultiPoint

LEVEL = 1e-3  # m between heights that are one
LEAST = 1.5  # m of height of a door's leaf whose joint has another name
STEPS = 16  # steps of a leaf from shut to open
LEAVES = ('hinge', 'sash', 'slide')  # joints of doors and windows
Corners = list[tuple[float, float]]


@dataclass(frozen=True)
class Shape:
    """A collision: its outline on the floor and its heights in the world."""

    model: str
    link: str
    type: str
    moves: bool
    corners: Corners
    bottom: float
    top: float
    tilted: bool  # at a height it is less than its outline


@dataclass(frozen=True)
class Leaf:
    """A leaf of a door or window: its outlines from shut to open, and its hinge if it turns."""

    model: str
    window: bool
    outlines: list[Corners]
    bottom: float
    hinge: tuple[float, float] | None

    @property
    def path(self) -> Corners:
        """Where the edge that is farthest from the hinge is, from shut to open."""
        shut = np.array(self.outlines[0])
        far = int(np.argmax(np.hypot(*(shut - self.hinge).T)))
        return [outline[far] for outline in self.outlines]


def shut(world: Any) -> None:
    """Shuts all doors and windows at once."""
    for name in world.joints:
        model, _, joint = name.partition('::')
        if joint.rpartition('::')[2] in LEAVES:
            world.set_joints(model, {joint: 0.0})


def shapes_of(world: Any) -> list[Shape]:
    """The shapes of a world that have an outline."""
    found = []
    for model, link, kind, moves, vertices in world.shapes:
        hull = MultiPoint(vertices[:, :2]).convex_hull
        if hull.geom_type != 'Polygon':
            continue
        heights = vertices[:, 2]
        bottom, top = float(heights.min()), float(heights.max())
        between = (heights > bottom + LEVEL) & (heights < top - LEVEL)
        found.append(Shape(model, link, kind, moves, list(hull.exterior.coords[:-1]), bottom, top,
                           kind == 'box' and bool(between.any())))
    return found


def leaves_of(world: Any, shapes: Sequence[Shape]) -> list[Leaf]:
    """The leaves on vertical hinges and on slides of a world's doors and windows."""
    found = []
    doors = {model for kind, _, model, _ in world.entities() if kind == 'door'}
    for name in world.joints:
        kind = name.rpartition('::')[2]
        joint = world.joint(name)
        if 'limits' not in joint or (kind not in LEAVES and joint['model'] not in doors):
            continue
        low, high = joint['limits']
        turns = joint['type'] == 'revolute'
        parts = [shape for shape in shapes
                 if (shape.model, shape.link) == (joint['model'], joint['child'])]
        named = kind in LEAVES or _height(parts) > LEAST
        if not parts or not named or high - low > 4 or turns != (abs(joint['axis'][2]) > 0.99):
            continue
        points = np.array(MultiPoint([corner for part in parts for corner in part.corners])
                          .convex_hull.exterior.coords[:-1])
        ways = np.linspace(0, low if -low > high else high, STEPS) - joint['position']
        axis, (x, y) = joint['axis'], joint['anchor'][:2].tolist()
        if turns:
            outlines = [_turned(points - (x, y), way * np.sign(axis[2])) + (x, y)
                        for way in ways]
        else:
            outlines = [points + way * axis[:2] for way in ways]
        found.append(Leaf(joint['model'], kind == 'sash',
                          [[(float(x), float(y)) for x, y in outline] for outline in outlines],
                          min(part.bottom for part in parts), (x, y) if turns else None))
    return found


def _height(parts: Sequence[Shape]) -> float:
    return max((part.top for part in parts), default=0.0) - min(
        (part.bottom for part in parts), default=0.0)


def _turned(points: np.ndarray, angle: float) -> np.ndarray:
    return points @ np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]])
