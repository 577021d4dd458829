"""Furniture. Every piece faces +x, its origin on the floor under its middle."""
from dataclasses import dataclass, replace
from math import pi
from pathlib import Path

from angen_models.devices import add_sensor, add_soil
from angen_models.sdf import (Color, Part, Place, Vector, add, add_link, add_plugin, add_thing,
                              new_model, spanned, write_model)

OAK: Color = (0.65, 0.47, 0.28)
DARK: Color = (0.35, 0.23, 0.14)
CREAM: Color = (0.92, 0.9, 0.86)
CERAMIC: Color = (0.96, 0.96, 0.96)
CLOTH: Color = (0.3, 0.4, 0.55)


@dataclass(frozen=True)
class Piece:
    """A piece of furniture; `touch` names the part whose contacts a sensor reports."""
    title: str
    parts: tuple[Part, ...]
    static: bool = True
    mesh: str | None = None         # file in its meshes/: then the parts are not shown
    color: Color | None = None      # color of an STL mesh, which has none of its own
    touch: str | None = None
    potted: bool = False            # a plant, whose soil dries


def legs(x: float, y: float, side: float, top: float, mass: float,
         color: Color) -> tuple[Part, ...]:
    """Returns four square legs whose outer corners are at (+-x, +-y)."""
    half = side / 2
    return tuple(
        spanned(f"leg_{name}", (sx * (x - half) - half, sy * (y - half) - half, 0.0),
                (sx * (x - half) + half, sy * (y - half) + half, top), mass=mass, material=color)
        for name, sx, sy in (("front_left", 1, 1), ("front_right", 1, -1),
                             ("back_left", -1, 1), ("back_right", -1, -1)))


def _table(length: float, width: float, height: float, mass: float, color: Color) -> Piece:
    """Returns a table, `length` along y and `width` along x (m), of `mass` kg with its legs."""
    top = spanned("top", (-width / 2, -length / 2, height - 0.04),
                  (width / 2, length / 2, height), mass=mass * 0.8, material=color)
    four = legs(width / 2 - 0.02, length / 2 - 0.02, 0.06, height - 0.04, mass * 0.05, color)
    return Piece("Table", (top, *four), static=False, touch="top")


def _chair() -> Piece:
    seat = spanned("seat", (-0.21, -0.21, 0.43), (0.21, 0.21, 0.47), mass=1.8)
    back = spanned("back", (-0.21, -0.2, 0.47), (-0.17, 0.2, 0.9), mass=1.2)
    four = legs(0.21, 0.21, 0.04, 0.43, 0.4, OAK)
    return Piece("Chair", (seat, back, *four), static=False, mesh="chair.dae", touch="seat")


def _desk() -> Piece:
    parts = (
        spanned("top", (-0.35, -0.75, 0.71), (0.35, 0.75, 0.74), mass=14.0, material=OAK),
        spanned("side_left", (-0.33, 0.7, 0.0), (0.33, 0.73, 0.71), mass=7.0, material=DARK),
        spanned("side_right", (-0.33, -0.73, 0.0), (0.33, -0.7, 0.71), mass=7.0, material=DARK),
        spanned("apron", (-0.33, -0.7, 0.4), (-0.31, 0.7, 0.71), mass=4.0, material=DARK),
    )
    return Piece("Desk", parts, static=False, touch="top")


def _bookshelf() -> Piece:
    colors: tuple[Color, ...] = ((0.6, 0.15, 0.12), (0.15, 0.3, 0.5), (0.2, 0.45, 0.25),
                                 (0.8, 0.65, 0.2))
    parts = [spanned("case", (-0.16, -0.6, 0.0), (-0.14, 0.6, 2.0), material=DARK)]
    for name, y in (("left", 0.585), ("right", -0.585)):
        parts.append(spanned(f"side_{name}", (-0.14, y - 0.015, 0.0), (0.16, y + 0.015, 2.0),
                             material=OAK))
    for i in range(6):
        z = 0.05 + i * 0.385
        parts.append(spanned(f"shelf_{i}", (-0.14, -0.57, z), (0.16, 0.57, z + 0.025),
                             material=OAK))
        if i < 5:
            start, width = -0.55 + 0.09 * i, 0.62 - 0.07 * i
            parts.append(spanned(f"books_{i}", (-0.13, start, z + 0.025),
                                 (0.09, start + width, z + 0.25), material=colors[i % 4]))
    return Piece("Bookshelf", tuple(parts))


