"""Views of rviz that show all of a world."""
from __future__ import annotations

from itertools import product
from math import cos, sin, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from angen_msgs.msg import HomeStorey

from angen_apps.viewer.views import PANEL, framed

CONFIG = yaml.safe_load(
    (Path(__file__).resolve().parents[3] / 'launch/angen.rviz').read_text())
FLATS = [HomeStorey(number=number, elevation=3.0 * number) for number in (-1, 0, 1)]
BOXES = [np.array([[0.0, 0.0, 0.0], [8.0, 6.0, 2.8]]), np.array([[-40.0, 10.0, -3.0], [60, 11, 9]]),
         np.array([[5.0, 5.0, 0.0], [5.2, 5.2, 30.0]])]


def pixels(view: dict[str, Any], box: np.ndarray) -> np.ndarray:
    """Shares of half the picture at which the corners are, by a camera that looks at its focus."""
    yaw, pitch = view['Yaw'], view['Pitch']
    focus = np.array([view['Focal Point'][axis] for axis in 'XYZ'])
    eye = focus + view['Distance'] * np.array(
        [cos(yaw) * cos(pitch), sin(yaw) * cos(pitch), sin(pitch)])
    ahead = (focus - eye) / np.linalg.norm(focus - eye)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    height = tan(view['Field of View'] / 2)
    width = height * PANEL[0] / PANEL[1]
    found = []
    for corner in product(*zip(*box)):
        away = np.array(corner) - eye
        assert away @ ahead > 0
        found.append([away @ right / (away @ ahead) / width, away @ up / (away @ ahead) / height])
    return np.array(found)


@pytest.mark.parametrize('box', BOXES)
def test_the_world_fills_the_picture_and_is_in_its_middle(box: np.ndarray) -> None:
    view = framed(CONFIG, box, FLATS)['Visualization Manager']['Views']['Current']
    shown = pixels(view, box)
    assert 0.85 < abs(shown).max() < 1.0
    assert np.allclose(shown.min(axis=0), -shown.max(axis=0), atol=0.05)


@pytest.mark.parametrize('box', BOXES)
def test_each_floor_has_a_view_from_above(box: np.ndarray) -> None:
    saved = framed(CONFIG, box, FLATS)['Visualization Manager']['Views']['Saved']
    assert [view['Name'] for view in saved] == [
        'Whole building', 'Floor -1 from above', 'Floor 0 from above', 'Floor 1 from above']
    assert [500 - view['Near Clip Distance'] for view in saved[1:3]] == pytest.approx([-0.1, 2.9])
    assert 500 - saved[3]['Near Clip Distance'] > box[1][2]
    for view in saved[1:]:
        half = np.array(PANEL) / 2 / view['Scale']  # m
        assert np.all([view['X'], view['Y']] - half < box[0][:2])
        assert np.all([view['X'], view['Y']] + half > box[1][:2])


def test_namespaces_and_maps_are_those_of_the_floors() -> None:
    displays = framed(CONFIG, BOXES[0], FLATS)['Visualization Manager']['Displays']
    building, = (display for display in displays if display['Name'] == 'Building')
    off = {name for name, shown in building['Namespaces'].items() if not shown}
    assert {'ground', 'ceilings -1', 'windows south 0', 'readings 1'} <= off
    assert not any(name.endswith(' 2') for name in off)
    assert [display['Topic'] for display in displays if display['Class'] == 'rviz/Map'] == [
        '/floor-1/map', '/floor0/map', '/floor1/map']


def test_a_world_without_floors_is_seen_from_above() -> None:
    saved = framed(CONFIG, BOXES[0], [])['Visualization Manager']['Views']['Saved']
    assert [view['Name'] for view in saved] == ['Whole building', 'From above']
