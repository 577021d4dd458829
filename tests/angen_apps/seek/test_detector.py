"""Arcs in scans and figures in depth images, against synthetic ones."""
import math
from types import SimpleNamespace
from typing import Callable

import numpy as np
import pytest
from angen import Grid

from angen_apps.maps.gridmap import FREE, OCCUPIED
from angen_apps.robot.localizer import Field
from angen_apps.robot.pilot import Pose
from angen_apps.seek.detector import Arc, find_arcs, find_figure

COUNT = 720
MOUNT = Pose(0.0, 0.0, 0.0)
Shape = Callable[[np.ndarray, np.ndarray], np.ndarray]  # ranges of rays from an origin


def circle(x: float, y: float, radius: float) -> Shape:
    def ranges(origin: np.ndarray, ways: np.ndarray) -> np.ndarray:
        away = origin - (x, y)
        along = ways @ away
        inside = along ** 2 - away @ away + radius ** 2
        near = -along - np.sqrt(np.maximum(inside, 0))
        return np.where((inside > 0) & (near > 0), near, np.inf)
    return ranges


def segment(x0: float, y0: float, x1: float, y1: float) -> Shape:
    def ranges(origin: np.ndarray, ways: np.ndarray) -> np.ndarray:
        line, start = np.array([x1 - x0, y1 - y0]), np.array([x0, y0]) - origin
        across = ways[:, 0] * line[1] - ways[:, 1] * line[0]
        across = np.where(np.abs(across) < 1e-12, np.nan, across)
        far = (start[0] * line[1] - start[1] * line[0]) / across
        share = (start[0] * ways[:, 1] - start[1] * ways[:, 0]) / across
        return np.where((far > 0) & (share >= 0) & (share <= 1), far, np.inf)
    return ranges


WALLS = [segment(0, 0, 8, 0), segment(8, 0, 8, 6), segment(8, 6, 0, 6), segment(0, 6, 0, 0)]


def room() -> Field:
    """The map of a room of 8 by 6 m: its walls."""
    cells = np.full((122, 162), FREE, np.int8)
    cells[0:2, :] = cells[-2:, :] = OCCUPIED
    cells[:, 0:2] = cells[:, -2:] = OCCUPIED
    return Field(Grid(cells, (-0.05, -0.05), 0.05, 0))


def scan(pose: Pose, *shapes: Shape, seed: int = 1) -> SimpleNamespace:
    """The scan of a laser with a noise of 1 cm at a pose in the room with these things in it."""
    angles = -math.pi + np.arange(COUNT) * 2 * math.pi / COUNT
    ways = np.stack([np.cos(angles + pose.yaw), np.sin(angles + pose.yaw)], axis=1)
    eye = np.array([pose.x, pose.y])
    ranges = np.min([shape(eye, ways) for shape in [*WALLS, *shapes]], axis=0)
    noise = np.random.default_rng(seed).normal(0.0, 0.01, COUNT)
    return SimpleNamespace(ranges=list(ranges + noise), angle_min=-math.pi, range_min=0.12,
                           angle_increment=2 * math.pi / COUNT, range_max=10.0)


def arcs(pose: Pose, *shapes: Shape, seed: int = 1) -> list[Arc]:
    return find_arcs(scan(pose, *shapes, seed=seed), MOUNT, pose, room())


@pytest.mark.parametrize('far', [1.0, 2.0, 3.0, 4.5])
@pytest.mark.parametrize('yaw', [0.0, 1.0, math.pi])
def test_a_person_is_an_arc_at_its_place(far: float, yaw: float) -> None:
    for seed in range(5):
        found = arcs(Pose(1.5, 3.0, yaw), circle(1.5 + far, 3.0, 0.25), seed=seed)
        assert len(found) == 1, (seed, found)
        assert math.dist(found[0].at, (1.5 + far, 3.0)) < 0.08
        assert found[0].far == pytest.approx(far, abs=0.08)


def test_a_person_across_the_seam_of_the_scan_is_one() -> None:
    found = arcs(Pose(5.0, 3.0, 0.0), circle(3.0, 3.0, 0.25))
    assert len(found) == 1 and math.dist(found[0].at, (3.0, 3.0)) < 0.05


