"""Lines of sight by geometry."""
import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from angen_apps.maps.gridmap import load_world
from angen_apps.patrol.sight import beam_angles, door_beside, hidden
from angen_apps.robot.building import Survey
from angen_apps.robot.entities import Entity, entities_of
from angen_apps.robot.planner import Door
from angen_apps.robot.views import View
from angen_tools.session.in_process import InProcess


def test_a_leaf_hides_things_behind_it_and_not_above_or_on_a_lower_floor() -> None:
    door = Door('d', (0.0, 0.0), 0.0, -math.pi / 2, 1.0, top=2.0)
    origin = np.array([0.5, -2.0, 2.5])
    points = np.array([[0.5, 2.0, 0.2], [0.5, 2.0, 2.4], [3.0, 2.0, 0.2], [0.5, -1.0, 0.2]])
    assert hidden(origin, points, door, np.zeros(4)).tolist() == [True, False, False, False]
    assert not hidden(origin, points, door, np.full(4, -1.57)).any()
    upper = replace(door, bottom=4.0, top=6.0)
    assert not hidden(origin, points, upper, np.zeros(4)).any()


def test_a_view_has_angles_and_a_reach() -> None:
    view = View(np.zeros(3), np.eye(3), math.pi / 4, 0.1, 5.0)
    points = np.array([[1, 0, 0], [1, 0.9, 0], [1, 1.1, 0], [6, 0, 0], [1, 0, 0.5], [-1, 0, 0]])
    assert view.holds(points).tolist() == [True, True, False, False, False, False]


def test_a_switch_belongs_to_the_door_under_it() -> None:
    doors = [Door('kitchen0', (2.4, 3.94), 0.0, -1.57, 1.0),
             Door('hall0', (4.4, 3.94), 0.0, -1.57, 1.0)]

    def switch(x: float, y: float) -> Entity:
        return Entity('switch', 's', 's', (x, y, 2.125, 0, 0, 0, 1))

    assert door_beside(switch(2.65, 3.94), doors) == 'kitchen0'
    assert door_beside(switch(4.9, 3.9), doors) == 'hall0'
    assert door_beside(switch(2.65, 2.0), doors) == ''
    assert door_beside(switch(0, 0), []) == ''


def test_a_beam_comes_free_at_the_same_angle_of_all_doors_alike() -> None:
    path = str(Path(__file__).resolve().parents[3] / 'worlds/angen.world')
    world, shut = load_world(path), load_world(path)
    switches = [e for e in entities_of(InProcess(shut)) if e.kind == 'switch' and e.floor == 0]
    survey = Survey(world, shut, {0})
    rooms = {e.name: door_beside(e, survey.doors[0]) for e in switches}
    angles = beam_angles(shut, survey.doors, switches, rooms)
    # to some ticks; the state that a door publishes is up to 20 ms older
    assert set(angles) == {e.name for e in switches} and len(angles) == 6
    assert max(angles.values()) - min(angles.values()) < 0.001
    assert 0.012 < min(angles.values()) < 0.017
