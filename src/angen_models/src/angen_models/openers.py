"""Parts that open besides doors: sashes of windows, fronts of furniture. Each has a reed contact.

A leaf's frame is on its hinge at its foot: x along the shut leaf, it opens towards -y. A flap's
hinge is its foot, along x.
"""
from dataclasses import dataclass
from math import cos, pi, sin
from pathlib import Path

from lxml import etree

from angen_models import plan
from angen_models.catalog import REED_GAP, STEEL, add_reed
from angen_models.furniture import CERAMIC, CREAM, OAK
from angen_models.sdf import (Color, Part, add, add_fixed, add_joint, add_link, add_plugin,
                              add_thing, new_model, spanned, write_model)

GLASS: Color = (0.55, 0.68, 0.8)
GLASS_DENSITY = 20.0    # kg/m2 of a sash: two panes of 3 mm at 2500 kg/m3, and its frame
SASH_THICK = 0.04
GAP = 0.002             # m between a shut leaf and the frame behind it
# yaw of a sash in an outer wall: its -y is the room's side
INWARDS = {"wall_south": pi, "wall_north": 0.0, "wall_east": -pi / 2, "wall_west": pi / 2}
# gains in those of a PID for a leaf of 1 kg m2: of 1 Hz, damped
GAIN = {"p": 40.0, "i": 40.0, "d": 8.0}

Rectangle = tuple[float, float, float, float]   # start, end along the wall, bottom, top
Pose = tuple[float, float, float, float, float, float]


@dataclass(frozen=True)
class Front:
    """The front of a piece of furniture: its size in m, mass in kg, and looks in its own frame."""
    title: str
    width: float
    height: float
    thick: float
    mass: float
    color: Color
    looks: tuple[Part, ...] = ()
    flap: bool = False          # its hinge is along its foot, and springs balance its weight
    open: float = -1.57         # rad


def fronts() -> dict[str, Front]:
    """Returns the fronts of furniture by model name."""
    def handle(x: float, z: float, wide: float, high: float) -> Part:
        return spanned("handle", (x, -0.03, z), (x + wide, 0.0, z + high), material=STEEL,
                       collide=False)

    def rows(count: int, width: float, height: float) -> tuple[Part, ...]:
        step = height / count
        return tuple(spanned(f"row_{i}", (0.02, -0.008, i * step),
                             (width - 0.02, 0.0, (i + 1) * step - 0.02), material=OAK,
                             collide=False) for i in range(count))

    return {
        "fridge_door": Front("Fridge door", 0.64, 1.17, 0.05, 9.0, CERAMIC,
                             (handle(0.58, 0.7, 0.02, 0.35),)),
        "freezer_door": Front("Freezer door", 0.64, 0.61, 0.05, 5.0, CERAMIC,
                              (handle(0.58, 0.1, 0.02, 0.35),)),
        "oven_door": Front("Oven door", 0.5, 0.45, 0.03, 4.0, (0.12, 0.12, 0.14),
                           (handle(0.05, 0.4, 0.4, 0.02),), flap=True),
        "wardrobe_door": Front("Wardrobe door", 0.52, 2.02, 0.02, 12.0, OAK,
                               (handle(0.48, 0.9, 0.02, 0.2),)),
        "counter_door": Front("Counter door", 0.596, 0.77, 0.018, 5.0, CREAM,
                              (handle(0.54, 0.55, 0.02, 0.15),)),
        "cabinet_door": Front("Cabinet door", 0.8, 1.14, 0.018, 10.0, CREAM,
                              rows(4, 0.8, 1.14)),
        "shoe_flap": Front("Shoe cabinet flap", 0.9, 0.42, 0.018, 4.0, CREAM,
                           rows(1, 0.9, 0.42), flap=True, open=-0.7),
    }


def span(sash: plan.Sash) -> Rectangle:
    """Returns a sash's edges."""
    rises = INWARDS[sash.wall] in (0.0, pi / 2)
    start = sash.hinge if rises else sash.hinge - sash.width
    return (start, start + sash.width, sash.bottom, sash.top)


def opening(sash: plan.Sash) -> Rectangle:
    """Returns the opening that a sash shuts."""
    start, end, bottom, top = span(sash)
    lap = plan.SASH_LAP
    return (round(start + lap, 6), round(end - lap, 6), round(bottom + lap, 6),
            round(top - lap, 6))


def panes(window: Rectangle, sash: plan.Sash) -> list[Rectangle]:
    """Returns the parts of a window beside, under and over its sash."""
    start, end, bottom, top = window
    left, right, low, high = span(sash)
    gap = 2 * GAP
    left, right, low, high = left - gap, right + gap, low - gap, high + gap
    rest = [(start, left, bottom, top), (right, end, bottom, top),
            (max(start, left), min(end, right), bottom, low),
            (max(start, left), min(end, right), high, top)]
    return [r for r in rest if r[1] - r[0] > 0.02 and r[3] - r[2] > 0.02]


