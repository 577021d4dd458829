"""The shapes of a world's file, seen from above: collisions, leaves that turn, and sensors."""
from __future__ import annotations

from dataclasses import dataclass, field
from math import pi
from pathlib import Path

import numpy as np
from lxml import etree

from angen_tools.world import sdf
from angen_tools.world.models import find
from angen_tools.world.placing import generator

LEVEL = 0.999  # of an axis that is upright
DEPTH = 8  # includes within includes
Corners = list[tuple[float, float]]


@dataclass(frozen=True)
class Shape:
    """A collision: its outline on the floor and its heights in the world."""

    model: str
    link: str
    corners: Corners
    bottom: float
    top: float
    round: bool = False
    tilted: bool = False  # at a height it is less than its outline


@dataclass(frozen=True)
class Swing:
    """A leaf on a vertical hinge: where its far edge is from shut to open."""

    model: str
    hinge: tuple[float, float]
    path: Corners
    bottom: float
    window: bool


@dataclass(frozen=True)
class Slide:
    """A leaf that slides: its outlines shut and open."""

    model: str
    shut: Corners
    open: Corners
    bottom: float


@dataclass
class Shapes:
    """All shapes of a world; `thing` by the model's name, with the pose of the model."""

    solids: list[Shape] = field(default_factory=list)
    swings: list[Swing] = field(default_factory=list)
    slides: list[Slide] = field(default_factory=list)
    sensors: dict[str, list[etree._Element]] = field(default_factory=dict)
    moving: set[str] = field(default_factory=set)
    unread: set[str] = field(default_factory=set)  # models with meshes and other shapes


def read_shapes(path: Path) -> Shapes:
    """The shapes of a world's file."""
    made = Shapes()
    world = sdf.read(path).find('world')
    if world is None:
        return made
    for element in world:
        if element.tag in ('model', 'include'):
            _add_model(made, element, np.eye(4), '', DEPTH)
    return made


def _pose(element: etree._Element) -> np.ndarray:
    text = element.findtext('pose')
    made = np.eye(4)
    if text and len(text.split()) in (3, 6):
        values = sdf.parse_pose(text)
        made[:3, :3] = generator('sdf').rotation(values[3:])
        made[:3, 3] = values[:3]
    return made


def _add_model(made: Shapes, element: etree._Element, frame: np.ndarray, outer: str, depth: int
               ) -> None:
    """Adds a <model>, or the one that an <include> names; parts of `outer` have its name."""
    name = (element.findtext('name') or element.get('name') or '').strip()
    frame = frame @ _pose(element)
    if element.tag == 'include':
        file = find((element.findtext('uri') or '').strip())
        body = sdf.read(file).find('model') if file is not None and depth else None
        if body is None:
            return
        name = name or body.get('name', '')
        if element.find('pose') is None:
            frame = frame @ _pose(body)
        element = body
    top = outer or name
    links = {link.get('name'): frame @ _pose(link) for link in element.iterfind('link')}
    for link in element.iterfind('link'):
        at = links[link.get('name')]
        for collision in link.iterfind('collision'):
            shape = _shape(top, link.get('name', ''), collision, at)
            if shape is not None:
                made.solids.append(shape)
            elif collision.find('geometry/plane') is None:
                made.unread.add(top)
        if link.find('sensor') is not None:
            made.sensors.setdefault(top, []).extend(link.findall('sensor'))
    if element.findtext('static') not in ('true', '1'):
        made.moving.add(top)
    for joint in element.iterfind('joint'):
        _add_swing(made, top, element, joint, links)
        _add_slide(made, top, joint, links)
    for inner in [*element.iterfind('model'), *element.iterfind('include')]:
        if depth:
            _add_model(made, inner, frame, top, depth - 1)


