"""Clients of gazebo_ros spawn lights, read errors, and set parameters by dynamic_reconfigure."""
import math
from typing import Any

import pytest
from angen_msgs.msg import LampState
from angen_msgs.srv import List, SendCommand
from dynamic_reconfigure.msg import (BoolParameter, Config, ConfigDescription, DoubleParameter,
                                     StrParameter)
from dynamic_reconfigure.srv import Reconfigure
from gazebo_msgs.msg import ModelState
from gazebo_scene import LAMP, SLIDE, Gazebo, at
from geometry_msgs.msg import Vector3
from harness import Angen
from rospy import ServiceException
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
    angen.command("bulb", "Dim 30")
    gazebo.step(50)
    state = angen.wait("/angen/lamp/bulb", LampState)
    assert (state.level, state.luminous_flux) == (30.0, 240.0)  # 800 lm at its brightest color
    bulb, = (e for e in angen.call("/angen/list", List, kind="lamp").entities if e.name == "bulb")
    assert (bulb.topic, bulb.model, bulb.pose.position.z) == ("/angen/lamp/bulb", "", 2.0)
    gazebo.call("delete_light", light_name="bulb")
    assert not angen.call("/angen/command", SendCommand, target="bulb", text="On").success


def test_parameters_of_dynamic_reconfigure(gazebo: Gazebo, angen: Angen) -> None:
    from dynamic_reconfigure.client import Client
    described = angen.wait("/gazebo/parameter_descriptions", ConfigDescription)
    names = [p.name for p in described.groups[0].parameters]
    assert len(names) == 15 and names[0] == "time_step" and "max_contacts" in names
    client = Client("/gazebo", timeout=20)
    try:
        changed = client.update_configuration({"gravity_x": 0.5, "sor_pgs_w": 1.25})
        assert changed["gravity_x"] == 0.5 and changed["sor_pgs_w"] == 1.25
        now = gazebo.call("get_physics_properties")
        assert now.gravity.x == 0.5 and now.ode_config.sor_pgs_w == 1.25
        update = angen.wait("/gazebo/parameter_updates", Config)
        assert {d.name: d.value for d in update.doubles}["gravity_x"] == 0.5
        client.update_configuration({"gravity_x": 0.0})
    finally:
        client.close()
    assert gazebo.call("get_physics_properties").gravity.x == 0.0


@pytest.mark.parametrize("nonsense, reason", [
    ({"doubles": [DoubleParameter("gravity_w", 1.0)]},
     "there is no parameter 'gravity_w' of type double"),
    ({"bools": [BoolParameter("gravity_x", True)]},
     "there is no parameter 'gravity_x' of type bool"),
    ({"doubles": [DoubleParameter("gravity_y", 1.0), DoubleParameter("gravity_x", math.nan)]},
     "the parameter gravity_x is not a number"),
    ({"strs": [StrParameter("gravity_x", "up")]}, "there is no parameter 'gravity_x'")])
def test_parameters_that_make_no_sense_are_rejected_with_the_reason(
        gazebo: Gazebo, angen: Angen, nonsense: dict[str, Any], reason: str) -> None:
    before = gazebo.call("get_physics_properties")
    with pytest.raises(ServiceException, match=reason):
        angen.call("/gazebo/set_parameters", Reconfigure, config=Config(**nonsense))
    assert gazebo.call("get_physics_properties") == before