def sash_pose(sash: plan.Sash, floor: int) -> Pose:
    """Returns the pose of a sash on a floor."""
    wall = next(wall for wall in plan.WALLS if wall.name == sash.wall)
    yaw = INWARDS[sash.wall]
    away = plan.WALL / 2 + GAP + SASH_THICK     # from the wall's axis to the hinge, into the room
    x, y = (sash.hinge, wall.at) if wall.axis == "x" else (wall.at, sash.hinge)
    return (x + away * sin(yaw), y - away * cos(yaw), sash.bottom + floor * plan.STOREY,
            0.0, 0.0, yaw)


def front_pose(piece: Pose, place: tuple[float, float, float]) -> Pose:
    """Returns the pose of a front, by its hinge's place in the frame of its piece."""
    yaw = piece[5]
    x, y, z = place
    return (piece[0] + x * cos(yaw) - y * sin(yaw), piece[1] + x * sin(yaw) + y * cos(yaw),
            piece[2] + z, 0.0, 0.0, yaw + pi / 2)


def write_openers(models: Path) -> None:
    """Writes models/<room>_window and a model for each front under models."""
    for room, sash in plan.SASHES.items():
        _write_sash(models, room, sash)
    for name, front in fronts().items():
        _write_front(models, name, front)


def _write_sash(models: Path, room: str, sash: plan.Sash) -> None:
    width, height = sash.width, sash.top - sash.bottom
    mass = round(GLASS_DENSITY * width * height, 1)
    pane = spanned("pane", (0.0, 0.0, 0.0), (width, SASH_THICK, height), mass=mass, material=GLASS)
    handle = spanned("handle", (width - 0.05, -0.05, height / 2 - 0.06),
                     (width - 0.025, 0.0, height / 2 + 0.06), material=STEEL, collide=False)
    root, model = new_model(f"{room}_window")
    base = add_link(model, "base", [_reed_housing(width, SASH_THICK, height)])
    _add_reed(base, "pane", width, SASH_THICK, height)
    add_fixed(model, "base_to_world", "world", "base")
    add_link(model, "pane", [pane, handle])
    _add_hinge(model, "sash", "pane", False, -1.57, 200)
    add_plugin(model, "window_controller", "libdoor_world_plugin.so",
               height=round(height - 2 * plan.SASH_LAP, 6), **_gains(mass * width ** 2 / 3))
    add_thing(model, "window")
    title = f"{room.replace('_', ' ').capitalize()} window"
    write_model(root, models, title,
                f"A sash of {width:g} x {height:.4g} m, {mass:g} kg, with a reed contact; opens "
                "from 0 to -1.57 rad towards its -y. Served by libdoor_world_plugin.so.")


def _write_front(models: Path, name: str, front: Front) -> None:
    panel = spanned("panel", (0.0, 0.0, 0.0), (front.width, front.thick, front.height),
                    mass=front.mass, material=front.color)
    root, model = new_model(name)
    base = add_link(model, "base", [_reed_housing(front.width, front.thick, front.height)])
    _add_reed(base, "panel", front.width, front.thick, front.height)
    add_fixed(model, "base_to_world", "world", "base")
    link = add_link(model, "panel", [panel, *front.looks])
    if front.flap:
        add(link, "gravity", "false")
    _add_hinge(model, "front", "panel", front.flap, front.open, 50)
    reach = front.height if front.flap else front.width
    add_plugin(model, "cabinet_controller", "libdoor_world_plugin.so", open_position=front.open,
               brake_torque=1, latch_torque=10, edge_force_max=40, width=reach,
               **_gains(front.mass * reach ** 2 / 3))
    write_model(root, models, front.title,
                f"A {'flap' if front.flap else 'leaf'} of {front.width:g} x {front.height:g} m, "
                f"{front.mass:g} kg, with a reed contact; opens from 0 to {front.open:g} rad "
                "towards its -y. Served by libdoor_world_plugin.so.")


def _gains(inertia: float) -> dict[str, float]:
    return {key: round(gain * inertia, 2) for key, gain in GAIN.items()}


# Magnet and reed are near the corner that moves farthest; the magnet is on the leaf's back.
def _magnet(width: float, thick: float, height: float) -> tuple[float, float, float]:
    return (round(width - 0.05, 6), thick, round(height - 0.05, 6))


def _reed_housing(width: float, thick: float, height: float) -> Part:
    x, y, z = _magnet(width, thick, height)
    return spanned("reed", (x - 0.02, y + REED_GAP - 0.004, z - 0.006),
                   (x + 0.02, y + REED_GAP + 0.008, z + 0.006), mass=0.01, collide=False)


def _add_reed(base: etree._Element, leaf: str, width: float, thick: float, height: float) -> None:
    x, y, z = _magnet(width, thick, height)
    add_reed(base, (x, round(y + REED_GAP, 6), z), leaf, (x, y, z))


def _add_hinge(model: etree._Element, name: str, child: str, flap: bool, low: float, effort: float
               ) -> None:
    add_joint(model, name, "revolute", "base", child, (-1, 0, 0) if flap else (0, 0, 1),
              limits={"lower": low, "upper": 0.001, "effort": effort, "velocity": 3},
              dynamics={"damping": 0.05, "friction": 0.05})
