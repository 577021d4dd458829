"""The box around a world."""
from math import cos, sin

import numpy as np
from angen_msgs.msg import Scene, SceneLink, SceneMesh, SceneShape
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3

from angen_apps.viewer.bounds import EMPTY, bounds


def pose(x: float, y: float, z: float, yaw: float = 0.0) -> Pose:
    return Pose(Point(x, y, z), Quaternion(0.0, 0.0, sin(yaw / 2), cos(yaw / 2)))


def box(link: int, *size: float) -> SceneShape:
    return SceneShape(type=SceneShape.BOX, link=link, pose=pose(0, 0, 0), size=Vector3(*size))


def test_the_bounds_are_those_of_the_building() -> None:
    scene = Scene()
    scene.links = [SceneLink(group='walls south 0', pose=pose(4, 0, 1)),
                   SceneLink(group='floors 0', pose=pose(4, 3, 0, np.pi / 2)),
                   SceneLink(group='furniture 0', pose=pose(90, 0, 0)),
                   SceneLink(group='ground', pose=pose(0, 0, 0))]
    scene.shapes = [box(0, 8, 0.1, 2), box(1, 6, 8, 0.2), box(2, 1, 1, 1), box(3, 99, 99, 1)]
    assert np.allclose(bounds(scene), [[0, -0.05, -0.1], [8, 6, 2]])


def test_the_bounds_are_those_of_all_but_the_ground_without_a_building() -> None:
    scene = Scene()
    scene.links = [SceneLink(group='furniture 0', pose=pose(2, 0, 0)),
                   SceneLink(group='ground', pose=pose(0, 0, 0))]
    scene.meshes = [SceneMesh(vertices=[0, 0, 0, 1, 2, 3], triangles=[])]
    scene.shapes = [SceneShape(type=SceneShape.MESH, link=0, mesh=0, pose=pose(0, 5, 0)),
                    box(1, 99, 99, 1)]
    assert np.allclose(bounds(scene), [[2, 5, 0], [3, 7, 3]])


def test_an_empty_world_has_one_too() -> None:
    assert np.array_equal(bounds(Scene()), EMPTY)
