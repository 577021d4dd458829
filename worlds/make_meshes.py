#!/usr/bin/env python3
"""Writes the meshes of the models, each as COLLADA and binary STL, into models/*/meshes.

    python3 worlds/make_meshes.py

The meshes are made here and carry the repository's licence (Apache-2.0).
"""
import argparse
from math import cos, pi, sin
from pathlib import Path

import numpy as np

from angen_models import elevator
from angen_models.sdf import Color
from angen_models.shapes import Mesh, box, lathe, leaf, rounded_box, tube, write_collada, write_stl

OAK, STEEL, WHITE = (0.65, 0.47, 0.28), (0.75, 0.75, 0.78), (0.96, 0.96, 0.96)
BLUE, BLUE_DARK, RED, RED_DARK = ((0.3, 0.4, 0.55), (0.24, 0.33, 0.47), (0.6, 0.25, 0.2),
                                  (0.5, 0.2, 0.16))
MODELS = Path(__file__).resolve().parent / "models"


def arc(center: tuple[float, float], radius: float, start: float, end: float,
        steps: int) -> list[tuple[float, float]]:
    """Returns points of a circle's arc in a plane (m, rad)."""
    return [(center[0] + radius * cos(start + (end - start) * i / steps),
             center[1] + radius * sin(start + (end - start) * i / steps))
            for i in range(steps + 1)]


def lamp_shade() -> list[Mesh]:
    """Returns a bell open below, round the bulb that hangs 0.35 m under the ceiling."""
    outside = [(0.19 - 0.165 * (i / 8) ** 2.2, -0.38 + 0.14 * i / 8) for i in range(9)]
    inside = [(max(r - 0.006, 0.004), z - 0.003) for r, z in reversed(outside)]
    return [lathe([*outside, (0.004, -0.23), *inside, outside[0]], (0.92, 0.86, 0.7), 28)]


def chair() -> list[Mesh]:
    """Returns a chair with turned legs and a slatted back."""
    parts = [rounded_box((-0.21, -0.21, 0.43), (0.21, 0.21, 0.47), 0.018, OAK)]
    leg = [(0.004, 0.0), (0.013, 0.0), (0.017, 0.15), (0.02, 0.3), (0.016, 0.36), (0.02, 0.44)]
    for x in (-0.19, 0.19):
        parts += [lathe(leg, OAK, 12).moved((x, y, 0)) for y in (-0.19, 0.19)]
    for y in (-0.18, 0.18):
        parts.append(rounded_box((-0.205, y - 0.02, 0.45), (-0.175, y + 0.02, 0.9), 0.012, OAK))
    for z in (0.56, 0.67, 0.79):
        parts.append(rounded_box((-0.2, -0.18, z), (-0.18, 0.18, z + 0.07), 0.009, OAK, 2))
    return parts


def sofa(width: float, seats: int, cloth: Color, dark: Color) -> list[Mesh]:
    """Returns a sofa `width` m wide with round cushions."""
    half, arm = width / 2, 0.18
    parts = [
        rounded_box((-0.45, -half, 0.06), (0.44, half, 0.28), 0.04, dark, 2),
        rounded_box((-0.45, -half, 0.1), (-0.25, half, 0.8), 0.07, dark, 2),
        rounded_box((-0.45, half - arm, 0.08), (0.45, half, 0.62), 0.07, dark, 2),
        rounded_box((-0.45, -half, 0.08), (0.45, -half + arm, 0.62), 0.07, dark, 2),
    ]
    cushion = (width - 2 * arm) / seats
    for i in range(seats):
        y0 = -half + arm + i * cushion
        parts.append(rounded_box((-0.24, y0 + 0.005, 0.26), (0.45, y0 + cushion - 0.005, 0.46),
                                 0.06, cloth))
        parts.append(rounded_box((-0.3, y0 + 0.01, 0.42), (-0.12, y0 + cushion - 0.01, 0.86),
                                 0.08, cloth))
    foot = [(0.003, 0.0), (0.02, 0.0), (0.028, 0.09)]
    parts += [lathe(foot, (0.2, 0.14, 0.1), 10).moved((x, y, 0))
              for x in (-0.38, 0.38) for y in (-half + 0.08, half - 0.08)]
    return parts


def toilet() -> list[Mesh]:
    """Returns bowl, seat and tank; the bowl is a lathed shape stretched along x."""
    bowl = [(0.1, 0.0), (0.105, 0.05), (0.085, 0.16), (0.12, 0.28), (0.175, 0.37), (0.18, 0.4),
            (0.15, 0.4), (0.12, 0.3), (0.05, 0.22), (0.004, 0.21)]
    ring = [(0.115, 0.4), (0.18, 0.4), (0.183, 0.41), (0.178, 0.42), (0.118, 0.42), (0.115, 0.4)]
    stretched = [lathe(profile, WHITE, 28).scaled((1.25, 1, 1)).moved((0.095, 0, 0))
                 for profile in (bowl, ring)]
    tank = [rounded_box((-0.32, -0.19, 0.38), (-0.13, 0.19, 0.79), 0.03, WHITE),
            rounded_box((-0.325, -0.195, 0.78), (-0.125, 0.195, 0.82), 0.015, WHITE),
            rounded_box((-0.3, -0.1, 0.0), (-0.02, 0.1, 0.39), 0.04, WHITE)]
    return stretched + tank


