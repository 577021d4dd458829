"""Writes a plan as a world in SDF that people can read and edit."""
from contextlib import ExitStack
from dataclasses import replace
from math import pi
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Iterable

from lxml import etree

from angen_apps.plan import sensors as rules
from angen_apps.plan.doors import GLASS, OAK, Hung, leaf_model
from angen_apps.plan.drawing import Drawing, drawing_of, kept
from angen_apps.plan.finish import beside_box, room_at, sides
from angen_apps.plan.furnish import obstacles, piece_model
from angen_apps.plan.lifts import add_lift, around_pits
from angen_apps.plan.names import Names, apart, line_of, slug, stem, with_number
from angen_apps.plan.model import Lamp, Mover, Opening, Plan, Room, Storey
from angen_apps.plan.slabs import Slabs, slabs
from angen_apps.plan.travel import Obstacle, hang
from angen_apps.plan.walls import Box, boxes
from angen_models.sdf import (ANGEN, Part, add, add_home, add_link, add_plugin, add_pose, new_model,
                              numbers, spanned)
from angen_models.world import add_world_plugins, comment, include, new_world
from angen_tools.common.catalog import angen_module, simulator
from angen_tools.common.files import make_folder, write_text
from angen_tools.common.geometry import turned
from angen_tools.world import sdf

SUNK = 0.02  # m that walls reach into the floor: no light passes below
STEP_DOWN = 0.005  # m from the lowest floor to the ground
PIT = 0.15  # m, the same where a lift needs room below its cabin
AROUND, GROUND = 6.0, (0.5, 0.5, 0.5)  # m of ground around a home with lifts, and its color
ROOF = 0.1  # m, thickness of a ceiling without a storey above
UNDER_TOP = 0.006  # m that ceilings begin below the walls' tops
PANE = 0.02  # m, thickness of a pane that does not open
AIR = {'temperature_sensor', 'humidity_sensor', 'heater'}  # models that need the air of rooms
WARM = 20  # °C to which radiators heat rooms
INSIDE = 0.02  # m from a wall's face to the source of daylight
FLOOR_THICK = 0.2  # m of the lowest floor
ELEMENTS, PARTS = 8000, 200  # XML elements of a building, boxes of a link; more are divided
ROBOT, ABOVE = 'turtlebot', 0.01  # m over the floor, on its wheels
SEATS = ('chair', 'sofa', 'armchair', 'bed')


def write_world(plan: Plan, path: Path, sensors: str = 'seed', drawn: Drawing | None = None
                ) -> dict[str, int]:
    """Writes the world with its drawing, and the meshes in a folder beside it; returns counts of
    its parts. `drawn`: the drawing from which the plan was made, if it was drawn."""
    folder = path.with_name(f'{path.stem}_meshes')
    for storey in plan.storeys:
        storey.pieces = [replace(piece, mesh=f'{folder.name}/{piece.mesh}')
                         if piece.mesh in plan.meshes else piece for piece in storey.pieces]
    drawn = drawn or drawing_of(plan, sensors)
    root, counts = world_of(plan, sensors)
    if plan.meshes:
        make_folder(folder)
    for name, text in plan.meshes.items():
        write_text(folder / name, text)
    _write_checked(path, kept(f'<?xml version="1.0"?>\n{sdf.text(root)}', drawn))
    return counts


def _write_checked(path: Path, text: str) -> None:
    """Writes a world that the simulator can load; Failure, and no world, if it cannot."""
    is_device = path.exists() and not path.is_file()  # a pipe, or /dev/null
    target = path if is_device else path.resolve()
    with ExitStack() as stack:
        folder = Path(stack.enter_context(TemporaryDirectory())) if is_device else target.parent
        part = folder / f'.{target.name}.part'
        stack.callback(part.unlink, missing_ok=True)
        write_text(part, text)
        with simulator('the plan makes a world that cannot be read again: '):
            angen_module().World(str(part))
        write_text(path, text)


def written(path: Path, counts: dict[str, int]) -> dict[str, Any]:
    """The result of writing a world, for angen_tools.common.output.show_done."""
    words = ', '.join(f'{number} {name if number != 1 else name[:-1]}'
                      for name, number in counts.items() if number)
    return {'file': str(path), **counts, 'text': f'wrote {path}: {words}'}


