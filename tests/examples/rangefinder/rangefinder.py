"""A sensor in Python: the distance straight ahead. See docs/plugins.md."""
from typing import Any

import angen
import numpy as np


class Rangefinder(angen.Sensor):
    """Distance straight ahead, m."""

    fields = {'range': 'number m'}  # type and unit of what read() returns
    rate = 20.0  # readings per second, unless the SDF has an <update_rate>

    def configure(self, params: Any, wiring: Any) -> None:
        self.reach = params.number('reach', 5.0, 'm', 'farther is not seen', min=0.0)

    # Rows of origin, direction, least and greatest range, in the world.
    def aim(self, view: Any) -> np.ndarray:
        return np.hstack([view.pose[:3], view.rotation[:, 0], [0.0, self.reach]])[None]

    def read(self, view: Any, ranges: np.ndarray, rng: Any) -> dict[str, float]:
        return {'range': min(ranges[0], self.reach)}


angen.register('rangefinder.py', 'rangefinder', Rangefinder)
