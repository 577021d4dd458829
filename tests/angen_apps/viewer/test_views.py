"""Views of rviz that show all of a world."""
from itertools import product
from math import cos, sin, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from angen_msgs.msg import HomeStorey

from angen_apps.viewer.views import framed

CONFIG = yaml.safe_load(
    (Path(__file__).resolve().parents[3] / 'launch/angen.rviz').read_text())
FLATS = [HomeStorey(number=number, elevation=3.0 * number) for number in (-1, 0, 1)]
BOXES = [np.array([[0.0, 0.0, 0.0], [8.0, 6.0, 2.8]]), np.array([[-40.0, 10.0, -3.0], [60, 11, 9]]),
         np.array([[5.0, 5.0, 0.0], [5.2, 5.2, 30.0]])]

# The size of a screen, and that of rviz's picture on it.
PANELS = [(None, (1000, 720)), ((1920, 1080), (1000, 720)), ((1024, 768), (624, 588))]


def pixels(view: dict[str, Any], box: np.ndarray, panel: tuple[int, int]) -> np.ndarray:
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
    width = height * panel[0] / panel[1]
    found = []
    for corner in product(*zip(*box)):
        away = np.array(corner) - eye
        assert away @ ahead > 0
        found.append([away @ right / (away @ ahead) / width, away @ up / (away @ ahead) / height])
    return np.array(found)


def views(box: np.ndarray, screen: tuple[int, int] | None) -> Any:
    return framed(CONFIG, box, FLATS, screen)['Visualization Manager']['Views']


@pytest.mark.parametrize('screen, panel', PANELS)
@pytest.mark.parametrize('box', BOXES)
def test_the_world_fills_the_picture_and_is_in_its_middle(
        box: np.ndarray, screen: tuple[int, int] | None, panel: tuple[int, int]) -> None:
    shown = pixels(views(box, screen)['Current'], box, panel)
    assert 0.85 < abs(shown).max() < 1.0
    assert np.allclose(shown.min(axis=0), -shown.max(axis=0), atol=0.05)


@pytest.mark.parametrize('screen, panel', PANELS)
@pytest.mark.parametrize('box', BOXES)
def test_each_floor_has_a_view_from_above(box: np.ndarray, screen: tuple[int, int] | None,
                                          panel: tuple[int, int]) -> None:
    saved = views(box, screen)['Saved']
    assert [view['Name'] for view in saved] == [
        'Whole building', 'Floor -1 from above', 'Floor 0 from above', 'Floor 1 from above']
    assert [500 - view['Near Clip Distance'] for view in saved[1:3]] == pytest.approx([-0.1, 2.9])
    assert 500 - saved[3]['Near Clip Distance'] > box[1][2]
    for view in saved[1:]:
        half = np.array(panel) / 2 / view['Scale']  # m
        assert np.all([view['X'], view['Y']] - half < box[0][:2])
        assert np.all([view['X'], view['Y']] + half > box[1][:2])


def test_the_window_fits_on_the_screen() -> None:
    for screen, size in ((None, (1400, 900)), ((1024, 768), (1024, 768)),
                         ((1920, 1080), (1400, 900)), ((1280, 1024), (1280, 900))):
        window = framed(CONFIG, BOXES[0], FLATS, screen)['Window Geometry']
        assert (window['Width'], window['Height']) == size


def test_namespaces_and_maps_are_those_of_the_floors() -> None:
    displays = framed(CONFIG, BOXES[0], FLATS, None)['Visualization Manager']['Displays']
    building, = (display for display in displays if display['Name'] == 'Building')
    off = {name for name, shown in building['Namespaces'].items() if not shown}
    assert {'ground', 'ceilings -1', 'windows south 0', 'readings 1'} <= off
    assert not any(name.endswith(' 2') for name in off)
    assert [display['Topic'] for display in displays if display['Class'] == 'rviz/Map'] == [
        'floor-1/map', 'floor0/map', 'floor1/map']


def test_a_world_without_floors_is_seen_from_above() -> None:
    saved = framed(CONFIG, BOXES[0], [], None)['Visualization Manager']['Views']['Saved']
    assert [view['Name'] for view in saved] == ['Whole building', 'From above']
