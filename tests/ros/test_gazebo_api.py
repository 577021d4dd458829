"""gazebo_ros's services and topics, each against a closed form or another of them."""
import math
import time
from typing import Any, Iterator

import pytest
from gazebo_msgs.msg import LinkState, LinkStates, ModelState, ModelStates, ODEJointProperties
from gazebo_msgs.msg import PerformanceMetrics
from gazebo_scene import CRATE, SLIDE, Gazebo, at
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3, Wrench
from harness import Angen, Inbox, until
from rospy import Duration, Time

SERVICES = {
    "apply_body_wrench": "ApplyBodyWrench", "apply_joint_effort": "ApplyJointEffort",
    "clear_body_wrenches": "BodyRequest", "clear_joint_forces": "JointRequest",
    "delete_light": "DeleteLight", "delete_model": "DeleteModel",
    "get_joint_properties": "GetJointProperties", "get_light_properties": "GetLightProperties",
    "get_link_properties": "GetLinkProperties", "get_link_state": "GetLinkState",
    "get_model_properties": "GetModelProperties", "get_model_state": "GetModelState",
    "get_physics_properties": "GetPhysicsProperties", "get_world_properties": "GetWorldProperties",
    "set_joint_properties": "SetJointProperties", "set_light_properties": "SetLightProperties",
    "set_link_properties": "SetLinkProperties", "set_link_state": "SetLinkState",
    "set_model_configuration": "SetModelConfiguration", "set_model_state": "SetModelState",
    "set_physics_properties": "SetPhysicsProperties", "spawn_sdf_model": "SpawnModel",
    "spawn_urdf_model": "SpawnModel"}
EMPTY = ("pause_physics", "unpause_physics", "reset_simulation", "reset_world")
TOPICS = {
    "/gazebo/link_states": "gazebo_msgs/LinkStates",
    "/gazebo/model_states": "gazebo_msgs/ModelStates",
    "/gazebo/performance_metrics": "gazebo_msgs/PerformanceMetrics",
    "/gazebo/parameter_descriptions": "dynamic_reconfigure/ConfigDescription",
    "/gazebo/parameter_updates": "dynamic_reconfigure/Config"}


@pytest.fixture(scope="module")
def node(angen: Angen) -> Iterator[Gazebo]:
    gazebo = Gazebo(angen)
    gazebo.pause()
    yield gazebo


@pytest.fixture
def gazebo(node: Gazebo) -> Iterator[Gazebo]:
    """Paused, with a crate and a slide of the test's own."""
    node.spawn("crate", CRATE, at(0, 0, 5))
    node.spawn("slide", SLIDE, at(0, 0, 9))
    yield node
    node.pause()
    for name in ("crate", "slide"):
        node.call("delete_model", model_name=name)


def place(pose: Pose) -> tuple[float, ...]:
    return (pose.position.x, pose.position.y, pose.position.z)


def speed(twist: Twist) -> tuple[float, ...]:
    return (twist.linear.x, twist.linear.y, twist.linear.z)


def spin(twist: Twist) -> tuple[float, ...]:
    return (twist.angular.x, twist.angular.y, twist.angular.z)


def near(expected: tuple[float, ...], tolerance: float = 1e-6) -> Any:
    return pytest.approx(expected, abs=tolerance)


def test_all_services_and_topics_have_gazebo_s_types(node: Gazebo, angen: Angen) -> None:
    import rosservice
    for name, kind in SERVICES.items():
        assert rosservice.get_service_type(f"/gazebo/{name}") == f"gazebo_msgs/{kind}", name
    for name in EMPTY:
        assert rosservice.get_service_type(f"/gazebo/{name}") == "std_srvs/Empty", name
    assert len(SERVICES) + len(EMPTY) == 27
    assert (rosservice.get_service_type("/gazebo/set_parameters")
            == "dynamic_reconfigure/Reconfigure")
    assert TOPICS.items() <= angen.master.topics().items()
    subscribed = {name for name, _ in angen.master.api.getSystemState("/test")[2][1]}
    assert {"/gazebo/set_model_state", "/gazebo/set_link_state"} <= subscribed


