"""The built-in building, measured: nothing overlaps, all is reachable, sensors see their room."""
from collections import Counter
from itertools import pairwise
from math import hypot

import angen
import numpy as np
import pytest
from lxml import etree
from scipy.ndimage import label
from shapely import vectorized
from shapely.geometry import LineString

import make_meshes
import make_worlds
from angen_models import plan
from angen_tools.common.geometry import rotation_of
from tests.angen_models import world_geometry as geometry

ROOMS = list(plan.ROOMS)
DOORS = [f"{room}_door{floor}" for floor in (0, 1) for room in ROOMS]
OPEN = -1.57
WINDOWS = [f"{room}_window{floor}" for floor in (0, 1) for room in plan.SASHES]
FRONTS = [f"{room}_{own}_cabinet{floor}" for floor in (0, 1)
          for room, pieces in plan.FURNITURE.items() for piece, *_ in pieces
          for _, own, *_ in plan.FRONTS.get(piece, ())]
FILE = geometry.WORLDS / "angen.world"
WORLD = etree.parse(str(FILE)).getroot().find("world")
SOURCES = {include.findtext("name"): include.findtext("uri").removeprefix("model://")
           for include in WORLD.iterfind("include")}


@pytest.fixture(scope="module")
def world() -> angen.World:
    """All is shut."""
    return geometry.shut_world(FILE)


@pytest.fixture(scope="module")
def solids(world) -> list[geometry.Shape]:
    """All collisions with all shut."""
    return geometry.shapes(world)


def opened(doors) -> angen.World:
    """The building with these doors open."""
    world = geometry.shut_world(FILE)
    for door in doors:
        world.set_joints(door, {"hinge": OPEN})
    return world


def around(solids, world, model: str, radius: float = 1.4) -> list[geometry.Shape]:
    """The collisions near a model, without its own."""
    return [shape for shape in geometry.nearby(solids, world.motion(model)[0][:3], radius)
            if shape.model != model]


def place(world, model: str, x: float, y: float, z: float) -> np.ndarray:
    """A point of a model's frame in the world (m)."""
    pose = world.motion(model)[0]
    return pose[:3] + rotation_of(*pose[3:]) @ [x, y, z]


