"""The world that residents live in: in this process, as fast as possible, or in ROS."""
from __future__ import annotations

from contextlib import suppress
from typing import Any, Mapping, NamedTuple

from angen_tools.common.failure import Failure
from angen_tools.common.geometry import yaw
from angen_tools.common.home import Home, Pose
from angen_tools.session.world import World


class Body(NamedTuple):
    """The place of a resident: m and rad in the world."""

    x: float
    y: float
    z: float
    yaw: float


class Simulator:
    """A world with a home in it. Failure says why a command or a body is rejected."""

    def __init__(self, world: World, home: Home | None = None) -> None:
        """`home`: that of the world, if it is known."""
        self.world, self.home = world, home or world.home

    @property
    def now(self) -> float:
        return self.world.now

    def run(self, seconds: float) -> None:
        self.world.run(seconds)

    def devices(self, kind: str = '') -> list[tuple[str, str, str, Pose]]:
        """Kind, name, model and pose of each device and sensor."""
        return [(e.kind, e.name, e.model, e.pose) for e in self.world.entities(kind)
                if e.kind != 'model']

    def state(self, kind: str, name: str) -> Mapping[str, Any]:
        """The state of a device, or the reading of a sensor; empty if there is none."""
        with suppress(Failure):
            return self.world.state(kind, name).values
        return {}

    def command(self, kind: str, name: str, text: str) -> None:
        self.world.command(kind, name, text)

    def appear(self, name: str, sdf: str, x: float, y: float, z: float, yaw: float) -> None:
        """Adds the body of a resident."""
        self.world.spawn(name, sdf, (x, y, z, 0.0, 0.0, yaw))

    def vanish(self, name: str) -> None:
        self.world.delete(name)

    def fidget(self, name: str, to: Body) -> None:
        """Moves a sitting or lying resident a little."""
        self.world.place(name, (to.x, to.y, to.z, 0.0, 0.0, to.yaw))

    def body(self, name: str) -> Body:
        x, y, z, *turned = self.world.pose(name)
        return Body(x, y, z, yaw(*turned))