def test_a_model_comes_while_time_stands_still_and_goes(node: Gazebo) -> None:
    time_before = node.call("get_world_properties").sim_time
    answer = node.spawn("box", CRATE, at(1, 2, 3))
    assert answer.status_message == "SpawnModel: Successfully spawned entity"
    world = node.call("get_world_properties")
    assert "box" in world.model_names and world.sim_time == time_before
    state = node.call("get_model_state", model_name="box")
    assert place(state.pose) == near((1, 2, 3))
    again = node.ask("spawn_sdf_model", model_name="box", model_xml=CRATE)
    assert not again.success
    assert again.status_message == "SpawnModel: Failure - entity already exists."
    deleted = node.call("delete_model", model_name="box")
    assert deleted.status_message == "DeleteModel: successfully deleted model"
    missing = node.ask("delete_model", model_name="box")
    assert not missing.success and missing.status_message == "DeleteModel: model does not exist"


def test_a_pose_is_in_its_reference_frame_before_the_model_s_own(gazebo: Gazebo) -> None:
    quarter = Quaternion(0, 0, math.sqrt(0.5), math.sqrt(0.5))
    gazebo.call("set_model_state", model_state=ModelState(
        model_name="crate", pose=Pose(Point(1, 1, 5), quarter)))
    xml = CRATE.replace('name="any">', 'name="any"><pose>0 0 0.5 0 0 0</pose>')
    for frame in ("crate", "crate::body", "crate::body::hull"):
        gazebo.spawn("near", xml, at(2, 0, 0), reference_frame=frame)
        state = gazebo.call("get_model_state", model_name="near")
        assert place(state.pose) == near((1, 3, 5.5))
        relative = gazebo.call("get_model_state", model_name="near", relative_entity_name=frame)
        assert place(relative.pose) == near((2, 0, 0.5))
        assert relative.header.frame_id == frame
        gazebo.call("delete_model", model_name="near")
    for frame in ("", "world", "map", "/map"):
        gazebo.spawn("near", CRATE, at(2, 0, 0), reference_frame=frame)
        assert place(gazebo.call("get_model_state", model_name="near",
                                 relative_entity_name=frame).pose) == near((2, 0, 0))
        gazebo.call("delete_model", model_name="near")


def test_a_state_is_read_back_by_all_that_read(gazebo: Gazebo, angen: Angen) -> None:
    twist = Twist(Vector3(0.5, 0, 0), Vector3(0, 0, 0.25))
    done = gazebo.call("set_model_state", model_state=ModelState(
        model_name="crate", pose=Pose(Point(3, 2, 1), Quaternion()), twist=twist))
    assert done.status_message == "SetModelState: set model state done"
    model = gazebo.call("get_model_state", model_name="crate")
    link = gazebo.call("get_link_state", link_name="crate::body").link_state
    for pose, motion in ((model.pose, model.twist), (link.pose, link.twist)):
        assert place(pose) == near((3, 2, 1))
        assert speed(motion) == near((0.5, 0, 0)) and spin(motion) == near((0, 0, 0.25))
    states = angen.wait("/gazebo/model_states", ModelStates, lambda m: "crate" in m.name)
    i = states.name.index("crate")
    assert place(states.pose[i]) == near((3, 2, 1)) and speed(states.twist[i]) == near((0.5, 0, 0))
    links = angen.wait("/gazebo/link_states", LinkStates, lambda m: "crate::body" in m.name)
    i = links.name.index("crate::body")
    assert place(links.pose[i]) == near((3, 2, 1)) and spin(links.twist[i]) == near((0, 0, 0.25))
    gazebo.step(1000)
    assert place(gazebo.call("get_model_state", model_name="crate").pose) == near((3.5, 2, 1), 1e-4)
    first, second = (gazebo.call("get_model_state", model_name="crate").header for _ in range(2))
    assert second.seq == first.seq + 1
    now = gazebo.call("get_world_properties").sim_time
    assert first.stamp.to_sec() == pytest.approx(now, abs=1e-9)


def test_states_in_a_frame_turn_with_it(gazebo: Gazebo) -> None:
    quarter = Quaternion(0, 0, math.sqrt(0.5), math.sqrt(0.5))
    gazebo.spawn("post", CRATE, Pose(Point(1, 1, 1), quarter))
    twist = Twist(Vector3(1, 0, 0), Vector3(0, 1, 0))
    gazebo.call("set_link_state", link_state=LinkState(
        link_name="crate::body", pose=at(2, 0, 0), twist=twist, reference_frame="post::body"))
    state = gazebo.call("get_link_state", link_name="crate::body").link_state
    assert place(state.pose) == near((1, 3, 1)) and speed(state.twist) == near((0, 1, 0))
    assert spin(state.twist) == near((-1, 0, 0))
    same = gazebo.call("get_link_state", link_name="body", reference_frame="post").link_state
    assert same.link_name == "body" and same.reference_frame == "post"
    same = gazebo.call("get_link_state", link_name="crate::body", reference_frame="post").link_state
    assert place(same.pose) == near((2, 0, 0)) and speed(same.twist) == near((1, 0, 0))
    gazebo.call("delete_model", model_name="post")


