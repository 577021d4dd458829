"""Makes worlds of drawings, and says what is wrong with a home."""
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

from lxml import etree
from shapely.geometry import Polygon

from angen_apps.edit.coverage import coverage
from angen_apps.edit.habits import check_day
from angen_apps.imports.flood import rooms_of
from angen_apps.plan.drawing import Drawing, from_json
from angen_apps.plan.finish import finish
from angen_apps.plan.lifts import with_shafts
from angen_apps.plan.model import Plan, Room, Storey
from angen_apps.plan.names import stem
from angen_apps.plan.writer import world_of, write_world, written
from angen_tools.common.catalog import angen_module, simulator
from angen_tools.common.failure import Failure
from angen_tools.common.geometry import contains
from angen_tools.world import sdf

MODELS = ('pir', 'pir_casas', 'luminosity_sensor')  # sensors that rules place
CEILING = 2.5  # m, of a floor without walls
SAME = 0.5  # share of the smaller of two rooms that is in both, if they are one


def finished(drawing: Drawing) -> Plan:
    """The plan with the rooms between its walls, and all names."""
    plan = deepcopy(drawing.plan)
    with_shafts(plan)
    for storey in plan.storeys:
        top = max((wall.top - storey.elevation for wall in storey.walls), default=CEILING)
        found = rooms_of(storey, top, [((label.x, label.y), label.name)
                                       for label in storey.labels])
        storey.rooms += [_used(room, storey) for room in found
                         if not any(_is_same(room, other) for other in storey.rooms)
                         and not any(contains(room.polygon, lift.x, lift.y)
                                     for lift in plan.lifts if storey.number in lift.stops)]
    return finish(plan)


def _is_same(room: Room, other: Room) -> bool:
    one, two = (Polygon(each.polygon).buffer(0) for each in (room, other))
    return bool(one.intersection(two).area > SAME * min(one.area, two.area))


def _used(room: Room, storey: Storey) -> Room:
    """The room with the use that its label has."""
    use = next((label.use for label in storey.labels if label.name == room.name and label.use), '')
    return replace(room, use=use or room.use)


def survey(data: Any, floor: Any = None) -> dict[str, Any]:
    """Rooms, findings and remarks of a drawing, and what sensors see of the storey of a number;
    Failure if it cannot be a world."""
    drawing = from_json(data, 'the drawing')
    plan = finished(drawing)
    rooms = [{'storey': storey.number, 'name': stem(room.name), 'use': room.use,
              'polygon': room.polygon, 'holes': room.holes}
             for storey in plan.storeys for room in storey.rooms]
    root, counts = world_of(plan, drawing.sensors)
    ruled = _by_rules(root, plan)
    for piece in root.iter('mesh'):  # looks do not matter, and their files are elsewhere
        visual = piece.getparent().getparent()
        visual.getparent().remove(visual)
    with simulator('the drawing makes a world that cannot be read: '):
        world = angen_module().World.from_text(etree.tostring(root, encoding='unicode'))
    findings = [text.partition('; name it in <angen:')[0] for _, text in world.home_findings()
                if not text.startswith('no <angen:')] if rooms else []
    findings += _wrong_days(plan)
    return {'rooms': rooms, 'findings': findings, 'remarks': plan.remarks, 'counts': counts,
            'ruled': ruled, 'coverage': coverage(world, floor) if rooms else None}


def _wrong_days(plan: Plan) -> list[str]:
    """What is wrong with the days of people."""
    found = []
    for mover in (mover for storey in plan.storeys for mover in storey.movers if mover.day):
        try:
            check_day(mover)
        except Failure as failure:
            found.append(str(failure))
    return found


def _by_rules(root: etree._Element, plan: Plan) -> list[dict[str, Any]]:
    """The sensors that a world has beside the plan's own."""
    own = {(sensor.model, sensor.x, sensor.y) for storey in plan.storeys
           for sensor in storey.sensors}
    found = []
    for block in root.iterfind('world/include'):
        model = block.findtext('uri').removeprefix('model://')
        x, y, z, _, pitch, yaw = sdf.parse_pose(block.findtext('pose'))
        if model in MODELS and (model, x, y) not in own:
            storey = max((storey for storey in plan.storeys if storey.elevation <= z),
                         key=lambda storey: storey.elevation)
            found.append({'storey': storey.number, 'model': model, 'x': x, 'y': y, 'z': z,
                          'pitch': pitch, 'yaw': yaw})
    return found


def write(data: Any, path: Path) -> str:
    """Writes the world of a drawing; returns what it has."""
    drawing = from_json(data, 'the drawing')
    plan = finished(drawing)
    return str(written(path, write_world(plan, path, drawing.sensors, drawing))['text'])
