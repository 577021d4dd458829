"""Imports homes and examines them: counts, areas, rays, doors, rooms that a person reaches."""
import time
import zipfile
from dataclasses import dataclass
from math import cos, sin
from pathlib import Path
from typing import Any, Mapping, Sequence

import numpy as np
from lxml import etree

from angen_bench import plans
from angen_bench.free_map import CELL, free_map
from angen_bench.walks import walk
from angen_apps.plan.travel import LEAST_TURN
from angen_apps.plan.model import Plan
from angen_apps.plan.polygons import area, inside
from angen_apps.plan.writer import write_world
from angen_tools.common.failure import Failure
from angen_tools.common.files import writing
from angen_tools.common.output import table
from angen_tools.common.progress import Progress

JAR = Path('/usr/share/sweethome3d/sweethome3d.jar')
FOLDER = 'com/eteks/sweethome3d/io/resources/examples/'
ASIDE = 0.25  # m: a leaf that slides is written before either face of its wall
OPENING = 8.0  # s for all leaves to open


def examples() -> dict[str, bytes]:
    """The homes of Debian's package sweethome3d, by name."""
    if not JAR.exists():
        raise Failure(f'{JAR} is missing; apt install sweethome3d')
    with zipfile.ZipFile(JAR) as jar:
        return {name.removeprefix(FOLDER).removesuffix('.xml'): jar.read(name)
                for name in sorted(jar.namelist())
                if name.startswith(FOLDER) and name.endswith('.xml')}


@dataclass
class Imported:
    """A home that was imported: its plan, counts of the writer, and CPU seconds."""

    name: str
    plan: Plan
    path: Path
    counts: dict[str, int]
    seconds: float


def example_case(name: str, xml: bytes, folder: Path) -> plans.Case:
    """Writes NAME.xml into a folder."""
    path = folder / f'{name}.xml'
    with writing(path, binary=True) as file:
        file.write(xml)
    return plans.Case(name, path, in_file(xml), areas_in_file(xml), True)


def import_case(case: plans.Case, folder: Path) -> Imported:
    """Writes NAME.world into a folder."""
    path = folder / f'{case.name.replace(" ", "_")}.world'
    begin = time.process_time()
    plan = case.read()
    counts = write_world(plan, path, 'seed')
    return Imported(case.name, plan, path, counts, time.process_time() - begin)


def in_file(xml: bytes) -> dict[str, int]:
    """The numbers of parts in a home's file; parts without a size are not built."""
    root = etree.fromstring(xml)

    def has_size(element: etree._Element) -> bool:
        if element.tag == 'wall':
            ends = [float(element.get(key)) for key in ('xStart', 'yStart', 'xEnd', 'yEnd')]
            return abs(ends[0] - ends[2]) + abs(ends[1] - ends[3]) >= 0.5
        return True

    return {tag: sum(map(has_size, root.iter(tag)))
            for tag in ('wall', 'room', 'doorOrWindow', 'light', 'level', 'pieceOfFurniture')}


def in_world(imported: Imported) -> dict[str, int]:
    """The same counts of the world that was written."""
    counts = imported.counts
    return {'wall': counts['walls'], 'room': counts['rooms'],
            'doorOrWindow': counts['doors'] + counts['windows'] + counts['openings'] - sum(
                opening.source == 'passage' for opening in imported.plan.all_openings()),
            'light': counts['lamps'],
            'level': counts['floors'] if len(imported.plan.storeys) > 1 else 0,
            'pieceOfFurniture': counts['pieces']}


def areas_in_file(xml: bytes) -> list[float]:
    """Areas of the rooms, m2, of the file's points in cm."""
    return [area([(float(p.get('x')), float(p.get('y'))) for p in room.findall('point')]) / 1e4
            for room in etree.fromstring(xml).iter('room')]