def _case(low: Vector, high: Vector, thick: float, color: Color,
          dividers: tuple[float, ...] = (), shelves: tuple[float, ...] = ()) -> tuple[Part, ...]:
    """Returns a case that is open towards +x, with dividers at y and shelves at z."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    inside = ((x0 + thick, y0 + thick), (x1, y1 - thick))
    boxes = {
        "body": (low, (x0 + thick, y1, z1)),
        "left": ((inside[0][0], y1 - thick, z0), high),
        "right": ((inside[0][0], y0, z0), (x1, y0 + thick, z1)),
        "bottom": ((*inside[0], z0), (*inside[1], z0 + thick)),
        "top": ((*inside[0], z1 - thick), (*inside[1], z1)),
    }
    for i, y in enumerate(dividers):
        boxes[f"divider_{i}"] = ((inside[0][0], y - thick / 2, z0 + thick),
                                 (x1 - 0.005, y + thick / 2, z1 - thick))
    for i, z in enumerate(shelves):
        boxes[f"shelf_{i}"] = ((*inside[0], z), (x1 - 0.02, inside[1][1], z + thick))
    return tuple(spanned(name, *corners, material=color) for name, corners in boxes.items())


def _wardrobe() -> Piece:
    case = _case((-0.3, -0.8, 0.0), (0.278, 0.8, 2.1), 0.018, CREAM, dividers=(-0.265, 0.265))
    plinth = spanned("plinth", (0.25, -0.782, 0.018), (0.278, 0.782, 0.08), material=CREAM)
    return Piece("Wardrobe", (*case, plinth))


def _cabinet() -> Piece:
    case = _case((-0.22, -0.4, 0.0), (0.2, 0.4, 1.2), 0.018, CREAM, shelves=(0.4, 0.8))
    plinth = spanned("plinth", (0.18, -0.382, 0.018), (0.2, 0.382, 0.06), material=CREAM)
    return Piece("Cabinet", (*case, plinth))


def _shoe_cabinet() -> Piece:
    case = _case((-0.14, -0.45, 0.0), (0.12, 0.45, 0.9), 0.018, OAK, shelves=(0.462,))
    plinth = spanned("plinth", (0.1, -0.432, 0.018), (0.12, 0.432, 0.06), material=OAK)
    return Piece("Shoe cabinet", (*case, plinth))


def _fridge() -> Piece:
    case = _case((-0.325, -0.32, 0.0), (0.273, 0.32, 1.8), 0.04, CERAMIC,
                 shelves=(0.45, 0.8, 1.165))
    return Piece("Fridge", case)


def _drawers(title: str, depth: float, width: float, height: float, rows: int,
             color: Color) -> Piece:
    """Returns a chest whose drawer fronts are looks on one solid box."""
    half = width / 2
    parts = [spanned("body", (-depth / 2, -half, 0.0), (depth / 2, half, height), material=color)]
    step = (height - 0.06) / rows
    for i in range(rows):
        low = 0.05 + i * step
        parts.append(spanned(f"drawer_{i}", (depth / 2, -half + 0.02, low),
                             (depth / 2 + 0.008, half - 0.02, low + step - 0.02),
                             material=OAK, collide=False))
    return Piece(title, tuple(parts))


def _counter() -> Piece:
    case = _case((-0.3, -0.9, 0.0), (0.25, 0.9, 0.86), 0.018, CREAM, dividers=(-0.3, 0.3))
    parts = (
        *case,
        spanned("plinth", (0.2, -0.882, 0.018), (0.25, 0.882, 0.1), material=CREAM),
        spanned("worktop", (-0.3, -0.9, 0.86), (0.3, 0.9, 0.9), material=DARK),
        spanned("sink", (-0.18, -0.6, 0.9), (0.2, -0.1, 0.904), material=(0.6, 0.62, 0.65),
                collide=False),
        Part("tap", (0.015, 0.22), (-0.22, -0.35, 1.01), material=(0.75, 0.75, 0.78)),
    )
    return Piece("Kitchen counter", parts)


def _stove() -> Piece:
    plates = tuple(
        Part(f"plate_{i}", (0.085, 0.006), (x, y, 0.903), material=(0.1, 0.1, 0.1), same=True)
        for i, (x, y) in enumerate(((0.13, 0.14), (0.13, -0.14), (-0.13, 0.14), (-0.13, -0.14))))
    oven = _case((-0.3, -0.3, 0.15), (0.27, 0.3, 0.7), 0.04, (0.2, 0.2, 0.22), shelves=(0.38,))
    front = (
        spanned("drawer", (-0.3, -0.3, 0.0), (0.3, 0.3, 0.15), material=CERAMIC),
        spanned("top", (-0.3, -0.3, 0.7), (0.3, 0.3, 0.9), material=CERAMIC),
        *(spanned(f"front_{name}", (0.27, y0, z0), (0.3, y1, z1), material=CERAMIC)
          for name, y0, y1, z0, z1 in (("right", -0.3, -0.254, 0.15, 0.7),
                                       ("left", 0.254, 0.3, 0.15, 0.7),
                                       ("low", -0.254, 0.254, 0.15, 0.196),
                                       ("high", -0.254, 0.254, 0.656, 0.7))),
    )
    walls = (replace(part, name=f"oven_{part.name}") for part in oven)
    return Piece("Stove", (*front, *walls, *plates))


def _bed() -> Piece:
    parts = (
        spanned("frame", (-1.02, -0.8, 0.1), (1.02, 0.8, 0.3), material=DARK),
        spanned("head", (-1.02, -0.8, 0.3), (-0.98, 0.8, 1.0), material=DARK),
        spanned("mattress", (-0.98, -0.78, 0.3), (1.0, 0.78, 0.5), material=CREAM),
        spanned("blanket", (-0.3, -0.79, 0.5), (1.01, 0.79, 0.53), material=CLOTH),
        spanned("pillow_left", (-0.9, 0.1, 0.5), (-0.5, 0.7, 0.6)),
        spanned("pillow_right", (-0.9, -0.7, 0.5), (-0.5, -0.1, 0.6)),
        *(Part(f"foot_{i}", (0.04, 0.1), (x, y, 0.05), material=DARK)
          for i, (x, y) in enumerate(((0.95, 0.73), (0.95, -0.73), (-0.95, 0.73),
                                      (-0.95, -0.73)))),
    )
    return Piece("Bed", parts)


def _sofa(title: str, width: float, mesh: str) -> Piece:
    half = width / 2
    parts = (
        spanned("seat", (-0.25, -half + 0.18, 0.06), (0.45, half - 0.18, 0.45)),
        spanned("back", (-0.45, -half, 0.06), (-0.25, half, 0.85)),
        spanned("arm_left", (-0.25, half - 0.18, 0.06), (0.45, half, 0.62)),
        spanned("arm_right", (-0.25, -half, 0.06), (0.45, -half + 0.18, 0.62)),
    )
    return Piece(title, parts, mesh=mesh)


def _simple(title: str, low: Vector, high: Vector, color: Color, *looks: Part) -> Piece:
    return Piece(title, (spanned("body", low, high, material=color), *looks))


def pieces() -> dict[str, Piece]:
    """Returns all furniture by model name."""
    porthole = Part("porthole", (0.16, 0.01), (0.3, 0, 0.45), (0, 1.570796, 0),
                    material=(0.25, 0.27, 0.3), collide=False)
    return {
        "armchair": _sofa("Armchair", 0.86, "armchair.dae"),
        "bathtub": Piece("Bathtub", (
            spanned("bottom", (-0.37, -0.85, 0.0), (0.37, 0.85, 0.16)),
            spanned("front", (0.3, -0.85, 0.16), (0.37, 0.85, 0.56)),
            spanned("rear", (-0.37, -0.85, 0.16), (-0.3, 0.85, 0.56)),
            spanned("end_left", (-0.3, 0.75, 0.16), (0.3, 0.85, 0.56)),
            spanned("end_right", (-0.3, -0.85, 0.16), (0.3, -0.75, 0.56)),
        ), mesh="bathtub.stl", color=CERAMIC),
        "bed": _bed(),
        "bookshelf": _bookshelf(),
        "cabinet": _cabinet(),
        "chair": _chair(),
        "desk": _desk(),
        "dresser": _drawers("Dresser", 0.42, 1.0, 0.9, 3, CREAM),
        "fridge": _fridge(),
        "kitchen_counter": _counter(),
        "kitchen_table": _table(1.1, 0.75, 0.75, 20.0, OAK),
        "nightstand": _drawers("Nightstand", 0.38, 0.4, 0.5, 2, OAK),
        "plant": Piece("Potted plant", (
            Part("pot", (0.14, 0.26), (0, 0, 0.13)),
            Part("leaves", (0.19, 0.8), (0, 0, 0.72)),
        ), mesh="plant.dae", potted=True),
        "shoe_cabinet": _shoe_cabinet(),
        "sofa": _sofa("Sofa", 2.0, "sofa.dae"),
        "stove": _stove(),
        "table": _table(1.0, 0.6, 0.45, 12.0, DARK),
        "toilet": Piece("Toilet", (
            spanned("bowl", (-0.13, -0.18, 0.0), (0.32, 0.18, 0.42)),
            spanned("tank", (-0.32, -0.19, 0.0), (-0.13, 0.19, 0.82)),
        ), mesh="toilet.stl", color=CERAMIC),
        "tv_stand": _simple("TV stand", (-0.2, -0.7, 0.0), (0.18, 0.7, 0.5), DARK),
        "wardrobe": _wardrobe(),
        "washbasin": Piece("Wash basin", (
            spanned("basin", (-0.24, -0.3, 0.68), (0.24, 0.3, 0.86)),
            Part("pedestal", (0.09, 0.68), (-0.1, 0, 0.34)),
        ), mesh="washbasin.stl", color=CERAMIC),
        "washing_machine": _simple("Washing machine", (-0.3, -0.3, 0.0), (0.3, 0.3, 0.85),
                                   CERAMIC, porthole),
    }


def _stand(x: float, y: float = 0.0) -> Place:
    """Returns a place in front of a piece, facing it."""
    return Place("stand", x, y, 0.0, pi)


# piece: its thing, and the places at which people use it
THINGS: dict[str, tuple[str, tuple[Place, ...]]] = {
    "armchair": ("armchair", (Place("sit", 0.1, 0.0, 0.45, 0.0),)),
    "bathtub": ("bathtub", (Place("lie", 0.0, 0.0, 0.16, pi / 2), _stand(0.75))),
    "bed": ("bed", (Place("lie", 0.05, 0.39, 0.53, pi), Place("lie", 0.05, -0.39, 0.53, pi),
                    Place("sit", 0.1, 0.6, 0.53, pi / 2), Place("sit", 0.1, -0.6, 0.53, -pi / 2))),
    "bookshelf": ("bookshelf", (_stand(0.55),)),
    "cabinet": ("cabinet", (_stand(0.7),)),
    "chair": ("chair", (Place("sit", 0.0, 0.0, 0.47, 0.0),)),
    "desk": ("desk", (_stand(0.7),)),
    "dresser": ("dresser", (_stand(0.65),)),
    "fridge": ("fridge", (_stand(0.9),)),
    "kitchen_counter": ("sink", (_stand(0.65, -0.35),)),
    "kitchen_table": ("table", ()),
    "nightstand": ("nightstand", ()),
    "plant": ("plant", ()),
    "shoe_cabinet": ("cabinet", (_stand(0.65),)),
    "sofa": ("sofa", (Place("sit", 0.1, 0.5, 0.45, 0.0), Place("sit", 0.1, 0.0, 0.45, 0.0),
                      Place("sit", 0.1, -0.5, 0.45, 0.0), Place("lie", 0.1, 0.0, 0.45, pi / 2))),
    "stove": ("stove", (_stand(0.65),)),
    "table": ("table", ()),
    "toilet": ("toilet", (Place("sit", 0.1, 0.0, 0.42, 0.0),)),
    "tv_stand": ("cabinet", ()),
    "wardrobe": ("wardrobe", (_stand(0.85),)),
    "washbasin": ("sink", (_stand(0.55),)),
    "washing_machine": ("washing_machine", (_stand(0.65),)),
}
PLUGINS = {"stove": "libstove.so"}      # pieces that are devices


def write_piece(models: Path, name: str, piece: Piece) -> None:
    """Writes models/<name>: one link `body`, with a contact sensor where the piece has one."""
    root, model = new_model(name, static=piece.static)
    parts = list(piece.parts)
    if piece.mesh:
        parts = [Part(p.name, p.size, p.at, p.rpy, mass=p.mass, show=False) for p in parts]
        parts.append(Part("looks", mesh=f"model://{name}/meshes/{piece.mesh}",
                          material=piece.color))
    link = add_link(model, "body", parts, moves=not piece.static)
    if piece.touch:
        sensor = add_sensor(link, "contact", "contact", 1)
        add(add(sensor, "contact"), "collision", f"{piece.touch}_collision")
        add_plugin(sensor, "bumper", "libgazebo_ros_bumper.so", noise_stddev=0.05)
    if name in PLUGINS:
        plugin = add_plugin(model, name, PLUGINS[name])
        for plate in (p.name for p in parts if p.same):
            add(plugin, "plate_visual", f"{plate}_visual")
    if piece.potted:
        add_soil(model, link)
    kind, places = THINGS[name]
    add_thing(model, kind, *places)
    how = "" if piece.static else "; moves when pushed, reports contacts"
    write_model(root, models, piece.title, f"{piece.title}, faces +x{how}.")