def test_published_states_are_set(gazebo: Gazebo, angen: Angen) -> None:
    angen.send("/gazebo/set_model_state", ModelState(model_name="crate", pose=at(7, 0, 2)))
    until(lambda: gazebo.call("get_model_state", model_name="crate").pose.position.x == 7.0,
          "the crate is there")
    angen.send("/gazebo/set_link_state", LinkState(link_name="crate::body", pose=at(8, 0, 2)))
    until(lambda: gazebo.call("get_model_state", model_name="crate").pose.position.x == 8.0,
          "the link is there")


def test_a_wrench_gives_force_by_mass_by_time(gazebo: Gazebo) -> None:
    done = gazebo.call("apply_body_wrench", body_name="crate::body", duration=Duration(0.5),
                       wrench=Wrench(Vector3(3, 0, 0), Vector3(0, 0, 0.2)))
    assert done.status_message == ""
    gazebo.step(800)
    twist = gazebo.call("get_model_state", model_name="crate").twist
    assert speed(twist) == near((3 / 2 * 0.5, 0, 0), 1e-9)
    assert spin(twist) == near((0, 0, 0.2 / 0.5 * 0.5), 1e-6)


def test_a_wrench_that_never_ends_is_cleared(gazebo: Gazebo) -> None:
    now = gazebo.call("get_world_properties").sim_time
    gazebo.call("apply_body_wrench", body_name="crate::body", duration=Duration(-1),
                start_time=Time.from_sec(now + 0.1), reference_point=Point(0, 0.1, 0),
                wrench=Wrench(Vector3(0, 0, 2), Vector3()))
    gazebo.step(100)
    assert speed(gazebo.call("get_model_state", model_name="crate").twist) == (0, 0, 0)
    gazebo.step(10)
    twist = gazebo.call("get_model_state", model_name="crate").twist
    assert speed(twist)[2] == pytest.approx(2 / 2 * 0.01)
    assert spin(twist)[0] == pytest.approx(0.1 * 2 / 0.5 * 0.01, rel=1e-3)
    gazebo.ask("clear_body_wrenches", body_name="crate::body")
    gazebo.step(100)
    assert speed(gazebo.call("get_model_state", model_name="crate").twist) == near(speed(twist))


def test_an_effort_accelerates_a_joint(gazebo: Gazebo) -> None:
    done = gazebo.call("apply_joint_effort", joint_name="along", effort=8.0,
                       duration=Duration(0.25))
    assert done.status_message == "ApplyJointEffort: effort set"
    gazebo.step(500)
    joint = gazebo.call("get_joint_properties", joint_name="slide::along")
    assert joint.type == joint.PRISMATIC
    assert joint.rate == near((8 / 4 * 0.25,), 1e-6)
    # v^2 / 2a while it acts, v t after it
    assert joint.position == near((0.5 ** 2 / 4 + 0.5 * 0.25,), 1e-3)
    gazebo.call("apply_joint_effort", joint_name="along", effort=8.0, duration=Duration(-1))
    gazebo.ask("clear_joint_forces", joint_name="along")
    gazebo.step(100)
    assert gazebo.call("get_joint_properties", joint_name="along").rate == near((0.5,), 1e-6)


def test_a_configuration_is_the_joints(gazebo: Gazebo) -> None:
    done = gazebo.call("set_model_configuration", model_name="slide", urdf_param_name="unused",
                       joint_names=["along"], joint_positions=[1.5])
    assert done.status_message == "SetModelConfiguration: success"
    assert gazebo.call("get_joint_properties", joint_name="along").position == near((1.5,))
    car = gazebo.call("get_link_state", link_name="slide::car").link_state
    assert place(car.pose) == near((1.5, 0, 9))
    gazebo.call("set_model_configuration", model_name="slide", joint_names=["along"],
                joint_positions=[10.0])  # its limit is 3
    assert gazebo.call("get_joint_properties", joint_name="along").position == near((3.0,))


