"""Poses and swings of doors, measured from a world's own geometry."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from angen_apps.maps.gridmap import OCCUPIED, SETTLE, GridMap
from angen_apps.robot.planner import Door, Point
from angen_tools.common.geometry import yaw
from angen_tools.common.home import Door as Described

REACH = 2.0  # m: no leaf is wider
NEAR = 0.12  # m to either side of a leaf's line: its thickness, and cells
GAP = 0.15  # m along a leaf where it ends
HEIGHTS = np.arange(0.1, 3.5, 0.02)  # m above the floor where a leaf's top is searched
ASIDE = 0.3  # m from a leaf, where rays across it start
SLIDES = 0.2  # m that a leaf slides, at least
LOOK = 0.5  # s of simulated time between two looks at a door that turns


@dataclass(frozen=True)
class ModelPose:
    """The pose of a model: its links (x, y in m, yaw), and its joints by name (rad or m)."""

    links: list[tuple[float, float, float]]
    joints: dict[str, float]

    def turned(self, since: ModelPose) -> str:
        """The joint that has moved farthest."""
        return max(self.joints, key=lambda name: abs(self.joints[name] - since.joints[name]))


@dataclass(frozen=True)
class Hinge:
    """The axis of a door, and how far it turns from shut to open (rad)."""

    at: Point
    turn: float


def pose_of(world: Any, model: str) -> ModelPose:
    """The present pose of a model of a world."""
    of = f'{model}::'
    links = [(x, y, yaw(qx, qy, qz, qw))
             for name, (x, y, _, qx, qy, qz, qw) in zip(world.links, world.link_poses)
             if name.startswith(of)]
    joints = {name: float(position) for name, position in zip(world.joints, world.joint_positions)
              if name.startswith(of)}
    return ModelPose(links, joints)


def opened_alone(world: Any, model: str, door: str) -> ModelPose:
    """The pose of a model while one of its doors, which are shut, is open."""
    _turn(world, door, 'Open', 'OPEN')
    pose = pose_of(world, model)
    _turn(world, door, 'Close', 'CLOSED')
    return pose


def _turn(world: Any, door: str, text: str, mode: str) -> None:
    world.command('door', door, text)
    for _ in range(int(SETTLE / LOOK)):
        world.run(LOOK)
        if world.device('door', door)['mode'] == mode:
            break


def find_hinge(shut: list[tuple[float, float, float]],
               opened: list[tuple[float, float, float]]) -> Hinge | None:
    """The axis about which a model's links have turned; None where none has."""
    turn, before, after = max(((math.remainder(b[2] - a[2], 2 * math.pi), a, b)
                               for a, b in zip(shut, opened)), key=lambda t: abs(t[0]))
    if abs(turn) < 0.1:
        return None
    rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    x, y = np.linalg.solve(np.eye(2) - rotation,
                           np.array(after[:2]) - rotation @ np.array(before[:2]))
    return Hinge((float(x), float(y)), turn)


def sliding_door(name: str, described: Described, shut: list[tuple[float, float, float]],
                 opened: list[tuple[float, float, float]]) -> Door | None:
    """The door whose leaf slides along the wall: it turns by nothing, about its end that is
    farthest from the edge that shuts. None where no link has moved so."""
    x, y = max(((b[0] - a[0], b[1] - a[1]) for a, b in zip(shut, opened)),
               key=lambda way: math.hypot(*way))
    if math.hypot(x, y) < SLIDES:
        return None
    middle, half = described.pose, described.width / 2
    along = math.copysign(1.0, x * math.cos(middle[3]) + y * math.sin(middle[3]))
    angle = middle[3] + (math.pi if along > 0 else 0.0)
    end = (middle[0] - half * math.cos(angle), middle[1] - half * math.sin(angle))
    return Door(name, end, angle, angle, described.width)


def find_door(name: str, hinge: Hinge, shut: GridMap, opened: GridMap) -> Door | None:
    """The door on a hinge: the cells that are on one map of its floor and not on the other.

    None where the maps do not differ around the hinge.
    """
    shut_cells, open_cells = shut.cells == OCCUPIED, opened.cells == OCCUPIED
    # turned back to shut, both maps show the same leaf
    leaf = np.concatenate([_around(hinge.at, shut_cells & ~open_cells, shut),
                           _around(hinge.at, open_cells & ~shut_cells, shut) @
                           np.array([[math.cos(hinge.turn), -math.sin(hinge.turn)],
                                     [math.sin(hinge.turn), math.cos(hinge.turn)]])])
    far = np.linalg.norm(leaf, axis=1)
    angles = np.arctan2(leaf[:, 1], leaf[:, 0])
    if not (far > ASIDE).any():
        return None
    around = angles[far > ASIDE]
    alike = np.abs(_wrapped(around[:, None] - around)) < 0.1
    best = around[alike.sum(axis=1).argmax()]
    along = np.abs(_wrapped(angles - best)) * far < NEAR
    angle = best + _wrapped(angles[along & (far > ASIDE)] - best).mean()
    reach = np.sort(far[along])
    ends = np.nonzero(np.diff(reach) > GAP)[0]
    width = float(reach[ends[0]] if len(ends) else reach[-1]) + shut.resolution / 2
    return Door(name, hinge.at, float(angle), float(angle + hinge.turn), width)


def _around(at: Point, mask: np.ndarray, grid: GridMap) -> np.ndarray:
    """The middles (n, 2) of a mask's cells within REACH, from a point."""
    rows, columns = np.nonzero(mask)
    away = (np.stack([columns, rows], axis=1) + 0.5) * grid.resolution + grid.origin - at
    return away[np.linalg.norm(away, axis=1) < REACH]


def _wrapped(angles: np.ndarray) -> np.ndarray:
    return np.remainder(angles + math.pi, 2 * math.pi) - math.pi


def find_top(caster: Any, door: Door, floor: float) -> float:
    """z (m) of a shut leaf's upper edge, by rays across it; `floor` is its floor's z."""
    along = np.array([math.cos(door.shut), math.sin(door.shut), 0.0])
    across = np.array([-along[1], along[0], 0.0])
    middle = np.array([*door.hinge, floor]) + 0.25 * door.width * along
    starts = middle - ASIDE * across + np.outer(HEIGHTS, [0, 0, 1])
    ranges = caster.cast(starts, np.broadcast_to(across, starts.shape), 2 * ASIDE)
    free = np.nonzero(ranges >= 2 * ASIDE)[0]
    return floor + float(HEIGHTS[free[0]] if len(free) else HEIGHTS[-1])
