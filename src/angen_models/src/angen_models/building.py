"""The apartment and its six doors."""
from dataclasses import replace
from pathlib import Path
from typing import Any

from lxml import etree

from angen_models import openers, plan
from angen_models.sdf import (Part, Vector, add, add_fixed, add_home, add_joint, add_link,
                              add_plugin, add_pose, new_model, numbers, spanned, write_model)

FLOOR_MATERIAL = "Gazebo/Wood"
WALL_MATERIAL = "Gazebo/White"
SUNK = 0.05     # walls start inside the floor slab, so that no hair of light passes below


def _wall_box(wall: plan.Wall, name: str, start: float, end: float, bottom: float, top: float,
              **options: Any) -> Part:
    """Returns a box through the wall, and `stands_out` beyond both faces (m)."""
    half = plan.WALL / 2 + options.pop("stands_out", 0.0)
    if wall.axis == "x":
        low, high = (start, wall.at - half), (end, wall.at + half)
    else:
        low, high = (wall.at - half, start), (wall.at + half, end)
    return spanned(name, (*low, bottom), (*high, top), **options)


def wall_parts(wall: plan.Wall) -> list[Part]:
    """Returns the boxes of one wall: pieces between openings, and a lintel over each."""
    parts: list[Part] = []

    def piece(name: str, start: float, end: float, bottom: float, top: float = wall.top) -> None:
        parts.append(_wall_box(wall, name, start, end, bottom, top, material=WALL_MATERIAL))

    start = wall.start
    holes = sorted(openers.opening(sash) for sash in plan.SASHES.values() if sash.wall == wall.name)
    for i, (low, high, bottom, top) in enumerate(holes):
        piece(f"{wall.name}_{i}", start, low, -SUNK)
        piece(f"{wall.name}_sill_{i}", low, high, -SUNK, bottom)
        piece(f"{wall.name}_lintel_{i}", low, high, top)
        start = high
    if holes:
        piece(f"{wall.name}_{len(holes)}", start, wall.end, -SUNK)
        return parts
    for i, opening in enumerate(wall.openings):
        piece(f"{wall.name}_{i}", start, opening, -SUNK)
        start = opening + plan.OPENING_WIDTH
        piece(f"{wall.name}_lintel_{i}", opening, start, plan.OPENING_HEIGHT)
    last = f"{wall.name}_{len(wall.openings)}" if wall.openings else wall.name
    piece(last, start, wall.end, -SUNK)
    return parts


def slab_parts() -> list[Part]:
    """Returns floors and ceilings: one of each a room and landing, and the landing's edge."""
    parts = []
    spaces = {**plan.ROOMS, "landing": plan.LANDING}
    west, south, east, north = -0.05, -0.05, 10.05, 9.65
    for name, (x0, y0, x1, y1) in spaces.items():
        if name == "landing":
            x0, y0, x1, y1 = x0 - 0.05, y0 - 0.05, west, y1 + 0.05
        else:
            x0, x1 = (west if x0 == 0.0 else x0), (east if x1 == 10.0 else x1)
            y0, y1 = (south if y0 == 0.0 else y0), (north if y1 == 9.6 else y1)
        parts.append(spanned(f"floor_{name}", (x0, y0, -plan.SLAB), (x1, y1, 0.0),
                             material=FLOOR_MATERIAL))
        parts.append(spanned(f"ceiling_{name}", (x0, y0, plan.CEILING),
                             (x1, y1, plan.CEILING + 0.1), material=WALL_MATERIAL))
    _, y0, x1, y1 = plan.SHAFT
    parts.append(spanned("floor_landing_edge", (plan.LANDING_EDGE, y0, -plan.SLAB), (x1, y1, 0.0),
                         material="Gazebo/Grey"))
    return parts


