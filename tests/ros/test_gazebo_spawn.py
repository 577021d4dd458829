"""Clients of gazebo_ros's services spawn lights and read errors."""

from __future__ import annotations

import pytest
from angen_msgs.msg import LampState
from angen_msgs.srv import List, SendCommand
from gazebo_msgs.msg import ModelState
from gazebo_scene import LAMP, SLIDE, Gazebo, at
from geometry_msgs.msg import Vector3
from harness import Angen
from std_msgs.msg import ColorRGBA


@pytest.fixture(scope="module")
def gazebo(angen: Angen) -> Gazebo:
    """Paused."""
    started = Gazebo(angen)
    started.pause()
    return started


def test_texts_of_clients(gazebo: Gazebo) -> None:
    for name, fields, text in (
            ("get_model_state", dict(model_name="x"), "GetModelState: model does not exist"),
            ("set_model_state", dict(model_state=ModelState(model_name="x")),
             "SetModelState: model does not exist"),
            ("get_link_state", dict(link_name="x"),
             "GetLinkState: link not found, did you forget to scope the link by model name?"),
            ("get_joint_properties", dict(joint_name="x"), "GetJointProperties: joint not found"),
            ("apply_body_wrench", dict(body_name="x"), "ApplyBodyWrench: body does not exist"),
            ("apply_joint_effort", dict(joint_name="x"), "ApplyJointEffort: joint not found"),
            ("get_light_properties", dict(light_name="x"),
             "getLightProperties: Requested light x not found!")):
        answer = gazebo.ask(name, **fields)
        assert (answer.success, answer.status_message) == (False, text)


def test_lights_come_change_and_go(gazebo: Gazebo) -> None:
    gazebo.spawn("bulb", LAMP, at(1, 0, 0))
    light = gazebo.call("get_light_properties", light_name="bulb")
    assert (light.diffuse.r, light.diffuse.g) == (0.5, 0.25)
    assert (light.attenuation_constant, light.attenuation_linear,
            light.attenuation_quadratic) == (0.3, 0.2, 0.1)
    done = gazebo.call("set_light_properties", light_name="bulb",
                       diffuse=ColorRGBA(0.25, 0.5, 0.75, 0.5), attenuation_linear=0.7,
                       pose=at(0, 0, 3), direction=Vector3(0, 0, -1))
    assert done.status_message == ""
    light = gazebo.call("get_light_properties", light_name="bulb")
    assert (light.diffuse.b, light.diffuse.a, light.attenuation_linear) == (0.75, 0.5, 0.7)
    again = gazebo.ask("spawn_sdf_model", model_name="bulb", model_xml=LAMP)
    assert again.status_message == "SpawnModel: Failure - entity already exists."
    deleted = gazebo.call("delete_light", light_name="bulb")
    assert deleted.status_message == "DeleteLight: bulb successfully deleted"
    kept = gazebo.ask("delete_light", light_name="kitchen_lamp0::bulb")
    assert not kept.success and "is a part of model" in kept.status_message


def test_a_file_with_a_light_alone_is_spawned_as_one(gazebo: Gazebo) -> None:
    gazebo.spawn("sun2", '<sdf version="1.6"><world name="default"><include><uri>model://sun</uri>'
                         '</include></world></sdf>')
    assert gazebo.call("get_light_properties", light_name="sun2").diffuse.r > 0
    gazebo.call("delete_light", light_name="sun2")


def test_a_urdf_of_an_unknown_package_is_not_spawned(gazebo: Gazebo) -> None:
    xml = SLIDE.replace('<link name="car">', '<link name="car"><visual><geometry><mesh filename='
                        '"package://no_such_package/a.dae"/></geometry></visual>')
    answer = gazebo.ask("spawn_urdf_model", model_name="slide2", model_xml=xml)
    assert (answer.success, answer.status_message) == (
        False, "urdf reference package name does not exist: no_such_package")


def test_lines_of_a_namespaced_robot_are_those_of_its_text(gazebo: Gazebo) -> None:
    xml = ('<sdf version="1.6">\n<model name="m">\n'
           '<plugin name="p" filename="libgazebo_ros_p3d.so"/>\n\n'
           '<link name="l">\n<pose>x 0 0 0 0 0</pose></link></model></sdf>')
    answer = gazebo.ask("spawn_sdf_model", model_name="m", model_xml=xml, robot_namespace="/ns")
    assert answer.success and "\nwarning: (text):6: <pose> " in answer.status_message
    gazebo.call("delete_model", model_name="m")


def test_a_spawned_light_is_a_lamp(gazebo: Gazebo, angen: Angen) -> None:
    gazebo.spawn("bulb", LAMP, at(1, 0, 0))
    assert angen.call("/angen/command", SendCommand, target="bulb", text="Dim 30").success
    gazebo.step(50)
    state = angen.wait("/angen/lamp/bulb", LampState)
    assert (state.level, state.luminous_flux) == (30.0, 240.0)  # 800 lm at its brightest color
    bulb, = (e for e in angen.call("/angen/list", List, kind="lamp").entities if e.name == "bulb")
    assert (bulb.topic, bulb.model, bulb.pose.position.z) == ("/angen/lamp/bulb", "", 2.0)
    gazebo.call("delete_light", light_name="bulb")
    assert not angen.call("/angen/command", SendCommand, target="bulb", text="On").success
