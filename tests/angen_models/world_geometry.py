"""The collisions of a world, as `import angen` has them, and the gaps between them."""
import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Collection, Iterator, Mapping, Sequence

import angen
import numpy as np
from lxml import etree
from scipy.spatial import ConvexHull
from shapely.geometry import MultiPoint

WORLDS = Path(__file__).resolve().parents[2] / "worlds"
NEAR = 0.2  # m


@dataclass(frozen=True)
class Shape:
    """A collision: the convex hull of its corners (n, 3), m in the world."""
    model: str
    link: str
    corners: np.ndarray

    @cached_property
    def normals(self) -> np.ndarray:
        """Those of its faces, (k, 3), without the rounding errors of upright ones."""
        return np.unique(np.round(ConvexHull(self.corners).equations[:, :3], 7), axis=0)

    @cached_property
    def low(self) -> np.ndarray:
        return self.corners.min(axis=0)

    @cached_property
    def high(self) -> np.ndarray:
        return self.corners.max(axis=0)

    @property
    def footprint(self) -> Any:
        """Its outline from above, as a geometry of shapely."""
        return MultiPoint(self.corners[:, :2]).convex_hull


def shut_world(path: Path) -> angen.World:
    """The world of a file without its person, all joints at 0."""
    world = angen.World(str(path))
    for person in world.devices("person"):
        world.delete(person)
    for name in world.joints:
        model, _, joint = name.partition("::")
        if "limits" in world.joint(name):
            world.set_joints(model, {joint: 0.0})
    return world


def alone(world: angen.World, name: str) -> angen.World:
    """A world with nothing but one model of a shut world, where it is there."""
    root = etree.fromstring(world.save().encode())
    for part in root.xpath("world/model | world/include | world/state"):
        if (part.get("name") or part.findtext("name")) != name:
            part.getparent().remove(part)
    return angen.World.from_text(etree.tostring(root, encoding="unicode"))


def shapes(world: angen.World, without: Collection[str] = ()) -> list[Shape]:
    """The collisions of all models but some, planes left out."""
    return [Shape(model, link, corners) for model, link, _, _, corners in world.shapes
            if len(corners) and model not in without]


def moved(world: angen.World, name: str, joints: Sequence[Mapping[str, float]]
          ) -> Iterator[tuple[Mapping[str, float], Shape]]:
    """The collisions of a model with its joints at each of some positions (rad or m)."""
    own = alone(world, name)
    for positions in joints:
        own.set_joints(name, positions)
        for shape in shapes(own):
            yield positions, shape


def nearby(solids: list[Shape], center: np.ndarray, radius: float) -> list[Shape]:
    """The shapes that may reach into a cube around a place (m)."""
    return [s for s in solids
            if (s.low < center + radius).all() and (s.high > center - radius).all()]


def gap(one: Shape, other: Shape) -> float:
    """A lower bound of the gap in m, negative if they overlap: along the best of the axes that may
    separate two hulls."""
    axes = np.concatenate([one.normals, other.normals,
                           np.cross(one.normals[:, None], other.normals).reshape(-1, 3)])
    length = np.linalg.norm(axes, axis=1)
    axes = axes[length > 1e-6] / length[length > 1e-6, None]
    a, b = one.corners @ axes.T, other.corners @ axes.T
    return float(np.maximum(b.min(axis=0) - a.max(axis=0), a.min(axis=0) - b.max(axis=0)).max())


def nearest(one: Shape, others: list[Shape]) -> tuple[float, str]:
    """The least gap (m) to one of the others within NEAR, and its model and link."""
    near = [other for other in others if (other.low < one.high + NEAR).all()
            and (other.high > one.low - NEAR).all()]
    return min(((gap(one, other), f"{other.model}::{other.link}") for other in near),
               default=(math.inf, ""))


def cast(world: angen.World, kind: str, name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Ranges (n,) of a sensor's rays, their ends (n, 3) and reaches (n,), m."""
    rays = world.detection_rays(kind, name)
    ranges = world.cast(rays[:, :3], rays[:, 3:6], rays[:, 7])
    return ranges, rays[:, :3] + ranges[:, None] * rays[:, 3:6], rays[:, 7]