def test_two_people_are_two_arcs() -> None:
    assert len(arcs(Pose(1.5, 3.0, 0.0), circle(3.5, 2.0, 0.25), circle(3.5, 4.0, 0.25))) == 2


def test_an_empty_room_has_none() -> None:
    assert not any(arcs(Pose(x, 3.0, 0.3), seed=seed) for x in (0.5, 2.0, 6.0)
                   for seed in range(5))


@pytest.mark.parametrize('shape', [
    segment(3.0, 2.6, 3.0, 3.1),  # a leaf that is ajar
    segment(3.0, 2.8, 3.3, 3.2),
    circle(3.0, 3.0, 0.03),  # the leg of a table
    circle(3.0, 3.0, 0.7),  # a round table
], ids=['leaf', 'slanted leaf', 'leg', 'table'])
def test_other_things_are_none(shape: Shape) -> None:
    for seed in range(10):
        assert arcs(Pose(1.0, 3.0, 0.0), shape, seed=seed) == [], seed


def test_what_the_map_has_is_none() -> None:
    field = room()
    grid = Grid(np.full((122, 162), FREE, np.int8), (-0.05, -0.05), 0.05, 0)
    angles = np.linspace(0, 2 * math.pi, 400)
    for x, y in zip(3.0 + 0.25 * np.cos(angles), 3.0 + 0.25 * np.sin(angles)):
        grid.cells[grid.cell(x, y)] = OCCUPIED
    pose = Pose(1.0, 3.0, 0.0)
    seen = scan(pose, circle(3.0, 3.0, 0.25))
    assert find_arcs(seen, MOUNT, pose, field)
    grid.cells[[0, 1, -2, -1], :] = OCCUPIED
    grid.cells[:, [0, 1, -2, -1]] = OCCUPIED
    assert find_arcs(seen, MOUNT, pose, Field(grid)) == []


FOCAL, CAMERA = 277.1, (0.13, 0.0, 0.34)


def depth(far: float, top: float, half: float, wall: float = 6.0) -> SimpleNamespace:
    """A depth image of a thing `far` ahead of the robot's middle, `top` high, 2 `half` wide."""
    rows, columns = np.mgrid[0:240, 0:320]
    z = far - 0.2 - CAMERA[0]
    height = CAMERA[2] - (rows - 119.5) / FOCAL * z
    aside = (columns - 159.5) / FOCAL * z
    image = np.where((np.abs(aside) < half) & (height < top) & (height > 0), z, wall)
    return SimpleNamespace(depth=image.astype(np.float32)[:, :, None], width=320, height=240,
                           focal=FOCAL, center_x=159.5, center_y=119.5)


@pytest.mark.parametrize('far', [0.9, 1.2, 2.0, 3.5, 4.5])
def test_a_person_is_a_figure(far: float) -> None:
    figure = find_figure(depth(far, 1.75, 0.2), CAMERA, Pose(0, 0, 0), Arc(far, 0, 0.25, far))
    assert figure is not None and figure.top > min(1.2, 0.43 * (far - 0.4) + 0.3)


def test_things_beside_a_person_do_not_matter() -> None:
    image = depth(3.0, 1.75, 0.2)
    machine = depth(3.0, 0.85, 0.7)
    image.depth = np.minimum(image.depth, machine.depth)
    assert find_figure(image, CAMERA, Pose(0, 0, 0), Arc(3.0, 0, 0.25, 3.0)) is not None


@pytest.mark.parametrize('top, half', [(0.9, 0.2), (0.45, 0.2), (1.75, 0.6)],
                         ids=['chair', 'robot', 'door'])
def test_others_are_none(top: float, half: float) -> None:
    assert find_figure(depth(3.0, top, half), CAMERA, Pose(0, 0, 0),
                       Arc(3.0, 0, 0.25, 3.0)) is None


def test_what_the_camera_does_not_face_is_none() -> None:
    assert find_figure(depth(3.0, 1.75, 0.2), CAMERA, Pose(0, 0, 1.5),
                       Arc(3.0, 0, 0.25, 3.0)) is None