def shaft_parts() -> list[Part]:
    """Returns three shaft walls as high as the floor, flush from floor to floor."""
    x0, y0, x1, y1 = plan.SHAFT
    bottom, top, thick = -plan.SLAB, plan.WALL_TOP, plan.WALL
    return [
        spanned("shaft_back", (x0 - thick, y0 - thick, bottom), (x0, y1 + thick, top)),
        spanned("shaft_south", (x0, y0 - thick, bottom), (x1, y0, top)),
        spanned("shaft_north", (x0, y1, bottom), (x1, y1 + thick, top)),
    ]


def window_parts() -> list[tuple[str, list[Part]]]:
    """Returns the panes that do not open, 1 cm out of the outer walls, of each window."""
    walls = {(wall.axis, wall.at): wall for wall in plan.WALLS if wall.top == plan.WALL_TOP}
    sashes = {sash.window: sash for sash in plan.SASHES.values()}
    windows = []
    for name, (x, y, length, axis, bottom, top) in plan.WINDOWS.items():
        middle, at = (x, y) if axis == "x" else (y, x)
        whole = (middle - length / 2, middle + length / 2, bottom, top)
        panes = openers.panes(whole, sashes[name]) if name in sashes else [whole]
        parts = [_wall_box(walls[axis, at], f"{name}_{i}", *pane, stands_out=0.01,
                           material=openers.GLASS) for i, pane in enumerate(panes)]
        if parts:
            windows.append((name, parts))
    return windows


def _centered(parts: list[Part]) -> tuple[Vector, list[Part]]:
    """Returns the place of the first part, and all parts as seen from there."""
    at = parts[0].at
    return at, [replace(part, at=tuple(round(a - b, 6) for a, b in zip(part.at, at)))
                for part in parts]


def apartment_links() -> list[tuple[str, list[Part]]]:
    """Returns name and boxes of each link of the apartment with its landing and shaft."""
    links = [(part.name, [part]) for part in slab_parts()]
    for wall in plan.WALLS:
        parts = wall_parts(wall)
        has_window = any(sash.wall == wall.name for sash in plan.SASHES.values())
        links += [(wall.name, parts)] if has_window else [(part.name, [part]) for part in parts]
    links += [(part.name, [part]) for part in shaft_parts()]
    return links + window_parts()


def add_rooms(model: etree._Element) -> None:
    """Appends the rooms between the faces of their walls, each once a storey."""
    half = plan.WALL / 2
    for name, (x0, y0, x1, y1) in (*plan.ROOMS.items(), ("landing", plan.LANDING)):
        x0, y0, x1, y1 = x0 + half, y0 + half, x1 - half, y1 - half
        room = add_home(model, "room", name=f"{name}{{storey}}")
        add_home(room, "use", plan.USES[name])
        add_home(room, "polygon", numbers(x0, y0, x1, y0, x1, y1, x0, y1))
        add_home(room, "ceiling", plan.CEILING)


def write_apartment(models: Path) -> None:
    """Writes models/apartment; its origin is at floor level, so flats stack every 4 m."""
    root, model = new_model("apartment", static=True)
    for name, parts in apartment_links():
        at, local = _centered(parts)
        add_link(model, name, local, at=at, moves=False)
    add_plugin(model, "climate", "libroom_climate.so", outside_temperature=5)
    add_rooms(model)
    write_model(root, models, "Apartment",
                "One storey: entrance, five rooms, landing and elevator shaft. "
                "Stack at z = 0, 4, 8 ...")


# room: leaf's color, panel's color
LOOKS = {
    "entrance": ((0.36, 0.2, 0.1), (0.28, 0.15, 0.07)),
    "kitchen": ((0.93, 0.9, 0.8), (0.85, 0.8, 0.66)),
    "livingroom": ((0.62, 0.42, 0.24), (0.75, 0.82, 0.86)),
    "bedroom": ((0.82, 0.74, 0.62), (0.74, 0.64, 0.5)),
    "workroom": ((0.45, 0.5, 0.55), (0.36, 0.41, 0.46)),
    "bathroom": ((0.86, 0.9, 0.93), (0.7, 0.8, 0.86)),
}
LEAF_WIDTH, LEAF_THICK, LEAF_TOP = 0.99, 0.04, 2.095


