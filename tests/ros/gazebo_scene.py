"""Models that the tests of gazebo_ros's services spawn, and short ways to call them."""
from typing import Any

import gazebo_msgs.srv as srv
from angen_msgs.srv import Step
from geometry_msgs.msg import Pose
from harness import Angen
from std_srvs.srv import Empty

# Free in space: only applied forces act on it. Its center of mass is its origin.
CRATE = """<sdf version="1.6"><model name="any"><link name="body"><gravity>0</gravity>
  <inertial><mass>2</mass><inertia><ixx>0.5</ixx><iyy>0.5</iyy><izz>0.5</izz></inertia></inertial>
  <collision name="hull"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
  </link></model></sdf>"""
SLIDE = """<robot name="any"><link name="rail"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="car"><inertial><mass value="4"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="world"/><joint name="fix" type="fixed"><parent link="world"/><child link="rail"/>
  </joint><joint name="along" type="prismatic"><parent link="rail"/><child link="car"/>
  <axis xyz="1 0 0"/><limit lower="-3" upper="3" effort="1000" velocity="100"/></joint></robot>"""
LAMP = """<sdf version="1.6"><light name="any" type="point"><pose>0 0 2 0 0 0</pose>
  <diffuse>0.5 0.25 1 1</diffuse><attenuation><range>20</range><constant>0.3</constant>
  <linear>0.2</linear><quadratic>0.1</quadratic></attenuation></light></sdf>"""


def at(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Pose:
    pose = Pose()
    pose.position.x, pose.position.y, pose.position.z = x, y, z
    return pose


class Gazebo:
    """The services by their names under /gazebo."""

    def __init__(self, angen: Angen) -> None:
        self._angen = angen

    def ask(self, name: str, **fields: Any) -> Any:
        """Call, whatever the answer is."""
        kind = "".join(word.capitalize() for word in name.split("_"))
        kind = {"SpawnSdfModel": "SpawnModel", "SpawnUrdfModel": "SpawnModel",
                "ClearBodyWrenches": "BodyRequest",
                "ClearJointForces": "JointRequest"}.get(kind, kind)
        return self._angen.call(f"/gazebo/{name}", getattr(srv, kind), **fields)

    def call(self, name: str, **fields: Any) -> Any:
        """Call a service that must succeed."""
        answer = self.ask(name, **fields)
        assert answer.success, answer.status_message
        return answer

    def spawn(self, name: str, xml: str, pose: Pose | None = None, **fields: Any) -> Any:
        kind = "spawn_urdf_model" if "<robot" in xml else "spawn_sdf_model"
        return self.call(kind, model_name=name, model_xml=xml, initial_pose=pose or Pose(),
                         **fields)

    def pause(self) -> None:
        self._angen.call("/gazebo/pause_physics", Empty)

    def unpause(self) -> None:
        self._angen.call("/gazebo/unpause_physics", Empty)

    def step(self, ticks: int) -> None:
        answer = self._angen.call("/angen/step", Step, ticks=ticks)
        assert answer.success, answer.message
