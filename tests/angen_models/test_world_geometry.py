"""The built-in building, measured: nothing overlaps, all is reachable, sensors see their room."""
from __future__ import annotations

from collections import Counter, deque
from itertools import pairwise
from math import hypot

import numpy as np
import pytest
from lxml import etree

import make_meshes
import make_worlds
from angen_models import plan
from tests.angen_models import world_geometry as geometry

ROOMS = list(plan.ROOMS)
DOORS = [f"{room}_door{floor}" for floor in (0, 1) for room in ROOMS]
OPEN = {"hinge": -1.57}
WINDOWS = [f"{room}_window{floor}" for floor in (0, 1) for room in plan.SASHES]
FRONTS = [f"{room}_{own}_cabinet{floor}" for floor in (0, 1)
          for room, pieces in plan.FURNITURE.items() for piece, *_ in pieces
          for _, own, *_ in plan.FRONTS.get(piece, ())]


@pytest.fixture(scope="module")
def models() -> dict[str, geometry.Model]:
    return geometry.load(geometry.WORLDS / "angen.world")


def solids(models, opened=(), without=()) -> list[geometry.Shape]:
    """Returns all collisions but those of `without`, the doors in `opened` open."""
    return [shape for model in models.values() if model.name not in without
            for shape in geometry.shapes(model, OPEN if model.name in opened else {})]