def world_of(plan: Plan, sensors: str) -> tuple[etree._Element, dict[str, int]]:
    """The <sdf> of a plan, and counts of its parts."""
    root, world = new_world(plan.name)
    root, world = _with_namespace(root)
    _lower_ground(world, plan)
    add_world_plugins(world)
    _add_home(world, plan)
    counts = dict.fromkeys(('floors', 'rooms', 'walls', 'doors', 'windows', 'openings', 'lamps',
                            'pieces', 'lifts'), 0)
    made = slabs(plan)
    opened: list[tuple[Hung, str]] = []
    shut: set[str] = set()
    for storey in plan.storeys:
        comment(world, storey.name)
        leaves = _add_storey(world, plan, storey, made[storey.number], sensors, counts, opened)
        shut |= {hung.name for hung in leaves if not hung.opens}
    _add_own(world, plan)
    for lift in plan.lifts:
        add_lift(world, plan, lift)
        counts['lifts'] += 1
    _add_state(world, opened)
    if plan.entrance in shut:
        plan.entrance = next((name for name in plan.entrances if name not in shut), plan.entrance)
        world.find(f'{{{ANGEN}}}home/{{{ANGEN}}}entrance').text = plan.entrance
    return root, counts


def _add_own(world: etree._Element, plan: Plan) -> None:
    """The sensors, people and robots that the plan has itself."""
    names = Names()
    for element in world.xpath('model/@name | include/name/text()'):
        names.take(element)
    for storey in plan.storeys:
        for sensor in storey.sensors:
            room = room_at(storey, (sensor.x, sensor.y))
            text = f'{stem(room.name)}_' if room is not None else ''
            text = slug(sensor.name or f'{text}{sensor.model}', 'sensor')
            include(world, sensor.model, names.take(text, storey.number),
                    (sensor.x, sensor.y, sensor.z, 0, sensor.pitch, sensor.yaw))
        for mover in storey.movers:
            name = names.take(slug(mover.name, mover.kind))
            if mover.kind == 'robot':
                include(world, ROBOT, name, (mover.x, mover.y, storey.elevation + ABOVE, 0, 0,
                                             mover.yaw))
            else:
                _add_person(world, mover, name, storey.elevation)


def _add_person(world: etree._Element, mover: Mover, name: str, floor: float) -> None:
    """A person who stands at a place until a command."""
    script = add(add(world, 'actor', name=name), 'script')
    waypoint = add(add(script, 'trajectory', id='0', type='walking'), 'waypoint')
    add(waypoint, 'time', 0)
    add(waypoint, 'pose', numbers(mover.x, mover.y, floor, 0, 0, mover.yaw))


def _with_namespace(root: etree._Element) -> tuple[etree._Element, etree._Element]:
    """The document with xmlns:angen declared once, at <sdf>."""
    made = etree.Element(root.tag, dict(root.attrib), nsmap={'angen': ANGEN})
    made.set('version', '1.9')
    made.extend(list(root))
    return made, made.find('world')


def _lower_ground(world: etree._Element, plan: Plan) -> None:
    """The ground is below the lowest floor, and deeper below the cabins of lifts."""
    lowest = min((storey.elevation for storey in plan.storeys), default=0.0)
    ground = world.find("model[@name='ground_plane']")
    lower = lowest - (PIT if plan.lifts else STEP_DOWN)
    ground.find('pose').text = numbers(0, 0, round(lower, 4), 0, 0, 0)
    if plan.lifts:
        _, model = new_model('ground_around_lifts', static=True)
        _link(model, 'link', [spanned(f'ground_{i}', (w, s, lower), (e, n, lowest - STEP_DOWN),
                                      material=GROUND)
                              for i, (w, s, e, n) in enumerate(around_pits(plan, AROUND))])
        world.append(model)


def _add_home(world: etree._Element, plan: Plan) -> None:
    home = add_home(world, 'home')
    if plan.entrance:
        add_home(home, 'entrance', plan.entrance)
    add_home(home, 'north', round(plan.north, 6))
    if plan.latitude is not None:
        add_home(home, 'latitude', round(plan.latitude, 4))
    if plan.start:
        add_home(home, 'start', plan.start)


def _add_storey(world: etree._Element, plan: Plan, storey: Storey, made: Slabs, sensors: str,
                counts: dict[str, int], opened: list[tuple[Hung, str]]) -> list[Hung]:
    walls = boxes(storey.walls, storey.openings, SUNK)
    models = [(piece, piece_model(piece, sensors != 'none' and piece.thing in SEATS))
              for piece in storey.pieces]
    furniture = [obstacle for piece, model in models if model is not None
                 for obstacle in obstacles(model, f'the {piece.source or piece.name}')]
    leaves = hang(storey, walls, furniture, plan)
    counts['floors'] += 1
    counts['rooms'] += len(storey.rooms)
    counts['walls'] += sum(wall.part == 0 for wall in storey.walls)
    _add_building(world, plan, storey, made, walls, leaves)
    for hung in leaves:
        if not hung.opens:
            continue
        model = leaf_model(hung, sensors != 'none')
        world.append(model)
        if hung.opening.ajar:
            opened.append((hung, model.get('name')))
    for opening in storey.openings:
        counts[opening.kind + 's'] += 1
        if opening.kind == 'window' or opening.glazed:
            _add_daylight(world, storey, opening)
    for lamp in storey.lamps:
        world.append(_lamp_model(lamp))
        counts['lamps'] += 1
    for _, model in models:
        if model is not None:
            world.append(model)
            counts['pieces'] += 1
    if sensors != 'none':
        comment(world, f'{storey.name}: sensors')
        solids = [Obstacle('a wall', box.corners(), box.low[2], box.high[2]) for box in walls]
        for room in storey.rooms:
            if room.use != 'outdoor':
                rules.place(world, room, stem(room.name), str(storey.number),
                            solids + furniture, sensors)
    return leaves