def through(world: Any, plan: Plan) -> dict[str, bool]:
    """For each opening, whether a ray passes its middle from one face of the wall to the other."""
    names, origins, directions, reach = [], [], [], []
    for opening in plan.all_openings():
        low, high = opening.band[0] - 0.06, opening.band[1] + 0.06
        for leaf in opening.leaves:
            side = ASIDE if leaf.slide else 0.06
            low, high = min(low, leaf.hinge[1] - side), max(high, leaf.hinge[1] + side)
        # beside the middle of two leaves, where a gap is
        x, y = opening.point(0.1 * opening.width, low)
        names.append(opening.name + ' ' + opening.kind)
        origins.append((x, y, (opening.bottom + opening.top) / 2))
        directions.append((-sin(opening.yaw), cos(opening.yaw), 0.0))
        reach.append(high - low)
    if not names:
        return {}
    ranges = world.cast(np.array(origins), np.array(directions), np.array(reach))
    return {name: bool(r >= far - 1e-6) for name, r, far in zip(names, ranges, reach)}


def open_all(world: Any) -> dict[tuple[str, str], tuple[str, float, float]]:
    """Opens every door and window; mode, position and target of each."""
    for kind in ('door', 'window'):
        if world.devices(kind):
            world.command(kind, 'all', 'Open')
    world.run(OPENING)
    found = {}
    for kind in ('door', 'window'):
        for name in world.devices(kind):
            state = world.device(kind, name)
            found[kind, name] = (state['mode'], state['position'], state['target'])
    return found


def turns(plan: Plan) -> int:
    """The number of leaves of a plan that open."""
    return sum(abs(leaf.turn) >= LEAST_TURN or leaf.slide != 0
               for opening in plan.all_openings() for leaf in opening.leaves)


def reached(path: Path, home: Mapping[str, Any]) -> tuple[set[str], set[str]]:
    """Rooms of the main entrance's storey with a door or opening, and those that a person reaches.

    The map is made of the file's shapes by this function alone; leaves are out of the way.
    """
    entrance = next((d for d in home['doors'] if d['name'] == home['entrance']), None)
    if entrance is None:
        return set(), set()
    rooms = {room['name']: room for room in home['rooms']}
    floor = next(rooms[name]['floor'] for name in entrance['rooms'] if name)
    here = {name: room for name, room in rooms.items() if abs(room['floor'] - floor) < 0.3}
    joined = {name for door in home['doors'] if door['kind'] != 'window'
              for name in door['rooms'] if name in here}
    grid = free_map(path, floor)
    free = np.argwhere(grid.cells >= 0)
    near = np.abs(free - grid.cell(*entrance['pose'][:2])).sum(axis=1).argmin()
    rows, columns = np.nonzero(grid.cells == grid.cells[tuple(free[near])])
    return joined, {name for name, room in here.items() if CELL ** 2 * np.count_nonzero(
        inside(room['polygon'], grid.x[columns], grid.y[rows])) > 0.1}


def moved(world: Any, seconds: float) -> tuple[str, float]:
    """The link that moves farthest within a time without a command, and how far (m)."""
    before = np.array(world.link_poses)
    world.run(seconds)
    away = np.linalg.norm(np.array(world.link_poses)[:, :3] - before[:, :3], axis=1)
    worst = int(away.argmax())
    return world.links[worst], float(away[worst])


def cases(folder: Path, files: Sequence[Path] = ()) -> list[plans.Case]:
    """The nine homes, two scans and the files of the user."""
    return [*(example_case(name, xml, folder) for name, xml in examples().items()),
            *plans.scans(folder), *map(plans.given, files)]


def measure(folder: Path, files: Sequence[Path] = ()) -> list[dict[str, Any]]:
    """A row for each of the nine homes, for two scans and for each file of the user."""
    rows = []
    every = cases(folder, files)
    with Progress('homes', 0.0) as progress:
        for i, case in enumerate(every):
            progress.update(i / len(every), case.name)
            rows.append(examine(case, folder))
    return rows


