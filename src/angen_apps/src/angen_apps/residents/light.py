"""The illuminance in a room by daylight through its window."""
from __future__ import annotations

import datetime
import math

from angen_tools.common.sun import sun

FACTOR = 0.015  # share of the light outside that comes to the eyes in a room with a window


def daylight(day: datetime.date, seconds: float, latitude: float) -> float:
    """lx at the eyes, under an overcast sky (Krochmann: 300 + 21000 sin of the elevation)."""
    midnight = datetime.datetime.combine(day, datetime.time())
    elevation, _ = sun(midnight + datetime.timedelta(seconds=seconds), latitude)
    up = math.sin(elevation)
    return FACTOR * (300.0 + 21000.0 * up) if up > 0 else 0.0