def _add_building(world: etree._Element, plan: Plan, storey: Storey, made: Slabs,
                  walls: list[Box], leaves: list[Hung]) -> None:
    """The model of a level: rooms, floors, walls, ceilings, and fixed panes."""
    model = add(world, 'model', name=f'building{storey.number}')
    add(model, 'static', 'true')
    if storey.rooms:
        described = add_home(model, 'storey', name=line_of(storey.name) or f'Floor {storey.number}',
                             number=str(storey.number))
        add_home(described, 'elevation', round(storey.elevation, 4))
        add_home(described, 'height', round(storey.height, 4))
    for room in storey.rooms:
        _add_room(model, room)
    models = {sensor.model for sensor in storey.sensors} | {piece.model for piece in storey.pieces}
    if storey.rooms and models & AIR:
        add_plugin(model, 'climate', 'libroom_climate.so', heating=WARM,
                   device_name=with_number('home', storey.number))
    for opening in storey.openings:
        if opening.kind == 'opening' and not opening.filled:
            _add_passage(model, storey, opening)
    lowest = storey.elevation <= min(s.elevation for s in plan.storeys) + 1e-6
    thick = FLOOR_THICK if lowest else storey.slab
    for name, areas in made.floors.items():
        color = next((room.color for room in storey.rooms if room.name == name), (0.6, 0.58, 0.55))
        _link(model, f'floor_{stem(name)}' if name else 'floor', [spanned(
            f'floor_{i}', (w, s, storey.elevation - thick), (e, n, storey.elevation),
            material=color) for i, (w, s, e, n) in enumerate(areas)])
    _add_walls(model, storey, walls)
    _link(model, 'ceiling', [spanned(
        f'ceiling_{i}', (w, s, round(z - UNDER_TOP, 4)), (e, n, round(z - UNDER_TOP + ROOF, 4)))
        for i, (z, (w, s, e, n)) in enumerate(made.ceilings)])
    panes = [(f'{opening.kind}_{opening.name}', _pane(opening))
             for opening in storey.openings if opening.glass]
    panes += [(f'{hung.opening.kind}_{hung.name}', _fixed_leaf(hung))
              for hung in leaves if not hung.opens]
    for name, part in panes:
        _link(model, name, [part])
    if model.find('link') is None:  # a level with furniture only
        world.remove(model)
    _divide(world, model)


def _divide(world: etree._Element, model: etree._Element) -> None:
    """Moves links of a model that is larger than the simulator reads into further ones."""
    whole, links = model, model.findall('link')
    size = sum(1 for _ in model.iter()) - sum(1 for link in links for _ in link.iter())
    for link in links:
        own = sum(1 for _ in link.iter())
        if size + own > ELEMENTS:
            size = 0
            model = add(world, 'model', name=f'{whole.get("name")}_{len(world)}')
            add(model, 'static', 'true')
        if model is not whole:
            model.append(link)
        size += own


def _add_room(model: etree._Element, room: Room) -> None:
    element = add_home(model, 'room', name=room.name)
    add_home(element, 'use', room.use)
    for tag, points in [('polygon', room.polygon),
                        *(('hole', hole) for hole in room.holes)]:
        add_home(element, tag, '  '.join(numbers(round(x, 4), round(y, 4)) for x, y in points))
    add_home(element, 'floor', round(room.floor, 4))
    add_home(element, 'ceiling', round(room.ceiling, 4))


def _add_passage(model: etree._Element, storey: Storey, opening: Opening) -> None:
    x, y = opening.point(0.0, sum(opening.band) / 2)
    element = add_home(model, 'opening', name=opening.name)
    add_home(element, 'pose', numbers(round(x, 4), round(y, 4), round(opening.bottom, 4),
                                      round(opening.yaw, 5)))
    add_home(element, 'width', round(opening.width, 4))
    add_home(element, 'height', round(opening.top - opening.bottom, 4))


