"""Lamp, sensors and robot."""
from math import pi, radians
from pathlib import Path
from typing import Sequence

from lxml import etree

from angen_models import urdf
from angen_models.sdf import (Part, add, add_joint, add_link, add_plugin, add_pose, add_thing,
                              new_model, numbers, spanned, write_model)

LIGHT_DROP = 0.35       # the light hangs this far under the ceiling
SOIL = 8.0              # l, in the pot of models/plant
PROBE_NOISE = 0.3       # %


def write_lamp(models: Path) -> None:
    """Writes models/ceiling_lamp: origin at the ceiling; no collision, so nothing dims it."""
    root, model = new_model("ceiling_lamp", static=True)
    parts = [
        spanned("rose", (-0.05, -0.05, -0.02), (0.05, 0.05, 0.0), collide=False),
        spanned("cord", (-0.004, -0.004, -0.26), (0.004, 0.004, -0.02), material="Gazebo/Black",
                collide=False),
        Part("shade", mesh="model://ceiling_lamp/meshes/shade.dae", material=None),
        Part("marker", (0.035,), (0, 0, -LIGHT_DROP), material=(1.0, 0.95, 0.8), collide=False,
             emissive=True),
    ]
    link = add_link(model, "lamp", parts, moves=False)
    light = add(link, "light", name="bulb", type="point")
    add_pose(light, (0, 0, -LIGHT_DROP))
    add(light, "cast_shadows", "true")
    add(light, "diffuse", "1 0.95 0.85 1")
    attenuation = add(light, "attenuation")
    add(attenuation, "range", 20)
    add(light, "direction", "0 0 -1")
    add_plugin(model, "lamp_controller", "libros_plugin.so", luminous_flux=800, level=0)
    add_thing(model, "lamp")
    write_model(root, models, "Ceiling lamp",
                "A point light of 800 lm in a shade, off at the start. Served by libros_plugin.so.")


def add_ray(sensor: etree._Element, horizontal: tuple[int, float], vertical: tuple[int, float],
            reach: tuple[float, float], stddev: float) -> None:
    """Appends <ray>; each scan is (samples, half angle in rad); reach is min, max in m."""
    ray = add(sensor, "ray")
    scan = add(ray, "scan")
    for tag, (samples, half) in (("horizontal", horizontal), ("vertical", vertical)):
        axis = add(scan, tag)
        add(axis, "samples", samples)
        add(axis, "resolution", 1)
        add(axis, "min_angle", round(-half, 6))
        add(axis, "max_angle", round(half, 6))
    limits = add(ray, "range")
    add(limits, "min", reach[0])
    add(limits, "max", reach[1])
    noise = add(ray, "noise")
    add(noise, "type", "gaussian")
    add(noise, "mean", 0)
    add(noise, "stddev", stddev)


def add_sensor(link: etree._Element, name: str, kind: str, rate: float) -> etree._Element:
    """Appends <sensor> of an SDF type; rate in Hz."""
    sensor = add(link, "sensor", name=name, type=kind)
    add(sensor, "always_on", "true")
    add(sensor, "update_rate", rate)
    return sensor


def write_static(models: Path, name: str, title: str, text: str, link: str, parts: Sequence[Part],
                 library: str, plugin: str = "", sensor: tuple[str, float] | None = None,
                 thing: str = "", **values: object) -> None:
    """Writes models/<name>: a static model of one link, with one plug-in; with a `sensor` (name,
    rate in Hz) that has it."""
    root, model = new_model(name, static=True)
    body = add_link(model, link, parts, moves=False)
    add_plugin(add_sensor(body, sensor[0], "custom", sensor[1]) if sensor else model,
               plugin or name, library, **values)
    if thing:
        add_thing(model, thing)
    write_model(root, models, title, f"{text} Served by {library}.")


def _new_pir(name: str) -> tuple[etree._Element, etree._Element]:
    """The root of a PIR's model, and its sensor; x looks into the room."""
    root, model = new_model(name, static=True)
    parts = [
        spanned("housing", (-0.05, -0.035, -0.05), (-0.01, 0.035, 0.05), collide=False),
        Part("lens", (0.022,), (-0.005, 0, 0), material=(0.93, 0.93, 0.9), collide=False),
    ]
    sensor = add_sensor(add_link(model, "pir", parts, moves=False), "pir", "ray", 10)
    add(sensor, "visualize", "true")
    return root, sensor


