"""A sensor in Python: the distance straight ahead. See docs/plugins.md."""
import angen
import numpy as np


class Rangefinder(angen.Sensor):
    """Distance straight ahead, m."""

    fields = {'range': 'number m'}  # type and unit of what read() returns
    rate = 20.0  # readings per second, unless the SDF has an <update_rate>

    def configure(self, params, wiring):
        self.reach = params.number('reach', 5.0, 'm', 'farther is not seen', min=0.0)

    def aim(self, view):  # rows of origin, direction, least and greatest range, in the world
        return np.hstack([view.pose[:3], view.rotation[:, 0], [0.0, self.reach]])[None]

    def read(self, view, ranges, rng):
        return {'range': min(ranges[0], self.reach)}


angen.register('rangefinder.py', 'rangefinder', Rangefinder)