def _link(model: etree._Element, name: str, parts: list[Part]) -> None:
    for i in range(0, len(parts), PARTS):
        add_link(model, f'{name}_{i // PARTS}' if i else name, parts[i:i + PARTS], moves=False)


def _add_walls(model: etree._Element, storey: Storey, walls: list[Box]) -> None:
    """One link for all boxes between the same two rooms."""
    links: dict[str, list[Part]] = {}
    for box in walls:
        x, y, z = box.middle
        wide, deep, high = box.size
        along = box.yaw if wide >= deep else box.yaw + pi / 2
        name = 'wall_' + '_'.join(beside_box(storey, (x, y), along, min(wide, deep) / 2))
        parts = links.setdefault(name, [])
        parts.append(Part(f'wall_{len(parts)}', tuple(round(v, 5) for v in box.size),
                          (round(x, 5), round(y, 5), round(z, 5)),
                          (0, 0, round(box.yaw, 6)), material=box.color))
    for name, parts in sorted(links.items()):
        _link(model, name, parts)


def _pane(opening: Opening) -> Part:
    x, y = opening.point(0.0, sum(opening.band) / 2)
    return Part(
        'pane', (opening.width, PANE, opening.top - opening.bottom),
        (round(x, 5), round(y, 5), round((opening.top + opening.bottom) / 2, 5)),
        (0, 0, round(opening.yaw, 6)), material=GLASS)


def _fixed_leaf(hung: Hung) -> Part:
    bottom, top = hung.heights
    away = hung.thick / 2 * (1 if hung.turn <= 0 else -1)
    x, y = turned(hung.hinge, hung.yaw, hung.width / 2, away)
    return Part(
        'leaf', (round(hung.width, 5), hung.thick, round(top - bottom, 5)),
        (round(x, 5), round(y, 5), round((top + bottom) / 2, 5)), (0, 0, round(hung.yaw, 6)),
        material=GLASS if hung.opening.kind == 'window' or hung.opening.glazed else OAK)


def _add_daylight(world: etree._Element, storey: Storey, opening: Opening) -> None:
    """A source of daylight on the room's side of a window to the outside."""
    outer, inner = sides(opening, storey)
    is_out = [room is None or room.use == 'outdoor' for room in (outer, inner)]
    if is_out[0] == is_out[1]:
        return
    v = opening.band[1] + INSIDE if is_out[0] else opening.band[0] - INSIDE
    yaw = opening.yaw + (pi / 2 if is_out[0] else -pi / 2)
    x, y = opening.point(0.0, v)
    wide, high = opening.width * 0.9, (opening.top - opening.bottom) * 0.9
    at, number = apart(opening.name)
    at += '_door' if opening.kind == 'door' else ''
    name = f'{at}_daylight{number}'
    _, model = new_model(name, static=True)
    add_pose(model, (round(x, 5), round(y, 5),
                     round((opening.bottom + opening.top) / 2, 5)), (0, 0, round(yaw, 6)))
    light = add(add(model, 'link', name='pane'), 'light', name='sky', type='point')
    add(light, 'direction', '1 0 0')
    add_home(light, 'rectangle', numbers(round(wide, 3), round(high, 3)))
    add_plugin(model, 'daylight', 'libdaylight_plugin.so',
                      device_name=with_number(at, int(number or 0)), area=round(wide * high, 4))
    world.append(model)


def _lamp_model(lamp: Lamp) -> etree._Element:
    _, model = new_model('{}_lamp{}'.format(*apart(lamp.name)), static=True)
    add_pose(model, (round(lamp.x, 4), round(lamp.y, 4), round(lamp.z, 4)))
    link = add_link(model, 'lamp', [Part(
        'bulb', (0.05,), material=lamp.color, collide=False, emissive=True)], moves=False)
    light = add(link, 'light', name='bulb', type='point')
    add(light, 'diffuse', numbers(*lamp.color, 1))
    add_plugin(model, 'lamp_controller', 'libros_plugin.so', device_name=lamp.name,
                      luminous_flux=round(lamp.flux, 1), level=0)
    return model


def _add_state(world: etree._Element, opened: Iterable[tuple[Hung, str]]) -> None:
    opened = list(opened)
    if not opened:
        return
    state = add(world, 'state', world_name=world.get('name'))
    for hung, name in opened:
        model = add(state, 'model', name=name)
        add(model, 'pose', numbers(*(round(v, 5) for v in hung.hinge),
                                   round(hung.heights[0], 5), 0, 0,
                                   round(hung.yaw, 6)))
        joint = add(model, 'joint', name='sash' if hung.opening.kind == 'window'
                           else 'hinge')
        add(joint, 'angle', round(hung.turn, 4), axis='0')
