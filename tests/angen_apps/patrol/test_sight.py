"""Lines of sight by geometry."""
from __future__ import annotations

import math

import numpy as np

from angen_apps.patrol.sight import door_beside, hidden
from angen_apps.robot.building import Entity
from angen_apps.robot.planner import Door
from angen_apps.robot.views import View


def test_a_leaf_hides_what_is_behind_it_and_not_above() -> None:
    door = Door('d', (0.0, 0.0), 0.0, -math.pi / 2, 1.0, top=2.0)
    origin = np.array([0.5, -2.0, 2.5])
    points = np.array([[0.5, 2.0, 0.2], [0.5, 2.0, 2.4], [3.0, 2.0, 0.2], [0.5, -1.0, 0.2]])
    assert hidden(origin, points, door, np.zeros(4)).tolist() == [True, False, False, False]
    assert not hidden(origin, points, door, np.full(4, -1.57)).any()


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
