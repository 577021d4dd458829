"""Draws a world as an architect's plan, to scale, floors side by side."""
from dataclasses import dataclass, field
from math import cos, pi, sin
from pathlib import Path
from typing import Any, Callable, Sequence

import numpy as np

from angen_apps.plan import overlays
from angen_apps.plan.names import stem
from angen_apps.plan.outlines import Leaf, Shape, leaves_of, shapes_of, shut
from angen_apps.plan.symbols import SYMBOLS
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure
from angen_tools.common.files import pyplot, save_figure
from angen_tools.common.geometry import local, turned
from angen_tools.common.home import Door, Home, Room, Storey, Thing

CUT = 1.1  # m above a floor at which walls are cut
TALL = 1.7  # m: a shape that ends higher than this over the floor is a wall
INCH = 0.9  # most paper for a meter
WIDEST = 24.0  # inches
MARGIN = 1.0  # m around a storey
DPI = 130
TINTS = {'kitchen': '#fdf0d8', 'bedroom': '#e8eefa', 'bathroom': '#dff2f2', 'living': '#f3f0e4',
         'hall': '#efefef', 'work': '#e9f3e4', 'landing': '#e6e6e6', 'outdoor': '#e4f1dc'}
Axes = Sequence[tuple[Any, Storey]]  # one pair for each storey
INK, GRAY, THIN = '#222222', '#8a8a8a', 0.7


@dataclass
class Scene:
    """A world, read for drawing."""

    path: Path
    home: Home
    shapes: list[Shape]
    leaves: list[Leaf]
    entities: list[Any]
    fields: dict[tuple[str, str], tuple[float, float, float]]  # fields of view, by kind and name
    things: dict[str, Thing] = field(default_factory=dict)

    def drawn(self) -> list[Storey]:
        """The storeys that have rooms."""
        return [storey for storey in self.home.storeys
                if any(room.storey == storey.number for room in self.home.rooms)]

    def pose_of(self, name: str) -> tuple[float, float, float] | None:
        """x y z of a device, a sensor, a thing or a model of that name."""
        if name in self.things:
            return self.things[name].pose[:3]
        for _, entity, model, (x, y, z, *_) in self.entities:
            if name in (entity, model):
                return float(x), float(y), float(z)
        return None


def read_scene(path: Path) -> Scene:
    """Loads a world; Failure if it cannot be loaded or has no room."""
    angen = angen_module()
    try:
        world = angen.World(str(path))
    except angen.Error as error:
        raise Failure(str(error)) from None
    home = Home.of_world(world)
    if not home.rooms:
        raise Failure(f'{path}: has no rooms, named or guessed, to draw')
    entities = list(world.entities())
    shut(world)  # a field of view ends at its room's doors
    people = {model for kind, _, model, _ in entities if kind == 'person'}
    shapes = [shape for shape in shapes_of(world) if shape.model not in people]
    fields = {(kind, name): field for kind, name, _, _ in entities
              if kind in overlays.WITH_FIELD and (field := world.field_of_view(kind, name))}
    return Scene(path, home, shapes, leaves_of(world, shapes), entities, fields,
                 {thing.name: thing for thing in home.things})


def read_running(copy: Path) -> Scene:
    """The world of the running simulator, of which it writes a copy."""
    from angen_tools.live.spawn import save
    save(copy)
    return read_scene(copy)