def write_pir(models: Path, name: str, nods: bool) -> None:
    """Writes a PIR: 16 x 3 rays, 100 x 40 degrees, 6 m, 10 Hz."""
    root, sensor = _new_pir(name)
    add_ray(sensor, (16, radians(50)), (3, radians(20)), (0.02, 6.0), 0.01)
    values = {"threshold": 0.1}
    if nods:
        values.update(nod_amplitude=0.35, nod_period=4.0)
    add_plugin(sensor, "pir_controller", "libpir_controller.so", **values)
    title, how = ("Nodding PIR", ", nods by 0.35 rad in 4 s") if nods else ("PIR", "")
    write_model(root, models, title,
                f"Motion detector, 6 m, 100 x 40 degrees, 10 Hz{how}. "
                "Served by libpir_controller.so.")


def write_pyroelectric(models: Path) -> None:
    """Writes models/pir_pyroelectric, for a wall at 2.2 m, and two PIRs as they are sold."""
    _write_heat_pir(
        models, "pir_pyroelectric", "Pyroelectric PIR", 52.5,
        "Motion detector by heat behind a wide-angle Fresnel lens, 12 m, 105 degrees, for a wall "
        "at 2.2 m; warm already when the world starts.", lens="area", warm_up=0)
    # The readme of the CASAS data sets (UCI): off 1.25 s after motion ends; a circle of 3 ft.
    _write_heat_pir(
        models, "pir_casas", "PIR of the CASAS flats", 11,
        "Motion detector of the CASAS flats, which sees a circle of 3 ft from the ceiling: turn it "
        "by 1.5708 about y. Still 1.25 s after the last motion.",
        rows=[(2, -0.19, 0.19, -0.18, -0.08), (2, -0.1425, 0.2375, -0.05, 0.05),
              (2, -0.19, 0.19, 0.08, 0.18)], hold_time=1.25, lockout_time=0, warm_up=0)
    # Its data sheet: 0.5 to 200 s by a knob, then 2.5 s locked out, retriggers, 60 s to warm up.
    _write_heat_pir(
        models, "pir_hc_sr501", "HC-SR501", 52.5,
        "Motion detector HC-SR501, 7 m, for a wall at 2.2 m: on for 0.5 s, the least of its knob, "
        "then locked out for 2.5 s; deaf for 60 s after the start.", lens="area", hold_time=0.5,
        lockout_time=2.5, warm_up=60, signal_threshold=0.002)


def _write_heat_pir(models: Path, name: str, title: str, half_angle: float, description: str,
                    rows: Sequence[tuple[float, ...]] = (), **values: object) -> None:
    """Writes a pyroelectric PIR with zone rows of its own, if any; half_angle in degrees."""
    root, sensor = _new_pir(name)
    # what rviz draws: the zones are in the plug-in
    add_ray(sensor, (13, radians(half_angle)), (1, 0.0), (0.05, 20.0), 0.0)
    plugin = add_plugin(sensor, "pir_controller", "libpir_controller.so", model="pyroelectric",
                        **values)
    for row in rows:
        add(plugin, "zone_row", numbers(*row))
    write_model(root, models, title, description + " Served by libpir_controller.so.")


def write_switch(models: Path) -> None:
    """Writes models/optical_switch: two rays along x from the emitter to the detector."""
    root, model = new_model("optical_switch", static=True)
    parts = [
        spanned("emitter", (-0.02, -0.012, -0.02), (-0.002, 0.012, 0.02), collide=False),
        spanned("detector", (0.502, -0.012, -0.02), (0.52, 0.012, 0.02), collide=False),
    ]
    link = add_link(model, "switch", parts, moves=False)
    sensor = add_sensor(link, "switch", "ray", 1)
    add(sensor, "visualize", "true")
    add_ray(sensor, (2, 0.004), (1, 0.0), (0.01, 0.5), 0.005)
    add_plugin(sensor, "switch_controller", "liboptical_switch_controller.so", sample_rate=100,
               threshold=0.05)
    write_model(root, models, "Optical switch",
                "Emitter and detector 0.5 m apart over a door; its green strip cuts the beam. "
                "Served by liboptical_switch_controller.so.")


def write_luminosity(models: Path) -> None:
    """Writes models/luminosity_sensor: a white box that measures along x."""
    root, model = new_model("luminosity_sensor", static=True)
    parts = [
        spanned("housing", (-0.04, -0.03, -0.03), (-0.005, 0.03, 0.03), collide=False),
        Part("dome", (0.018, 0.01), (-0.004, 0, 0), (0, pi / 2, 0), material=(0.95, 0.95, 0.9),
             collide=False),
    ]
    link = add_link(model, "sensor", parts, moves=False)
    sensor = add_sensor(link, "luminosity", "camera", 1)
    _add_lens(sensor, 0.8, (1, 1), (0.01, 20))
    add_plugin(sensor, "luminosity_controller", "libluminosity_sensor_controller.so",
               noise_stddev=0.01)
    write_model(root, models, "Luminosity sensor",
                "Illuminance in lux on its face (x), 1 Hz, and the mean colour it sees. "
                "Served by libluminosity_sensor_controller.so.")


