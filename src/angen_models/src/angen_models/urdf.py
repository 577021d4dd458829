"""Writes URDF: the same parts as SDF has, for robot_state_publisher and rviz."""
from collections.abc import Sequence
from pathlib import Path

from lxml import etree

from angen_models.sdf import Color, Part, Vector, add, combine, num, numbers, write

NAMED = {"Gazebo/Black": (0.0, 0.0, 0.0), "Gazebo/Grey": (0.7, 0.7, 0.7),
         "Gazebo/White": (1.0, 1.0, 1.0)}


def _add_origin(parent: etree._Element, at: Sequence[float], rpy: Sequence[float] = (0, 0, 0)
                ) -> None:
    if any(at) or any(rpy):
        add(parent, "origin", xyz=numbers(*at), rpy=numbers(*rpy))


def _add_geometry(parent: etree._Element, part: Part) -> None:
    geometry = add(parent, "geometry")
    if len(part.size) == 3:
        add(geometry, "box", size=numbers(*part.size))
    elif len(part.size) == 2:
        add(geometry, "cylinder", radius=num(part.size[0]), length=num(part.size[1]))
    else:
        add(geometry, "sphere", radius=num(part.size[0]))


def _color(part: Part) -> Color:
    return NAMED[part.material] if isinstance(part.material, str) else part.material or (1, 1, 1)


def add_link(robot: etree._Element, name: str, parts: Sequence[Part]) -> None:
    """Appends <link> with the parts' mass, looks and shapes."""
    link = add(robot, "link", name=name)
    inertia = combine(parts)
    inertial = add(link, "inertial")
    _add_origin(inertial, inertia.center.tolist())
    add(inertial, "mass", value=num(inertia.mass))
    tensor = inertia.tensor
    add(inertial, "inertia", ixx=num(tensor[0, 0]), ixy=num(tensor[0, 1]), ixz=num(tensor[0, 2]),
        iyy=num(tensor[1, 1]), iyz=num(tensor[1, 2]), izz=num(tensor[2, 2]))
    for part in parts:
        for tag, present in (("visual", part.show), ("collision", part.collide)):
            if not present:
                continue
            shape = add(link, tag)
            _add_origin(shape, part.at, part.rpy)
            _add_geometry(shape, part)
            if tag == "visual":
                color = _color(part)
                add(add(shape, "material", name=f"{name}_{part.name}"), "color",
                    rgba=numbers(*color, 1))


def add_root(robot: etree._Element, root: str, body: str) -> None:
    """Appends a link without mass and the joint by which it holds the body, at the same place."""
    add(robot, "link", name=root)
    joint = add(robot, "joint", name=f"{root}_joint", type="fixed")
    add(joint, "parent", link=root)
    add(joint, "child", link=body)


def add_wheel_joint(robot: etree._Element, name: str, parent: str, child: str, at: Vector) -> None:
    """Appends a joint that turns endlessly about y."""
    joint = add(robot, "joint", name=name, type="continuous")
    add(joint, "parent", link=parent)
    add(joint, "child", link=child)
    _add_origin(joint, at)
    add(joint, "axis", xyz="0 1 0")


def write_robot(robot: etree._Element, models: Path) -> None:
    """Writes <models>/NAME/NAME.urdf."""
    name = robot.get("name")
    write(robot, models / name / f"{name}.urdf")
