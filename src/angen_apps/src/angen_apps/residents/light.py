"""The illuminance in a room by daylight through its window."""
from __future__ import annotations

import datetime
import math

from angen_tools.common.home import Home
from angen_tools.common.sun import sun

LATITUDE = 48.0  # degrees, of homes without a latitude of their own
FACTOR = 0.015  # share of the light outside that comes to the eyes in a room with a window


def latitude_of(home: Home) -> float:
    return LATITUDE if home.latitude is None else home.latitude


def daylight_in(home: Home, room: str, day: datetime.date, seconds: float) -> float:
    """lx of daylight in a room; 0 in one without a window, where other rooms have some."""
    windows = [door for door in home.doors if door.kind == 'window']
    if windows and not any(room in door.rooms for door in windows):
        return 0.0
    return daylight(day, seconds, latitude_of(home))


def daylight(day: datetime.date, seconds: float, latitude: float) -> float:
    """lx at the eyes, under an overcast sky (Krochmann: 300 + 21000 sin of the elevation)."""
    midnight = datetime.datetime.combine(day, datetime.time())
    elevation, _ = sun(midnight + datetime.timedelta(seconds=seconds), latitude)
    up = math.sin(elevation)
    return FACTOR * (300.0 + 21000.0 * up) if up > 0 else 0.0