WHEEL_RADIUS, SEPARATION = 0.0352, 0.23
LIDAR_AT = (0.0, 0.0, 0.44)
CAMERA_AT = (0.13, 0.0, 0.34)     # its lens, before the poles


def _robot_body() -> list[Part]:
    black, plate = (0.12, 0.12, 0.13), (0.2, 0.2, 0.22)
    parts = [Part("body", (0.177, 0.1), (0, 0, 0.067), material=black, mass=3.9)]
    for i, (z, mass) in enumerate(((0.15, 0.35), (0.28, 0.35), (0.415, 0.4))):
        parts.append(Part(f"plate_{i}", (0.16, 0.01), (0, 0, z), material=plate, mass=mass))
    for i, (x, y) in enumerate(((0.11, 0.09), (0.11, -0.09), (-0.11, 0.09), (-0.11, -0.09))):
        parts.append(Part(f"pole_{i}", (0.007, 0.293), (x, y, 0.2635), material="Gazebo/Grey",
                          mass=0.1))
    # casters hang half a millimetre over the floor, so that the wheels carry the robot
    for side, x in (("front", 0.125), ("back", -0.125)):
        parts.append(Part(f"caster_{side}", (0.017,), (x, 0, 0.0175), material="Gazebo/Grey",
                          mass=0.1, friction=0.0))
    # housings weigh nothing and stop no rays
    parts.append(Part("lidar", (0.035, 0.04), (0, 0, 0.44), material="Gazebo/Black",
                      collide=False))
    parts.append(spanned("camera", (0.085, -0.14, 0.315), (0.125, 0.14, 0.365), material=black,
                         collide=False))
    return parts


def write_sitter(models: Path) -> None:
    """Writes models/sitter: 75 kg who sits on the seat under the origin and faces +x.

    One rigid body: its feet hang 5 cm over the floor of a chair 0.47 m high, so that the seat
    carries all of it. Masses of the parts: D. A. Winter, Biomechanics and Motor Control of Human
    Movement, table 4.1 (trunk with head and arms 67.8 %, thighs 20 %, shanks and feet 12.2 %).
    """
    root, model = new_model("sitter")
    skin, shirt, trousers = (0.85, 0.65, 0.53), (0.35, 0.45, 0.6), (0.25, 0.25, 0.3)
    parts = [
        spanned("thighs", (-0.13, -0.18, 0.0), (0.43, 0.18, 0.15), material=trousers, mass=15.0),
        spanned("trunk", (-0.13, -0.18, 0.15), (0.09, 0.18, 0.62), material=shirt, mass=37.75),
        *(spanned(f"arm_{side}", (-0.08, y - 0.04, 0.2), (0.02, y + 0.04, 0.6), material=shirt,
                  mass=3.75) for side, y in (("left", 0.22), ("right", -0.22))),
        Part("head", (0.11,), (-0.02, 0.0, 0.75), material=skin, mass=5.6),
        *(spanned(f"shank_{side}", (0.32, y - 0.06, -0.42), (0.43, y + 0.06, 0.0),
                  material=trousers, mass=4.575) for side, y in (("left", 0.1), ("right", -0.1))),
    ]
    add_link(model, "body", parts)
    write_model(root, models, "Sitter", "A person of 75 kg who sits; angen spawn sitter seats it.")


