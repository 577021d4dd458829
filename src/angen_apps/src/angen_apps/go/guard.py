"""Whether a robot may drive on: its way is free, it makes progress, and it is localized."""
import math

import numpy as np

from angen_apps.robot.driver import Driver
from angen_apps.robot.interface import CYCLE
from angen_tools.common.geometry import length

BESIDE = 0.02  # m: things nearer to the line than the clearance less this are in the way
AHEAD, NEAR = 14, 1.2  # points of the line that are looked at, 0.05 m apart; m around the robot
HELD = 5.0  # s that it waits for something in its way
STILL, STEP = 10.0, 0.1  # s without coming nearer by STEP m
LOST, UNSURE = 0.5, 1.5  # share of a scan on the map: less for UNSURE s means that it is lost


class Guard:
    """Guards one drive after the other; `reason` says why it gave the last one up."""

    def __init__(self, clearance: float) -> None:
        self._beside = clearance - BESIDE
        self.driver: Driver | None = None
        self.begin()

    def begin(self) -> None:
        """A new drive."""
        self.reason = ''
        self._held = self._unsure = self._still = 0.0
        self._left = math.inf  # m

    def may_go(self) -> bool:
        """Whether its way is free of things that are not on the map."""
        assert self.driver is not None
        pose = np.array([self.driver.pose.x, self.driver.pose.y])
        ahead = np.array([pose, *self.driver.left[:AHEAD]])
        foreign = self.driver.foreign
        foreign = foreign[np.hypot(*(foreign - pose).T) < NEAR]
        gaps = np.hypot(*(foreign[:, None] - ahead).transpose(2, 0, 1)).min(axis=1)
        in_way = foreign[gaps < self._beside]
        self._held = self._held + CYCLE if len(in_way) else 0.0
        if self._held > HELD:
            x, y = in_way.mean(axis=0)
            self.reason = f'something is in its way at {x:.1f}, {y:.1f}'
        return not len(in_way)

    def give_up(self) -> bool:
        """Whether to end the drive."""
        assert self.driver is not None
        self._unsure = self._unsure + CYCLE if self.driver.share < LOST else 0.0
        if self._unsure > UNSURE:
            self.reason = 'its lidar scan does not fit the map'
        left = length(self.driver.left)
        if left < self._left - STEP or self._held:
            self._left, self._still = left, 0.0
        self._still += CYCLE
        if self._still > STILL:
            self.reason = 'it does not come nearer'
        return bool(self.reason)
