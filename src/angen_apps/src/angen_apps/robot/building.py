"""A robot's knowledge of a building before it starts: its floors' maps and doors, and itself."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Collection

import numpy as np
from angen import Grid
from lxml import etree

from angen_apps.maps.gridmap import floors, make_map
from angen_apps.robot.doors import door_of
from angen_apps.robot.entities import Entity
from angen_apps.robot.pilot import Pose
from angen_apps.robot.planner import Door
from angen_apps.robot.route_file import Route
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.home import Home
from angen_tools.common.nearest import did_you_mean
from angen_tools.world import sdf


class Survey:
    """A world's geometry: its floors' maps with doors open and shut, and its doors.

    `world` and `shut` are two worlds of the same file; it changes both: they lose robots and
    people, and their doors are open and shut; those named in `but` are shut in both.
    """

    def __init__(self, world: Any, shut: Any, only: set[int] | None = None,
                 but: Collection[str] = ()) -> None:
        self.world, self.shut_world = world, shut
        self.home = Home.of_world(world)
        self.maps: dict[int, Grid] = {}
        self.landmarks: dict[int, Grid] = {}
        self.shut: dict[int, Grid] = {}
        known = set(floors(world))
        for floor in sorted(known if only is None else only & known):
            self.maps[floor] = make_map(world, floor, 'open', but=but)
            self.shut[floor] = make_map(shut, floor, 'shut')
            both = np.maximum(self.maps[floor].cells, self.shut[floor].cells)
            self.landmarks[floor] = self.shut[floor].with_cells(both)
        self.doors: dict[int, list[Door]] = {floor: [] for floor in self.maps}
        for described in self.home.doors:
            floor = self.home.storey_at(described.pose[2])
            if described.kind == 'door' and floor in self.maps:
                self.doors[floor].append(door_of(described, shut.device('door', described.name)))


@dataclass(frozen=True)
class Start:
    """A robot at its start."""

    robot: Entity
    laser: Entity
    pose: Pose  # its own estimate
    mount: Pose  # the laser on the robot

    @property
    def floor(self) -> int:
        return self.robot.floor


def find_start(route: Route, entities: list[Entity], offset: tuple[float, float, float]) -> Start:
    """A route's robot, which believes that it starts `offset` beside the truth; Failure if the
    world lacks it, its lidar or its elevator."""
    robots = [entity.name for entity in entities if entity.kind == 'drive']
    otherwise = (did_you_mean(route.robot, robots, 'angen list --kind drive') if robots else
                 'include model://turtlebot in it under that name')
    robot = _one(entities, 'drive', route.robot,
                 f'the world has no robot {route.robot}; {otherwise}')
    laser = next((entity for entity in entities
                  if (entity.kind, entity.model) == ('lidar', robot.model)), None)
    if laser is None:
        raise Failure(f'the robot {route.robot} has no lidar, by which it finds its way')
    if route.elevator:
        _one(entities, 'elevator', route.elevator.name,
             f'{route.path}: the world has no elevator {route.elevator.name}')
    truth = robot.flat
    believed = Pose(truth.x - offset[0], truth.y - offset[1], truth.yaw - offset[2])
    return Start(robot, laser, believed, truth.inverse().then(laser.flat))


def _one(entities: list[Entity], kind: str, name: str, otherwise: str) -> Entity:
    found = next((e for e in entities if (e.kind, e.name) == (kind, name)), None)
    if found is None:
        raise Failure(otherwise)
    return found


def write_world(world: Path, robot: str, offset: tuple[float, float, float] | None, to: Path
                ) -> list[str]:
    """Writes a world without its people, the robot moved from its place; the people's names."""
    root = sdf.read(world)
    people = remove_actors(root)
    if offset is not None:
        move_robot(root, robot, offset, world)
    write_text(to, sdf.text(root))
    return people


def move_robot(root: etree._Element, robot: str, offset: tuple[float, float, float], world: Path
               ) -> None:
    """Moves a robot in a world's SDF: x, y (m), yaw (rad); Failure if there is none."""
    robots = [element for element in root.iter('include', 'model')
              if robot == (element.findtext('name') or element.get('name', '')).strip()]
    if not robots:
        raise Failure(f'{world}: has no robot {robot}')
    for element in robots:
        pose = element.find('pose')
        if pose is None:
            pose = etree.SubElement(element, 'pose')
            pose.text = '0 0 0 0 0 0'
        values = [float(word) for word in pose.text.split()]
        for i, by in zip((0, 1, 5), offset):
            values[i] += by
        pose.text = ' '.join(f'{value:.9g}' for value in values)


def remove_actors(root: etree._Element) -> list[str]:
    """Takes the people out of a world's SDF; their names."""
    actors = root.findall('.//actor')
    for actor in actors:
        actor.getparent().remove(actor)
    return [actor.get('name', '') for actor in actors]
