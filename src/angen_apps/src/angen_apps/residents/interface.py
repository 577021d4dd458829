"""The simulator's interface to residents: in this process (simulated.py) or ROS (live.py)."""
from __future__ import annotations

from typing import Any, NamedTuple, Protocol

from angen_tools.common.home import Home, Place


class Body(NamedTuple):
    """The place of a resident: m and rad in the world."""

    x: float
    y: float
    z: float
    yaw: float


class Rejected(Exception):
    """The simulator rejected a command."""


class Simulator(Protocol):
    """One home with residents in it."""

    home: Home

    @property
    def now(self) -> float:
        """Simulated time, s."""

    def run(self, seconds: float) -> None:
        """Lets time pass."""

    def devices(self) -> list[tuple[str, str, str, tuple[float, ...]]]:
        """Kind, name, model and pose (x y z qx qy qz qw) of each device and sensor."""

    def state(self, kind: str, name: str) -> dict[str, Any]:
        """The state of a device, or the reading of a sensor; empty if there is none."""

    def command(self, kind: str, name: str, text: str) -> None:
        """Commands a device; Rejected says why not."""

    def appear(self, name: str, x: float, y: float, z: float, yaw: float, speed: float, body: str
               ) -> None:
        """Places a standing resident there, whatever its posture was."""

    def settle(self, name: str, place: Place) -> None:
        """Makes a resident sit or lie at a place."""

    def vanish(self, name: str) -> None:
        """Removes a resident from the home."""

    def fidget(self, name: str, turn: float) -> None:
        """Turns a sitting or lying resident by some rad."""

    def body(self, name: str) -> Body:
        """The place of a resident."""
