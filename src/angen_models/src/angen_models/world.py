"""The worlds, assembled from <include> blocks."""
from math import atan2, cos, hypot, pi, sin
from pathlib import Path
from typing import Iterable, Sequence

from lxml import etree

from angen_models import catalog, openers, plan
from angen_models.building import add_ground
from angen_models.sdf import SDF_VERSION, add, add_home, add_plugin, add_pose, numbers, write
from angen_models.things import add_tag

Pose = tuple[float, float, float, float, float, float]


def new_world(name: str) -> tuple[etree._Element, etree._Element]:
    """Returns (<sdf>, <world>) with physics, scene and the ground."""
    root = etree.Element("sdf", version=SDF_VERSION)
    world = add(root, "world", name=name)
    add(world, "gravity", "0 0 -9.8")
    physics = add(world, "physics", name="default_physics", type="ode")
    for tag, value in (("max_step_size", 0.001), ("real_time_factor", 1),
                       ("real_time_update_rate", 1000)):
        add(physics, tag, value)
    solver = add(add(physics, "ode"), "solver")
    add(solver, "type", "world")
    # night: the lamps are the only light
    scene = add(world, "scene")
    add(scene, "ambient", "0 0 0 1")
    add(scene, "background", "0.05 0.06 0.1 1")
    add(scene, "shadows", "true")
    add_ground(world)
    return root, world


def add_world_plugins(world: etree._Element) -> None:
    """Appends the plug-ins that serve every door and every robot, also those spawned later."""
    add_plugin(world, "door_controller", "libdoor_world_plugin.so", p=70, i=200, d=25, i_max=100,
               i_min=-100, cmd_max=120, cmd_min=-120)
    add_plugin(world, "robot_controller", "librobot_controller.so", wheelSeparation=0.23,
               wheelDiameter=0.0704, wheelTorque=1.0, wheelAcceleration=1.8,
               commandTopic="cmd_vel", odometryTopic="odom", odometryFrame="odom",
               robotBaseFrame="base_footprint", leftJoint="left_wheel_joint",
               rightJoint="right_wheel_joint", updateRate=50)


def add_home_site(world: etree._Element) -> None:
    """Says which door is the main entrance, where north is, and when simulated time begins."""
    home = add_home(world, "home")
    add_home(home, "entrance", "entrance0")
    add_home(home, "north", round(plan.NORTH, 5))
    add_home(home, "latitude", plan.LATITUDE)
    add_home(home, "start", f"{plan.DAY}T{plan.BEGINS}")


def include(world: etree._Element, model: str, name: str, pose: Pose) -> etree._Element:
    """Appends a model of worlds/models as a block, and returns it."""
    block = add(world, "include")
    add(block, "name", name)
    add(block, "pose", numbers(*pose))
    add(block, "uri", f"model://{model}")
    return block


def door_pose(room: str, floor: int) -> Pose:
    """Returns the pose of a room's door on a floor."""
    x, y, yaw = plan.DOORS[room]
    return (x, y, floor * plan.STOREY, 0.0, 0.0, yaw)


def switch_pose(room: str, floor: int) -> Pose:
    """Returns the pose of the optical switch of a room's door."""
    x, y, yaw = plan.DOORS[room]
    u, v, z = plan.SWITCH_IN_DOOR
    return (x + u * cos(yaw) - v * sin(yaw), y + u * sin(yaw) + v * cos(yaw),
            z + floor * plan.STOREY, 0.0, 0.0, yaw)


def add_devices(world: etree._Element, floor: int) -> None:
    """Appends the doors and lamps of a floor."""
    for room in plan.ROOMS:
        include(world, f"{room}_door", f"{room}_door{floor}", door_pose(room, floor))
    for room, (x, y) in plan.LAMPS.items():
        include(world, "ceiling_lamp", f"{room}_lamp{floor}",
                (x, y, plan.CEILING + floor * plan.STOREY, 0, 0, 0))


