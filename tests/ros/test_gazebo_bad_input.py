"""No request to a service of gazebo_ros that makes no sense changes anything or ends the node."""
import copy
import math
from typing import Any, Iterator

import pytest
from gazebo_msgs.msg import LinkState, ModelState, ODEJointProperties
from gazebo_msgs.srv import SetPhysicsPropertiesRequest
from gazebo_scene import CRATE, LAMP, SLIDE, Gazebo, at
from harness import Angen, RawText
from rospy import Duration

# Numbers that are kept for the answer alone, or normalized: any that is finite will do.
FREE = ("orientation", "erp", "cfm", "stop_", "fudge_factor", "specular", "diffuse.a",
        "attenuation", "sor_pgs_w", "rms")
XML = CRATE.replace("any", "other")


@pytest.fixture(scope="module")
def gazebo(angen: Angen) -> Iterator[Gazebo]:
    gazebo = Gazebo(angen)
    gazebo.pause()
    gazebo.spawn("crate", CRATE, at(0, 0, 5))
    gazebo.spawn("slide", SLIDE, at(0, 0, 9))
    gazebo.spawn("lamp", LAMP)
    yield gazebo


def requests(gazebo: Gazebo) -> dict[str, dict[str, Any]]:
    """One good request of each service that has numbers."""
    now = gazebo.call("get_physics_properties")
    mass = gazebo.call("get_link_properties", link_name="crate::body")
    wrench = dict(body_name="crate::body", duration=Duration(0.01))
    joint = ODEJointProperties(*[[0.1] for _ in ODEJointProperties.__slots__])
    request = SetPhysicsPropertiesRequest(
        now.time_step, now.max_update_rate, now.gravity, now.ode_config)
    return {
        "spawn_sdf_model": dict(model_name="other", model_xml=XML),
        "spawn_urdf_model": dict(model_name="other", model_xml=SLIDE),
        "set_model_state": dict(model_state=ModelState(model_name="crate")),
        "set_link_state": dict(link_state=LinkState(link_name="crate::body")),
        "set_model_configuration": dict(
            model_name="slide", joint_names=["along"], joint_positions=[0.0]),
        "set_link_properties": dict(
            link_name="crate::body", mass=mass.mass, com=mass.com, ixx=mass.ixx, iyy=mass.iyy,
            izz=mass.izz, ixy=0.0, ixz=0.0, iyz=0.0, gravity_mode=False),
        "set_joint_properties": dict(joint_name="slide::along", ode_joint_config=joint),
        "set_light_properties": dict(light_name="lamp"),
        "apply_body_wrench": wrench,
        "apply_joint_effort": dict(joint_name="slide::along", effort=1.0, duration=Duration(0.01)),
        "set_physics_properties": {
            name: getattr(request, name) for name in request.__slots__},
    }


def with_number(value: Any, number: float, path: str = "") -> Iterator[tuple[str, Any]]:
    """The value once for each number in it, that number replaced."""
    if isinstance(value, float):
        yield path, number
    elif isinstance(value, list):
        for i, item in enumerate(value):
            for where, changed in with_number(item, number, path):
                yield where, [*value[:i], changed, *value[i + 1:]]
    elif hasattr(value, "__slots__") and hasattr(value, "_type"):
        for slot in value.__slots__:
            for where, changed in with_number(getattr(value, slot), number, f"{path}.{slot}"):
                other = copy.deepcopy(value)
                setattr(other, slot, changed)
                yield where, other


def changed_requests(fields: dict[str, Any], kind: type, number: float
                     ) -> Iterator[tuple[str, dict[str, Any]]]:
    full = kind(**fields)
    for slot in full.__slots__:
        for where, changed in with_number(getattr(full, slot), number, slot):
            yield where, {**fields, slot: changed}


def state(gazebo: Gazebo) -> list[str]:
    """All that a service could have changed."""
    answers = [gazebo.call(*[name], **fields) for name, fields in (
        ("get_world_properties", {}), ("get_physics_properties", {}),
        ("get_link_state", dict(link_name="crate::body")),
        ("get_link_state", dict(link_name="slide::car")),
        ("get_link_properties", dict(link_name="crate::body")),
        ("get_joint_properties", dict(joint_name="slide::along")),
        ("get_light_properties", dict(light_name="lamp")),
        ("get_model_properties", dict(model_name="crate")))]
    return [str(answer) for answer in answers]


def rejected(gazebo: Gazebo, name: str, fields: dict[str, Any]) -> str:
    answer = gazebo.ask(name, **fields)
    assert answer.success is False and answer.status_message, (name, fields, answer)
    return str(answer.status_message)


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf, 1e30], ids=str)
def test_a_number_that_makes_no_sense_is_rejected(gazebo: Gazebo, number: float) -> None:
    import gazebo_msgs.srv as srv
    before = state(gazebo)
    tried = 0
    for name, fields in requests(gazebo).items():
        kind = "SpawnModel" if name.startswith("spawn") else "".join(
            word.capitalize() for word in name.split("_"))
        for where, wrong in changed_requests(fields, getattr(srv, f"{kind}Request"), number):
            free = any(part in where for part in FREE)
            if math.isfinite(number) and free and name != "set_physics_properties":
                continue
            if math.isfinite(number) and ("sor_pgs_w" in where or "rms" in where):
                continue
            rejected(gazebo, name, wrong)
            tried += 1
    assert tried > 60
    assert state(gazebo) == before