def on_floor(model: geometry.Model, floor: int) -> bool:
    return floor == int((model.pose[2, 3] + 0.5) // plan.STOREY)


def room_bounds(room: str, floor: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the corners of a room between its walls' faces (m)."""
    x0, y0, x1, y1 = plan.ROOMS[room]
    z = floor * plan.STOREY
    return (np.array([x0 + 0.05, y0 + 0.05, z]),
            np.array([x1 - 0.05, y1 - 0.05, z + plan.CEILING]))


def test_world_holds_what_the_building_needs(models):
    count = Counter(m.source for m in models.values())
    assert count["apartment"] == 2 and count["elevator"] == 1 and count["turtlebot"] == 1
    assert sum(count[f"{room}_door"] for room in ROOMS) == 12
    assert count["ceiling_lamp"] == count["optical_switch"] == count["luminosity_sensor"] == 12
    assert count["pir"] == 22 and count["pir_nodding"] == 2
    assert 45 <= len(models["apartment0"].links) <= 55
    assert len(WINDOWS) == 12 and len(FRONTS) == 24 and {*WINDOWS, *FRONTS} < set(models)
    assert count["tv"] == count["fan"] == count["stereo"] == 2
    assert count["microphone"] == 6 and count["radio_receiver"] == 10
    plugs = [m.element.findtext(".//load") for m in models.values() if m.name.endswith("_plug0")]
    assert sorted(plugs) == ["appliance/bedroom_fan0", "appliance/livingroom_tv0",
                             "appliance/workroom_stereo0", "stove/kitchen0"]
    touching = [m for m in models.values() if m.element.find(".//sensor[@type='contact']")
                is not None]
    # chairs and tables, a weighing table and a mat, the elevator, the robot
    assert len(touching) == 2 * (6 + 3 + 2) + 2


@pytest.mark.parametrize("floor", [0, 1])
def test_each_floor_is_furnished_with_meshes(models, floor):
    furniture = {f"{m}" for room in plan.FURNITURE.values() for m, *_ in room}
    here = [m for m in models.values() if m.source in furniture and on_floor(m, floor)]
    assert len(here) >= 15
    uris = {uri.text for m in here for uri in m.element.iterfind(".//mesh/uri")}
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


@pytest.mark.parametrize("door", DOORS)
def test_door_swings_free(models, door):
    others = geometry.nearby(solids(models, without={door}), models[door].pose[:3, 3], 3.0)
    for angle in np.linspace(-1.57, 0.001, 60):
        for shape in geometry.shapes(models[door], {"hinge": angle}):
            gap = geometry.gaps(shape, others)
            nearest = int(gap.argmin())
            assert gap[nearest] > 0.001, (angle, shape.name, others[nearest].full_name)


@pytest.mark.parametrize("name", WINDOWS + FRONTS)
def test_windows_and_fronts_swing_free(models, name):
    leaf = models[name]
    joint = leaf.joint("sash" if name in WINDOWS else "front")
    low, high = (float(joint.findtext(f"axis/limit/{end}")) for end in ("lower", "upper"))
    others = geometry.nearby(solids(models, without={name}), leaf.pose[:3, 3], 3.0)
    for angle in np.linspace(low, high, 40):
        for shape in geometry.shapes(leaf, {joint.get("name"): angle}):
            gap = geometry.gaps(shape, others)
            nearest = int(gap.argmin())
            assert gap[nearest] > 0.0009, (angle, shape.name, others[nearest].full_name)


@pytest.mark.parametrize("name", WINDOWS)
def test_a_window_opens_a_way_through_the_wall(models, name):
    sash = plan.SASHES[name.removesuffix("_window" + name[-1])]
    leaf = models[name]
    middle = leaf.pose @ [sash.width / 2, -0.2, (sash.top - sash.bottom) / 2, 1.0]
    out = leaf.pose[:3, 1]
    for angle, blocked in ((0.0, True), (-1.57, False)):
        there = solids(models, without={name}) + geometry.shapes(leaf, {"sash": angle})
        ranges, _ = geometry.cast(middle[None, :3], out[None], there, 1.0)
        assert (ranges[0] < 1.0) == blocked


@pytest.mark.parametrize("name", WINDOWS + FRONTS)
def test_a_shut_leaf_holds_its_magnet_at_its_reed(models, name):
    leaf = models[name]
    sensor, pose = geometry.sensor_pose(leaf)
    plugin = sensor.find("plugin")
    magnet = [float(v) for v in plugin.findtext("magnet").split()]
    place = leaf.links[plugin.findtext("magnet_link")] @ [*magnet, 1.0]
    assert np.linalg.norm(place[:3] - pose[:3, 3]) == pytest.approx(0.012, abs=1e-6)


def test_open_doors_leave_each_other_alone(models):
    for door in DOORS:
        others = [s for other in DOORS if other != door
                  for s in geometry.shapes(models[other], OPEN)]
        for shape in geometry.shapes(models[door], OPEN):
            assert geometry.gaps(shape, others).min() > 0.1


@pytest.mark.parametrize("floor", [0, 1])
def test_furniture_and_robot_overlap_nothing(models, floor):
    kinds = {m for room in plan.FURNITURE.values() for m, *_ in room} | {"turtlebot"}
    kinds |= {m for m, *_ in plan.APPLIANCES.values()}
    opened = {door for door in DOORS if door in plan.OPEN_DOORS}
    for model in models.values():
        if model.source not in kinds or not on_floor(model, floor):
            continue
        others = geometry.nearby(solids(models, opened, without={model.name}),
                                 model.pose[:3, 3], 3.0)
        for shape in geometry.shapes(model):
            gap = geometry.gaps(shape, others)
            nearest = int(gap.argmin())
            least = 1e-4 if not model.static else -1e-9
            assert gap[nearest] > least, (shape.full_name, others[nearest].full_name)


@pytest.mark.parametrize("height", [0.0, 0.5, 2.0, 3.7, 4.0])
def test_elevator_rides_clear_of_the_shaft(models, height):
    others = solids(models, without={"elevator"})
    for doors in (0.0, 0.52):
        positions = {"lift": height, "cabin_door_left": doors, "cabin_door_right": doors}
        positions |= {f"landing_door_{floor}_{side}": doors for floor in (0, 1)
                      for side in ("left", "right")}
        for shape in geometry.shapes(models["elevator"], positions):
            gap = geometry.gaps(shape, others)
            nearest = int(gap.argmin())
            assert gap[nearest] > 0.004, (shape.name, others[nearest].full_name)


def test_elevator_parts_keep_apart(models):
    for height in (0.0, 1.3, 4.0):
        for doors in (0.0, 0.26, 0.52):
            parts = geometry.shapes(models["elevator"],
                                    {"lift": height, "cabin_door_left": doors,
                                     "cabin_door_right": doors})
            for shape in parts:
                others = [s for s in parts if s.link != shape.link]
                assert geometry.gaps(shape, others).min() > 0.003, (height, doors, shape.name)


@pytest.mark.parametrize("floor", [0, 1])
def test_gap_into_the_cabin_is_small_and_level(models, floor):
    z = floor * plan.STOREY
    inside = solids(models, without={"elevator"}) + geometry.shapes(
        models["elevator"], {"lift": z, "cabin_door_left": 0.52, "cabin_door_right": 0.52,
                             "landing_door_0_left": 0.52, "landing_door_0_right": 0.52,
                             "landing_door_1_left": 0.52, "landing_door_1_right": 0.52})
    for y in (4.6, 5.0, 5.4):
        x = np.arange(-4.3, -0.2, 0.001)
        start = np.stack([x, np.full_like(x, y), np.full_like(x, z + 0.3)], 1)
        ranges, _ = geometry.cast(start, np.tile([0.0, 0.0, -1.0], (len(x), 1)), inside, 10.0)
        missing = np.abs(ranges - 0.3) > 1e-6
        assert 0 < missing.sum() <= 20


@pytest.mark.parametrize("floor", [0, 1])
def test_shut_landing_doors_guard_the_shaft(models, floor):
    z, away = floor * plan.STOREY, (1 - floor) * plan.STOREY
    there = solids(models, without={"elevator"})
    there += geometry.shapes(models["elevator"], {"lift": away})
    y, height = np.meshgrid(np.arange(4.51, 5.5, 0.0311), np.arange(0.03, 2.0, 0.1))
    start = np.stack([np.full(y.size, -2.0), y.ravel(), z + height.ravel()], 1)
    ranges, hits = geometry.cast(start, np.tile([-1.0, 0.0, 0.0], (len(start), 1)), there, 5.0)
    assert {there[k].link for k in hits} == {f"landing_door_{floor}_left_panel",
                                             f"landing_door_{floor}_right_panel"}
    assert ranges.max() < 0.8


@pytest.mark.parametrize("floor", [0, 1])
def test_floor_has_no_holes(models, floor):
    z = floor * plan.STOREY
    slab = geometry.shapes(models[f"apartment{floor}"])
    x, y = np.meshgrid(np.arange(-2.64, 9.95, 0.0473), np.arange(0.06, 9.55, 0.0473))
    x, y = x.ravel(), y.ravel()
    inside = (x > 0.06) | ((x < -0.06) & (y > 3.36) & (y < 6.64))
    start = np.stack([x, y, np.full_like(x, z + 0.01)], 1)[inside]
    ranges, hits = geometry.cast(start, np.tile([0.0, 0.0, -1.0], (len(start), 1)), slab, 5.0)
    walls = np.array([not shape.link.startswith("floor") for shape in slab])
    on_wall = (hits >= 0) & walls[hits]
    start_in_wall = ranges > 0.011
    assert not (start_in_wall & ~on_wall).any()
    assert (np.abs(ranges - 0.01) < 1e-9).mean() > 0.9


def reachable(models, radius: float, floor: int) -> set[str]:
    """Returns the rooms that a disc gets to from the landing, all doors open, by grid steps."""
    z, step = floor * plan.STOREY, 0.05
    opened = [door for door in DOORS if door.endswith(str(floor))]
    xs, ys = np.arange(-2.6, 9.96, step), np.arange(0.06, 9.56, step)
    grid = np.stack(np.meshgrid(xs, ys, indexing="ij"), -1).reshape(-1, 2)
    free = np.ones(len(grid), bool)
    for shape in solids(models, opened, without={"turtlebot", "elevator"}):
        low, high = geometry.span_z(shape)
        if high > z + 0.02 and low < z + 1.8:
            free &= geometry.footprint_distance(grid, shape) >= radius
    free = free.reshape(len(xs), len(ys))
    start = (int((-1.3 - xs[0]) / step), int((5.0 - ys[0]) / step))
    assert free[start]
    seen, queue = {start}, deque([start])
    while queue:
        i, j = queue.popleft()
        for near in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
            if (0 <= near[0] < len(xs) and 0 <= near[1] < len(ys) and free[near]
                    and near not in seen):
                seen.add(near)
                queue.append(near)
    points = np.array([(xs[i], ys[j]) for i, j in seen])
    return {room for room, (x0, y0, x1, y1) in plan.ROOMS.items()
            if (np.hypot(points[:, 0] - (x0 + x1) / 2, points[:, 1] - (y0 + y1) / 2) < 1.2).any()}


@pytest.mark.parametrize("radius", [0.18, 0.25, 0.4])
@pytest.mark.parametrize("floor", [0, 1])
def test_every_room_is_reachable(models, radius, floor):
    assert reachable(models, radius, floor) == set(ROOMS)


@pytest.mark.parametrize("door", DOORS)
def test_strip_cuts_the_beam_only_when_shut(models, door):
    switch = models[door.replace("_door", "_switch")]
    origins, directions, reach = geometry.ray_fan(*geometry.sensor_pose(switch))
    assert len(origins) == 2 and reach == 0.5
    others = geometry.nearby(solids(models, without={door}), switch.pose[:3, 3], 3.0)
    for angle in (0.001, 0.0, -0.002):
        strip = geometry.shapes(models[door], {"hinge": angle})
        ranges, _ = geometry.cast(origins, directions, others + strip, reach)
        assert (ranges < 0.2).all(), angle
    for angle in (-0.0175, -0.2, -0.8, -1.57):
        strip = geometry.shapes(models[door], {"hinge": angle})
        ranges, _ = geometry.cast(origins, directions, others + strip, reach)
        assert (ranges == reach).all(), angle


@pytest.mark.parametrize("floor", [0, 1])
@pytest.mark.parametrize("room", ROOMS)
def test_pirs_see_their_own_room(models, room, floor):
    low, high = room_bounds(room, floor)
    middle = (low + high) / 2
    shut = geometry.nearby(solids(models), middle, 7.0)
    for suffix in "ab":
        pir = models[f"{room}_pir{floor}_{suffix}"]
        origins, directions, reach = geometry.ray_fan(*geometry.sensor_pose(pir))
        ranges, _ = geometry.cast(origins, directions, shut, reach)
        ends = origins + ranges[:, None] * directions
        assert ((ends > low - 0.11) & (ends < high + 0.11)).all()
        assert np.median(ranges) > 1.5 and (ranges > 0.3).all()


@pytest.mark.parametrize("room", ROOMS)
def test_light_stays_behind_a_shut_door(models, room):
    low, high = room_bounds(room, 0)
    x, y = plan.LAMPS[room]
    count = 10_000
    k = np.arange(count) + 0.5
    up, turn = 1 - 2 * k / count, np.pi * (1 + 5 ** 0.5) * k
    flat = np.sqrt(1 - up ** 2)
    directions = np.stack([flat * np.cos(turn), flat * np.sin(turn), up], 1)
    origins = np.tile([x, y, plan.CEILING - 0.35], (count, 1))
    near = geometry.nearby(solids(models), origins[0], 6.0)
    ranges, _ = geometry.cast(origins, directions, near, 30.0)
    ends = origins + ranges[:, None] * directions
    outside = ((ends < low - 0.11) | (ends > high + 0.11)).any(axis=1)
    assert outside.mean() < 0.002


def test_luminosity_sensors_face_away_from_the_lamp_and_into_the_room(models):
    for floor in (0, 1):
        for room in ROOMS:
            sensor, pose = geometry.sensor_pose(models[f"{room}_lux{floor}"])
            lamp = models[f"{room}_lamp{floor}"].pose[:3, 3] - [0, 0, 0.35]
            to_lamp = lamp - pose[:3, 3]
            angle = np.arccos(pose[:3, 0] @ to_lamp / np.linalg.norm(to_lamp))
            assert angle > float(sensor.findtext("camera/horizontal_fov")) / 2 + 0.1
            ahead, _ = geometry.cast(pose[None, :3, 3], pose[None, :3, 0], solids(models), 10.0)
            assert ahead[0] > 1.5


def waypoints() -> list[tuple[float, np.ndarray]]:
    """Returns the person's waypoints as (t in s, x y z roll pitch yaw)."""
    actor = etree.parse(str(geometry.WORLDS / "angen.world")).find(".//actor[@name='person']")
    return [(float(w.findtext("time")), np.array([float(v) for v in w.findtext("pose").split()]))
            for w in actor.iterfind(".//waypoint")]


def test_person_walks_a_closed_round_at_one_metre_a_second():
    points = waypoints()
    assert np.allclose(points[0][1][:3], points[-1][1][:3])
    for (t0, p0), (t1, p1) in pairwise(points):
        assert t1 > t0 and p0[2] == p1[2] == 0.0
        speed = hypot(*(p1 - p0)[:2]) / (t1 - t0)
        assert speed == pytest.approx(1.0, abs=0.01) or speed == 0.0


def test_person_passes_all_with_room_to_spare(models):
    state = etree.parse(str(geometry.WORLDS / "angen.world")).find(".//state")
    opened = {m.get("name") for m in state.iterfind("model")}
    path = np.array([p0[:2] + (p1 - p0)[:2] * f for (_, p0), (_, p1) in pairwise(waypoints())
                     for f in np.linspace(0, 1, 200)])
    for shape in solids(models, opened):
        low, high = geometry.span_z(shape)
        if high > 0.02 and low < 1.9:
            assert geometry.footprint_distance(path, shape).min() > 0.35, shape.full_name
    visited = {room for room, (x0, y0, x1, y1) in plan.ROOMS.items()
               if ((path[:, 0] > x0) & (path[:, 0] < x1)
                   & (path[:, 1] > y0) & (path[:, 1] < y1)).any()}
    assert len(visited) >= 4 and {f"{room}_door0" for room in visited} >= opened


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
