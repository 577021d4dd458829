"""What a patrol knows before it starts: its own copy of the world, maps, doors, the whole route."""
from __future__ import annotations

import random
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree

from angen_tools.common.failure import Failure
from angen_tools.common.geometry import yaw_of
from angen_tools.maps.gridmap import STOREY, GridMap, floors, load_world, make_map
from angen_tools.maps.rays import Caster
from angen_tools.patrol.drive import Scene, floor_of, pose_of
from angen_tools.patrol.sight import beam_angles, outline
from angen_tools.robot.doors import find_door, find_hinge, find_top, link_poses
from angen_tools.robot.pilot import Pose
from angen_tools.robot.planner import Door, Planner
from angen_tools.robot.route import Action, Router
from angen_tools.robot.route_file import Route
from angen_tools.world import sdf

START_PLACE, START_YAW = 0.1, 0.1  # m, rad: how far a start may lie from the world's own


def start_offset(seed: int) -> tuple[float, float, float]:
    """How far from its place in the world the robot is put at the start: x, y (m), yaw (rad)."""
    chance = random.Random(seed)
    return (chance.uniform(-START_PLACE, START_PLACE), chance.uniform(-START_PLACE, START_PLACE),
            chance.uniform(-START_YAW, START_YAW))


def write_world(world: Path, robot: str, seed: int, to: Path) -> None:
    """Writes the world without its actors, the robot moved from its place by the seed."""
    root = sdf.read(world)
    for actor in root.findall('.//actor'):
        actor.getparent().remove(actor)
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
        for i, offset in zip((0, 1, 5), start_offset(seed)):
            values[i] += offset
        pose.text = ' '.join(f'{value:.9g}' for value in values)
    to.write_text(sdf.text(root))


class Survey:
    """A world's geometry: its floors' maps with doors open and shut, the doors, the robot."""

    def __init__(self, world: str, entities: list[Any], robot: Any, wanted: set[int]) -> None:
        self.world, shut = load_world(world), load_world(world)
        place = robot.pose.position
        self.body = outline(self.world, np.array([place.x, place.y, place.z,
                                                  yaw_of(robot.pose.orientation)]))
        self.maps: dict[int, GridMap] = {}
        self.landmarks: dict[int, GridMap] = {}
        shut_maps = {}
        for floor in sorted(wanted & set(floors(self.world))):
            self.maps[floor] = make_map(self.world, floor, 'open')
            shut_maps[floor] = make_map(shut, floor, 'shut')
            both = np.maximum(self.maps[floor].cells, shut_maps[floor].cells)
            self.landmarks[floor] = replace(shut_maps[floor], cells=both)
        self.doors: dict[int, list[Door]] = {floor: [] for floor in self.maps}
        by_model = {}
        opened_poses, shut_poses = link_poses(self.world), link_poses(shut)
        for entity in entities:
            floor = floor_of(entity.pose.position.z)
            if entity.kind != 'door' or floor not in self.maps:
                continue
            hinge = find_hinge(shut_poses[entity.model], opened_poses[entity.model])
            door = hinge and find_door(entity.name, hinge, shut_maps[floor], self.maps[floor])
            if door:
                door = replace(door, top=find_top(Caster(shut), door, STOREY * floor))
                self.doors[floor].append(door)
                by_model[entity.model] = door
        self.beams = beam_angles(shut, by_model, [e for e in entities if e.kind == 'switch'])


def make_scene(route: Route, world: str, entities: list[Any], offset: tuple[float, float, float]
               ) -> tuple[Scene, list[Action]]:
    """The scene and all actions; Failure names a waypoint that cannot be reached.

    The robot believes that it starts at its place in the original world, `offset` beside the truth.
    """
    robot = _one(entities, 'drive', route.robot, f'the world has no robot {route.robot}')
    laser = next((entity for entity in entities
                  if (entity.kind, entity.model) == ('lidar', robot.model)), None)
    if laser is None:
        raise Failure(f'the robot {route.robot} has no lidar, by which it finds its way')
    if route.elevator:
        _one(entities, 'elevator', route.elevator.name,
             f'{route.path}: the world has no elevator {route.elevator.name}')
    truth = pose_of(robot.pose)
    believed = Pose(truth.x - offset[0], truth.y - offset[1], truth.yaw - offset[2])
    floor = floor_of(robot.pose.position.z)
    survey = Survey(world, entities, robot, {floor} | {p.floor for p in route.waypoints})
    scene = Scene(believed, truth.inverse().then(pose_of(laser.pose)), laser.topic, robot.topic,
                  survey.maps, survey.landmarks, survey.doors, survey.beams, floor, survey.body,
                  survey.world)
    planners = {number: Planner(grid, route.clearance) for number, grid in survey.maps.items()}
    return scene, Router(route, planners, survey.doors).actions((believed.x, believed.y), floor)


def _one(entities: list[Any], kind: str, name: str, otherwise: str) -> Any:
    found = next((e for e in entities if (e.kind, e.name) == (kind, name)), None)
    if found is None:
        raise Failure(otherwise)
    return found
