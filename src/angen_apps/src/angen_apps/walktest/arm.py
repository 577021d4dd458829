"""The arm of a walk test's minor motion: a warm box that turns about its elbow on command."""
import math
from functools import cache
from typing import Any, Mapping

from angen_tools.common.catalog import angen_module

ARM_LIBRARY = 'walktest_arm.py'
TORQUE = 50.0  # N m, more than enough
MASS = 1.0     # kg


@cache
def register_arm() -> None:
    """Makes the arm a plug-in of this process."""
    angen = angen_module()
    device: Any = angen.Device

    class Arm(device):
        """Turns at the commanded rate, rad/s."""

        @staticmethod
        def serves(model: str, joints: list[str], lights: list[str]) -> bool:
            return 'elbow' in joints

        def configure(self, params: Any, wiring: Any) -> None:
            self.joint = wiring.joint('elbow')
            self.rate: float | None = None

        def command(self, text: str, values: list[float], view: Any) -> None:
            self.rate, = values

        def update(self, view: Any, outputs: Any) -> None:
            if self.rate is not None:
                outputs.motor(self.joint, self.rate, TORQUE)
                self.rate = None

    angen.register(ARM_LIBRARY, ARM_LIBRARY.removesuffix('.py'), Arm)


def arm_model(test: Mapping[str, Any], place: tuple[float, float]) -> str:
    """The arm as SDF, its elbow at the origin; it swings evenly about the line to the detector."""
    width, height, length = test['size']
    moment = MASS / 12 * length ** 2
    towards = math.atan2(-place[1], -place[0]) - test['turn'] / 2
    box = f'<geometry><box><size>{length} {width} {height}</size></box></geometry>'
    at = f'<pose>{length / 2} 0 0 0 0 0</pose>'
    return f'''<sdf version="1.6"><model name="arm">
  <link name="arm"><pose>0 0 0 0 0 {towards}</pose><gravity>false</gravity>
    <inertial>{at}<mass>{MASS}</mass><inertia><ixx>{moment}</ixx><iyy>{moment}</iyy>
      <izz>{moment}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
    <collision name="arm">{at}{box}</collision>
    <visual name="arm">{at}{box}<plugin name="gz::sim::systems::Thermal"
      filename="gz-sim-thermal-system"><temperature>{test["temperature"]}</temperature></plugin>
    </visual></link>
  <joint name="elbow" type="revolute"><parent>world</parent><child>arm</child>
    <axis><xyz>0 0 1</xyz><limit><lower>0</lower><upper>{test["turn"]}</upper></limit></axis>
  </joint>
  <plugin name="arm" filename="{ARM_LIBRARY}"/></model></sdf>'''
