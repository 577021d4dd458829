"""Reads a world's collisions, joints and sensors from its SDF, and measures between them."""
from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from lxml import etree

WORLDS = Path(__file__).resolve().parents[2] / "worlds"


@dataclass
class Shape:
    """A collision as a box round it: half sizes (m) and 4 x 4 pose in the world."""
    model: str
    link: str
    name: str
    half: np.ndarray
    pose: np.ndarray
    kind: str

    @property
    def full_name(self) -> str:
        return f"{self.model}::{self.link}::{self.name}"


@dataclass
class Model:
    """A model instance; link poses are in the world, with all joints at 0."""
    name: str
    source: str
    static: bool
    pose: np.ndarray
    element: etree._Element
    links: dict[str, np.ndarray] = field(default_factory=dict)
    posed: dict[frozenset[tuple[str, float]], list[Shape]] = field(default_factory=dict)

    def joint(self, name: str) -> etree._Element | None:
        return self.element.find(f"joint[@name='{name}']")


def matrix(values: list[float]) -> np.ndarray:
    """Returns the 4 x 4 matrix of x y z roll pitch yaw (m, rad)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(values[3:]), np.sin(values[3:])
    result = np.eye(4)
    result[:3, :3] = [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                      [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                      [-sp, cp * sr, cp * cr]]
    result[:3, 3] = values[:3]
    return result


def pose_of(element: etree._Element) -> np.ndarray:
    """Returns an element's <pose> as a 4 x 4 matrix, the identity where it has none."""
    text = element.findtext("pose")
    return matrix([float(v) for v in text.split()]) if text else np.eye(4)


def _model(element: etree._Element, source: str, name: str, pose: np.ndarray) -> Model:
    static = element.findtext("static") == "true"
    model = Model(name, source, static, pose, element)
    model.links = {link.get("name"): pose @ pose_of(link) for link in element.iterfind("link")}
    return model


def load(path: Path, models: Path = WORLDS / "models") -> dict[str, Model]:
    """Returns the models of a world by name; ValueError if a name is taken twice."""
    world = etree.parse(str(path)).getroot().find("world")
    found: dict[str, Model] = {}
    for element in world:
        if element.tag == "model":
            model = _model(element, "", element.get("name"), pose_of(element))
        elif element.tag == "include":
            source = element.findtext("uri").removeprefix("model://")
            body = etree.parse(str(models / source / "model.sdf")).getroot().find("model")
            model = _model(body, source, element.findtext("name"),
                           pose_of(element) @ pose_of(body))
        else:
            continue
        if model.name in found:
            raise ValueError(f"{path}: the name {model.name} is taken twice")
        found[model.name] = model
    return found


def _half(geometry: etree._Element) -> tuple[str, np.ndarray] | None:
    kind = geometry[0].tag
    if kind == "box":
        return kind, np.array([float(v) for v in geometry.findtext("box/size").split()]) / 2
    if kind == "cylinder":
        radius = float(geometry.findtext("cylinder/radius"))
        return kind, np.array([radius, radius, float(geometry.findtext("cylinder/length")) / 2])
    if kind == "sphere":
        return kind, np.full(3, float(geometry.findtext("sphere/radius")))
    return None


def _moved(model: Model, positions: dict[str, float]) -> dict[str, np.ndarray]:
    """Returns link poses with the named joints at the given positions (rad or m)."""
    moves: dict[str, np.ndarray] = {}
    joints = list(model.element.iterfind("joint"))
    for joint in joints:
        value = positions.get(joint.get("name"), 0.0)
        child = joint.findtext("child")
        frame = model.links[child]
        step = np.eye(4)
        if value:
            axis = np.array([float(v) for v in joint.findtext("axis/xyz").split()])
            if joint.get("type") == "prismatic":
                step[:3, 3] = value * axis
            else:
                step = matrix([0, 0, 0, *(value * axis)])
        moves[child] = frame @ step @ np.linalg.inv(frame)

    def total(link: str) -> np.ndarray:
        parent = next((j.findtext("parent") for j in joints if j.findtext("child") == link), None)
        own = moves.get(link, np.eye(4))
        return own if parent is None or parent == "world" else total(parent) @ own

    return {link: total(link) @ pose for link, pose in model.links.items()}


def shapes(model: Model, positions: dict[str, float] | None = None) -> list[Shape]:
    """Returns a model's collisions, planes left out, with its joints at `positions`."""
    key = frozenset((positions or {}).items())
    if key in model.posed:
        return model.posed[key]
    poses = _moved(model, positions or {})
    result = model.posed[key] = []
    for link in model.element.iterfind("link"):
        for collision in link.iterfind("collision"):
            sized = _half(collision.find("geometry"))
            if sized:
                result.append(Shape(model.name, link.get("name"), collision.get("name"),
                                    sized[1], poses[link.get("name")] @ pose_of(collision),
                                    sized[0]))
    return result


def nearby(solids: list[Shape], center: np.ndarray, radius: float) -> list[Shape]:
    """Returns the shapes that may reach into a ball (m)."""
    return [s for s in solids
            if np.linalg.norm(s.pose[:3, 3] - center) - np.linalg.norm(s.half) < radius]


