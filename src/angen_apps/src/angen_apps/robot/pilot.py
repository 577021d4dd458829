"""Keeps a differential drive on a line of points: turn towards it, then follow it."""
from __future__ import annotations

import math
from dataclasses import dataclass

from angen_apps.robot.planner import Point

LOOK_AHEAD = 0.30  # m
TURN_FIRST = 0.5  # rad: with a greater error it turns on the spot
ARRIVED = 0.03  # m
FINE_TURN = 3.0  # rad/s a rad
LATE_TURN, LATE_WAY = 0.5, 0.2  # share of an error, m in one command: if they are rare


@dataclass(frozen=True)
class Pose:
    """x, y (m), yaw (rad) in the world."""

    x: float
    y: float
    yaw: float

    def then(self, other: Pose) -> Pose:
        """`other`, which is given in this frame, in the frame that this one is given in."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return Pose(self.x + c * other.x - s * other.y, self.y + s * other.x + c * other.y,
                    wrapped(self.yaw + other.yaw))

    def inverse(self) -> Pose:
        """The frame that this one is given in, in this one."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return Pose(-c * self.x - s * self.y, s * self.x - c * self.y, -self.yaw)


def wrapped(angle: float) -> float:
    """The angle in -pi … pi."""
    return math.remainder(angle, 2 * math.pi)


class Pilot:
    """Follows points to the last, with limits on speed (m/s), turn (rad/s) and acceleration."""

    def __init__(self, points: list[Point], speed: float, turn: float, acceleration: float) -> None:
        self._points, self._speed, self._turn = points, speed, turn
        self._acceleration = acceleration
        self._next = 0
        self._v = self._w = 0.0
        self.arrived = False

    @property
    def left(self) -> list[Point]:
        """The points that are still ahead."""
        return self._points[self._next:]

    def stop(self, dt: float) -> tuple[float, float] | None:
        """Speed and turn for the next dt seconds while the robot brakes; None once it stopped."""
        return None if self._v == 0.0 and self._w == 0.0 else self._ramp(0.0, 0.0, dt)

    def steer(self, pose: Pose, dt: float) -> tuple[float, float] | None:
        """Speed and turn for the next dt seconds; None once it has arrived and stopped."""
        end = self._points[-1]
        left = math.dist((pose.x, pose.y), end)
        if left < ARRIVED or (self._next == len(self._points) - 1 and left < 3 * ARRIVED
                              and abs(self._bearing(pose, end)) > math.pi / 2):
            self.arrived = self._v == 0.0 and self._w == 0.0
            return self.stop(dt)
        target = self._target(pose)
        error = self._bearing(pose, target)
        if abs(error) > TURN_FIRST or (self._v == 0.0 and abs(error) > 0.1):
            gain = min(FINE_TURN, LATE_TURN / dt)
            turn = math.copysign(min(self._turn, gain * abs(error)), error)
            return self._ramp(0.0, turn if self._v < 0.05 else 0.0, dt)
        speed = min(self._speed, math.sqrt(2 * 0.7 * self._acceleration * left), 1.5 * left + 0.02)
        speed = min(speed * max(0.25, math.cos(2 * error)), LATE_WAY / dt)
        far = max(math.dist((pose.x, pose.y), target), 0.1)
        turn = 2 * speed * math.sin(error) / far
        return self._ramp(speed, max(-self._turn, min(self._turn, turn)), dt)

    def _target(self, pose: Pose) -> Point:
        here = (pose.x, pose.y)
        ahead = range(self._next, min(self._next + 40, len(self._points)))
        self._next = min(ahead, key=lambda i: math.dist(here, self._points[i]))
        for i in range(self._next, len(self._points)):
            if math.dist(here, self._points[i]) >= LOOK_AHEAD:
                return self._points[i]
        self._next = len(self._points) - 1
        return self._points[-1]

    def _bearing(self, pose: Pose, point: Point) -> float:
        return wrapped(math.atan2(point[1] - pose.y, point[0] - pose.x) - pose.yaw)

    def _ramp(self, v: float, w: float, dt: float) -> tuple[float, float]:
        self._v += max(-self._acceleration * dt, min(self._acceleration * dt, v - self._v))
        most = 4.0 * dt
        self._w += max(-most, min(most, w - self._w))
        return self._v, self._w