def _leaf(room: str) -> list[Part]:
    leaf_color, panel_color = LOOKS[room]
    panels = []
    for i, (bottom, top) in enumerate(((0.2, 0.9), (1.2, 1.95))):
        panels.append(spanned(f"panel_{i}", (0.17, -0.003, bottom), (0.82, LEAF_THICK + 0.003, top),
                              material=panel_color, collide=False))
    return [
        spanned("block", (0.0, 0.0, 0.005), (LEAF_WIDTH, LEAF_THICK, LEAF_TOP),
                material=leaf_color, mass=20.0),
        # upright in front of the lintel: cuts the optical switch's beam when the door is shut
        spanned("strip", (0.35, -0.01, 2.06), (0.65, 0.0, 2.14), material="Gazebo/Green",
                mass=0.05),
        *panels,
    ]


def _handle(side: float) -> list[Part]:
    steel = (0.75, 0.75, 0.78)
    return [
        Part("rose", (0.04, 0.04, 0.16), (0.0, side * 0.02, 0.0), material=steel, mass=0.15),
        Part("lever", (0.13, 0.02, 0.02), (-0.045, side * 0.045, 0.02), material=steel, mass=0.15),
    ]


def _frame() -> list[Part]:
    """Returns the trim round the opening on both wall faces; looks only."""
    parts = []
    for face, (y0, y1) in (("front", (0.003, 0.01)), ("back", (0.11, 0.117))):
        parts += [
            spanned(f"{face}_left", (-0.085, y0, 0.0), (-0.005, y1, 2.18)),
            spanned(f"{face}_right", (0.995, y0, 0.0), (1.075, y1, 2.18)),
            spanned(f"{face}_top", (-0.005, y0, 2.1), (0.995, y1, 2.18)),
        ]
    trim = (0.9, 0.88, 0.84)
    return [Part(p.name, p.size, p.at, material=trim, mass=0.2, collide=False) for p in parts]


def write_door(models: Path, room: str) -> None:
    """Writes models/<room>_door: origin on the hinge at floor level, x along the shut leaf."""
    root, model = new_model(f"{room}_door")
    add_link(model, "base", _frame())
    add_fixed(model, "base_to_world", "world", "base")
    add_link(model, "door", _leaf(room))
    add_joint(model, "hinge", "revolute", "base", "door", (0, 0, 1),
              limits={"lower": -1.57, "upper": 0.001, "effort": 200, "velocity": 3},
              dynamics={"damping": 0.2, "friction": 0.1})
    for name, side, y in (("handle_front", -1.0, 0.0), ("handle_back", 1.0, LEAF_THICK)):
        add_link(model, name, _handle(side), at=(0.92, y, 1.05))
        add_fixed(model, f"{name}_joint", "door", name)
    write_model(root, models, f"{room.capitalize()} door",
                "A hinged door, 0.99 x 2.09 m, 20 kg; opens from 0 to -1.57 rad towards its -y. "
                "Served by libdoor_world_plugin.so.")


def add_ground(parent: etree._Element) -> None:
    """Appends the ground as an inline model, level with the building's underside."""
    model = add(parent, "model", name="ground_plane")
    add(model, "static", "true")
    add_pose(model, (0, 0, -plan.SLAB))
    link = add(model, "link", name="link")
    for kind in ("collision", "visual"):
        shape = add(link, kind, name=kind)
        plane = add(add(shape, "geometry"), "plane")
        add(plane, "normal", "0 0 1")
        add(plane, "size", "100 100")
        if kind == "visual":
            script = add(add(shape, "material"), "script")
            add(script, "uri", "file://media/materials/scripts/gazebo.material")
            add(script, "name", "Gazebo/Grey")