def examine(case: plans.Case, folder: Path) -> dict[str, Any]:
    """Imports a plan and tries the world."""
    import angen

    imported = import_case(case, folder)
    plan, path = imported.plan, imported.path
    made = in_world(imported) if case.is_home else plans.in_plan(case, plan, imported.counts)
    world = angen.World(str(path))
    home = world.home
    errors = [abs(a - b) for a, b in zip(sorted(case.areas or []),
                                         sorted(room['area'] for room in home['rooms']))]
    link, away = moved(world, 60.0)
    shut = through(world, plan)
    states = open_all(world)
    opened = sum(mode == 'OPEN' for mode, _, _ in states.values())
    free = through(world, plan)
    joined, found = reached(path, home)
    walked = 'not tried'
    if case.is_home:
        passed, stopped = walk(path, home)
        print('\n'.join(f'{case.name}: {what}' for what in stopped))
        walked = f'{passed}/{passed + len(stopped)}'
    return {
        'plan': case.name, 'in file': '/'.join(map(str, case.said.values())) or 'unknown',
        'in world': '/'.join(map(str, made.values())), 'equal': case.said == made,
        'area m2': max(errors) if errors else 'unknown', 'opened': f'{opened}/{len(states)}',
        'fixed': sum(len(o.leaves) for o in plan.all_openings()) - len(states),
        'shut stops rays': sum(not v for v in shut.values()),
        'open lets rays': sum(free.values()), 'reached': f'{len(found & joined)}/{len(joined)}',
        'walked': walked, 'moved m': away, 'import s': imported.seconds,
        'factor': speed(path, home)}


def speed(path: Path, home: Mapping[str, Any]) -> float:
    """Simulated seconds a CPU second, with a person that walks to and fro in the largest room."""
    import angen
    room = max((r for r in home['rooms'] if r['use'] != 'outdoor'), key=lambda r: r['area'])
    x, y = np.array(room['polygon']).mean(axis=0)
    actor = f'''<actor name="walker"><script><loop>true</loop><auto_start>true</auto_start>
      <trajectory id="0" type="walk">
      <waypoint><time>0</time><pose>{x} {y} {room["floor"]} 0 0 0</pose></waypoint>
      <waypoint><time>2</time><pose>{x + 1} {y} {room["floor"]} 0 0 0</pose></waypoint>
      <waypoint><time>4</time><pose>{x} {y} {room["floor"]} 0 0 0</pose></waypoint>
      </trajectory></script></actor>'''
    text = path.read_text().replace('</world>', f'{actor}</world>')
    world = angen.World.from_text(text)
    world.run(2)
    begin = time.process_time()
    world.run(30)
    return 30 / max(time.process_time() - begin, 1e-9)


def show_table(rows: list[dict[str, Any]]) -> Any:
    """The rows as a table."""
    head = list(rows[0])
    return table(head, [[f'{v:.4g}' if isinstance(v, float) else str(v) for v in row.values()]
                        for row in rows])


def examine_seed(seed: int, folder: Path) -> list[str]:
    """The errors in the home of a seed: findings, shut doors, unreachable rooms."""
    from angen_apps.plan.apartment import apartment
    rooms, storeys = 1 + seed % 5, 1 + (seed % 4 == 3)
    return examine_plan(apartment(rooms, storeys, seed), folder / f'home{seed}.world', rooms + 3)


def examine_plan(plan: Plan, path: Path, rooms: int) -> list[str]:
    """The same of a plan, which is written to a file; `rooms` have doors on the lowest storey."""
    write_world(plan, path, 'seed')
    import angen
    world = angen.World(str(path))
    wrong = list(plan.remarks)
    wrong += [text for kind, text in world.home_findings() if kind == 'contradicting']
    states = open_all(world)
    wrong += [f'{kind} {name} is {mode}' for (kind, name), (mode, _, _) in states.items()
              if mode != 'OPEN']
    joined, found = reached(path, world.home)
    wrong += [f'{name} is not reached' for name in sorted(joined - found)]
    if len(joined) < rooms:
        wrong.append(f'only {len(joined)} rooms have doors')
    return wrong


def measure_seeds(count: int, folder: Path) -> list[dict[str, Any]]:
    """A row for each of these seeds that has an error, and one for all."""
    rows = []
    with Progress('homes', 0.05) as progress:
        for seed in range(count):
            progress.update(seed / count, f'seed {seed}')
            wrong = examine_seed(seed, folder)
            if wrong:
                rows.append({'seed': seed, 'wrong': '; '.join(wrong)})
                progress.note(f'seed {seed}: {"; ".join(wrong)}')
    return [*rows, {'seed': 'all', 'wrong': f'{len(rows)} of {count}'}]
