"""Writes SDF: parts (box, cylinder, sphere, mesh) -> links, joints, models, files."""
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree
from numpy.typing import NDArray

SDF_VERSION = "1.6"
ANGEN = "angen"     # the namespace of our own elements
Color = tuple[float, float, float]
Vector = tuple[float, float, float]
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Part:
    """One shape of a link: lengths in m, angles in rad, mass in kg.

    size is (x, y, z) of a box, (radius, length) of a cylinder, (radius,) of a sphere. A part
    with `mesh` (a uri) is looks only. `material` is a Gazebo material's name or an RGB color.
    With `same`, collision and visual have one name: rays hit it with its own surface.
    """
    name: str
    size: Sequence[float] = ()
    at: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)
    material: str | Color | None = "Gazebo/White"
    mass: float = 0.0
    collide: bool = True
    show: bool = True
    friction: float | None = None
    mesh: str | None = None
    emissive: bool = False
    same: bool = False


@dataclass
class Inertia:
    """Mass in kg, center of mass in m, inertia tensor about it (3 x 3, kg m2)."""
    mass: float
    center: Array
    tensor: Array = field(default_factory=lambda: np.zeros((3, 3)))


def spanned(name: str, low: Vector, high: Vector, **options: Any) -> Part:
    """Returns the box part whose opposite corners are `low` and `high` (m)."""
    size = tuple(round(b - a, 6) for a, b in zip(low, high))
    x, y, z = (round((a + b) / 2, 6) for a, b in zip(low, high))
    return Part(name, size, (x, y, z), **options)


def rotation(rpy: Sequence[float]) -> Array:
    """Returns the 3 x 3 matrix of roll, pitch, yaw (rad)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                     [-sp, cp * sr, cp * cr]])


def _own_tensor(part: Part) -> Array:
    m, size = part.mass, part.size
    if len(size) == 3:
        x, y, z = (v * v / 12 for v in size)
        return m * np.diag([y + z, x + z, x + y])
    if len(size) == 2:
        radius, length = size
        side = radius ** 2 / 4 + length ** 2 / 12
        return m * np.diag([side, side, radius ** 2 / 2])
    return m * np.eye(3) * 0.4 * size[0] ** 2


def combine(parts: Iterable[Part]) -> Inertia:
    """Returns mass, center and tensor of the solid parts together; ValueError if massless."""
    solid = [p for p in parts if p.mass > 0]
    mass = sum(p.mass for p in solid)
    if mass <= 0:
        raise ValueError("a moving link needs a mass: give one of its parts a mass above 0")
    center = sum((p.mass * np.array(p.at) for p in solid), start=np.zeros(3)) / mass
    tensor = np.zeros((3, 3))
    for part in solid:
        turn, arm = rotation(part.rpy), np.array(part.at) - center
        tensor += turn @ _own_tensor(part) @ turn.T
        tensor += part.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return Inertia(mass, center, tensor)


def num(value: float) -> str:
    """Returns a number as short text, never -0."""
    text = f"{value:.7g}"
    return "0" if text in ("-0", "-0.0") else text


def numbers(*values: float) -> str:
    """Returns numbers separated by blanks."""
    return " ".join(num(v) for v in values)


def add(parent: etree._Element, tag: str, text: object = None, **attributes: str) -> etree._Element:
    """Appends <tag> to parent and returns it; numbers are written short."""
    child = etree.SubElement(parent, tag, attributes)
    if text is not None:
        child.text = num(text) if isinstance(text, (int, float)) else str(text)
    return child


def add_home(parent: etree._Element, tag: str, text: object = None, **attributes: str
             ) -> etree._Element:
    """Appends <angen:tag>, a part of the home's description, and returns it."""
    child = etree.SubElement(parent, f"{{{ANGEN}}}{tag}", attributes, nsmap={"angen": ANGEN})
    if text is not None:
        child.text = num(text) if isinstance(text, (int, float)) else str(text)
    return child


@dataclass(frozen=True)
class Place:
    """The position of a user in the model's frame: feet, seat or middle; m, rad."""
    posture: str
    x: float
    y: float
    z: float
    yaw: float


def add_thing(model: etree._Element, thing: str, *places: Place) -> None:
    """Marks a model as a thing, with the places at which people use it."""
    add_home(model, "thing", thing)
    for place in places:
        add_home(model, "place", numbers(place.x, place.y, place.z, round(place.yaw, 5)),
                 posture=place.posture)


def add_pose(parent: etree._Element, at: Sequence[float], rpy: Sequence[float] = (0, 0, 0)) -> None:
    """Appends <pose> unless it is the identity."""
    if any(at) or any(rpy):
        add(parent, "pose", numbers(*at, *rpy))