def fronts_of(piece: str, name: str, pose: Pose) -> list[tuple[str, str, Pose]]:
    """Returns model, name and pose of each front of a piece of furniture."""
    floor = int(pose[2] // plan.STOREY)
    room = name.split("_")[0]
    return [(model, f"{room}_{own}_cabinet{floor}", openers.front_pose(pose, (x, y, z)))
            for model, own, x, y, z in plan.FRONTS.get(piece, ())]


def add_openers(world: etree._Element, floor: int) -> None:
    for room, sash in plan.SASHES.items():
        include(world, f"{room}_window", f"{room}_window{floor}", openers.sash_pose(sash, floor))
    for room in plan.FURNITURE:
        for piece in furniture_in(room, floor):
            for front in fronts_of(*piece):
                include(world, *front)


def _add_sensors(world: etree._Element, floor: int) -> None:
    z = floor * plan.STOREY
    for room in plan.ROOMS:
        include(world, "optical_switch", f"{room}_switch{floor}", switch_pose(room, floor))
    for room, corners in plan.PIRS.items():
        for suffix, (x, y, yaw) in zip("ab", corners):
            nods = (room, suffix) == plan.NODDING_PIR
            include(world, "pir_nodding" if nods else "pir", f"{room}_pir{floor}_{suffix}",
                    (x, y, plan.PIR_HEIGHT + z, 0, plan.PIR_PITCH, yaw))
    for room, (x, y, yaw) in plan.LUX.items():
        include(world, "luminosity_sensor", f"{room}_lux{floor}",
                (x, y, plan.LUX_HEIGHT + z, 0, plan.LUX_PITCH, yaw))


def add_readers(world: etree._Element) -> None:
    """Appends the RFID readers."""
    for room, (x, y, z, yaw) in plan.READERS.items():
        include(world, "rfid_reader", f"{room}_rfid0", (x, y, z, 0, 0, yaw))


def furniture_in(room: str, floor: int) -> list[tuple[str, str, Pose]]:
    """Returns model, name and pose of each piece in a room."""
    found = []
    for model, suffix, x, y, yaw in plan.FURNITURE.get(room, ()):
        own = model if model.startswith(room) else f"{room}_{model}"
        z = floor * plan.STOREY + (0.001 if model in plan.RAISED else 0.0)
        found.append((model, f"{own}{floor}{suffix}", (x, y, z, 0.0, 0.0, yaw)))
    return found


def _add_furniture(world: etree._Element, floor: int) -> None:
    for room in plan.FURNITURE:
        for piece in furniture_in(room, floor):
            include(world, *piece)


def _add_appliances(world: etree._Element, floor: int) -> None:
    z = floor * plan.STOREY
    for room, (model, x, y, height, yaw) in plan.APPLIANCES.items():
        include(world, model, f"{room}_{model}{floor}", (x, y, z + height, 0, 0, yaw))
    for name, (load, x, y, height, yaw) in plan.PLUGS.items():
        plug = catalog.smart_plug(f"{name}{floor}", f"{load}{floor}")
        add_pose(plug, (x, y, z + height), (0, 0, yaw))
        world.append(plug)
    for model, height, places in (("microphone", plan.MICROPHONE_HEIGHT, plan.MICROPHONES),
                                  ("radio_receiver", plan.RECEIVER_HEIGHT, plan.RECEIVERS)):
        for room, (x, y, yaw) in places.items():
            include(world, model, f"{room}_{model.removeprefix('radio_')}{floor}",
                    (x, y, z + height, 0, 0, yaw))


def _add_transmitter(carrier: etree._Element, name: str) -> None:
    add_plugin(carrier, "transmitter", "libradio_transmitter.so",
               position=numbers(*plan.TRANSMITTERS[name]))


def _add_things(world: etree._Element, floor: int) -> None:
    for model, name, x, y, z, pitch, yaw in plan.THINGS:
        include(world, model, f"{name}{floor}", (x, y, z + floor * plan.STOREY, 0, pitch, yaw))


def walk() -> list[tuple[float, float, float, float]]:
    """Returns the person's waypoints (t in s, x, y, yaw), turning on the spot at corners."""
    points, t = [], 0.0
    corners = plan.WALK
    (x0, y0), (x1, y1) = corners[:2]
    first = heading = atan2(y1 - y0, x1 - x0)
    for i, ((x0, y0), (x1, y1)) in enumerate(zip(corners, corners[1:])):
        if i > 0:
            heading += (atan2(y1 - y0, x1 - x0) - heading + pi) % (2 * pi) - pi
            t += plan.TURN_TIME
        points.append((t, x0, y0, heading))
        t += hypot(x1 - x0, y1 - y0) / plan.WALK_SPEED
        points.append((t, x1, y1, heading))
    turned = heading + (first - heading + pi) % (2 * pi) - pi
    points.append((t + plan.TURN_TIME, *corners[-1], turned))
    return points


def add_actor(world: etree._Element, rows: Iterable[tuple[float, float, float, float]],
              loops: bool, digits: int) -> etree._Element:
    """Appends a person who is at x, y with a yaw at each t (s, of that many digits), and returns
    the block."""
    actor = add(world, "actor", name="person")
    script = add(actor, "script")
    add(script, "loop", str(loops).lower())
    add(script, "delay_start", 0)
    add(script, "auto_start", "true")
    trajectory = add(script, "trajectory", id="0", type="walk")
    for t, x, y, yaw in rows:
        waypoint = add(trajectory, "waypoint")
        add(waypoint, "time", round(t, digits))
        add(waypoint, "pose", numbers(x, y, 0, 0, 0, round(yaw, digits + 2)))
    return actor


def add_person(world: etree._Element) -> etree._Element:
    """Appends the person who walks round floor 0, and returns the block."""
    actor = add_actor(world, walk(), True, 3)
    _add_transmitter(actor, "person")
    return actor


def add_state(world: etree._Element, name: str, doors: Sequence[str] = plan.OPEN_DOORS) -> None:
    """Appends the doors that are open at the start."""
    state = add(world, "state", world_name=name)
    for door in doors:
        model = add(state, "model", name=door)
        room, floor = door[:-1].removesuffix("_door"), int(door[-1])
        add(model, "pose", numbers(*door_pose(room, floor)))
        joint = add(model, "joint", name="hinge")
        add(joint, "angle", -1.57, axis="0")


def comment(world: etree._Element, text: str) -> None:
    """Appends a comment."""
    world.append(etree.Comment(f" {text} "))


def write_angen(folder: Path) -> None:
    """Writes angen.world: two floors with all their contents."""
    root, world = new_world("angen")
    add_world_plugins(world)
    add_home_site(world)
    comment(world, "the building")
    for floor in range(plan.FLOORS):
        include(world, "apartment", f"apartment{floor}", (0, 0, floor * plan.STOREY, 0, 0, 0))
    include(world, "elevator", "elevator", (*plan.ELEVATOR, 0, 0, 0, 0))
    for floor in range(plan.FLOORS):
        comment(world, f"floor {floor}: doors and lamps")
        add_devices(world, floor)
        comment(world, f"floor {floor}: sensors")
        _add_sensors(world, floor)
        comment(world, f"floor {floor}: furniture")
        _add_furniture(world, floor)
        comment(world, f"floor {floor}: windows, and the fronts of furniture")
        add_openers(world, floor)
        comment(world, f"floor {floor}: appliances, and sensors of power, sound and radio")
        _add_appliances(world, floor)
        comment(world, f"floor {floor}: things")
        _add_things(world, floor)
    add_readers(world)
    x, y, yaw = plan.ROBOT
    comment(world, "who moves")
    robot = include(world, "turtlebot", "turtlebot", (x, y, 0.001, 0, 0, yaw))
    _add_transmitter(robot, "turtlebot")
    add_tag(robot, plan.ROBOT_TAG)
    add_tag(add_person(world), plan.BADGE)
    add_state(world, "angen")
    write(root, folder / "angen.world")


def write_empty(folder: Path) -> None:
    """Writes empty.world: the ground and the world's plug-ins."""
    root, world = new_world("empty")
    add_world_plugins(world)
    write(root, folder / "empty.world")
