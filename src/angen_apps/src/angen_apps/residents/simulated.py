"""Residents' back end in this process: `import angen`, as fast as possible."""
from __future__ import annotations

from typing import Any

from angen_apps.residents.figures import figure, walker
from angen_apps.residents.interface import Body, Rejected
from angen_tools.common.catalog import angen_module
from angen_tools.common.geometry import yaw as yaw_of
from angen_tools.common.home import Home, Place

ABOVE = 0.002  # m between the support and a placed figure


class Simulated:
    """See interface.Simulator."""

    def __init__(self, world: Any, home: Home) -> None:
        self.world, self.home = world, home
        self._error = angen_module().Error

    @property
    def now(self) -> float:
        return float(self.world.time)

    def run(self, seconds: float) -> None:
        self.world.run(seconds, long_steps=True)

    def devices(self) -> list[tuple[str, str, str, tuple[float, ...]]]:
        return [(kind, name, model, tuple(float(v) for v in pose))
                for kind, name, model, pose in self.world.entities()]

    def state(self, kind: str, name: str) -> dict[str, Any]:
        try:
            return dict(self.world.device(kind, name))
        except self._error:
            pass
        try:
            return dict(self.world.sensor(kind, name))
        except self._error:
            return {}

    def command(self, kind: str, name: str, text: str) -> None:
        try:
            self.world.command(kind, name, text)
        except self._error as error:
            raise Rejected(str(error)) from None

    def appear(self, name: str, x: float, y: float, z: float, yaw: float, speed: float, body: str
               ) -> None:
        self._put(name, walker(name, speed, body), (x, y, z, 0.0, 0.0, yaw))

    def settle(self, name: str, place: Place) -> None:
        x, y, z, yaw = place.pose
        self._put(name, figure(name, place.posture), (x, y, z + ABOVE, 0.0, 0.0, yaw))

    def _put(self, name: str, sdf: str, pose: tuple[float, ...]) -> None:
        self.vanish(name)
        try:
            self.world.spawn(sdf, name, pose)
        except self._error as error:
            raise Rejected(str(error)) from None

    def vanish(self, name: str) -> None:
        if name in self.world.models:
            self.world.delete(name)

    def fidget(self, name: str, turn: float) -> None:
        pose, _, _ = self.world.motion(name)
        x, y, z = (float(value) for value in pose[:3])
        self.world.set_state(name, [x, y, z, 0.0, 0.0, yaw_of(*pose[3:]) + turn],
                             [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])

    def body(self, name: str) -> Body:
        pose, _, _ = self.world.motion(name)
        x, y, z = (float(value) for value in pose[:3])
        return Body(x, y, z, yaw_of(*pose[3:]))
