"""A patrol's knowledge before it starts: a copy of the world, maps, doors, the whole route."""
import random
from dataclasses import dataclass
from typing import Any

import numpy as np
from angen import Grid

from angen_apps.maps.gridmap import load_world
from angen_apps.patrol.sight import beam_angles, door_beside, outline
from angen_apps.robot.building import Start, Survey, find_start
from angen_apps.robot.entities import Entity
from angen_apps.robot.planner import Door, Planner
from angen_apps.robot.route import Action, Router
from angen_apps.robot.route_file import Route
from angen_tools.common.home import Home

START_PLACE, START_YAW = 0.1, 0.1  # m, rad: how far a start may lie from the world's own


def start_offset(seed: int) -> tuple[float, float, float]:
    """The offset of the robot at the start from its place in the world: x, y (m), yaw (rad)."""
    chance = random.Random(seed)
    return (chance.uniform(-START_PLACE, START_PLACE), chance.uniform(-START_PLACE, START_PLACE),
            chance.uniform(-START_YAW, START_YAW))


@dataclass(frozen=True)
class Scene:
    """The robot's knowledge of the building before it starts, and the data of the report."""

    start: Start
    maps: dict[int, Grid]  # by floor, with doors open
    landmarks: dict[int, Grid]  # all that a laser may hit: leaves both open and shut
    doors: dict[int, list[Door]]
    beams: dict[str, float]  # a switch's: rad of its door from shut at which its beam is free
    body: np.ndarray  # (n, 3) points of the robot's surface, m
    world: Any  # angen.World without robots, for rays
    rooms: dict[str, str]  # each sensor's; a switch has its door, which is called after a room
    home: Home


def make_scene(route: Route, path: str, entities: list[Entity],
               offset: tuple[float, float, float], survey: Survey | None = None
               ) -> tuple[Scene, list[Action]]:
    """The scene and all actions; Failure names a waypoint that cannot be reached. Surveys the
    building if need be.

    The robot believes that it starts at its place in the original world, `offset` beside the truth.
    """
    start = find_start(route, entities, offset)
    world = load_world(path)
    body = outline(world, np.array([*start.robot.place, start.robot.flat.yaw]))
    used = {start.floor} | {p.floor for p in route.waypoints}
    survey = survey or Survey(world, load_world(path), used)
    maps = {floor: grid for floor, grid in survey.maps.items() if floor in used}
    doors = {floor: survey.doors[floor] for floor in maps}
    rooms = {e.name: (e.kind == 'switch' and door_beside(e, doors.get(e.floor, [])))
             or e.room or e.name for e in entities}
    switches = [e for e in entities if e.kind == 'switch']
    beams = beam_angles(survey.shut_world, doors, switches, rooms)
    scene = Scene(start, maps, survey.landmarks, doors, beams, body, survey.world, rooms,
                  survey.home)
    planners = {number: Planner(grid, route.clearance) for number, grid in maps.items()}
    return scene, Router(route, planners, doors).actions((start.pose.x, start.pose.y), start.floor)