NAMES = {
    "spawn_sdf_model": ("reference_frame", dict(model_name="other", model_xml=XML)),
    "spawn_urdf_model": ("reference_frame", dict(model_name="other", model_xml=SLIDE)),
    "delete_model": ("model_name", {}),
    "delete_light": ("light_name", {}),
    "get_model_state": ("model_name", {}),
    "get_model_state ": ("relative_entity_name", dict(model_name="crate")),
    "get_model_properties": ("model_name", {}),
    "get_link_state": ("link_name", {}),
    "get_link_state ": ("reference_frame", dict(link_name="crate::body")),
    "get_link_properties": ("link_name", {}),
    "get_joint_properties": ("joint_name", {}),
    "get_light_properties": ("light_name", {}),
    "set_model_state": ("model_state", {}),
    "set_link_state": ("link_state", {}),
    "set_model_configuration": ("model_name", {}),
    "set_link_properties": ("link_name", {}),
    "set_joint_properties": ("joint_name", {}),
    "set_light_properties": ("light_name", {}),
    "apply_body_wrench": ("body_name", {}),
    "apply_body_wrench ": ("reference_frame", dict(body_name="crate::body")),
    "apply_joint_effort": ("joint_name", {}),
}


@pytest.mark.parametrize("name", NAMES)
def test_an_unknown_name_is_rejected(gazebo: Gazebo, name: str) -> None:
    field, fields = NAMES[name]
    before = state(gazebo)
    unknown = ["nobody", "crate::nobody", "crate::", "::", "base_footprint ", "x" * 1_000_000,
               RawText(b"\xff\xfe")]
    frames = [*unknown, "odom", "base_link/../x"]
    for value in frames if "frame" in field or "relative" in field else ["", *unknown]:
        states = {"model_state": lambda: ModelState(model_name=value),
                  "link_state": lambda: LinkState(link_name=value)}
        given = states[field]() if field in states else value
        message = rejected(gazebo, name.strip(), {**fields, field: given})
        assert len(message) <= 11_000
    assert state(gazebo) == before


@pytest.mark.parametrize("kind,state_of", [("set_model_state", ModelState),
                                           ("set_link_state", LinkState)])
def test_a_state_in_an_unknown_frame_is_rejected(gazebo: Gazebo, kind: str, state_of: type) -> None:
    before = state(gazebo)
    field = kind.removeprefix("set_")
    target = dict(model_name="crate") if state_of is ModelState else dict(link_name="crate::body")
    for frame in ("odom", "nobody", "crate::nobody"):
        rejected(gazebo, kind, {field: state_of(reference_frame=frame, **target)})
    assert state(gazebo) == before


TEXTS = {
    "empty": "",
    "blank": " \n",
    "no XML": "hello",
    "unclosed": "<robot name='r'><link name='l'>",
    "unclosed comment": "<!-- <robot name='r'/>",
    "another root": "<launch/>",
    "no link": "<robot name='r'/>",
    "10 MB of text": "x" * 10_000_000,
    "10 MB of elements": "<robot name='r'>" + "<link name='l'/>" * 650_000 + "</robot>",
    "10 MB deep": "<robot>" * 1_400_000,
    "10 MB of a name": f"<robot name='{'r' * 10_000_000}'><link name=''/></robot>",
    "no numbers": "<sdf version='1.6'><model name='m'><pose>nan 0 0 0 0 0</pose><link name='l'/>"
                  "</model></sdf>",
    "not UTF-8": RawText(b"<robot name='\xff'/>"),
    "entities": "<!DOCTYPE r [<!ENTITY a 'aaaa'>]><robot name='&a;'/>",
    "two models": "<sdf version='1.6'><model name='a'><link name='l'/></model>"
                  "<model name='b'><link name='l'/></model></sdf>",
}


@pytest.mark.parametrize("text", TEXTS)
@pytest.mark.parametrize("service", ["spawn_urdf_model", "spawn_sdf_model"])
def test_a_text_that_is_no_model_is_rejected(gazebo: Gazebo, service: str, text: str) -> None:
    before = state(gazebo)
    message = rejected(gazebo, service, dict(model_name="other", model_xml=TEXTS[text]))
    assert len(message) <= 11_000
    assert state(gazebo) == before


def test_lists_of_different_lengths_are_rejected(gazebo: Gazebo) -> None:
    before = state(gazebo)
    message = rejected(gazebo, "set_model_configuration", dict(
        model_name="slide", joint_names=["along"], joint_positions=[]))
    assert message == ("SetModelConfiguration: joint name and position list have different lengths")
    gazebo.call("set_model_configuration", model_name="slide", joint_names=["across"],
                joint_positions=[0.0])    # as in Gazebo, a name that it lacks changes nothing
    assert state(gazebo) == before


def test_clearing_what_does_not_exist_is_no_failure(gazebo: Gazebo) -> None:
    gazebo.ask("clear_body_wrenches", body_name="nobody::body")
    gazebo.ask("clear_joint_forces", joint_name="nobody::joint")


def test_published_states_that_make_no_sense_change_nothing(gazebo: Gazebo, angen: Angen) -> None:
    before = state(gazebo)
    for name, x in (("nobody", 0.0), ("crate", math.nan), ("crate", 1e30)):
        message = ModelState(model_name=name)
        message.pose.position.x = x
        angen.send("/gazebo/set_model_state", message)
        other = LinkState(link_name=f"{name}::body")
        other.twist.linear.x = x
        angen.send("/gazebo/set_link_state", other)
    assert state(gazebo)[:2] == before[:2]
    assert "nan" not in "".join(state(gazebo))
