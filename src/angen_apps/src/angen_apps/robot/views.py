"""The fields of view of a building's sensors, by their SDF."""
import math
from dataclasses import dataclass

import numpy as np
from lxml import etree

from angen_apps.robot.entities import Entity
from angen_tools.world import sdf
from angen_tools.world.models import find

FAR = 20.0  # m: how far a sensor without a range sees


@dataclass(frozen=True)
class View:
    """A field of view: half angles about its x axis (rad) and reach (m)."""

    position: np.ndarray  # (3,)
    rotation: np.ndarray  # (3, 3), sensor to world
    left: float
    up: float
    reach: float

    def holds(self, points: np.ndarray) -> np.ndarray:
        """Which of the points (n, 3) lie in it."""
        local = (points - self.position) @ self.rotation
        yaw = np.arctan2(local[:, 1], local[:, 0])
        pitch = np.arctan2(local[:, 2], np.hypot(local[:, 0], local[:, 1]))
        return ((np.linalg.norm(local, axis=1) <= self.reach) & (np.abs(yaw) <= self.left)
                & (np.abs(pitch) <= self.up))


def sensor_element(world: etree._Element, entity: Entity) -> etree._Element | None:
    """The <sensor> of an entity's kind in a world's file; None if it is not found there."""
    for entry in world.iterfind('world/*'):
        if (entry.findtext('name') or entry.get('name', '')).strip() != entity.model:
            continue
        if entry.tag == 'include':
            file = find(entry.findtext('uri', '').strip())
            entry = sdf.read(file) if file and file.exists() else entry
        return next(iter(entry.iter('sensor')), None)
    return None


def view_of(entity: Entity, sensor: etree._Element | None) -> View:
    """The view of a PIR by its <ray>, its nodding included; of another sensor all that is ahead."""
    at, turned = entity.place, entity.rotation
    if entity.kind != 'pir' or sensor is None:
        return View(at, turned, math.pi / 2, math.pi / 2, FAR)
    up = (_number(sensor, 'ray/scan/vertical/max_angle', 0.0)
          + _number(sensor, 'plugin/nod_amplitude', 0.0))
    return View(at, turned, _number(sensor, 'ray/scan/horizontal/max_angle', math.pi / 4), up,
                _number(sensor, 'ray/range/max', 6.0))


def _number(element: etree._Element, path: str, fallback: float) -> float:
    return float(element.findtext(path) or fallback)