def test_a_joint_s_properties_act(gazebo: Gazebo) -> None:
    config = ODEJointProperties(damping=[2.0], hiStop=[0.5], loStop=[-0.5], cfm=[0.1])
    gazebo.call("set_joint_properties", joint_name="slide::along", ode_joint_config=config)
    assert gazebo.call("get_joint_properties", joint_name="along").damping == (2.0,)
    gazebo.call("set_joint_properties", joint_name="slide::along",
                ode_joint_config=ODEJointProperties(fmax=[100.0], vel=[1.0]))
    gazebo.step(200)
    assert gazebo.call("get_joint_properties", joint_name="along").rate == near((1.0,), 1e-3)
    gazebo.step(1000)
    assert gazebo.call("get_joint_properties", joint_name="along").position == near((0.5,), 5e-3)


def test_a_model_s_parts(gazebo: Gazebo) -> None:
    slide = gazebo.call("get_model_properties", model_name="slide")
    assert set(slide.body_names) >= {"rail", "car"} and "along" in slide.joint_names
    assert not slide.is_static and slide.parent_model_name == ""
    crate = gazebo.call("get_model_properties", model_name="crate")
    assert (crate.body_names, crate.geom_names, crate.canonical_body_name) == (
        ["body"], ["hull"], "body")
    assert gazebo.call("get_model_properties", model_name="ground").is_static


def test_another_mass_is_answered_and_accelerated(gazebo: Gazebo) -> None:
    before = gazebo.call("get_link_properties", link_name="crate::body")
    assert (before.mass, before.izz, before.gravity_mode) == (2.0, 0.5, False)
    gazebo.call("set_link_properties", link_name="crate::body", mass=8.0, ixx=1.0, iyy=1.0, izz=2.0,
                ixy=0.0, ixz=0.0, iyz=0.0, gravity_mode=False, com=at(0.1, 0, 0))
    after = gazebo.call("get_link_properties", link_name="crate::body")
    assert (after.mass, after.izz, after.com.position.x) == (8.0, 2.0, 0.1)
    gazebo.call("apply_body_wrench", body_name="crate::body", duration=Duration(0.5),
                wrench=Wrench(Vector3(0, 4, 0), Vector3(0, 0, 0.5)))
    gazebo.step(600)
    twist = gazebo.call("get_model_state", model_name="crate").twist
    assert spin(twist)[2] == pytest.approx(0.5 / 2.0 * 0.5, rel=1e-6)
    gravity = dict(link_name="crate::body", mass=8.0, ixx=1.0, iyy=1.0, izz=2.0, ixy=0.0, ixz=0.0,
                   iyz=0.0, com=at())
    gazebo.call("set_model_state", model_state=ModelState(model_name="crate", pose=at(0, 0, 5)))
    gazebo.call("set_link_properties", gravity_mode=True, **gravity)
    gazebo.step(500)
    fallen = gazebo.call("get_model_state", model_name="crate")
    assert fallen.twist.linear.z == pytest.approx(-9.8 * 0.5, rel=1e-6)


def test_physics_is_answered_as_it_was_set(gazebo: Gazebo) -> None:
    first = gazebo.call("get_physics_properties")
    assert (first.time_step, first.pause, first.gravity.z) == (0.001, True, -9.8)
    assert first.max_update_rate == pytest.approx(1000.0)
    given = {"time_step": 0.001, "max_update_rate": 500.0, "gravity": Vector3(0, 0, -1.62)}
    ode = first.ode_config
    ode.sor_pgs_iters, ode.sor_pgs_precon_iters, ode.sor_pgs_w, ode.max_contacts = 60, 3, 1.1, 9
    done = gazebo.call("set_physics_properties", ode_config=ode, **given)
    assert done.status_message == "physics engine updated"
    after = gazebo.call("get_physics_properties")
    assert after.ode_config == ode and after.gravity.z == -1.62
    assert after.max_update_rate == pytest.approx(500.0)
    crate = CRATE.replace("<gravity>0</gravity>", "")
    gazebo.spawn("falls", crate, at(0, 3, 5))
    gazebo.step(1000)
    fallen = gazebo.call("get_model_state", model_name="falls")
    assert fallen.twist.linear.z == pytest.approx(-1.62, rel=1e-6)
    gazebo.call("delete_model", model_name="falls")
    kept = gazebo.call("set_physics_properties", ode_config=ode, **{**given, "time_step": 0.01})
    assert "time_step stays the 0.001 s" in kept.status_message
    assert gazebo.call("get_physics_properties").time_step == 0.001
    # A client that sets gravity alone leaves the rest at 0.
    gazebo.call("set_physics_properties", gravity=Vector3(0, 0, -1.0))
    assert gazebo.call("get_physics_properties").gravity.z == -1.0
    gazebo.call("set_physics_properties", time_step=0.001, max_update_rate=1000.0,
                gravity=Vector3(0, 0, -9.8), ode_config=first.ode_config)