def on_floor(world, model: str, floor: int) -> bool:
    return floor == int((world.motion(model)[0][2] + 0.5) // plan.STOREY)


def room_bounds(room: str, floor: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the corners of a room between its walls' faces (m)."""
    x0, y0, x1, y1 = plan.ROOMS[room]
    z = floor * plan.STOREY
    return (np.array([x0 + 0.05, y0 + 0.05, z]),
            np.array([x1 - 0.05, y1 - 0.05, z + plan.CEILING]))


def test_world_holds_what_the_building_needs(world):
    count = Counter(SOURCES.values())
    assert count["apartment"] == 2 and count["elevator"] == 1 and count["turtlebot"] == 1
    assert sum(count[f"{room}_door"] for room in ROOMS) == 12
    assert count["ceiling_lamp"] == count["optical_switch"] == count["luminosity_sensor"] == 12
    assert count["pir"] == 22 and count["pir_nodding"] == 2
    assert 45 <= sum(link.startswith("apartment0::") for link in world.links) <= 55
    assert len(WINDOWS) == 12 and len(FRONTS) == 24 and {*WINDOWS, *FRONTS} < set(world.models)
    assert count["tv"] == count["fan"] == count["stereo"] == 2
    assert count["microphone"] == 6 and count["radio_receiver"] == 10
    plugs = [model.findtext(".//load") for model in WORLD.iterfind("model")
             if model.get("name").endswith("_plug0")]
    assert sorted(plugs) == ["appliance/bedroom_fan0", "appliance/livingroom_tv0",
                             "appliance/workroom_stereo0", "stove/kitchen0"]
    # chairs and tables, a weighing table and a mat, the elevator, the robot
    assert len({model for kind, _, model, _ in world.entities()
                if kind in ("contact", "pressure", "load_cells")}) == 2 * (6 + 3 + 2) + 2


@pytest.mark.parametrize("floor", [0, 1])
def test_each_floor_is_furnished_with_meshes(world, floor):
    furniture = {f"{m}" for room in plan.FURNITURE.values() for m, *_ in room}
    here = [source for name, source in SOURCES.items()
            if source in furniture and on_floor(world, name, floor)]
    assert len(here) >= 15
    uris = {uri.text for source in here for uri in etree.parse(
        str(geometry.WORLDS / "models" / source / "model.sdf")).iterfind(".//mesh/uri")}
    assert len(uris) >= 5
    assert {uri.rsplit(".", 1)[1] for uri in uris} == {"dae", "stl"}


def test_meshes_exist_in_both_forms_and_are_small():
    folder = geometry.WORLDS / "models"
    uris = {uri.text for sdf in folder.glob("*/model.sdf")
            for uri in etree.parse(str(sdf)).iterfind(".//mesh/uri")}
    assert uris
    for uri in uris:
        path = folder / uri.removeprefix("model://")
        for suffix in (".dae", ".stl"):
            assert 1000 < path.with_suffix(suffix).stat().st_size < 100_000, path


@pytest.mark.parametrize("name", DOORS + WINDOWS + FRONTS)
def test_leaves_swing_free(world, solids, name):
    joint = "hinge" if name in DOORS else "sash" if name in WINDOWS else "front"
    least = 0.001 if name in DOORS else 0.0009
    others = around(solids, world, name)
    angles = np.linspace(*world.joint(f"{name}::{joint}")["limits"], 60 if name in DOORS else 40)
    for at, shape in geometry.moved(world, name, [{joint: angle} for angle in angles]):
        gap, other = geometry.nearest(shape, others)
        assert gap > least, (at, shape.link, other)


@pytest.mark.parametrize("name", WINDOWS)
def test_a_window_opens_a_way_through_the_wall(name):
    world = geometry.shut_world(FILE)
    sash = plan.SASHES[name.removesuffix("_window" + name[-1])]
    middle = place(world, name, sash.width / 2, -0.2, (sash.top - sash.bottom) / 2)
    out = rotation_of(*world.motion(name)[0][3:])[:, 1]
    for angle, blocked in ((0.0, True), (OPEN, False)):
        world.set_joints(name, {"sash": angle})
        assert (world.cast(middle[None], out[None], 1.0)[0] < 1.0) == blocked


def test_a_shut_leaf_holds_its_magnet_at_its_reed():
    world = angen.World(str(FILE))
    world.run(1.1)
    for name in WINDOWS + FRONTS:
        assert world.sensor("reed", name)["distance"] == pytest.approx(0.012, abs=1e-4), name


def test_open_doors_leave_each_other_alone():
    leaves = [shape for shape in geometry.shapes(opened(DOORS)) if shape.model in DOORS]
    for shape in leaves:
        others = [other for other in leaves if other.model != shape.model]
        assert geometry.nearest(shape, others)[0] > 0.1


@pytest.mark.parametrize("floor", [0, 1])
def test_furniture_and_robot_overlap_nothing(floor):
    kinds = {m for room in plan.FURNITURE.values() for m, *_ in room} | {"turtlebot"}
    kinds |= {m for m, *_ in plan.APPLIANCES.values()}
    world = opened(plan.OPEN_DOORS)
    solids = geometry.shapes(world)
    static = {model for model, _, _, moves, _ in world.shapes if not moves}
    for name, source in SOURCES.items():
        if source in kinds and on_floor(world, name, floor):
            others = around(solids, world, name, 3.0)
            for shape in solids:
                if shape.model == name:
                    gap, other = geometry.nearest(shape, others)
                    least = -1e-6 if name in static else 1e-4  # rounding to floats, and air
                    assert gap > least, (name, shape.link, other)


@pytest.mark.parametrize("height", [0.0, 0.5, 2.0, 3.7, 4.0])
def test_elevator_rides_clear_of_the_shaft(world, solids, height):
    others = [shape for shape in solids if shape.model != "elevator"]
    doors = ["cabin_door_left", "cabin_door_right",
             *(f"landing_door_{floor}_{side}" for floor in (0, 1) for side in ("left", "right"))]
    for at, shape in geometry.moved(world, "elevator", [
            {"lift": height, **dict.fromkeys(doors, way)} for way in (0.0, 0.52)]):
        gap, other = geometry.nearest(shape, others)
        assert gap > 0.004, (at, shape.link, other)


def test_elevator_parts_keep_apart(world):
    own = geometry.alone(world, "elevator")
    for height in (0.0, 1.3, 4.0):
        for doors in (0.0, 0.26, 0.52):
            own.set_joints("elevator", {"lift": height, "cabin_door_left": doors,
                                        "cabin_door_right": doors})
            parts = geometry.shapes(own)
            for shape in parts:
                others = [s for s in parts if s.link != shape.link]
                assert geometry.nearest(shape, others)[0] > 0.003, (height, doors, shape.link)


@pytest.mark.parametrize("floor", [0, 1])
def test_gap_into_the_cabin_is_small_and_level(floor):
    world, z = geometry.shut_world(FILE), floor * plan.STOREY
    world.set_joints("elevator", {"lift": z, **{joint.partition("::")[2]: 0.52
                                                for joint in world.joints
                                                if joint.startswith("elevator::")
                                                and "_door_" in joint}})
    for y in (4.6, 5.0, 5.4):
        x = np.arange(-4.3, -0.2, 0.001)
        start = np.stack([x, np.full_like(x, y), np.full_like(x, z + 0.3)], 1)
        ranges = world.cast(start, np.tile([0.0, 0.0, -1.0], (len(x), 1)), 10.0)
        missing = np.abs(ranges - 0.3) > 1e-6
        assert 0 < missing.sum() <= 20


@pytest.mark.parametrize("floor", [0, 1])
def test_shut_landing_doors_guard_the_shaft(floor):
    world, z = geometry.shut_world(FILE), floor * plan.STOREY
    world.set_joints("elevator", {"lift": (1 - floor) * plan.STOREY})
    face = max(shape.high[0] for shape in geometry.shapes(world)
               if shape.link.startswith(f"landing_door_{floor}_"))
    y, height = np.meshgrid(np.arange(4.51, 5.5, 0.0311), np.arange(0.03, 2.0, 0.1))
    start = np.stack([np.full(y.size, -2.0), y.ravel(), z + height.ravel()], 1)
    ranges = world.cast(start, np.tile([-1.0, 0.0, 0.0], (len(start), 1)), 5.0)
    assert np.allclose(ranges, -2.0 - face, atol=1e-6) and ranges.max() < 0.8


@pytest.mark.parametrize("floor", [0, 1])
def test_floor_has_no_holes(world, floor):
    """A ray that starts in a wall ends at its foot, which is in the floor."""
    slab, z = geometry.alone(world, f"apartment{floor}"), floor * plan.STOREY
    x, y = np.meshgrid(np.arange(-2.64, 9.95, 0.0473), np.arange(0.06, 9.55, 0.0473))
    x, y = x.ravel(), y.ravel()
    inside = (x > 0.06) | ((x < -0.06) & (y > 3.36) & (y < 6.64))
    start = np.stack([x, y, np.full_like(x, z + 0.01)], 1)[inside]
    ranges = slab.cast(start, np.tile([0.0, 0.0, -1.0], (len(start), 1)), 5.0)
    assert ranges.max() < 0.2
    assert (np.abs(ranges - 0.01) < 1e-6).mean() > 0.9


def reachable(radius: float, floor: int) -> set[str]:
    """Returns the rooms that a disc gets to from the landing, all doors open, by grid steps."""
    z, step = floor * plan.STOREY, 0.05
    xs, ys = np.arange(-2.6, 9.96, step), np.arange(0.06, 9.56, step)
    grid = np.stack(np.meshgrid(xs, ys, indexing="ij"), -1).reshape(-1, 2)
    free = np.ones(len(grid), bool)
    for shape in geometry.shapes(opened([door for door in DOORS if door.endswith(str(floor))]),
                                 without={"turtlebot", "elevator"}):
        if shape.high[2] > z + 0.02 and shape.low[2] < z + 1.8:
            near = np.flatnonzero(((grid > shape.low[:2] - radius)
                                   & (grid < shape.high[:2] + radius)).all(axis=1))
            taken = vectorized.contains(shape.footprint.buffer(radius, 64), *grid[near].T)
            free[near[taken]] = False
    parts, _ = label(free.reshape(len(xs), len(ys)))
    start = parts[int((-1.3 - xs[0]) / step), int((5.0 - ys[0]) / step)]
    assert start > 0
    points = grid[parts.ravel() == start]
    return {room for room, (x0, y0, x1, y1) in plan.ROOMS.items()
            if (np.hypot(points[:, 0] - (x0 + x1) / 2, points[:, 1] - (y0 + y1) / 2) < 1.2).any()}


@pytest.mark.parametrize("radius", [0.18, 0.25, 0.4])
@pytest.mark.parametrize("floor", [0, 1])
def test_every_room_is_reachable(radius, floor):
    assert reachable(radius, floor) == set(ROOMS)


@pytest.mark.parametrize("door", DOORS)
def test_strip_cuts_the_beam_only_when_shut(door):
    world = geometry.shut_world(FILE)
    for angle in (0.001, 0.0, -0.002, -0.0175, -0.2, -0.8, OPEN):
        world.set_joints(door, {"hinge": angle})
        ranges, _, reach = geometry.cast(world, "switch", door.replace("_door", "_switch"))
        assert len(ranges) == 2 and (reach == 0.5).all()
        assert (ranges < 0.2 if angle > -0.01 else ranges == reach).all(), angle


@pytest.mark.parametrize("floor", [0, 1])
@pytest.mark.parametrize("room", ROOMS)
def test_pirs_see_their_own_room(world, room, floor):
    """At each tilt of those that nod, which turn nearer to the wall below them."""
    low, high = room_bounds(room, floor)
    for suffix in "ab":
        name = f"{room}_pir{floor}_{suffix}"
        ranges, ends, _ = geometry.cast(world, "pir", name)
        assert ((ends > low - 0.11) & (ends < high + 0.11)).all()
        least = 0.25 if SOURCES[name] == "pir_nodding" else 0.3
        assert np.median(ranges) > 1.5 and (ranges > least).all()


@pytest.mark.parametrize("room", ROOMS)
def test_light_stays_behind_a_shut_door(world, room):
    low, high = room_bounds(room, 0)
    x, y = plan.LAMPS[room]
    count = 10_000
    k = np.arange(count) + 0.5
    up, turn = 1 - 2 * k / count, np.pi * (1 + 5 ** 0.5) * k
    flat = np.sqrt(1 - up ** 2)
    directions = np.stack([flat * np.cos(turn), flat * np.sin(turn), up], 1)
    origins = np.tile([x, y, plan.CEILING - 0.35], (count, 1))
    ends = origins + world.cast(origins, directions, 30.0)[:, None] * directions
    outside = ((ends < low - 0.11) | (ends > high + 0.11)).any(axis=1)
    assert outside.mean() < 0.002


def test_luminosity_sensors_face_away_from_the_lamp_and_into_the_room(world):
    poses = {name: pose for _, name, _, pose in world.entities("luminosity")}
    for floor in (0, 1):
        for room in ROOMS:
            pose = poses[f"{room}_lux{floor}"]
            ahead = rotation_of(*pose[3:])[:, 0]
            to_lamp = world.motion(f"{room}_lamp{floor}")[0][:3] - [0, 0, 0.35] - pose[:3]
            angle = np.arccos(ahead @ to_lamp / np.linalg.norm(to_lamp))
            right, left, _ = world.field_of_view("luminosity", f"{room}_lux{floor}")
            assert angle > (left - right) / 2 + 0.1
            assert world.cast(pose[None, :3], ahead[None], 10.0)[0] > 1.5


def waypoints() -> list[tuple[float, np.ndarray]]:
    """Returns the person's waypoints as (t in s, x y z roll pitch yaw)."""
    actor = WORLD.find("actor[@name='person']")
    return [(float(w.findtext("time")), np.array([float(v) for v in w.findtext("pose").split()]))
            for w in actor.iterfind(".//waypoint")]


def test_person_walks_a_closed_round_at_one_metre_a_second():
    points = waypoints()
    assert np.allclose(points[0][1][:3], points[-1][1][:3])
    for (t0, p0), (t1, p1) in pairwise(points):
        assert t1 > t0 and p0[2] == p1[2] == 0.0
        speed = hypot(*(p1 - p0)[:2]) / (t1 - t0)
        assert speed == pytest.approx(1.0, abs=0.01) or speed == 0.0


def test_person_passes_all_with_room_to_spare():
    doors = {model.get("name") for model in WORLD.iterfind("state/model")}
    path = np.array([p0[:2] + (p1 - p0)[:2] * f for (_, p0), (_, p1) in pairwise(waypoints())
                     for f in np.linspace(0, 1, 200)])
    way = LineString(path)
    for shape in geometry.shapes(opened(doors)):
        if shape.high[2] > 0.02 and shape.low[2] < 1.9:
            assert way.distance(shape.footprint) > 0.35, f"{shape.model}::{shape.link}"
    visited = {room for room, (x0, y0, x1, y1) in plan.ROOMS.items()
               if ((path[:, 0] > x0) & (path[:, 0] < x1)
                   & (path[:, 1] > y0) & (path[:, 1] < y1)).any()}
    assert len(visited) >= 4 and {f"{room}_door0" for room in visited} >= doors


def test_generated_files_are_what_the_script_makes(tmp_path):
    make_worlds.write_all(tmp_path)
    made = [p for p in tmp_path.rglob("*") if p.is_file()]
    assert len(made) > 60
    for name, meshes in make_meshes.all_meshes().items():
        model, stem = name.split("/")
        path = tmp_path / "models" / model / "meshes" / stem
        make_meshes.write_collada(meshes, path.with_suffix(".dae"))
        make_meshes.write_stl(meshes, path.with_suffix(".stl"))
        made += [path.with_suffix(".dae"), path.with_suffix(".stl")]
    for path in made:
        assert path.read_bytes() == (geometry.WORLDS / path.relative_to(tmp_path)).read_bytes(), (
            f"{path.name} differs: run worlds/make_worlds.py and worlds/make_meshes.py")