def draw(path: Path, output: Path, what: overlays.What,
         placed: Callable[[Axes], None] = lambda _: None) -> dict[str, Any]:
    """Draws a world's plan as SVG or PNG, by the ending of `output`; returns the result. `placed`
    is called with the axes before it is written."""
    kind = output.suffix.lower().lstrip('.')
    if kind not in ('svg', 'png'):
        raise Failure(f'{output}: must end in .svg or .png')
    scene = read_scene(path)
    data = overlays.read(what, scene.entities)
    with pyplot().rc_context({'svg.hashsalt': 'angen', 'svg.fonttype': 'none', 'font.size': 8}):
        figure, axes = sheet(scene, scene.drawn())
        for axis, storey in axes:
            overlays.draw(axis, scene, storey, data, what)
        placed(axes)
        metadata = {'Date': None} if kind == 'svg' else {'Software': None}
        save_figure(figure, output, format=kind, dpi=DPI, metadata=metadata)
    counts = {'floors': len(axes), 'rooms': len(scene.home.rooms),
              'doors_and_windows': len(scene.home.doors)}
    return {'file': str(output), **counts,
            'text': f'wrote {output}: {len(axes)} floor{"s"[:len(axes) > 1]}, '
                    f'{counts["rooms"]} rooms, {counts["doors_and_windows"]} doors and windows'}


def sheet(scene: Scene, storeys: Sequence[Storey], below: float = 0.0
          ) -> tuple[Any, list[tuple[Any, Storey]]]:
    """A figure of storeys side by side, and the axes of each. At the foot of the figure `below`
    inches are left for a tool's own."""
    extents = [extent(scene, storey) for storey in storeys]
    widths = [e[1] - e[0] for e in extents]
    high = max(e[3] - e[2] for e in extents)
    inch = min(INCH, WIDEST / sum(widths))
    tall = high * inch + 0.6 + below
    figure, axes = pyplot().subplots(1, len(storeys), squeeze=False, width_ratios=widths,
                                     figsize=(sum(widths) * inch, tall))
    for axis, storey, each in zip(axes[0], storeys, extents):
        middle = (each[2] + each[3]) / 2
        draw_storey(axis, scene, storey, inch)
        axis.set_ylim(middle - high / 2, middle + high / 2)
        axis.set_title(storey.name, fontsize=9, parse_math=False)
    _scale_and_north(axes[0][0], scene.home.north)
    figure.subplots_adjust(0.005, 0.005 + below / tall, 0.995, 1 - 0.35 / tall, 0.02)
    return figure, list(zip(axes[0], storeys))


def extent(scene: Scene, storey: Storey) -> tuple[float, float, float, float]:
    """West, east, south and north edge of a storey's drawing, m."""
    points = np.array([p for room in scene.home.rooms if room.storey == storey.number
                       for p in room.polygon])
    for elevator in scene.home.elevators:
        points = np.vstack([points, np.array([elevator.pose[:2]]) + 1, np.array(
            [elevator.pose[:2]]) - 1])
    west, south = points.min(axis=0) - MARGIN
    east, north = points.max(axis=0) + MARGIN
    return float(west), float(east), float(south), float(north)


def draw_storey(axis: Any, scene: Scene, storey: Storey, inch: float | None) -> None:
    """Draws a storey on axes; without `inch` of paper for a meter its rooms have no names and no
    tints, so that a tool can draw a map of its own under its walls (zorder 2 and less)."""
    west, east, south, north = extent(scene, storey)
    axis.set_xlim(west, east)
    axis.set_ylim(south, north)
    axis.set_aspect('equal')
    axis.axis('off')
    rooms = [room for room in scene.home.rooms if room.storey == storey.number]
    for room in rooms if inch else ():
        axis.fill(*zip(*room.polygon), color=TINTS.get(room.use, '#f6f6f6'), lw=0, zorder=1)
    if any(shape.type == 'mesh' for shape in scene.shapes):
        _draw_section(axis, scene, storey)
    leaves = [leaf for leaf in scene.leaves if is_on(leaf.bottom, storey)]
    hung = {leaf.model for leaf in leaves}
    for shape in scene.shapes:
        if shape.model not in hung:
            _draw_solid(axis, scene, storey, shape)
    for thing in scene.home.things:
        _draw_thing(axis, scene, storey, thing)
    for door in scene.home.doors:
        if door.kind == 'window' and is_on(door.pose[2], storey):
            _draw_window(axis, door)
    for leaf in leaves:
        _draw_leaf(axis, leaf)
    if inch:
        for room in rooms:
            _label(axis, room, inch)
    for elevator in scene.home.elevators:
        for landing in elevator.landings:
            if landing.storey == storey.number:
                x, y = elevator.pose[:2]
                axis.plot([x - .7, x + .7], [y - .7, y + .7], color=GRAY, lw=THIN, zorder=5)
                axis.plot([x - .7, x + .7], [y + .7, y - .7], color=GRAY, lw=THIN, zorder=5)


