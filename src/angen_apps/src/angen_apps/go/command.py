"""angen go: sends the robot of the running simulator to a room."""
import math
import os
import re
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Collection, Mapping, Sequence

from lxml import etree

from angen_apps.go.live_robot import LiveRobot
from angen_apps.go.trip import Goal, Trip
from angen_apps.maps.gridmap import load_world
from angen_apps.robot.building import Start, Survey, find_start
from angen_apps.robot.entities import Entity, entities_of
from angen_apps.robot.planner import Planner
from angen_apps.robot.route import Ride, Turn
from angen_apps.robot.rooms_route import lift_of
from angen_apps.robot.route_file import NUMBERS, Route, Waypoint
from angen_tools.common.catalog import kinds
from angen_tools.common.failure import Failure, WrongWords
from angen_tools.common.files import write_text
from angen_tools.common.home import Home, Room
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.output import as_json
from angen_tools.common.progress import Progress
from angen_tools.common.verbs import comma_hint
from angen_tools.session.live import Live

ASTRAY = 0.5  # m: a robot farther from its goal has not arrived
MISSING_LIBRARY = re.compile(r'plug-in library (\S+) is not found')
REACH = 2.0  # m from the middle of a room to the nearest free place for the robot


@dataclass(frozen=True)
class Arrived:
    """A drive in numbers: m, s of simulated time; `error_m` from the goal to the robot's place."""

    goal: str
    floor: int
    x_m: float
    y_m: float
    time_s: float
    distance_m: float
    doors: int
    rides: int
    error_m: float
    goal_x_m: float
    goal_y_m: float
    tries: int


def go(words: Sequence[str], robot: str, json: bool) -> int:
    """Drives to a room, or to X Y [FLOOR]; 0 once it is there. Failure says why it is not."""
    world = Live()
    check(words, world.home)  # before the survey, which takes seconds
    robots = [entity.name for entity in world.entities('drive')]
    if not robots:
        raise Failure('the world has no robot; angen spawn model turtlebot turtlebot adds one')
    if robot and robot not in robots:
        raise Failure(f'the world has no robot {robot}; {did_you_mean(robot, robots)}')
    with tempfile.TemporaryDirectory(prefix='angen_go_') as folder:
        place = Surveyed(world, Path(folder) / 'now.world')
    route = Route(Path('angen go'), [], robot or robots[0], elevator=None,
                  **{key: usual for key, (_, _, usual) in NUMBERS.items()})
    start = find_start(route, place.entities, (0.0, 0.0, 0.0))
    arrived = drive(world, route, lambda planners: goal_of(words, place.home, planners), place,
                    start)
    if arrived.error_m > ASTRAY:
        raise Failure(f'{route.robot} is at {arrived.x_m:.2f}, {arrived.y_m:.2f}, '
                      f'{arrived.error_m:.2f} m from {arrived.goal}: its estimate is wrong')
    print(as_json(asdict(arrived)) if json else
          f'{route.robot} is in {arrived.goal}: {arrived.distance_m:.1f} m in '
          f'{arrived.time_s:.1f} s, doors: {arrived.doors}, rides: {arrived.rides}, '
          f'{100 * arrived.error_m:.0f} cm from x '
          f'{arrived.goal_x_m:.2f}, y {arrived.goal_y_m:.2f} m'
          + (f'; {arrived.tries} tries' if arrived.tries > 1 else ''))
    return 0


class Surveyed:
    """The maps and doors of the running world as it is now, and its home."""

    def __init__(self, running: Live, path: Path) -> None:
        import rospy
        foreign = {entity.model for entity in running.entities()
                   if entity.topic and entity.kind not in kinds()}
        saved = without(running.save(), foreign)
        source = rospy.get_param('angen/world', '')
        paths = [str(Path(source).parent / 'models'), os.environ.get('ANGEN_MODEL_PATH', '')]
        os.environ['ANGEN_MODEL_PATH'] = ':'.join(filter(None, paths))
        world, shut = loaded(path, saved), loaded(path, saved)
        self.home = Home.of_world(world)
        self.entities = entities_of(running)
        for one in (world, shut):
            for entity in self.entities:
                if entity.kind == 'drive':
                    one.delete(entity.model)
        self.survey = Survey(world, shut)