def test_the_update_rate_is_the_rate_of_time(gazebo: Gazebo) -> None:
    now = gazebo.call("get_physics_properties")
    fields = {"time_step": 0.001, "gravity": now.gravity, "ode_config": now.ode_config}
    gazebo.call("set_physics_properties", max_update_rate=0.0, **fields)  # as fast as possible
    gazebo.unpause()
    start, wall = gazebo.call("get_world_properties").sim_time, time.monotonic()
    until(lambda: gazebo.call("get_world_properties").sim_time - start > 3 * (
        time.monotonic() - wall) + 1, "time is faster than the wall's")
    gazebo.pause()
    gazebo.call("set_physics_properties", max_update_rate=1000.0, **fields)


def test_unknown_joints_of_a_configuration_are_passed_over(gazebo: Gazebo) -> None:
    # Names may be scoped, as in Gazebo.
    for names, positions in ((["none", "along"], [0.5, 0.25]), (["slide::along"], [0.75])):
        done = gazebo.call("set_model_configuration", model_name="slide", joint_names=names,
                           joint_positions=positions)
        assert done.status_message == "SetModelConfiguration: success"
        joint = gazebo.call("get_joint_properties", joint_name="slide::along")
        assert joint.position == near(positions[-1:])


def test_topics_have_the_rate_that_was_set(gazebo: Gazebo) -> None:
    gazebo.unpause()
    with Inbox("/gazebo/model_states", ModelStates) as inbox:
        until(lambda: inbox.messages, "a first message")
        start, count = gazebo.call("get_world_properties").sim_time, len(inbox.messages)
        until(lambda: len(inbox.messages) >= count + 60, "60 messages")
        taken = gazebo.call("get_world_properties").sim_time - start
    assert taken == pytest.approx(60 / 30.0, abs=0.3)


def test_performance_is_measured(gazebo: Gazebo, angen: Angen) -> None:
    gazebo.unpause()
    metrics = angen.wait("/gazebo/performance_metrics", PerformanceMetrics,
                         lambda m: m.real_time_factor > 0.1 and len(m.sensors) > 0)
    pirs = [s for s in metrics.sensors if s.name.startswith("eye::")]
    assert pirs, [s.name for s in metrics.sensors]
    assert pirs[0].sim_update_rate == pytest.approx(10.0, abs=2.0) and pirs[0].fps == -1.0


@pytest.mark.parametrize("kind, library, fps", [
    ("camera", "libgazebo_ros_camera.so", 0.0),
    ("depth", "libgazebo_ros_openni_kinect.so", 0.0),
    ("depth", "libgazebo_ros_depth_camera.so", 0.0),
    ("gpu_ray", "libgazebo_ros_gpu_laser.so", -1.0)])
def test_sensors_with_images_have_frames_per_second(gazebo: Gazebo, angen: Angen, kind: str,
                                                    library: str, fps: float) -> None:
    """All of these sample on demand: without a subscriber a camera makes 0 frames."""
    gazebo.spawn("lens", f"""<sdf version="1.6"><model name="lens"><link name="body">
      <sensor name="lens" type="{kind}"><plugin name="lens" filename="{library}"/></sensor>
      </link></model></sdf>""")
    gazebo.unpause()
    metrics = angen.wait("/gazebo/performance_metrics", PerformanceMetrics,
                         lambda m: any(s.name == "lens::body::lens" for s in m.sensors))
    gazebo.call("delete_model", model_name="lens")
    assert [s.fps for s in metrics.sensors if s.name == "lens::body::lens"] == [fps]


def test_a_reset_brings_back_what_moved_and_ends_what_pushes(gazebo: Gazebo, angen: Angen) -> None:
    from std_srvs.srv import Empty
    gazebo.call("apply_body_wrench", body_name="crate::body", duration=Duration(-1),
                wrench=Wrench(Vector3(3, 0, 0), Vector3()))
    gazebo.step(100)
    angen.call("/gazebo/reset_world", Empty)
    gazebo.step(50)
    state = gazebo.call("get_model_state", model_name="crate")
    assert place(state.pose) == near((0, 0, 5)) and speed(state.twist) == near((0, 0, 0))
