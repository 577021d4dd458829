"""When a sensor could first notice the robot, by geometry: rays, and no sensor's reading."""
import math
from typing import Any, Iterable

import numpy as np

from angen_apps.maps.gridmap import models_with
from angen_apps.maps.rays import sees
from angen_apps.robot.entities import Entity
from angen_apps.robot.planner import Door
from angen_apps.robot.views import View

AROUND = 1.0  # m from a robot's axis, from where its outline is sampled
SIDES, HEIGHTS = 16, np.arange(0.03, 1.5, 0.06)  # rays that find a robot's outline; m
BEAM = 0.5  # m
BESIDE = 0.6  # m from the middle of a shut leaf to the switch over it
CHUNK = 50  # positions at a time
TICKS, SAMPLES = 6, 120  # ticks between two samples of the beams of opening doors, and how many
CHANGED = 0.05  # m by which a cut beam is shorter


def hidden(origin: np.ndarray, points: np.ndarray, door: Door, turned: np.ndarray) -> np.ndarray:
    """Which points (n, 3) a leaf hides from origin; `turned` (n,): rad from shut."""
    angle = door.shut + turned
    leaf = door.width * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    line = points[:, :2] - origin[:2]
    start = np.array(door.hinge) - origin[:2]
    across = line[:, 0] * leaf[:, 1] - line[:, 1] * leaf[:, 0]
    across = np.where(np.abs(across) < 1e-9, np.nan, across)
    along_line = (start[0] * leaf[:, 1] - start[1] * leaf[:, 0]) / across
    along_leaf = (start[0] * line[:, 1] - start[1] * line[:, 0]) / across
    crosses = (along_line > 0) & (along_line < 1) & (along_leaf > 0) & (along_leaf < 1)
    height = origin[2] + along_line * (points[:, 2] - origin[2])
    return crosses & (door.bottom < height) & (height < door.top)


def outline(world: Any, start: np.ndarray) -> np.ndarray:
    """Points (n, 3) of the surface of the robot at `start` (x, y, z, yaw; m), in its
    own frame. Removes all robots from the world."""
    turns = np.arange(SIDES) * 2 * math.pi / SIDES
    ways = np.repeat(np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1), len(HEIGHTS),
                     axis=0)
    origins = start[:3] - AROUND * ways + np.outer(np.tile(HEIGHTS, SIDES), [0, 0, 1])
    before = world.cast(origins, ways, AROUND)
    for name in models_with(world, 'left_wheel_joint'):
        world.delete(name)
    hit = before < world.cast(origins, ways, AROUND) - 1e-6
    points = (origins + before[:, None] * ways)[hit] - start[:3]
    c, s = math.cos(start[3]), math.sin(start[3])
    return points @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


class Sight:
    """Lines of sight in a world, from which it removes the doors; leaves are at recorded angles.

    `body` (n, 3): points of the robot's surface. `angles` has, for each door, (n, 2) times (s) and
    radians from shut. The world must be without robots.
    """

    def __init__(self, world: Any, body: np.ndarray, doors: list[Door],
                 angles: dict[str, np.ndarray]) -> None:
        self._world = world
        self._body, self._doors, self._angles = body, doors, angles
        for name in models_with(world, 'hinge'):
            world.delete(name)

    def _bodies(self, track: np.ndarray) -> np.ndarray:
        """(rows, points, 3): the robot's surface along a track with rows t, x, y, z, yaw."""
        c, s = np.cos(track[:, 4])[:, None], np.sin(track[:, 4])[:, None]
        x, y, z = self._body.T
        return track[:, None, 1:4] + np.stack([c * x - s * y, s * x + c * y,
                                               np.broadcast_to(z, (len(track), len(z)))], axis=2)

    def first(self, view: View, track: np.ndarray) -> float | None:
        """When a sensor first has a free line to a point of the robot; None if it never has."""
        away = np.hypot(*(track[:, 1:3] - view.position[:2]).T)
        near = track[away <= view.reach + AROUND]
        for start in range(0, len(near), CHUNK):
            rows = near[start:start + CHUNK]
            bodies = self._bodies(rows)
            times = np.repeat(rows[:, 0], bodies.shape[1])
            points = bodies.reshape(-1, 3)
            inside = view.holds(points)
            seen = times[inside][self._free(view.position, points[inside], times[inside])]
            if len(seen):
                return float(seen.min())
        return None

    def _free(self, origin: np.ndarray, points: np.ndarray, times: np.ndarray) -> np.ndarray:
        if len(points) == 0:
            return np.zeros(0, bool)
        free = np.nonzero(sees(self._world, origin, points))[0]
        for door in self._doors:
            history = self._angles[door.name]
            which = np.searchsorted(history[:, 0], times[free], side='right') - 1
            turned = history[np.maximum(which, 0), 1]
            free = free[~hidden(origin, points[free], door, turned)]
        return np.isin(np.arange(len(points)), free)


def door_beside(switch: Entity, doors: Iterable[Door]) -> str:
    """The door in whose opening a switch is: it is over the middle of the leaf; '' for none."""
    near = [(math.dist(switch.pose[:2], door.middle), door.name) for door in doors]
    away, name = min(near, default=(math.inf, ''))
    return name if away < BESIDE else ''


def beam_angles(world: Any, doors: dict[int, list[Door]], switches: list[Entity],
                rooms: dict[str, str]) -> dict[str, float]:
    """The angle (rad) of each switch's door from shut at which its beam is free.

    `doors` of each floor, all shut; they are opened for it.
    """
    origins = np.array([s.place for s in switches]).reshape(-1, 3)
    ways = np.array([s.rotation[:, 0] for s in switches]).reshape(-1, 3)
    names = {door.name for each in doors.values() for door in each}
    joints = {name: [i for i, joint in enumerate(world.joints) if joint.startswith(f'{model}::')]
              for _, name, model, _ in world.entities('door') if name in names}
    shut = world.cast(origins, ways, BEAM)
    for name in names:
        world.command('door', name, 'Open')
    found: dict[str, float] = {}
    for _ in range(SAMPLES if switches else 0):
        world.step(TICKS)
        longer = world.cast(origins, ways, BEAM) > shut + CHANGED
        positions = world.joint_positions
        for switch, free in zip(switches, longer):
            door = rooms[switch.name]
            if free and door in joints:  # doors of one model turn alike
                turned = max(abs(float(positions[i])) for i in joints[door])
                found.setdefault(switch.name, turned)
    return found
