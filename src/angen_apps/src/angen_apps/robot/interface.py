"""The inputs and outputs of a robot's program, through ROS or in this process."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from angen_apps.robot.door_client import DoorState
from angen_apps.robot.pilot import Pose
from angen_tools.common.failure import Failure
from angen_tools.session import Event
from angen_tools.world.models import collisions as collisions_of
from angen_tools.world.sdf import read

BUMPER = 'patrol_bumper'  # the sensor on the robot that detects all that it touches
CYCLE = 0.1  # s from one command to the next
BASE = 'base_footprint'  # the robot's link that carries its body
ROLLS = ('wheel', 'tread', 'caster')  # a collision with this in its name may touch the floor


@dataclass(frozen=True)
class LiftState:
    """The fields of angen_msgs/ElevatorState that a robot needs; position in m."""

    mode: str
    door_mode: str
    target_floor: int
    position: float

    def stands_open(self, floor: int, level: float) -> bool:
        """Whether it is at a floor, whose z is `level` (m), with its doors open."""
        return (self.mode == 'IDLE' and self.target_floor == floor and self.door_mode == 'OPEN'
                and abs(self.position - level) < 0.1)


class Robot(Protocol):
    """A robot in a building. Commands take effect at the start of the next cycle."""

    @property
    def now(self) -> float:
        """Simulated time, s."""

    @property
    def events(self) -> list[Event]:
        """All that happened, in order."""

    def cycle(self, v: float, w: float) -> None:
        """Commands the wheels (m/s, rad/s) and lets CYCLE pass."""

    def command(self, kind: str, name: str, text: str) -> None:
        """Commands a door or an elevator."""

    def door(self, name: str) -> DoorState: ...

    def lift(self, name: str) -> LiftState: ...

    def odometry(self) -> Pose:
        """By the wheels, since the start."""

    def scan(self) -> Any:
        """The latest scan; has the fields of sensor_msgs/LaserScan."""

    def scanned_at(self) -> Pose:
        """The odometry at the time of the latest scan."""

    def truth(self) -> tuple[float, float, float, float]:
        """x, y, z (m), yaw (rad), to record and judge a run; no program may steer by it."""


def bumper(world: Path, robot: str) -> tuple[str, str]:
    """SDF of a sensor that samples each step the contacts of the robot's body, and the
    MODEL::LINK that carries it. Failure if the file of the world has no such robot."""
    link = f'{robot}::{BASE}'
    names = collisions_of(read(world), link)
    if not names:
        raise Failure(f'the robot {robot} has no link {BASE} with collisions')
    return bumper_of(names), link


def bumper_of(collisions: list[str]) -> str:
    """SDF of the bumper of a robot with these collisions."""
    parts = ''.join(f'<collision>{name}</collision>' for name in collisions
                    if not any(part in name for part in ROLLS))
    return (f'<sensor name="{BUMPER}" type="contact"><update_rate>1000</update_rate><contact>'
            f'{parts}</contact><plugin name="bumper" filename="libgazebo_ros_bumper.so"/></sensor>')


def collisions(events: list[Event]) -> list[tuple[float, str]]:
    """When the robot touched something that it must not touch (s), and its name."""
    return [(e.time, e.detail) for e in events
            if (e.source, e.kind, e.event) == (BUMPER, 'contact', 'pressed')]
