"""angen go: sends the robot of the running simulator to a room."""
from __future__ import annotations

import math
import os
import tempfile
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Mapping, Sequence

from angen_apps.go.live_robot import LiveRobot
from angen_apps.maps.gridmap import load_world
from angen_apps.robot.building import Start, Survey, entity_of, find_start
from angen_apps.robot.driver import Driver
from angen_apps.robot.planner import Planner
from angen_apps.robot.route import Action, Drive, Ride, Router, Turn
from angen_apps.robot.route_file import NUMBERS, Lift, Route, Waypoint
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.home import Home
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.output import as_json
from angen_tools.common.progress import Progress
from angen_tools.live.client import Client


REACH = 2.0  # m from the middle of a room to where the robot can stand


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


def go(words: Sequence[str], robot: str, json: bool) -> int:
    """Drives to a room, or to X Y [FLOOR]; 0 once it is there. Failure says why it is not."""
    client = Client()
    robots = [entity.name for entity in client.entities('drive')]
    if not robots:
        raise Failure('the world has no robot; angen spawn model turtlebot turtlebot adds one')
    with tempfile.TemporaryDirectory(prefix='angen_go_') as folder:
        place = Surveyed(client, Path(folder) / 'now.world')
    route = Route(Path('angen go'), [], robot or robots[0], elevator=None,
                  **{key: usual for key, (_, _, usual) in NUMBERS.items()})
    start = find_start(route, place.entities, (0.0, 0.0, 0.0))
    planners = {number: Planner(grid, route.clearance)
                for number, grid in place.survey.maps.items()}
    goal = goal_of(words, place.home, planners)
    route = replace(route, elevator=lift_of(place.home, start.floor), waypoints=[goal])
    actions = Router(route, planners, place.survey.doors).actions((start.pose.x, start.pose.y),
                                                                  start.floor)
    arrived = drive(client, route, goal, place.survey, start, actions)
    print(as_json(asdict(arrived)) if json else
          f'{route.robot} is in {arrived.goal}: {arrived.distance_m:.1f} m in '
          f'{arrived.time_s:.1f} s, {arrived.doors} doors, {arrived.rides} rides, '
          f'{100 * arrived.error_m:.0f} cm from {goal.at[0]:.2f}, {goal.at[1]:.2f}')
    return 0


class Surveyed:
    """The maps and doors of the running world as it is now, and its home."""

    def __init__(self, client: Client, path: Path) -> None:
        import rospy
        from angen_msgs.srv import Save
        write_text(path, client.call('/angen/save', Save).xml)
        source = rospy.get_param('/angen/world', '')
        paths = [str(Path(source).parent / 'models'), os.environ.get('ANGEN_MODEL_PATH', '')]
        os.environ['ANGEN_MODEL_PATH'] = ':'.join(filter(None, paths))
        world, shut = load_world(str(path)), load_world(str(path))
        self.home = Home.of_world(world)
        self.entities = [entity_of(message, self.home) for message in client.entities()]
        for one in (world, shut):
            for entity in self.entities:
                if entity.kind == 'drive':
                    one.delete(entity.model)
        self.survey = Survey(world, shut, self.entities, None)


def goal_of(words: Sequence[str], home: Home, planners: Mapping[int, Planner]) -> Waypoint:
    """The goal that the words of the command name: of a room the free place nearest to its
    middle."""
    name = ' '.join(words)
    room = next((room for room in home.rooms if room.name == name), None)
    if room is not None:
        planner = planners.get(room.storey)
        at = planner.nearest(room.center, REACH) if planner else None
        if at is None or not room.contains(*at):
            raise Failure(f'the robot finds no room to stand in {name}')
        return Waypoint(name, room.storey, at, 1)
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) not in (2, 3) or not all(map(math.isfinite, numbers)):
        raise Failure(f"'{name}' is neither a room nor X Y [FLOOR]; "
                      + did_you_mean(name, [room.name for room in home.rooms], 'angen home'))
    floor = numbers[2] if len(numbers) == 3 else 0.0
    if floor not in planners:
        raise Failure(f'there is no floor {floor:g}; known are {", ".join(map(str, planners))}')
    return Waypoint(f'{numbers[0]:g} {numbers[1]:g}', int(floor), (numbers[0], numbers[1]), 1)


def lift_of(home: Home, floor: int) -> Lift | None:
    """The first elevator, and where the robot waits for it on its floor."""
    for lift in home.elevators:
        for landing in lift.landings:
            if landing.storey == floor:
                return Lift(lift.name, lift.pose[:2], landing.pose[:2])
    return None


def drive(client: Client, route: Route, goal: Waypoint, survey: Survey, start: Start,
          actions: list[Action]) -> Arrived:
    """Does the actions in the time of the running simulator."""
    doors = sorted({action.door for action in actions if isinstance(action, Turn)})
    devices = [('door', name) for name in doors]
    rides = [action for action in actions if isinstance(action, Ride)]
    if rides and route.elevator:
        devices.append(('elevator', route.elevator.name))
    length = sum(math.dist(a, b) for action in actions if isinstance(action, Drive)
                 for a, b in zip(action.points, action.points[1:]))
    with LiveRobot(client, start, devices) as robot, Progress('go') as progress:
        driver = Driver(robot, route, survey.landmarks, start.mount,
                        lambda: progress.update(share, driver.text))
        share, began = 0.0, robot.now
        driver.begin(start.pose, start.floor)
        for number, action in enumerate(actions):
            share = number / len(actions)
            driver.do(action)
        took = robot.now - began
    at = next(message.pose.position for message in client.entities('drive')
              if message.name == route.robot)
    return Arrived(goal.name, goal.floor, at.x, at.y, took, length,
                   len(doors), sum(ride.aboard for ride in rides),
                   math.dist((at.x, at.y), goal.at))