def _add_geometry(parent: etree._Element, part: Part) -> None:
    geometry = add(parent, "geometry")
    if part.mesh:
        add(add(geometry, "mesh"), "uri", part.mesh)
    elif len(part.size) == 3:
        add(add(geometry, "box"), "size", numbers(*part.size))
    elif len(part.size) == 2:
        cylinder = add(geometry, "cylinder")
        add(cylinder, "radius", part.size[0])
        add(cylinder, "length", part.size[1])
    else:
        add(add(geometry, "sphere"), "radius", part.size[0])


def _add_material(visual: etree._Element, part: Part) -> None:
    if part.material is None:
        return
    material = add(visual, "material")
    if isinstance(part.material, str):
        script = add(material, "script")
        add(script, "uri", "file://media/materials/scripts/gazebo.material")
        add(script, "name", part.material)
        return
    color = numbers(*part.material, 1)
    add(material, "ambient", color)
    add(material, "diffuse", color)
    if part.emissive:
        add(material, "emissive", color)


def _add_part(link: etree._Element, part: Part) -> None:
    if part.collide and not part.mesh:
        kind = "visual" if part.same else "collision"
        collision = add(link, "collision", name=f"{part.name}_{kind}")
        add_pose(collision, part.at, part.rpy)
        _add_geometry(collision, part)
        if part.friction is not None:
            ode = add(add(add(collision, "surface"), "friction"), "ode")
            add(ode, "mu", part.friction)
            add(ode, "mu2", part.friction)
    if part.show or part.mesh:
        visual = add(link, "visual", name=part.name + "_visual")
        add_pose(visual, part.at, part.rpy)
        _add_geometry(visual, part)
        _add_material(visual, part)


def add_link(model: etree._Element, name: str, parts: Sequence[Part], at: Vector = (0, 0, 0),
             moves: bool = True) -> etree._Element:
    """Appends a link made of parts; a link that moves gets their mass and inertia."""
    link = add(model, "link", name=name)
    add_pose(link, at)
    if moves:
        whole = combine(parts)
        inertial = add(link, "inertial")
        add_pose(inertial, [round(float(v), 6) for v in whole.center])
        add(inertial, "mass", whole.mass)
        inertia = add(inertial, "inertia")
        for i, j, tag in ((0, 0, "ixx"), (0, 1, "ixy"), (0, 2, "ixz"),
                          (1, 1, "iyy"), (1, 2, "iyz"), (2, 2, "izz")):
            add(inertia, tag, round(whole.tensor[i, j], 8))
    for part in parts:
        _add_part(link, part)
    return link


def add_fixed(model: etree._Element, name: str, parent: str, child: str) -> None:
    """Appends a fixed joint."""
    joint = add(model, "joint", name=name, type="fixed")
    add(joint, "parent", parent)
    add(joint, "child", child)


def add_joint(model: etree._Element, name: str, kind: str, parent: str, child: str,
              axis: Vector, limits: dict[str, float] | None = None,
              dynamics: dict[str, float] | None = None) -> None:
    """Appends a revolute or prismatic joint; limits: lower, upper, effort, velocity."""
    joint = add(model, "joint", name=name, type=kind)
    add(joint, "parent", parent)
    add(joint, "child", child)
    element = add(joint, "axis")
    add(element, "xyz", numbers(*axis))
    if limits:
        limit = add(element, "limit")
        for tag, value in limits.items():
            add(limit, tag, value)
    if dynamics:
        motion = add(element, "dynamics")
        for tag, value in dynamics.items():
            add(motion, tag, value)


def add_plugin(parent: etree._Element, name: str, filename: str, **values: object
               ) -> etree._Element:
    """Appends <plugin> with one child per value and returns it."""
    plugin = add(parent, "plugin", name=name, filename=filename)
    for tag, value in values.items():
        add(plugin, tag, value)
    return plugin


def new_model(name: str, static: bool = False) -> tuple[etree._Element, etree._Element]:
    """Returns (<sdf> root, its <model>)."""
    root = etree.Element("sdf", version=SDF_VERSION)
    model = add(root, "model", name=name)
    if static:
        add(model, "static", "true")
    return root, model


def write(root: etree._Element, path: Path) -> None:
    """Writes pretty-printed XML, making the folder where it is missing."""
    path.parent.mkdir(parents=True, exist_ok=True)
    etree.cleanup_namespaces(root, top_nsmap={"angen": ANGEN})
    etree.indent(root, "  ")
    body = etree.tostring(root, encoding="unicode")
    path.write_text('<?xml version="1.0"?>\n' + body + "\n", encoding="utf-8")


def write_model(root: etree._Element, models: Path, title: str, description: str,
                version: str = SDF_VERSION) -> None:
    """Writes model.sdf and model.config into models/<the model's name>/."""
    name = root.find("model").get("name")
    write(root, models / name / "model.sdf")
    config = etree.Element("model")
    add(config, "name", title)
    add(config, "version", "1.0")
    add(config, "sdf", "model.sdf", version=version)
    author = add(config, "author")
    add(author, "name", "Angen")
    add(config, "description", description)
    write(config, models / name / "model.config")