def _shape(model: str, link: str, collision: etree._Element, frame: np.ndarray) -> Shape | None:
    geometry = collision.find('geometry')
    pose = frame @ _pose(collision)
    if geometry is None:
        return None
    if geometry.find('box') is not None:
        half = np.array([float(v) for v in geometry.findtext('box/size').split()]) / 2
    elif geometry.find('cylinder') is not None:
        radius = float(geometry.findtext('cylinder/radius'))
        half = np.array([radius, radius, float(geometry.findtext('cylinder/length')) / 2])
        if abs(pose[2, 2]) > 0.99:
            return _disc(model, link, pose, radius, half[2])
    elif geometry.find('sphere') is not None:
        radius = float(geometry.findtext('sphere/radius'))
        return _disc(model, link, pose, radius, radius)
    else:
        return None
    corners = np.array([[a, b, c] for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]) * half
    points = corners @ pose[:3, :3].T + pose[:3, 3]
    return Shape(model, link, _hull(points[:, :2]), float(points[:, 2].min()),
                 float(points[:, 2].max()), tilted=bool(np.abs(pose[2, :3]).max() < LEVEL))


def _disc(model: str, link: str, pose: np.ndarray, radius: float, half: float) -> Shape:
    angles = np.linspace(0, 2 * pi, 24, endpoint=False)
    corners = [(float(pose[0, 3] + radius * np.cos(a)), float(pose[1, 3] + radius * np.sin(a)))
               for a in angles]
    return Shape(model, link, corners, float(pose[2, 3] - half), float(pose[2, 3] + half), True)


def _hull(points: np.ndarray) -> Corners:
    """The convex hull of some points, counterclockwise."""
    ordered = sorted({(round(float(x), 6), round(float(y), 6)) for x, y in points})
    if len(ordered) < 3:
        return ordered

    def half(run: list[tuple[float, float]]) -> Corners:
        found: Corners = []
        for p in run:
            while len(found) > 1 and ((found[-1][0] - found[-2][0]) * (p[1] - found[-2][1])
                                      - (found[-1][1] - found[-2][1]) * (p[0] - found[-2][0])
                                      ) <= 1e-12:
                found.pop()
            found.append(p)
        return found[:-1]

    return half(ordered) + half(ordered[::-1])


def _add_swing(made: Shapes, model: str, element: etree._Element, joint: etree._Element,
               links: dict[str | None, np.ndarray]) -> None:
    """Adds a hinge about the vertical with limits, and the leaf on it."""
    child = (joint.findtext('child') or '').strip()
    if joint.get('type') != 'revolute' or child not in links:
        return
    frame = links[child] @ _pose(joint)
    axis = frame[:3, :3] @ np.array(
        [float(v) for v in (joint.findtext('axis/xyz') or '0 0 1').split()])
    low = float(joint.findtext('axis/limit/lower') or -1e16)
    high = float(joint.findtext('axis/limit/upper') or 1e16)
    if abs(axis[2]) < 0.99 or high - low > 4 or joint.get('name') not in ('hinge', 'sash'):
        return
    leaf = [shape for shape in made.solids if shape.model == model and shape.link == child]
    if not leaf:
        return
    hinge = frame[:2, 3]
    corners = np.array([corner for shape in leaf for corner in shape.corners])
    far = corners[np.argmax(np.hypot(*(corners - hinge).T))] - hinge
    end = (low if -low > high else high) * np.sign(axis[2])
    path = [(float(hinge[0] + far[0] * np.cos(a) - far[1] * np.sin(a)),
             float(hinge[1] + far[0] * np.sin(a) + far[1] * np.cos(a)))
            for a in np.linspace(0, end, 16)]
    made.swings.append(Swing(model, (float(hinge[0]), float(hinge[1])), path,
                             min(shape.bottom for shape in leaf), joint.get('name') == 'sash'))


def _add_slide(made: Shapes, model: str, joint: etree._Element,
               links: dict[str | None, np.ndarray]) -> None:
    """Adds the leaf of a sliding door."""
    child = (joint.findtext('child') or '').strip()
    leaf = [shape for shape in made.solids if shape.model == model and shape.link == child]
    if joint.get('type') != 'prismatic' or joint.get('name') != 'slide' or not leaf:
        return
    axis = (links[child] @ _pose(joint))[:3, :3] @ np.array(
        [float(v) for v in (joint.findtext('axis/xyz') or '1 0 0').split()])
    low, high = (float(joint.findtext(f'axis/limit/{end}') or 0) for end in ('lower', 'upper'))
    far = low if -low > high else high
    for shape in leaf:
        made.slides.append(Slide(model, shape.corners, [
            (x + far * axis[0], y + far * axis[1]) for x, y in shape.corners], shape.bottom))
