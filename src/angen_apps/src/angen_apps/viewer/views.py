"""Views of rviz that show a whole world, and each of its floors from above."""
import copy
import re
from math import cos, sin, tan
from typing import Any, Sequence

import numpy as np

AROUND = np.array([400.0, 180.0])  # pixels of a window of angen.rviz around its picture
SMALLEST = 200.0  # pixels of a picture
FILLS = 0.94  # share of the picture
ROUNDS = 8  # to center a perspective
ORTHO_HEIGHT = 500.0  # m above the world's origin, where rviz has the camera of TopDownOrtho
BELOW_NEXT = 0.1  # m below the next floor, where the view of a floor cuts
STOREY = re.compile(r'(.*) (-?\d+)')  # names of displays of a storey: ceilings 0, Map 1


def framed(config: dict[str, Any], box: np.ndarray, storeys: Sequence[Any],
           screen: tuple[int, int] | None) -> dict[str, Any]:
    """angen.rviz with views of a world within `box`, namespaces and maps of its storeys, and a
    window that fits on the screen.

    `storeys` are those of angen_msgs/Home, from the lowest up; `screen` its size in pixels.
    """
    config = copy.deepcopy(config)
    window = config['Window Geometry']
    for name, pixels in zip(('Width', 'Height'), screen or ()):
        window[name] = min(window[name], pixels)
    panel = np.maximum(np.array([window['Width'], window['Height']]) - AROUND, SMALLEST)
    manager = config['Visualization Manager']
    numbers = [storey.number for storey in storeys] or [0]
    for display in manager['Displays']:
        if display.get('Namespaces'):
            display['Namespaces'] = _of_storeys(display['Namespaces'], numbers)
    maps = [display for display in manager['Displays'] if display['Class'] == 'rviz/Map']
    place = manager['Displays'].index(maps[0])
    others = [display for display in manager['Displays'] if display not in maps]
    manager['Displays'] = others[:place] + [
        {**maps[0], 'Name': f'Map {number}', 'Topic': f'floor{number}/map'}
        for number in numbers] + others[place:]
    views = manager['Views']
    whole = orbit(views['Current'], box, panel)
    views['Current'] = whole
    views['Saved'] = [{**copy.deepcopy(whole), 'Name': 'Whole building'}] + _floors(
        box, storeys, panel)
    return config


def _of_storeys(names: dict[str, bool], numbers: Sequence[int]) -> dict[str, bool]:
    """Sets the namespaces of all storeys as that of one storey."""
    found = {}
    for name, value in names.items():
        match = STOREY.fullmatch(name)
        for each in [f'{match[1]} {number}' for number in numbers] if match else [name]:
            found[each] = value
    return found


def orbit(view: dict[str, Any], box: np.ndarray, panel: np.ndarray) -> dict[str, Any]:
    """The same direction, at the distance and focus at which the box fills a picture of this size.
    """
    yaw, pitch = view['Yaw'], view['Pitch']
    axes = np.array([[-sin(yaw), cos(yaw), 0.0],
                     [-sin(pitch) * cos(yaw), -sin(pitch) * sin(yaw), cos(pitch)],
                     [cos(pitch) * cos(yaw), cos(pitch) * sin(yaw), sin(pitch)]])
    corners = np.array([[box[i][0], box[j][1], box[k][2]]
                        for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    half = FILLS * tan(view['Field of View'] / 2) * np.array([panel[0] / panel[1], 1.0])
    focus, distance = box.mean(axis=0), 0.0
    for _ in range(ROUNDS):
        seen = (corners - focus) @ axes.T  # right, up, towards the camera
        distance = float((seen[:, 2] + (abs(seen[:, :2]) / half).max(axis=1)).max())
        shares = seen[:, :2] / (distance - seen[:, 2:])
        middle = (shares.min(axis=0) + shares.max(axis=0)) / 2
        focus = focus + (middle * distance) @ axes[:2]
    place = dict(zip('XYZ', (round(float(value), 3) for value in focus)))
    return {**view, 'Distance': round(distance, 3), 'Focal Point': place}


def _floors(box: np.ndarray, storeys: Sequence[Any], panel: np.ndarray) -> list[dict[str, Any]]:
    """The view from above, without the parts that are higher than the floor."""
    views = []
    for i, storey in enumerate(storeys):
        top = (storeys[i + 1].elevation if i + 1 < len(storeys) else box[1][2] + 2 * BELOW_NEXT)
        views.append(_from_above(f'Floor {storey.number} from above', box, top - BELOW_NEXT,
                                 panel))
    return views or [_from_above('From above', box, box[1][2] + BELOW_NEXT, panel)]


def _from_above(name: str, box: np.ndarray, top: float, panel: np.ndarray) -> dict[str, Any]:
    middle, size = box.mean(axis=0), np.maximum(box[1] - box[0], 1.0)
    return {'Class': 'rviz/TopDownOrtho', 'Name': name, 'Angle': 0,
            'Near Clip Distance': round(ORTHO_HEIGHT - float(top), 3),
            'Scale': round(FILLS * float((panel / size[:2]).min()), 2),
            'Target Frame': 'world', 'Value': 'TopDownOrtho (rviz)',
            'X': round(float(middle[0]), 3), 'Y': round(float(middle[1]), 3)}