def gaps(one: Shape, others: list[Shape]) -> np.ndarray:
    """Returns, per other shape, a lower bound of the gap in m; negative where boxes overlap.

    Boxes are compared by the balls round them, and where those are close by their separating axes;
    a round shape is the box round it.
    """
    if not others:
        return np.array([])
    between = np.array([s.pose[:3, 3] for s in others]) - one.pose[:3, 3]
    radii = np.array([s.half @ s.half for s in others]) ** 0.5
    bound = np.linalg.norm(between, axis=1) - radii - np.linalg.norm(one.half)
    close = np.flatnonzero(bound < 0.2)
    bound[close] = _box_gaps(one, [others[k] for k in close], between[close])
    return bound


def _box_gaps(one: Shape, others: list[Shape], between: np.ndarray) -> np.ndarray:
    """Returns the gaps along the best of the 15 axes that may separate two boxes."""
    halves = np.array([s.half for s in others]).reshape(-1, 3)
    turns = np.array([s.pose[:3, :3] for s in others]).reshape(-1, 3, 3)
    own = np.broadcast_to(one.pose[:3, :3], turns.shape)
    crosses = np.cross(own.transpose(0, 2, 1)[:, :, None], turns.transpose(0, 2, 1)[:, None])
    axes = np.concatenate([own.transpose(0, 2, 1), turns.transpose(0, 2, 1),
                           crosses.reshape(-1, 9, 3)], axis=1)
    length = np.linalg.norm(axes, axis=2, keepdims=True)
    axes = np.where(length > 1e-6, axes / np.maximum(length, 1e-12), 0.0)
    reach = (np.abs(np.einsum("nki,nij->nkj", axes, own)) @ one.half
             + np.einsum("nkj,nj->nk", np.abs(np.einsum("nki,nij->nkj", axes, turns)), halves))
    apart = np.abs(np.einsum("nki,ni->nk", axes, between)) - reach
    apart[length[:, :, 0] <= 1e-6] = -np.inf
    return apart.max(axis=1)


def cast(origins: np.ndarray, directions: np.ndarray, solids: list[Shape],
         reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns ranges (n,) in m and hit indices (n,), -1 and `reach` where nothing is hit.

    origins and directions are n x 3; round shapes count as the boxes round them.
    """
    best, which = np.full(len(origins), reach), np.full(len(origins), -1)
    for k, solid in enumerate(solids):
        turn = solid.pose[:3, :3]
        start = (origins - solid.pose[:3, 3]) @ turn
        along = directions @ turn
        with np.errstate(divide="ignore", invalid="ignore"):
            near = (-solid.half - start) / along
            far = (solid.half - start) / along
        first = np.nanmax(np.minimum(near, far), axis=1)
        last = np.nanmin(np.maximum(near, far), axis=1)
        hit = (first <= last) & (first > 0) & (first < best)
        best[hit], which[hit] = first[hit], k
    return best, which


def footprint_distance(points: np.ndarray, solid: Shape) -> np.ndarray:
    """Returns the distance in the floor's plane (m, 0 inside) of n x 2 points to a shape."""
    turn = solid.pose[:3, :3]
    if abs(turn[2, 2]) < 0.999:
        extent = np.abs(turn) @ solid.half
        offset = np.abs(points - solid.pose[:2, 3]) - extent[:2]
    elif solid.kind in ("cylinder", "sphere"):
        away = np.linalg.norm(points - solid.pose[:2, 3], axis=1)
        return np.maximum(away - solid.half[0], 0.0)
    else:
        offset = np.abs((points - solid.pose[:2, 3]) @ turn[:2, :2]) - solid.half[:2]
    return np.linalg.norm(np.maximum(offset, 0.0), axis=1)


def span_z(solid: Shape) -> tuple[float, float]:
    """Returns the lowest and highest z of a shape (m)."""
    extent = np.abs(solid.pose[2, :3]) @ solid.half
    return solid.pose[2, 3] - extent, solid.pose[2, 3] + extent


def sensor_pose(model: Model) -> tuple[etree._Element, np.ndarray]:
    """Returns a model's first sensor and its pose in the world."""
    for link in model.element.iterfind("link"):
        sensor = link.find("sensor")
        if sensor is not None:
            return sensor, model.links[link.get("name")] @ pose_of(sensor)
    raise ValueError(f"{model.name} holds no sensor")


def ray_fan(sensor: etree._Element, pose: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Returns origins, directions (n x 3) and reach (m) of a ray sensor."""
    angles = []
    for axis in ("horizontal", "vertical"):
        scan = sensor.find(f"ray/scan/{axis}")
        angles.append(np.linspace(float(scan.findtext("min_angle")),
                                  float(scan.findtext("max_angle")),
                                  int(scan.findtext("samples"))))
    yaw, pitch = (v.ravel() for v in np.meshgrid(*angles))
    local = np.stack([np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), np.sin(pitch)], 1)
    directions = local @ pose[:3, :3].T
    origins = np.broadcast_to(pose[:3, 3], directions.shape)
    return origins, directions, float(sensor.findtext("ray/range/max"))
