#!/usr/bin/env python3
"""Writes the models that public worlds include from Gazebo's model database, of shapes of our own.

    python3 worlds/make_public_models.py      writes worlds/models/NAME for each of MODELS

Names, outer sizes and masses are those by which worlds use them; nothing else is theirs. Those that
worlds name by their mesh (model://cafe_table/meshes/cafe_table.dae) have one.
"""
from dataclasses import dataclass, field
from pathlib import Path

from angen_models.shapes import Mesh, box, lathe, write_collada

MODELS_FOLDER = Path(__file__).resolve().parent / 'models'
Corner = tuple[float, float, float]


@dataclass
class Part:
    """A box (x y z) or a cylinder (radius, length), by its center."""
    size: tuple[float, ...]
    at: Corner

    @property
    def is_box(self) -> bool:
        return len(self.size) == 3

    def geometry(self) -> str:
        if self.is_box:
            return f'<box><size>{self.size[0]:g} {self.size[1]:g} {self.size[2]:g}</size></box>'
        return (f'<cylinder><radius>{self.size[0]:g}</radius>'
                f'<length>{self.size[1]:g}</length></cylinder>')


@dataclass
class Model:
    """The contents of a model's SDF."""
    color: str
    mass: float  # kg; 0: it is static
    parts: list[Part] = field(default_factory=list)
    mesh: str = ''  # the file of the mesh that worlds name


def stack(*layers: tuple[float, float]) -> list[Part]:
    """Cylinders (radius, length) on top of each other."""
    parts, height = [], 0.0
    for radius, length in layers:
        parts.append(Part((radius, length), (0, 0, height + length / 2)))
        height += length
    return parts


MODELS = {
    'cafe_table': Model('0.55 0.4 0.25', 20, [
        Part((0.91, 0.91, 0.04), (0, 0, 0.755)), Part((0.03, 0.71), (0, 0, 0.38)),
        Part((0.55, 0.55, 0.03), (0, 0, 0.015))], 'cafe_table'),
    'cardboard_box': Model('0.7 0.55 0.35', 20, [Part((0.5, 0.4, 0.3), (0, 0, 0.15))]),
    'construction_cone': Model('0.95 0.35 0.05', 2, [Part((0.37, 0.37, 0.03), (0, 0, 0.015))] + [
        Part((0.14 - 0.012 * i, 0.06), (0, 0, 0.06 + 0.06 * i)) for i in range(10)]),
    'dumpster': Model('0.2 0.35 0.25', 0, [Part((2.8, 1.5, 1.3), (0, 0, 0.65))]),
    'fire_hydrant': Model('0.75 0.1 0.08', 0, stack((0.2, 0.08), (0.12, 0.55), (0.15, 0.12),
                                                    (0.06, 0.08))),
    'first_2015_trash_can': Model('0.35 0.37 0.4', 5, stack((0.21, 0.05), (0.24, 0.6)),
                                  'trash_can'),
    'grey_wall': Model('0.6 0.6 0.6', 0, [Part((7.5, 0.2, 2.8), (0, 0, 1.4))]),
    'jersey_barrier': Model('0.75 0.75 0.72', 0, [Part((4.06, 0.81, 0.2), (0, 0, 0.1)),
                                                  Part((4.06, 0.5, 0.25), (0, 0, 0.325)),
                                                  Part((4.06, 0.24, 0.69), (0, 0, 0.795))]),
    'mailbox': Model('0.1 0.25 0.55', 0, [Part((0.08, 0.08, 0.9), (0, 0, 0.45)),
                                          Part((0.25, 0.5, 0.3), (0, 0, 1.05))], 'mailbox'),
    'table_marble': Model('0.8 0.78 0.75', 0, [
        Part((1.6, 0.9, 0.04), (0, 0, 0.74)), Part((0.1, 0.72), (-0.5, 0, 0.36)),
        Part((0.1, 0.72), (0.5, 0, 0.36))], 'table_lightmap'),
    'wood_cube_10cm': Model('0.65 0.46 0.28', 0.5, [Part((0.1, 0.1, 0.1), (0, 0, 0.05))]),
}


def mesh(part: Part, color: str) -> Mesh:
    rgb = (float(color.split()[0]), float(color.split()[1]), float(color.split()[2]))
    if part.is_box:
        half = [s / 2 for s in part.size]
        return box([-h for h in half], half, rgb).moved(part.at)
    radius, length = part.size
    ends = [(1e-4, -length / 2), (radius, -length / 2), (radius, length / 2), (1e-4, length / 2)]
    return lathe(ends, rgb).moved(part.at)


def inertial(model: Model) -> str:
    """The inertia of a solid box around all parts."""
    half = [max(abs(part.at[i]) + (part.size[i] / 2 if part.is_box else part.size[0])
                for part in model.parts) for i in (0, 1)]
    top = max(part.at[2] + (part.size[2] if part.is_box else part.size[1]) / 2
              for part in model.parts)
    x, y, z = 2 * half[0], 2 * half[1], top
    ixx, iyy, izz = ((a * a + b * b) * model.mass / 12 for a, b in ((y, z), (x, z), (x, y)))
    return (f'      <inertial>\n        <pose>0 0 {top / 2:g} 0 0 0</pose>\n'
            f'        <mass>{model.mass:g}</mass>\n        <inertia>\n'
            f'          <ixx>{ixx:.5g}</ixx>\n          <iyy>{iyy:.5g}</iyy>\n'
            f'          <izz>{izz:.5g}</izz>\n        </inertia>\n      </inertial>\n')


def sdf(name: str, model: Model) -> str:
    text = f'<?xml version="1.0"?>\n<sdf version="1.6">\n  <model name="{name}">\n'
    if not model.mass:
        text += '    <static>true</static>\n'
    text += '    <link name="link">\n' + (inertial(model) if model.mass else '')
    for i, part in enumerate(model.parts):
        place = f'<pose>{part.at[0]:g} {part.at[1]:g} {part.at[2]:g} 0 0 0</pose>'
        shape = f'<geometry>{part.geometry()}</geometry>'
        text += (f'      <collision name="collision_{i}">{place}{shape}</collision>\n'
                 f'      <visual name="visual_{i}">{place}{shape}'
                 f'<material><diffuse>{model.color} 1</diffuse></material></visual>\n')
    return text + '    </link>\n  </model>\n</sdf>\n'


def main() -> None:
    for name, model in MODELS.items():
        folder = MODELS_FOLDER / name
        folder.mkdir(exist_ok=True)
        (folder / 'model.sdf').write_text(sdf(name, model))
        (folder / 'model.config').write_text(
            f'<?xml version="1.0"?>\n<model>\n  <name>{name}</name>\n  <version>1.0</version>\n'
            '  <sdf version="1.6">model.sdf</sdf>\n'
            '  <description>Stands where public worlds include this name.</description>\n'
            '</model>\n')
        if model.mesh:
            (folder / 'meshes').mkdir(exist_ok=True)
            write_collada([mesh(part, model.color) for part in model.parts],
                          folder / 'meshes' / f'{model.mesh}.dae')


if __name__ == '__main__':
    main()
