"""Triangle meshes from a few primitives, written as COLLADA and binary STL. Meters, z up."""
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from angen_models.sdf import Array, Color

NAMESPACE = "http://www.collada.org/2005/11/COLLADASchema"


@dataclass
class Mesh:
    """points: n x 3 in m; faces: m x 3 indices, counter-clockwise from outside; one color."""
    points: Array
    faces: NDArray[np.int64]
    color: Color = (0.8, 0.8, 0.8)

    def moved(self, at: Sequence[float]) -> "Mesh":
        """Returns the mesh shifted by `at`."""
        return Mesh(self.points + np.asarray(at, float), self.faces, self.color)

    def turned(self, matrix: Array) -> "Mesh":
        """Returns the mesh turned by a 3 x 3 rotation matrix."""
        return Mesh(self.points @ matrix.T, self.faces, self.color)

    def scaled(self, factors: Sequence[float]) -> "Mesh":
        """Returns the mesh stretched along the axes by positive factors."""
        return Mesh(self.points * np.asarray(factors, float), self.faces, self.color)


def _grid_faces(rows: int, columns: int, wrap: bool) -> NDArray[np.int64]:
    """Returns triangles of a rows x columns grid of points, columns joined up if wrap."""
    faces = []
    for i in range(rows - 1):
        for j in range(columns if wrap else columns - 1):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            c, d = a + columns, b + columns
            faces += [(a, b, d), (a, d, c)]
    return np.array(faces)


def box(low: Sequence[float], high: Sequence[float], color: Color) -> Mesh:
    """Returns an axis-aligned box with a corner point per face, so that edges look sharp."""
    points: list[Array] = []
    faces: list[tuple[int, int, int]] = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            first = len(points)
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = np.zeros(3)
                corner[axis] = (low, high)[side][axis]
                corner[u], corner[v] = (low, high)[du][u], (low, high)[dv][v]
                points.append(corner)
            order = (0, 1, 2, 3) if side else (0, 3, 2, 1)
            a, b, c, d = (first + k for k in order)
            faces += [(a, b, c), (a, c, d)]
    return Mesh(np.array(points), np.array(faces), color)


def rounded_box(low: Sequence[float], high: Sequence[float], radius: float, color: Color,
                steps: int = 3) -> Mesh:
    """Returns a box with edges of `radius`: a sphere cut in eight and pulled apart."""
    least, most = np.asarray(low, float), np.asarray(high, float)
    middle, reach = (least + most) / 2, (most - least) / 2 - radius
    quarter = np.linspace(0, np.pi / 2, steps + 1)
    rows = []
    for hemisphere in (-1, 1):
        for lift in (quarter - np.pi / 2 if hemisphere < 0 else quarter):
            for quadrant, signs in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
                for turn in quarter + quadrant * np.pi / 2:
                    normal = np.array([np.cos(lift) * np.cos(turn), np.cos(lift) * np.sin(turn),
                                       np.sin(lift)])
                    rows.append(middle + reach * (*signs, hemisphere) + radius * normal)
    columns, count = 4 * (steps + 1), 2 * (steps + 1)
    points = np.array(rows)
    faces = list(_grid_faces(count, columns, wrap=True))
    corners = [k * (steps + 1) for k in range(4)]
    last = (count - 1) * columns
    a, b, c, d = corners
    faces += [(a, c, b), (a, d, c), (last + a, last + b, last + c), (last + a, last + c, last + d)]
    return Mesh(points, np.array(faces), color)


def lathe(profile: Sequence[tuple[float, float]], color: Color, sides: int = 24) -> Mesh:
    """Returns (radius, z) points turned about z; go up outside, down inside."""
    angles = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    points = [(r * np.cos(t), r * np.sin(t), z) for r, z in profile for t in angles]
    return Mesh(np.array(points), _grid_faces(len(profile), sides, wrap=True), color)


def tube(path: Sequence[Sequence[float]], radius: float, color: Color, sides: int = 8) -> Mesh:
    """Returns a round bar along a path of points (m), open at its ends."""
    bends = np.asarray(path, float)
    angles = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    points = []
    for i, point in enumerate(bends):
        along = bends[min(i + 1, len(bends) - 1)] - bends[max(i - 1, 0)]
        along /= np.linalg.norm(along)
        other = np.eye(3)[np.argmin(np.abs(along))]
        u = np.cross(along, other)
        u /= np.linalg.norm(u)
        v = np.cross(along, u)
        points += [point + radius * (np.cos(t) * u + np.sin(t) * v) for t in angles]
    return Mesh(np.array(points), _grid_faces(len(path), sides, wrap=True), color)


def leaf(root: Sequence[float], heading: float, length: float, width: float, rise: float,
         color: Color) -> Mesh:
    """Returns a bent two-sided leaf of `length` that starts at root and droops at its tip."""
    points, steps = [], 6
    for i in range(steps + 1):
        t = i / steps
        out, up = length * t, rise * np.sin(np.pi * 0.75 * t)
        half = width / 2 * np.sin(np.pi * min(0.08 + 0.92 * t, 1.0))
        for side in (-half, half):
            points.append((out * np.cos(heading) - side * np.sin(heading),
                           out * np.sin(heading) + side * np.cos(heading), up))
    faces = _grid_faces(steps + 1, 2, wrap=False)
    points = np.array(points) + np.asarray(root, float)
    count = len(points)
    return Mesh(np.vstack([points, points]), np.vstack([faces, faces[:, ::-1] + count]), color)