def loaded(path: Path, xml: str) -> Any:
    """Writes a world that this process can load, without the plug-ins whose libraries only its
    node finds; returns it loaded."""
    while True:
        write_text(path, xml)
        try:
            return load_world(str(path), allow_paths=True)  # its node has read the same files
        except Failure as failure:
            found = MISSING_LIBRARY.search(str(failure))
            world = etree.fromstring(xml.encode())
            missing = [part for part in world.iter('plugin')
                       if found and part.get('filename') == found[1]]
            if not missing:
                raise
            for part in missing:
                part.getparent().remove(part)
            xml = etree.tostring(world, encoding='unicode')


def without(xml: str, models: Collection[str]) -> str:
    """A world without the sensors and devices of some models, whose plug-ins only its node has."""
    world = etree.fromstring(xml.encode())
    for model in list(world.iter('model', 'include')):
        if (model.get('name') or model.findtext('name')) in models:
            parts = [model] if model.tag == 'include' else list(model.iter('sensor', 'plugin'))
            for part in parts:
                part.getparent().remove(part)
    return etree.tostring(world, encoding='unicode')


def goal_of(words: Sequence[str], home: Home, planners: Mapping[int, Planner]) -> Waypoint:
    """The goal that the words of the command name: of a room the free place nearest to its
    middle."""
    found = named(words, home)
    if isinstance(found, Room):
        planner = planners.get(found.storey)
        at = planner.nearest(found.center, REACH) if planner else None
        if at is None or not found.contains(*at):
            raise Failure(f'the robot finds no free place in {found.name}')
        return Waypoint(found.name, found.storey, at, 0)
    floor = found[2] if len(found) == 3 else 0.0
    if floor not in planners:
        raise Failure(f'there is no floor {floor:g}; known are {", ".join(map(str, planners))}')
    return Waypoint(f'{found[0]:g} {found[1]:g}', int(floor), (found[0], found[1]), 0)


def check(words: Sequence[str], home: Home) -> None:
    """Failure if the words name no room or floor of a home."""
    found = named(words, home)
    if isinstance(found, Room) or len(found) < 3 or not home.described:
        return
    if found[2] not in (known := [storey.number for storey in home.storeys]):
        raise Failure(f'there is no floor {found[2]:g}; known are {", ".join(map(str, known))}')


def named(words: Sequence[str], home: Home) -> Room | list[float]:
    """The room that the words name, or the two or three numbers that they are."""
    name = ' '.join(words)
    if len(words) > 3:
        raise WrongWords(f"'{name}' has {len(words)} words; give ROOM or X Y [FLOOR]")
    room = next((room for room in home.rooms if room.name == name), None)
    if room is not None:
        return room
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) not in (2, 3) or not all(map(math.isfinite, numbers)):
        raise Failure(f"'{name}' is neither a room nor X Y [FLOOR]; "
                      + did_you_mean(name, [room.name for room in home.rooms], 'angen home')
                      + comma_hint(name))
    return numbers


def drive(world: Live, route: Route, goal: Goal, place: Surveyed, start: Start) -> Arrived:
    """Drives to a goal in the time of the running simulator."""
    devices = [('door', door.name) for doors in place.survey.doors.values() for door in doors]
    devices += [('elevator', lift.name) for lift in place.home.elevators]
    with LiveRobot(world, start, devices) as robot, Progress('go', 0.01) as progress:
        began = robot.now
        trip = Trip(robot, route, place.survey, start, goal,
                    lambda floor, planner: lift_of(place.home, planner, floor),
                    lambda line: progress.note(f'go: {line}'), progress.update)
        try:
            reached = trip.run()
        except Failure as problem:
            raise Failure(f'{problem}{empty(world, route.robot, place.entities)}') from None
        took = robot.now - began
    x, y = next(entity.pose[:2] for entity in world.entities('drive')
                if entity.name == route.robot)
    return Arrived(reached.name, reached.floor, x, y, took, trip.distance,
                   len({action.door for action in trip.done if isinstance(action, Turn)}),
                   sum(isinstance(action, Ride) and action.aboard for action in trip.done),
                   math.dist((x, y), reached.at), *reached.at, trip.tries)


def empty(world: Live, robot: str, entities: Sequence[Entity]) -> str:
    """The text to add to a failure if the robot's battery is empty."""
    models = [entity.model for entity in entities if (entity.kind, entity.name) == ('drive', robot)]
    for battery in entities:
        if battery.kind == 'battery' and battery.model in models:
            if world.state('battery', battery.name)['percentage'] <= 0.0:
                return f'; its battery is empty: angen set battery {battery.name} charge 100'
    return ''
