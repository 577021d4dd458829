"""Lamp, sensors and robot."""
from __future__ import annotations

from math import pi, radians
from pathlib import Path

from lxml import etree

from .sdf import (Part, add, add_joint, add_link, add_plugin, add_pose, new_model,
                  spanned, write_model)

LIGHT_DROP = 0.35       # the light hangs this far under the ceiling


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
    add(light, "specular", "0.1 0.1 0.1 1")
    attenuation = add(light, "attenuation")
    for tag, value in (("range", 20), ("constant", 0.2), ("linear", 0), ("quadratic", 0.1)):
        add(attenuation, tag, value)
    add(light, "direction", "0 0 -1")
    add_plugin(model, "lamp_controller", "libros_plugin.so", luminous_flux=800, level=0)
    write_model(root, models, "Ceiling lamp",
                "A point light of 800 lm in a shade, off at the start. Served by libros_plugin.so.")


def _add_ray(sensor: etree._Element, horizontal: tuple[int, float], vertical: tuple[int, float],
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


def _add_sensor(link: etree._Element, name: str, kind: str, rate: float) -> etree._Element:
    sensor = add(link, "sensor", name=name, type=kind)
    add(sensor, "always_on", "true")
    add(sensor, "update_rate", rate)
    return sensor


def write_pir(models: Path, name: str, nods: bool) -> None:
    """Writes a PIR: 16 x 3 rays, 100 x 40 degrees, 6 m, 10 Hz; x looks into the room."""
    root, model = new_model(name, static=True)
    parts = [
        spanned("housing", (-0.05, -0.035, -0.05), (-0.01, 0.035, 0.05), collide=False),
        Part("lens", (0.022,), (-0.005, 0, 0), material=(0.93, 0.93, 0.9), collide=False),
    ]
    link = add_link(model, "pir", parts, moves=False)
    sensor = _add_sensor(link, "pir", "ray", 10)
    add(sensor, "visualize", "true")
    _add_ray(sensor, (16, radians(50)), (3, radians(20)), (0.02, 6.0), 0.01)
    values = {"threshold": 0.1}
    if nods:
        values.update(nod_amplitude=0.35, nod_period=4.0)
    add_plugin(sensor, "pir_controller", "libpir_controller.so", **values)
    title, how = ("Nodding PIR", ", nods by 0.35 rad in 4 s") if nods else ("PIR", "")
    write_model(root, models, title,
                f"Motion detector, 6 m, 100 x 40 degrees, 10 Hz{how}. "
                "Served by libpir_controller.so.")


def write_switch(models: Path) -> None:
    """Writes models/optical_switch: two rays along x from the emitter to the detector."""
    root, model = new_model("optical_switch", static=True)
    parts = [
        spanned("emitter", (-0.02, -0.012, -0.02), (-0.002, 0.012, 0.02), collide=False),
        spanned("detector", (0.502, -0.012, -0.02), (0.52, 0.012, 0.02), collide=False),
    ]
    link = add_link(model, "switch", parts, moves=False)
    sensor = _add_sensor(link, "switch", "ray", 1)
    add(sensor, "visualize", "true")
    _add_ray(sensor, (2, 0.004), (1, 0.0), (0.01, 0.5), 0.005)
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
    sensor = _add_sensor(link, "luminosity", "camera", 1)
    camera = add(sensor, "camera")
    add(camera, "horizontal_fov", 0.8)
    image = add(camera, "image")
    for tag, value in (("width", 1), ("height", 1), ("format", "R8G8B8")):
        add(image, tag, value)
    clip = add(camera, "clip")
    add(clip, "near", 0.01)
    add(clip, "far", 20)
    add_plugin(sensor, "luminosity_controller", "libluminosity_sensor_controller.so",
               noise_stddev=0.01)
    write_model(root, models, "Luminosity sensor",
                "Illuminance in lux on its face (x), 1 Hz, and the mean colour it sees. "
                "Served by libluminosity_sensor_controller.so.")


WHEEL_RADIUS, SEPARATION = 0.0352, 0.23


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
    return parts


def write_turtlebot(models: Path) -> None:
    """Writes models/turtlebot: origin on the floor between the wheels, x forward, 6.3 kg."""
    root, model = new_model("turtlebot")
    add_link(model, "base_footprint", _robot_body())
    for side, y in (("left", SEPARATION / 2), ("right", -SEPARATION / 2)):
        # a sphere rolls as the wheel does and meets the floor in one point, which keeps ODE calm
        tread = Part("tread", (WHEEL_RADIUS,), mass=0.0, show=False, friction=1.0)
        looks = Part("wheel", (WHEEL_RADIUS, 0.021), rpy=(pi / 2, 0, 0), material="Gazebo/Black",
                     mass=0.25, collide=False)
        add_link(model, f"{side}_wheel", [tread, looks], at=(0, y, WHEEL_RADIUS))
        add_joint(model, f"{side}_wheel_joint", "revolute", "base_footprint", f"{side}_wheel",
                  (0, 1, 0))
    write_model(root, models, "TurtleBot",
                "A Kobuki-like base with a stack, 0.354 m wide, 0.42 m high, 6.3 kg. "
                "Served by librobot_controller.so.")