def washbasin() -> list[Mesh]:
    """Returns a basin on a pedestal, with a tap."""
    bowl = [(0.08, 0.68), (0.17, 0.71), (0.23, 0.78), (0.245, 0.85), (0.24, 0.86), (0.205, 0.86),
            (0.18, 0.79), (0.12, 0.73), (0.004, 0.72)]
    basin = lathe(bowl, WHITE, 32).scaled((0.95, 1.2, 1))
    pedestal = lathe([(0.11, 0.0), (0.11, 0.03), (0.075, 0.2), (0.08, 0.55), (0.11, 0.7)], WHITE,
                     20).moved((-0.1, 0, 0))
    spout = [(-0.21, 0, 0.85), (-0.21, 0, 0.95),
             *((x, 0, z) for x, z in arc((-0.16, 0.95), 0.05, pi, 0.0, 6)), (-0.11, 0, 0.93)]
    return [basin, pedestal, tube(spout, 0.012, STEEL)]


def bathtub() -> list[Mesh]:
    """Returns a tub: the rim's rounded rectangle, drawn in level by level."""
    def ring(x: float, y: float, radius: float, z: float) -> list[tuple[float, float, float]]:
        points = []
        for k, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
            corner = (sx * (x - radius), sy * (y - radius))
            points += [(*p, z) for p in arc(corner, radius, k * pi / 2, (k + 1) * pi / 2, 5)]
        return points

    levels = [ring(0.33, 0.81, 0.1, 0.0), ring(0.355, 0.835, 0.11, 0.3),
              ring(0.37, 0.85, 0.12, 0.53), ring(0.37, 0.85, 0.12, 0.56),
              ring(0.31, 0.79, 0.14, 0.56), ring(0.29, 0.76, 0.16, 0.5),
              ring(0.25, 0.66, 0.18, 0.2), ring(0.2, 0.58, 0.18, 0.16),
              ring(0.002, 0.002, 0.001, 0.16)]
    columns = len(levels[0])
    faces = []
    for i in range(len(levels) - 1):
        for j in range(columns):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            faces += [(a, b, b + columns), (a, b + columns, a + columns)]
    return [Mesh(np.array([p for level in levels for p in level]), np.array(faces), WHITE)]


def plant() -> list[Mesh]:
    """Returns a pot, a stem and three rows of leaves."""
    pot = [(0.004, 0.0), (0.1, 0.0), (0.14, 0.22), (0.15, 0.22), (0.15, 0.26), (0.13, 0.26),
           (0.125, 0.23), (0.004, 0.23)]
    parts = [lathe(pot, (0.62, 0.32, 0.2), 20),
             tube([(0, 0, 0.2), (0.015, 0.01, 0.5), (-0.01, 0.0, 0.8), (0, 0.01, 1.0)], 0.014,
                  (0.35, 0.28, 0.16), 6)]
    green = ((0.16, 0.42, 0.17), (0.2, 0.5, 0.2), (0.28, 0.58, 0.24))
    for row, (z, count, length) in enumerate(((0.4, 7, 0.19), (0.68, 6, 0.18), (0.92, 5, 0.16))):
        for k in range(count):
            heading = 2 * pi * (k + 0.37 * row) / count
            parts.append(leaf((0, 0, z), heading, length, 0.11, 0.16, green[row]))
    return parts


def cabin() -> list[Mesh]:
    """Returns the elevator's cabin as its collision boxes say, with a handrail and a lit panel."""
    colors = {"floor": (0.25, 0.25, 0.27), "roof": (0.85, 0.85, 0.86), "kickboard": STEEL}
    parts = []
    for part in elevator.cabin_collisions():
        half, at = np.array(part.size) / 2, np.array(part.at)
        parts.append(box(at - half, at + half, colors.get(part.name, (0.66, 0.68, 0.7))))
    for side in (-1, 1):
        y = side * 0.74
        rail = [(-0.65, side * 0.8, 0.9), (-0.65, y, 0.9), (0.6, y, 0.9), (0.6, side * 0.8, 0.9)]
        parts.append(tube(rail, 0.016, (0.45, 0.3, 0.18)))
    parts.append(rounded_box((-0.5, -0.5, 2.22), (0.5, 0.5, 2.25), 0.01, (1.0, 0.98, 0.9), 2))
    parts.append(rounded_box((0.735, 0.56, 1.0), (0.757, 0.68, 1.35), 0.008, (0.2, 0.2, 0.22), 2))
    return parts


def all_meshes() -> dict[str, list[Mesh]]:
    """Returns meshes by model/name."""
    return {
        "ceiling_lamp/shade": lamp_shade(),
        "chair/chair": chair(),
        "sofa/sofa": sofa(2.0, 3, BLUE, BLUE_DARK),
        "armchair/armchair": sofa(0.86, 1, RED, RED_DARK),
        "toilet/toilet": toilet(),
        "washbasin/washbasin": washbasin(),
        "bathtub/bathtub": bathtub(),
        "plant/plant": plant(),
        "elevator/cabin": cabin(),
    }


def main() -> None:
    """Writes every mesh twice and says how big each file is."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0],
                                     epilog="example: python3 worlds/make_meshes.py")
    parser.add_argument("--models", type=Path, default=MODELS, help="folder of the models")
    models = parser.parse_args().models
    for name, meshes in all_meshes().items():
        model, stem = name.split("/")
        base = models / model / "meshes" / stem
        write_collada(meshes, base.with_suffix(".dae"))
        write_stl(meshes, base.with_suffix(".stl"))
        sizes = [base.with_suffix(s).stat().st_size for s in (".dae", ".stl")]
        print(f"{base}: {sum(len(m.faces) for m in meshes)} triangles, "
              f"dae {sizes[0]} bytes, stl {sizes[1]} bytes")


if __name__ == "__main__":
    main()