def _draw_section(axis: Any, scene: Scene, storey: Storey) -> None:
    """The outline of a storey's shapes that are not boxes, such as meshes, found by rays."""
    from angen_apps.maps.gridmap import OCCUPIED, load_world, make_map
    grid = make_map(load_world(str(scene.path)), storey.number)
    shade = np.zeros((*grid.cells.shape, 4))
    shade[grid.cells == OCCUPIED] = (0.3, 0.3, 0.3, 1.0)
    limits = axis.get_xlim(), axis.get_ylim()
    axis.imshow(shade, origin='lower', extent=grid.extent, zorder=2.5, interpolation='none')
    axis.set_xlim(*limits[0])
    axis.set_ylim(*limits[1])


def is_on(z: float, storey: Storey) -> bool:
    """Whether a height belongs to a storey, and not to its ceiling."""
    return storey.elevation - 0.3 <= z < storey.elevation + storey.height - 0.3


def _draw_solid(axis: Any, scene: Scene, storey: Storey, shape: Shape) -> None:
    """Walls are black, lower shapes are outlines; things have symbols of their own."""
    thing = scene.things.get(shape.model)
    cut = storey.elevation + CUT
    is_building = not shape.moves and shape.type != 'mesh' and thing is None
    if is_building and shape.link.startswith(('window_', 'door_')):
        if not is_on(shape.bottom, storey):
            return
        axis.fill(*zip(*shape.corners), color='#4a7fb5', lw=0, zorder=6)  # a pane or a fixed leaf
    elif is_building and shape.tilted:  # drawn like a roof: lines above the cut
        if is_on(shape.bottom, storey):
            axis.fill(*zip(*shape.corners), facecolor='none', edgecolor=GRAY, lw=THIN, ls=':',
                      zorder=6)
    elif is_building and shape.bottom < cut < shape.top and shape.top > storey.elevation + TALL:
        axis.fill(*zip(*shape.corners), color=INK, lw=0, zorder=6)
    elif is_building and _is_low(shape, storey, 0.3):
        axis.fill(*zip(*shape.corners), facecolor='white', edgecolor=GRAY, lw=THIN, zorder=3)


def _is_low(shape: Shape, storey: Storey, least: float) -> bool:
    """Whether a shape is on the floor of a storey and higher than a step."""
    return (storey.elevation - 0.15 < shape.bottom < storey.elevation + CUT
            and shape.top > storey.elevation + least and shape.top - shape.bottom > 0.02)


def _draw_thing(axis: Any, scene: Scene, storey: Storey, thing: Thing) -> None:
    parts = [shape for shape in scene.shapes if shape.model == thing.name
             and storey.elevation - 0.15 < shape.bottom < storey.elevation + 1.8]
    if not parts or thing.type in ('lamp', 'window'):
        return
    if all(part.bottom > storey.elevation + 1.3 for part in parts):
        style = {'ls': ':', 'facecolor': 'none'}  # above the cut
    else:
        style = {'facecolor': 'white'}
    turn = 2 * np.arctan2(thing.pose[5], thing.pose[6])
    own = np.array([local(thing.pose[:2], turn, at) for part in parts for at in part.corners])
    low, high = own.min(axis=0), own.max(axis=0)
    middle, half = (low + high) / 2, (high - low) / 2

    def place(line: list[tuple[float, float]]) -> Any:
        return zip(*(turned(thing.pose[:2], turn, *at) for at in np.array(line) * half + middle))

    outline = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
    if len(parts) == 1 and parts[0].type in ('cylinder', 'sphere'):
        outline = [(cos(a), sin(a)) for a in np.linspace(0, 2 * pi, 24)]
    axis.fill(*place(outline), edgecolor=INK, lw=THIN, zorder=4, **style)
    for line in SYMBOLS.get(thing.type, []):
        axis.plot(*place(line), color=GRAY if 'ls' in style else INK, lw=THIN * 0.8, zorder=4.5)