def normals_of(mesh: Mesh) -> Array:
    """Returns one unit normal per point, the mean of its faces weighted by area."""
    a, b, c = (mesh.points[mesh.faces[:, k]] for k in range(3))
    flat = np.cross(b - a, c - a)
    normals = np.zeros_like(mesh.points)
    for k in range(3):
        np.add.at(normals, mesh.faces[:, k], flat)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(length > 1e-12, normals / np.maximum(length, 1e-12), (0.0, 0.0, 1.0))


def _cleaned(mesh: Mesh) -> Mesh:
    """Returns the mesh without triangles that have no area."""
    a, b, c = (mesh.points[mesh.faces[:, k]] for k in range(3))
    solid = np.linalg.norm(np.cross(b - a, c - a), axis=1) > 1e-9
    return Mesh(mesh.points, mesh.faces[solid], mesh.color)


def write_stl(meshes: Sequence[Mesh], path: Path) -> None:
    """Writes all meshes as one binary STL."""
    corners = np.concatenate([m.points[m.faces] for m in map(_cleaned, meshes)]).astype("<f4")
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    record = np.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)),
                                           ("attribute", "<u2")])
    record["normal"], record["corners"] = flat, corners
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"Angen".ljust(80) + np.uint32(len(corners)).tobytes() + record.tobytes())


def _source(parent: etree._Element, name: str, values: Array) -> None:
    source = etree.SubElement(parent, "source", id=name)
    array = etree.SubElement(source, "float_array", id=f"{name}-array", count=str(values.size))
    # Twice: processors differ in a sine's last bit, which decides about halves.
    rounded = np.round(np.round(values.ravel(), 9), 4)
    array.text = " ".join(f"{v:g}" for v in rounded + 0.0)
    accessor = etree.SubElement(etree.SubElement(source, "technique_common"), "accessor",
                                source=f"#{name}-array", count=str(len(values)), stride="3")
    for axis in "XYZ":
        etree.SubElement(accessor, "param", name=axis, type="float")


def _material(effects: etree._Element, materials: etree._Element, i: int, color: Color) -> None:
    effect = etree.SubElement(effects, "effect", id=f"effect{i}")
    profile = etree.SubElement(effect, "profile_COMMON")
    lambert = etree.SubElement(etree.SubElement(profile, "technique", sid="common"), "lambert")
    for kind in ("ambient", "diffuse"):
        value = etree.SubElement(etree.SubElement(lambert, kind), "color")
        value.text = " ".join(f"{c:g}" for c in (*color, 1))
    material = etree.SubElement(materials, "material", id=f"material{i}", name=f"material{i}")
    etree.SubElement(material, "instance_effect", url=f"#effect{i}")


def _geometry(parent: etree._Element, i: int, mesh: Mesh, material: int) -> None:
    element = etree.SubElement(etree.SubElement(parent, "geometry", id=f"part{i}"), "mesh")
    _source(element, f"part{i}-points", mesh.points)
    _source(element, f"part{i}-normals", normals_of(mesh))
    vertices = etree.SubElement(element, "vertices", id=f"part{i}-vertices")
    etree.SubElement(vertices, "input", semantic="POSITION", source=f"#part{i}-points")
    etree.SubElement(vertices, "input", semantic="NORMAL", source=f"#part{i}-normals")
    triangles = etree.SubElement(element, "triangles", material=f"material{material}",
                                 count=str(len(mesh.faces)))
    etree.SubElement(triangles, "input", semantic="VERTEX", source=f"#part{i}-vertices",
                     offset="0")
    etree.SubElement(triangles, "p").text = " ".join(str(k) for k in mesh.faces.ravel())


def write_collada(meshes: Sequence[Mesh], path: Path) -> None:
    """Writes COLLADA 1.4.1, one geometry a color, meters and z up."""
    root = etree.Element("COLLADA", version="1.4.1", nsmap={None: NAMESPACE})
    asset = etree.SubElement(root, "asset")
    for tag in ("created", "modified"):
        etree.SubElement(asset, tag).text = "2024-01-01T00:00:00Z"
    etree.SubElement(asset, "unit", name="meter", meter="1")
    etree.SubElement(asset, "up_axis").text = "Z_UP"
    effects, materials, geometries, scenes = (
        etree.SubElement(root, f"library_{name}")
        for name in ("effects", "materials", "geometries", "visual_scenes"))
    scene = etree.SubElement(scenes, "visual_scene", id="scene")
    colors = sorted({m.color for m in meshes})
    for i, color in enumerate(colors):
        _material(effects, materials, i, color)
        group = [_cleaned(m) for m in meshes if m.color == color]
        offsets = np.cumsum([0] + [len(m.points) for m in group])
        whole = Mesh(np.vstack([m.points for m in group]),
                     np.vstack([m.faces + k for m, k in zip(group, offsets)]), color)
        _geometry(geometries, i, whole, i)
        node = etree.SubElement(scene, "node", id=f"node{i}")
        instance = etree.SubElement(node, "instance_geometry", url=f"#part{i}")
        bind = etree.SubElement(etree.SubElement(instance, "bind_material"), "technique_common")
        etree.SubElement(bind, "instance_material", symbol=f"material{i}",
                         target=f"#material{i}")
    etree.SubElement(etree.SubElement(root, "scene"), "instance_visual_scene", url="#scene")
    etree.indent(root, " ")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text('<?xml version="1.0" encoding="utf-8"?>\n'
                    + etree.tostring(root, encoding="unicode") + "\n", encoding="utf-8")