def write_turtlebot(models: Path) -> None:
    """Writes models/turtlebot: origin on the floor between the wheels, x forward, 6.3 kg.

    Its URDF has no sensors' frames: those come from the node. There the body is base_link, held
    by base_footprint, as robot_state_publisher takes no mass at the root.
    """
    root, model = new_model("turtlebot")
    robot = etree.Element("robot", name="turtlebot")
    _add_robot_sensors(add_link(model, "base_footprint", _robot_body()))
    urdf.add_root(robot, "base_footprint", "base_link")
    urdf.add_link(robot, "base_link", _robot_body())
    for side, y in (("left", SEPARATION / 2), ("right", -SEPARATION / 2)):
        # a sphere rolls as the wheel does and touches the floor in one point, which keeps ODE calm
        tread = Part("tread", (WHEEL_RADIUS,), mass=0.0, show=False, friction=1.0)
        looks = Part("wheel", (WHEEL_RADIUS, 0.021), rpy=(pi / 2, 0, 0), material="Gazebo/Black",
                     mass=0.25, collide=False)
        at = (0, y, WHEEL_RADIUS)
        add_link(model, f"{side}_wheel", [tread, looks], at)
        add_joint(model, f"{side}_wheel_joint", "revolute", "base_footprint", f"{side}_wheel",
                  (0, 1, 0))
        urdf.add_link(robot, f"{side}_wheel", [tread, looks])
        urdf.add_wheel_joint(robot, f"{side}_wheel_joint", "base_link", f"{side}_wheel", at)
    add_plugin(model, "battery", "librobot_battery.so", voltage=14.8, capacity=2.2, idle_power=10)
    urdf.write_robot(robot, models)
    write_model(root, models, "TurtleBot",
                "A Kobuki-like base with a stack, 0.354 m wide, 0.46 m high, 6.3 kg, with a lidar, "
                "a colour and depth camera and a bumper. Served by librobot_controller.so.")


def _add_lens(sensor: etree._Element, angle: float, size: tuple[int, int],
              reach: tuple[float, float]) -> None:
    """Appends <camera>: full horizontal angle in rad, size in pixels, near and far in m."""
    camera = add(sensor, "camera")
    add(camera, "horizontal_fov", angle)
    image = add(camera, "image")
    for tag, value in zip(("width", "height", "format"), (*size, "R8G8B8")):
        add(image, tag, value)
    clip = add(camera, "clip")
    add(clip, "near", reach[0])
    add(clip, "far", reach[1])


def _add_robot_sensors(base: etree._Element) -> None:
    """Lidar on the top plate, a Kinect-like camera before the poles, the body as a bumper."""
    lidar = add_sensor(base, "lidar", "ray", 10)
    add_pose(lidar, LIDAR_AT)
    add_ray(lidar, (720, pi * 719 / 720), (1, 0.0), (0.12, 10.0), 0.01)
    add_plugin(lidar, "lidar", "libgazebo_ros_laser.so", topicName="scan", frameName="base_scan")

    color = add_sensor(base, "camera", "camera", 30)
    add_pose(color, CAMERA_AT)
    _add_lens(color, 1.047198, (320, 240), (0.05, 100))
    add_plugin(color, "camera", "libgazebo_ros_camera.so", cameraName="camera",
               imageTopicName="rgb/image_raw", cameraInfoTopicName="rgb/camera_info",
               frameName="camera_rgb_optical_frame")

    depth = add_sensor(base, "depth", "depth", 30)
    add_pose(depth, CAMERA_AT)
    _add_lens(depth, 1.047198, (320, 240), (0.3, 10))
    add_plugin(depth, "depth", "libgazebo_ros_openni_kinect.so", cameraName="camera",
               depthImageTopicName="depth/image_raw",
               depthImageCameraInfoTopicName="depth/camera_info",
               pointCloudTopicName="depth/points", frameName="camera_depth_optical_frame")

    bumper = add_sensor(base, "bumper", "contact", 10)
    add(add(bumper, "contact"), "collision", "body_collision")
    add_plugin(bumper, "bumper", "libgazebo_ros_bumper.so", bumperTopicName="bumper")


def write_camera(models: Path) -> None:
    """Writes models/camera: a room camera that looks along x."""
    root, model = new_model("camera", static=True)
    parts = [
        spanned("housing", (-0.12, -0.03, -0.03), (-0.01, 0.03, 0.03), material=(0.2, 0.2, 0.22),
                collide=False),
        Part("lens", (0.02, 0.02), (-0.01, 0, 0), (0, pi / 2, 0), material="Gazebo/Black",
             collide=False),
    ]
    link = add_link(model, "camera", parts, moves=False)
    sensor = add_sensor(link, "camera", "camera", 30)
    _add_lens(sensor, 1.396263, (320, 240), (0.02, 100))
    add_plugin(sensor, "camera", "libgazebo_ros_camera.so")
    write_model(root, models, "Camera",
                "A room camera, 320 x 240 at 30 Hz, 80 degrees wide, looking along x. "
                "Served by libgazebo_ros_camera.so.")


def add_soil(model: etree._Element, link: etree._Element) -> None:
    """Makes a potted plant dry, and puts a moisture probe into its soil."""
    sensor = add_sensor(link, "soil_moisture", "custom", 1)
    add_pose(sensor, (0.06, 0, 0.22))
    add_plugin(sensor, "soil_moisture", "libsoil_moisture.so", noise_stddev=PROBE_NOISE)
    add_plugin(model, "plant", "libplant.so", soil=SOIL, leaf_height=1.15)