def _draw_window(axis: Any, door: Door) -> None:
    x, y, _, yaw = door.pose
    for away in (-0.07, 0.0, 0.07):
        axis.plot(*zip(*(turned((x, y), yaw, side * door.width / 2, away) for side in (-1, 1))),
                  color='#4a7fb5', lw=THIN, zorder=7, solid_capstyle='butt')


def _draw_leaf(axis: Any, leaf: Leaf) -> None:
    if leaf.hinge is None:
        axis.fill(*zip(*leaf.outlines[-1]), facecolor='none', edgecolor=GRAY, lw=0.5, ls=':',
                  zorder=7)
        axis.fill(*zip(*leaf.outlines[0]), facecolor='white', edgecolor=INK, lw=THIN, zorder=7)
        return
    color, path = '#4a7fb5' if leaf.window else INK, leaf.path
    axis.plot(*zip(leaf.hinge, path[-1]), color=color, lw=0.6 if leaf.window else 1.4, zorder=7)
    axis.plot(*zip(*path), color=color, lw=0.5, zorder=7)


def _label(axis: Any, room: Room, inch: float) -> None:
    """The room's name and area at the point of it that is farthest from its walls."""
    x, y, away = _inner_point(room)
    west, south, east, north = room.bounds
    text = (stem(room.name) or room.name).replace('_', ' ')
    wide = 0.065 * max(len(text), 7) / inch  # m of 8 points
    size = 8 if wide < max(2 * away, 0.6 * (east - west)) else 5.5
    axis.text(x, y, f'{text}{"?" if room.guessed else ""}\n{room.area:.1f} m²', ha='center',
              va='center', fontsize=size, zorder=9, color='#333333', linespacing=1.1,
              parse_math=False, bbox={'facecolor': 'white', 'alpha': 0.65, 'lw': 0, 'pad': 0.6})


def _inner_point(room: Room) -> tuple[float, float, float]:
    west, south, east, north = room.bounds
    best = (*room.polygon[0], -1.0)
    for x in np.linspace(west, east, 18)[1:-1]:
        for y in np.linspace(south, north, 18)[1:-1]:
            if room.contains(x, y) and (away := room.distance(x, y)) > best[2] + 1e-9:
                best = (float(x), float(y), away)
    return best


def _scale_and_north(axis: Any, north: float) -> None:
    west, east = axis.get_xlim()
    south = axis.get_ylim()[0]
    length = 1.0 if east - west < 12 else 2.0
    x, y = west + 0.2, south + 0.2
    for i in range(2):
        axis.fill([x + i * length / 2, x + (i + 1) * length / 2] * 1 + [
            x + (i + 1) * length / 2, x + i * length / 2], [y, y, y + 0.07, y + 0.07],
            facecolor=INK if i == 0 else 'white', edgecolor=INK, lw=THIN, zorder=10)
    axis.text(x + length, y + 0.1, f'{length:g} m', fontsize=7, ha='center', va='bottom')
    cx, cy, r = west + length + 0.9, south + 0.45, 0.28
    dx, dy = cos(north), sin(north)
    axis.fill([cx + r * dx, cx - r * dx * 0.6 - r * dy * 0.5, cx - r * dx * 0.25,
               cx - r * dx * 0.6 + r * dy * 0.5],
              [cy + r * dy, cy - r * dy * 0.6 + r * dx * 0.5, cy - r * dy * 0.25,
               cy - r * dy * 0.6 - r * dx * 0.5], color=INK, lw=0, zorder=10)
    axis.text(cx + 1.35 * r * dx, cy + 1.35 * r * dy, 'N', fontsize=7, ha='center', va='center',
              zorder=11)
